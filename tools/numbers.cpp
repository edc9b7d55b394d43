// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "tools/commands.h"

namespace throng::tools {

namespace {

/// The whole number that `text` is, or why it is none.
std::string read_whole(const std::string& text, std::int64_t& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc::result_out_of_range) return text + " is out of range";
  return error != std::errc() || stop != end ? "'" + text + "' is no whole number" : "";
}

std::string read_real(const std::string& text, double& number) {
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (text.size() > 1 && text.front() == '+' && text[1] != '-');
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (text.empty()) return "a value is missing";
  if (error == std::errc::result_out_of_range) return text + " is out of range";
  return error != std::errc() || stop != end || std::isnan(number) ? "'" + text + "' is no number" : "";
}

std::string range_text(double low, double high) {
  char text[80];
  std::snprintf(text, sizeof text, "%.15g to %.15g", low, high);
  return text;
}

}  // namespace

CLI::Validator whole_number() {
  const auto check = [](std::string& text) {
    std::int64_t number = 0;
    std::string fault = read_whole(text, number);
    if (fault.empty()) text = std::to_string(number);
    return fault;
  };
  return {check, ""};
}

CLI::Validator whole_number(std::int64_t low, std::int64_t high) {
  const std::string range = std::to_string(low) + " to " + std::to_string(high);
  const auto check = [=](std::string& text) -> std::string {
    std::int64_t number = 0;
    if (!read_whole(text, number).empty() || number < low || number > high)
      return "must be a whole number from " + range + ", not '" + text + "'";
    text = std::to_string(number);
    return {};
  };
  return {check, range};
}

CLI::Validator real_number() {
  const auto check = [](std::string& text) {
    double number = 0.0;
    return read_real(text, number);
  };
  return {check, ""};
}

CLI::Validator real_number(double low, double high) {
  const std::string range = range_text(low, high);
  const auto check = [=](std::string& text) -> std::string {
    double number = 0.0;
    if (read_real(text, number).empty() && number >= low && number <= high) return {};
    return "must be a number from " + range + ", not '" + text + "'";
  };
  return {check, range};
}

}  // namespace throng::tools
