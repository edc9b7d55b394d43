// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

/// Texts for a terminal.
namespace throng::tools {

/// Names and texts come from strangers: nothing of theirs may steer the terminal.
inline std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

/// The shortest text that reads back as the same number.
inline std::string text_of(double number) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

/// The double nearest to the number's first 15 digits: 0.3 where 3 * 0.1 is a little more. For times, steps
/// times dt, as people read them.
inline double rounded(double number) {
  char digits[32];
  const char* end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 15).ptr;
  std::from_chars(digits, end, number);
  return number;
}

/// "1 wall", "2 walls".
inline std::string counted(std::int64_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

/// "1 body", "2 bodies".
inline std::string counted_bodies(std::size_t n) {
  return std::to_string(n) + (n == 1 ? " body" : " bodies");
}

}  // namespace throng::tools
