// SPDX-License-Identifier: MIT
#include "tools/screen.h"

#include <algorithm>

namespace throng::tools {

namespace {

/// Takes the first character off a text: '?' for what is no UTF-8, for controls, and for all beyond U+02FF,
/// where characters begin that combine or are wide.
char32_t take(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  std::size_t length = 1;
  while (length < text.size() && (byte(length) & 0xC0U) == 0x80U) ++length;
  char32_t glyph = U'?';
  if (length == 1 && byte(0) >= 0x20 && byte(0) < 0x7F) glyph = byte(0);
  if (length == 2 && byte(0) >= 0xC2 && byte(0) < 0xCC) glyph = (byte(0) & 0x1FU) << 6U | (byte(1) & 0x3FU);
  if (glyph >= 0x80 && glyph < 0xA0) glyph = U'?';
  text.remove_prefix(length);
  return glyph;
}

void append_utf8(std::string& text, char32_t glyph) {
  const auto tail = [glyph](int shift) { return static_cast<char>(0x80U | (glyph >> shift & 0x3FU)); };
  if (glyph < 0x80)
    text += static_cast<char>(glyph);
  else if (glyph < 0x800)
    text += {static_cast<char>(0xC0U | glyph >> 6U), tail(0)};
  else
    text += {static_cast<char>(0xE0U | glyph >> 12U), tail(6), tail(0)};
}

/// Text in the making, and the colour that the terminal has come to.
struct Stream {
  std::string text;
  std::uint8_t colour = 0;

  void set(std::uint8_t to) {
    if (to != colour) text += to == 0 ? "\033[39m" : "\033[38;5;" + std::to_string(to) + "m";
    colour = to;
  }
  void put(const Cell& cell) {
    if (cell.glyph != U' ') set(cell.colour);
    append_utf8(text, cell.glyph);
  }
  void move_to(int column, int row) {
    text += "\033[" + std::to_string(row + 1) + ";" + std::to_string(column + 1) + "H";
  }
};

}  // namespace

int width(std::string_view text) {
  int cells = 0;
  for (; !text.empty(); ++cells) take(text);
  return cells;
}

int Screen::put(int column, int row, std::string_view text, std::uint8_t colour) {
  for (; !text.empty(); ++column) {
    const char32_t glyph = take(text);
    if (column >= 0 && column < columns_ && row >= 0 && row < rows()) at(column, row) = {glyph, colour};
  }
  return column;
}

std::string Screen::update(const Screen& shown) const {
  const bool afresh = shown.columns_ != columns_ || shown.cells_.size() != cells_.size();
  constexpr int kNear = 3;  // cells: what lies between costs less than moving on
  Stream out;
  if (afresh) out.text = "\033[2J";
  for (int row = 0; row < rows(); ++row) {
    int cursor = -kNear - 1;  // the column that the terminal would write next
    for (int column = 0; column < columns_; ++column) {
      if (at(column, row) == (afresh ? Cell{} : shown.at(column, row))) continue;
      if (column - cursor > kNear) out.move_to(cursor = column, row);
      while (cursor <= column) out.put(at(cursor++, row));
    }
  }
  out.set(0);
  return out.text;
}

std::string Screen::lines() const {
  Stream out;
  for (int row = 0; row < rows(); ++row) {
    int end = columns_;
    while (end > 0 && at(end - 1, row).glyph == U' ') --end;
    for (int column = 0; column < end; ++column) out.put(at(column, row));
    out.set(0);
    out.text += "\n";
  }
  return out.text;
}

}  // namespace throng::tools
