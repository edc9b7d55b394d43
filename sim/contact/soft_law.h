// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/plan.h"
#include "sim/scene.h"

/// How soft discs push each other: forces by how deep they are in each other and how that changes. Pairs of
/// discs do the same in lanes (soft_law-inl.h). Inlined always: handed over through memory, their dozen
/// numbers would cost as much as what is done with them.
///
/// All forces are means over a step of length h, on the straight way that the depth takes in it: at its
/// beginning and end a contact is there for a part of a step only, and a dashpot that sets in with all its
/// strength would else leave an error of first order.
namespace throng {

/// What the two surfaces of a contact bring in.
struct SoftPair {
  double stiffness;          ///< N/m; of Hertz N/m^1.5: force over depth^1.5
  double damping;            ///< N s/m; of Hertz N s/m^1.25: force over speed and depth^0.25
  double friction;           ///< Coulomb's coefficient
  double rolling = 0.0;      ///< coefficient of rolling resistance
  double roll_radius = 0.0;  ///< m, the effective one
};

/// Its tangential springs: what is remembered of a contact.
struct SoftSprings {
  double slip = 0.0;  ///< m, how far b slid along the normal turned left and didn't slip
  double roll = 0.0;  ///< rad, how far b turned against a
};

/// How the two move against each other where they touch.
struct SoftMotion {
  double depth;    ///< m, in the middle of the step; below 0 they are apart
  double closing;  ///< m/s, how fast the depth grows
  double sliding;  ///< m/s, of b's surface along the normal turned left
  double rolling;  ///< rad/s, b's spin less a's
};

/// On b; a feels the opposite of the forces and of the torque of rolling.
struct SoftForce {
  double normal = 0.0;   ///< N, from a to b; below 0 while the dashpot holds back two that part
  double tangent = 0.0;  ///< N, along the normal turned left
  double torque = 0.0;   ///< N m
};

/// A step's mean of what acts along the normal, and what tangential springs are measured against.
struct SoftMean {
  double normal = 0.0;     ///< N
  double share = 0.0;      ///< part of the step in which there is contact
  double stiffness = 0.0;  ///< N/m, more force by more depth
  double damping = 0.0;    ///< N s/m
};

/// Tangential spring and dashpot, as parts of the normal ones.
struct SoftRatios {
  double stiffness, damping;
};

/// A spring and a dashpot (Cundall and Strack, Geotechnique 29, 47, 1979). Force: k d + c d'.
struct LinearLaw {
  SoftRatios tangential;

  [[gnu::always_inline]] SoftMean mean(const SoftPair& pair, double depth, double closing, double h) const {
    const double way = std::abs(0.5 * h * closing), most = depth + way;
    if (!(most > 0.0)) return {};
    const double full = pair.stiffness * depth + pair.damping * closing;
    if (depth >= way) return {full, 1.0, pair.stiffness, pair.damping};
    const double share = 0.5 * most / way;
    return {share * (0.5 * pair.stiffness * most + pair.damping * closing), share, pair.stiffness,
            pair.damping};
  }
};

/// Spheres by Hertz, with the damping that makes restitution the same at any speed (Tsuji, Tanaka and Ishida,
/// Powder Technol. 71, 239, 1992; in closed form Antypov and Elliott, EPL 94, 50004, 2011). Force:
/// k d^1.5 + c d^0.25 d'.
struct HertzLaw {
  SoftRatios tangential;

  [[gnu::always_inline]] SoftMean mean(const SoftPair& pair, double depth, double closing, double h) const {
    const double way = std::abs(0.5 * h * closing), most = depth + way;
    if (!(most > 0.0)) return {};
    const double root = std::sqrt(std::max(depth, 0.0)), fourth = std::sqrt(root);
    const double stiffness = 1.5 * pair.stiffness * root, damping = pair.damping * fourth;
    if (way < kStraight * depth)
      return {pair.stiffness * depth * root + damping * closing, 1.0, stiffness, damping};
    const double least = std::max(depth - way, 0.0), size = 2.0 * way;
    const double elastic = 0.4 * (work(most) - work(least)), viscous = 0.8 * (drag(most) - drag(least));
    return {(pair.stiffness * elastic + pair.damping * closing * viscous) / size, (most - least) / size,
            stiffness, damping};
  }

