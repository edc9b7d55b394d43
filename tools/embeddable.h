// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace throng::tools {

inline constexpr std::string_view kGiven = "@GIVEN@";  ///< where a page's template takes its JSON

/// JSON that may stand in a script element of a page: no text in it can end the element.
template <class Json>
std::string embeddable(const Json& json) {
  std::string safe;
  for (char c : json.dump(-1, ' ', false, Json::error_handler_t::replace))
    c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

}  // namespace throng::tools
