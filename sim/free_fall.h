// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/rows.h"
#include "sim/scene.h"

namespace throng {

/// Keeps bodies that nothing touches in a substep on their parabolas. Semi-implicit Euler moves all by the
/// velocities that they have after it, which is too far by half of what gravity gives: of who falls freely
/// that is taken back, and his place and energy are exact. So they are of who rolls or slides straight on, if
/// nothing makes him faster or slower than gravity could: half of that is taken back along his way. Others
/// are where contacts want them; so is who slides in a scene with bends, since what is off
/// on its straight parts is made up for by what is off in the bends. Not for steps under guard.
class FreeFall {
 public:
  FreeFall(const Scene& scene, std::size_t rows);

  /// Adds `kick` (m/s), what gravity gives in a substep, to the velocities of dynamic bodies. Like land() to
  /// be called by several threads, each with its rows.
  void fall(BodyRows<SolverBody> bodies, Rows rows, const Vec& kick);

  /// Of a body that was stopped where it has arrived since the substep began: it doesn't fly.
  void stop(BodyRows<SolverBody> bodies, std::uint32_t row);

  /// Whether nothing but gravity has changed the body's velocities since fall(), but by rounding, or they are
  /// never changed.
  bool flies(BodyRows<const SolverBody> bodies, std::uint32_t row) const;

  /// After a substep of h (s).
  void land(BodyRows<SolverBody> bodies, Rows rows, const Vec& kick, double h) const;

 private:
  struct Fallen {
    Vec velocity;  // m/s
    double spin;   // rad/s
  };

  static bool flies(const SolverBody& body, const Fallen& fallen);
  static void slide(SolverBody& body, const Fallen& fallen, const Vec& kick, double h);

  bool is_straight_;            // what one slides on
  std::vector<Fallen> fallen_;  // after fall(), in the bodies' slots
};

}  // namespace throng