  static constexpr double kStraight =
      1e-3;  ///< of the depth: the middle of a shorter way stands for all, to 1e-7

 private:
  static double work(double depth) { return depth * depth * std::sqrt(depth); }
  static double drag(double depth) { return depth * std::sqrt(std::sqrt(depth)); }
};

/// The tangential part of a force: a spring and a dashpot that give at `most`; what the spring then keeps is
/// what `most` needs (Luding, Granular Matter 10, 235, 2008).
[[gnu::always_inline]] inline double soft_hold(double stiffness, double damping, double share, double most,
                                               double rate, double& spring) {
  const double force = -share * (stiffness * spring + damping * rate);
  if (std::abs(force) <= most) return force;
  const double held = std::copysign(most, force);
  if (stiffness > 0.0) spring = -(held / share + damping * rate) / stiffness;
  return held;
}

/// The mean force over a step of length h (s). The springs are those of its middle; they give where friction
/// doesn't hold them. `rolls`: whether surfaces resist rolling.
template <class Law>
[[gnu::always_inline]] inline SoftForce soft_force(const Law& law, const SoftPair& pair,
                                                   const SoftMotion& motion, double h, bool rolls,
                                                   SoftSprings& springs) {
  const SoftMean mean = law.mean(pair, motion.depth, motion.closing, h);
  if (!(mean.share > 0.0)) return {};
  const double pressing = std::max(mean.normal, 0.0);
  const double stiffness = law.tangential.stiffness * mean.stiffness,
               damping = law.tangential.damping * mean.damping;
  SoftForce force{mean.normal, 0.0, 0.0};
  force.tangent =
      soft_hold(stiffness, damping, mean.share, pair.friction * pressing, motion.sliding, springs.slip);
  if (!rolls) return force;
  const double radius2 = pair.roll_radius * pair.roll_radius;
  force.torque = soft_hold(stiffness * radius2, damping * radius2, mean.share,
                           pair.rolling * pair.roll_radius * pressing, motion.rolling, springs.roll);
  return force;
}

/// For how long (s) of the last `span` the two have been in contact, that deep now.
inline double contact_time_before(const SoftMotion& motion, double span) {
  if (!(motion.depth > 0.0)) return 0.0;
  return motion.closing * span > motion.depth ? motion.depth / motion.closing : span;
}

/// For how long of the next; who parts is in no contact for which it mattered.
inline double contact_time_after(const SoftMotion& motion, double span) {
  if (motion.depth > 0.0) return span;
  return motion.closing * span > -motion.depth ? span + motion.depth / motion.closing : 0.0;
}

/// Stretches the springs for a time (s) of that motion.
inline void stretch(SoftSprings& springs, const SoftMotion& motion, double time, bool rolls) {
  springs.slip += time * motion.sliding;
  if (rolls) springs.roll += time * motion.rolling;
}

/// The dashpot's damping ratio that gives this restitution, 1 at 0: exact for both laws, where a contact ends
/// with its depth.
double damping_ratio(double restitution);

/// Of each of the plan's surfaces.
std::vector<double> damping_ratios(const Plan& plan);

/// `mass` (kg) and `radius` (m): the reduced ones of the two; `ratio`: damping_ratio() of their restitution.
SoftPair soft_pair(const Scene& scene, double mass, double radius, double ratio);

/// How tangential springs go with the normal ones.
SoftRatios soft_ratios(const Scene& scene);

/// Calls f(law) with the law of the scene's contact model.
template <class F>
void with_law(const Scene& scene, F f) {
  const SoftRatios ratios = soft_ratios(scene);
  if (scene.contact == ContactModel::spring)
    f(LinearLaw{ratios});
  else
    f(HertzLaw{ratios});
}

/// How long (s) two that meet at `speed` (m/s) stay in contact, without damping: the shortest that it may be.
double contact_duration(const Scene& scene, const SoftPair& pair, double mass, double speed);

/// m/s, of Hertz: at which two must meet to get that deep (m) into each other, and those that begin so part.
double speed_of_depth(const SoftPair& pair, double mass, double depth);

/// How stiff (N/m) the contact is at its deepest then.
double largest_stiffness(const Scene& scene, const SoftPair& pair, double mass, double speed);

}  // namespace throng
