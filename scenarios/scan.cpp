// SPDX-License-Identifier: MIT
#include "scenarios/scan.h"

#include "scenarios/limits.h"

namespace throng::scenarios {

namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  Excess run() {
    while (at_ < text_.size() && excess_.line == 0) step();
    return excess_;
  }

 private:
  void step() {
    const char c = text_[at_];
    if (c == '#') return skip_comment();
    if (c == '"' || c == '\'') return skip_string(c);
    if (c == '[' || c == '{') open();
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
    if (c == ',' || c == '=') ++items_;
    if (c == '.') ++dots_;
    if (c == ',' || c == '=' || c == '[' || c == '{' || c == '\n') dots_ = 0;
    if (dots_ >= kDeepest) fail("a dotted key of more than " + std::to_string(kDeepest) + " parts");
    if (items_ > kMostItems) fail("more than " + std::to_string(kMostItems) + " values");
    if (c == '\0') fail("a zero byte: this is a binary file, no TOML");
    advance();
  }

  void open() {
    if (++depth_ > kDeepest) fail("lists or tables more than " + std::to_string(kDeepest) + " deep");
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') advance();
  }

  void skip_string(char quote) {
    const bool multiline = starts_with_three(quote);
    const std::size_t width = multiline ? 3 : 1;
    for (std::size_t i = 0; i < width; ++i) advance();
    while (at_ < text_.size()) {
      if (multiline ? starts_with_three(quote) : text_[at_] == quote) break;
      if (!multiline && text_[at_] == '\n') return;  // unfinished: the parser says so
      if (quote == '"' && text_[at_] == '\\') advance();
      advance();
    }
    for (std::size_t i = 0; i < width; ++i) advance();
    for (int i = 0; multiline && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i)
      advance();  // up to two quotes of its own may stand before the closing three
  }

  bool starts_with_three(char quote) const {
    return at_ + 3 <= text_.size() && text_[at_] == quote && text_[at_ + 1] == quote &&
           text_[at_ + 2] == quote;
  }

  void advance() {
    if (at_ >= text_.size()) return;
    if (text_[at_++] == '\n')
      ++line_, column_ = 1;
    else
      ++column_;
  }

  void fail(std::string message) { excess_ = {line_, column_, std::move(message)}; }

  std::string_view text_;
  std::size_t at_ = 0, items_ = 0;
  int line_ = 1, column_ = 1, depth_ = 0, dots_ = 0;
  Excess excess_;
};

}  // namespace

Excess find_excess(std::string_view text) {
  return Scanner(text).run();
}

}  // namespace throng::scenarios
