// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace throng::tools {

/// A place for one character.
struct Cell {
  char32_t glyph = U' ';
  std::uint8_t colour = 0;  ///< of the 256 that terminals have; 0: the terminal's own
  bool operator==(const Cell&) const = default;
};

/// What a terminal shows, as data.
class Screen {
 public:
  Screen() = default;
  Screen(int columns, int rows) : columns_(columns), cells_(std::size_t(columns) * rows) {}

  int columns() const { return columns_; }
  int rows() const { return columns_ == 0 ? 0 : static_cast<int>(cells_.size()) / columns_; }
  Cell& at(int column, int row) { return cells_[std::size_t(row) * columns_ + column]; }
  const Cell& at(int column, int row) const { return cells_[std::size_t(row) * columns_ + column]; }

  /// Puts UTF-8 text from `column` on, cut off at the border. What may not take one cell, or may steer the
  /// terminal, becomes '?'. Returns the column after it.
  int put(int column, int row, std::string_view text, std::uint8_t colour = 0);

  /// What brings a terminal from `shown` to this: the cells that differ, or, where it has another size, all
  /// of it.
  std::string update(const Screen& shown) const;

  /// This as lines of text, without the spaces at their ends.
  std::string lines() const;

 private:
  int columns_ = 0;
  std::vector<Cell> cells_;
};

/// How many cells `put` takes for a text.
int width(std::string_view text);

}  // namespace throng::tools
