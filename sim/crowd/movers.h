// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/body_solids.h"
#include "sim/crowd/slide.h"
#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// The kinematic bodies of a scene with agents: they move as told, and push agents out of their way.
class Movers {
 public:
  /// `scene` must outlive this.
  explicit Movers(const Scene& scene);

  bool empty() const { return movers_.empty(); }

  /// Takes over where they are, and where they will be after dt.
  void look(const State& state);

  /// Their edges as they are.
  void add_lines(std::vector<BarrierLine>& lines) const;

  /// Whether one of them is on `p` as they are.
  bool cover(const Vec& p) const;

  /// Where a disc of that radius (m) gets that is to move from `from` to `to` (m) while they move: never into
  /// one that it wasn't in, by the exact time of contact in its frame, in which the disc's way is taken as
  /// straight. From one whose middle it covers at the beginning it is free to go. O(movers + edges near).
  Moved push(const Vec& from, const Vec& to, double radius) const;

  /// Moves them in the state.
  void move(State& state) const;

 private:
  struct Mover {
    std::size_t row;
    std::vector<Region> solids;  // about its centre
    Barriers edges;              // likewise
    double reach;                // m, of the disc about its centre that holds it
    narrowphase::Pose before{}, after{};
  };

  const Scene& scene_;
  std::vector<Mover> movers_;
};

}  // namespace throng
