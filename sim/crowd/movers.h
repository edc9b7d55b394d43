// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/body_solids.h"
#include "sim/scene.h"
#include "sim/state.h"

namespace throng {

/// Where movers push a disc.
struct Pushed {
  Vec to{0.0, 0.0};        ///< m
  bool corrected = false;  ///< one was in the way
  bool settled = true;     ///< all of them let it be there; else they were asked again and again in vain
};

/// The kinematic bodies of a scene with agents: they move as told, and push agents out of their way.
class Movers {
 public:
  /// `scene` must outlive this.
  explicit Movers(const Scene& scene);

  bool empty() const { return movers_.empty(); }

  /// Takes over where they are, and where they will be after dt, and sets their edges as they are among the
  /// barriers.
  void show(const State& state, Barriers& barriers);

  /// m, how deep `p` is inside of one of them as they are, the deepest; 0 outside of all. O(movers).
  double depth(const Vec& p) const;

  /// Where a disc of that radius (m) gets that is to move from `from` to `to` (m) while they move: where it
  /// is settled into none that it wasn't in, by the exact time of contact in its frame, in which the disc's
  /// way is taken as straight. From one whose middle it covers at the beginning it is free to go. O(movers +
  /// edges near).
  Pushed push(const Vec& from, const Vec& to, double radius) const;

  /// Moves them in the state.
  void move(State& state) const;

 private:
  struct Mover {
    std::size_t row;
    std::vector<Region> solids;  // about its centre
    Barriers edges;              // likewise
    double reach;                // m, of the disc about its centre that holds it
    narrowphase::Pose before{}, after{};
    double shift = 0.0, turn = 0.0;  // m, rad, from the one to the other
  };

  void look(const State& state);
  static bool may_meet(const Mover& mover, const Vec& from, const Vec& to, double radius);

  const Scene& scene_;
  std::vector<Mover> movers_;
};

}  // namespace throng
