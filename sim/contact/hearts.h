// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "narrowphase/convex.h"
#include "sim/colliders.h"

namespace throng {

/// How thick a convex part is: its area over its outline, which is half to all of its inscribed disc's
/// radius, and its own radius. m.
double thickness(const narrowphase::Convex& part);

/// The part without what lies less than `rim` (m) below its surface. Expects 0 <= rim < thickness(part).
/// O(n²).
narrowphase::Convex inset(const narrowphase::Convex& part, double rim);

/// What of each collider nothing else may get into. Contacts give way a little: then surfaces overlap, while
/// the hearts are still apart. Who got past a heart would be pushed out on the other side. A heart is in the
/// next larger one: who has got into that is still kept out of this one.
class Hearts {
 public:
  static constexpr std::array<double, 3> kRims{0.5, 0.75, 0.9375};  ///< of the thickness
  static constexpr std::size_t kDepths = kRims.size();

  explicit Hearts(const Colliders& colliders);

  double thickness(std::uint32_t collider) const { return thickness_[collider]; }  ///< m
  double least_thickness() const { return least_; }  ///< m, of all; infinite of none

  /// Makes those of all shapes, before the first heart(): where nothing is fast nobody asks for any.
  void make();

  /// In the body's frame. A disc about its body's centre has no shape of its own: it is put into `lent`.
  const narrowphase::Convex& heart(std::uint32_t collider, std::size_t depth,
                                   narrowphase::Convex& lent) const;

 private:
  const Colliders& colliders_;
  std::vector<double> thickness_;  // m, of each collider
  double least_;                   // m
  std::vector<std::uint32_t>
      shape_;  // of each collider its row below; empty before make() and of discs alone
  std::vector<std::array<narrowphase::Convex, kDepths>> hearts_;
};

}  // namespace throng
