// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <cstdint>

#include "tools/commands.h"

namespace throng::tools {

CLI::Validator whole_number() {
  const auto check = [](std::string& text) -> std::string {
    std::int64_t number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc::result_out_of_range) return text + " is out of range";
    if (error != std::errc() || stop != end) return "'" + text + "' is no whole number";
    text = std::to_string(number);
    return {};
  };
  return {check, ""};
}

CLI::Validator real_number() {
  const auto check = [](std::string& text) -> std::string {
    double number = 0.0;
    const char* end = text.data() + text.size();
    const char* begin = text.data() + (text.size() > 1 && text.front() == '+' && text[1] != '-');
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (text.empty()) return "a value is missing";
    if (error == std::errc::result_out_of_range) return text + " is out of range";
    if (error != std::errc() || stop != end || std::isnan(number)) return "'" + text + "' is no number";
    return {};
  };
  return {check, ""};
}

}  // namespace throng::tools
