// SPDX-License-Identifier: MIT
#include "tools/bench/options.h"

#include <regex.h>

#include <algorithm>
#include <filesystem>

#include "sim/input_error.h"

namespace throng::bench {

namespace {

bool holds(const std::string& name, const std::string& expression) {
  regex_t compiled;
  if (const int fault = regcomp(&compiled, expression.c_str(), REG_EXTENDED | REG_NOSUB); fault != 0) {
    char reason[128];
    regerror(fault, &compiled, reason, sizeof reason);
    throw InputError("--only " + expression + ": not a regular expression: " + reason);
  }
  const bool result = regexec(&compiled, name.c_str(), 0, nullptr, 0) == 0;
  regfree(&compiled);
  return result;
}

}  // namespace

std::string of_clone(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  for (fs::path clone = program.parent_path(); clone.has_relative_path(); clone = clone.parent_path())
    if (fs::exists(clone / "scenarios/pile.toml", none)) return clone / folder;
  return fs::path(THRONG_SOURCE) / folder;
}

bool chosen(const std::string& name, const Options& options) {
  const auto is_meant = [&](const std::string& expression) { return holds(name, expression); };
  if (options.only.empty() || std::ranges::any_of(options.only, is_meant)) return *options.any_chosen = true;
  options.passed_over->push_back(name);
  return false;
}

}  // namespace throng::bench
