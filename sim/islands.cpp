// SPDX-License-Identifier: MIT
#include "sim/islands.h"

#include <algorithm>

namespace throng {

void Islands::start(Rows rows, std::size_t n) {
  nearer_.resize(n);
  rows.for_each([&](std::uint32_t row) { nearer_[row] = row; });
}

void Islands::join(std::uint32_t a, std::uint32_t b) {
  const auto [first, second] = std::minmax({this->first(a), this->first(b)});
  nearer_[second] = first;
}

std::uint32_t Islands::first(std::uint32_t row) {
  while (nearer_[row] != row) row = nearer_[row] = nearer_[nearer_[row]];
  return row;
}

}  // namespace throng
