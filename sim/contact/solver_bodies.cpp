// SPDX-License-Identifier: MIT
#include "sim/contact/solver_bodies.h"

namespace throng {

namespace {
constexpr std::size_t kAstray = 32;  // one of so many bodies among those of another part matters little
}

bool SolverBodies::arrange(const Parts& parts) {
  if (parts.count() == 1) return false;
  const std::size_t dynamic = bodies_.size() - parts.groups();
  const auto part_of = [&](std::size_t row) {
    return row < dynamic ? parts.group(static_cast<std::uint32_t>(row)) : row - dynamic;
  };
  std::size_t astray = part_.empty() ? bodies_.size() : 0;
  part_.resize(bodies_.size());
  for (std::size_t row = 0; row < bodies_.size(); ++row) astray += part_[row] != part_of(row);
  if (astray * kAstray <= bodies_.size()) return false;
  old_ = bodies_, old_places_ = places_, places_.resize(bodies_.size());
  std::vector<std::uint32_t> next(parts.groups() + 1, 0);
  for (std::size_t row = 0; row < bodies_.size(); ++row) {
    part_[row] = static_cast<std::uint8_t>(part_of(row));
    ++next[part_[row] + 1];
  }
  for (std::size_t group = 1; group < next.size(); ++group) next[group] += next[group - 1];
  for (std::size_t row = 0; row < bodies_.size(); ++row) {
    places_[row] = next[part_[row]]++;
    bodies_[places_[row]] = old_[old_places_.empty() ? row : old_places_[row]];
  }
  return true;
}

}  // namespace throng
