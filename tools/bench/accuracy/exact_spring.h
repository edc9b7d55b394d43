// SPDX-License-Identifier: MIT
#pragma once

namespace throng::bench {

/// Two that meet on a linear spring and dashpot, until they no longer overlap: a damped oscillation's first
/// half (Schwager and Poeschel, Granular Matter 9, 465, 2007).
struct SpringImpact {
  double restitution;  ///< exp(-pi z / sqrt(1 - z²)), z the damping ratio
  double duration;     ///< s, pi / (w sqrt(1 - z²)), w² = stiffness / mass
};

/// `stiffness` N/m, `mass` kg, of both together, `damping` kg/s.
SpringImpact exact_spring_impact(double stiffness, double mass, double damping);

/// kg/s, with which that restitution comes about.
double exact_damping(double stiffness, double mass, double restitution);

}  // namespace throng::bench
