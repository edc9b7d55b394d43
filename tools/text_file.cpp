// SPDX-License-Identifier: MIT
#include "tools/text_file.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <iostream>

#include "sim/input_error.h"

namespace throng::tools {

namespace {

template <class Number>
std::string_view digits(Number number, char (&text)[32]) {
  return {text, static_cast<std::size_t>(std::to_chars(text, text + sizeof text, number).ptr - text)};
}

}  // namespace

TextFile::TextFile(const ExportTarget& target)
    : name_(target.name), out_(target.path == kStandardOutput ? std::cout : file_) {
  if (target.path != kStandardOutput) file_.open(target.path, std::ios::binary);
  expect_written();
}

TextFile& TextFile::operator<<(std::string_view text) {
  out_.write(text.data(), static_cast<std::streamsize>(text.size()));
  expect_written();
  return *this;
}

TextFile& TextFile::operator<<(double number) {
  char text[32];
  return *this << digits(number, text);
}

TextFile& TextFile::operator<<(std::int64_t number) {
  char text[32];
  return *this << digits(number, text);
}

void TextFile::close() {
  out_.flush();
  if (file_.is_open()) file_.close();
  expect_written();
}

void TextFile::expect_written() const {
  if (!out_) throw InputError("cannot write " + name_ + ": " + std::strerror(errno));
}

}  // namespace throng::tools
