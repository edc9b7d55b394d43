// SPDX-License-Identifier: MIT
#include "scenarios/path.h"

#include <algorithm>

#include "scenarios/report.h"

namespace throng::scenarios {

bool is_bare_key(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

std::string Path::text() const {
  if (!parent_) return "";
  std::string result = parent_->text();
  if (index_ != kNoIndex) return result + "[" + std::to_string(index_) + "]";
  if (!result.empty()) result += ".";
  return result + (is_bare_key(key_) && key_.size() <= 64 ? std::string(key_) : in_quotes(key_));
}

}  // namespace throng::scenarios
