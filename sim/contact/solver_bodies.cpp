// SPDX-License-Identifier: MIT
#include "sim/contact/solver_bodies.h"

#include <numeric>
#include <utility>

namespace throng {

namespace {
constexpr std::size_t kAstray = 32;  // one of so many bodies among those of another part matters little
}

void SolverBodies::arrange(const Parts& parts) {
  if (parts.count() == 1) return;
  const std::size_t n = bodies_.size(), real = n - parts.groups();
  const auto part_of = [&](std::size_t row) {
    return row < real ? parts.group(static_cast<std::uint32_t>(row)) : row - real;
  };
  std::size_t astray = part_.empty() ? n : 0;
  part_.resize(n);
  for (std::size_t row = 0; row < n; ++row) astray += part_[row] != part_of(row);
  if (astray * kAstray <= n) return;
  std::vector<std::uint32_t> next(parts.groups() + 1, 0), slots(n);
  for (std::size_t row = 0; row < n; ++row) {
    part_[row] = static_cast<std::uint8_t>(part_of(row));
    ++next[part_[row] + 1u];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  old_.resize(n), std::swap(old_, bodies_);
  for (std::uint32_t row = 0; row < n; ++row) {
    slots[row] = next[part_[row]]++;
    bodies_[slots[row]] = old_[slots_.slot(row)];
  }
  slots_ = BodySlots(std::move(slots));
}

}  // namespace throng
