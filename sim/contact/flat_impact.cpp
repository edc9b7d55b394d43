// SPDX-License-Identifier: MIT
#include "sim/contact/flat_impact.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/arms.h"

namespace throng {

namespace {

constexpr double kApart = 1e-9;  // of what one point feels: two that differ less are as good as one

/// Midway between the points: where their line is at right angles to the normal, slip is the same at all of
/// it.
PointArms middle(const PointContact& i, const PointContact& j) {
  return {0.5 * (i.arm_a + j.arm_a), 0.5 * (i.arm_b + j.arm_b), i.normal};
}

/// What impulses at the two points and across do to the velocities there, 1/kg; both normals are one.
struct Couplings {
  double ii, ij, jj, it, jt, tt;
  double slip;  ///< m/s, before

  Couplings(const PointContact& i, const PointContact& j, const SolverBody& a, const SolverBody& b) {
    const PointArms at = middle(i, j);
    const double masses = a.inverse_mass + b.inverse_mass;
    const auto turned = [&](double a1, double a2, double b1, double b2) {
      return a.inverse_inertia * a1 * a2 + b.inverse_inertia * b1 * b2;
    };
    const double ai = cross(i.arm_a, i.normal), bi = cross(i.arm_b, i.normal);
    const double aj = cross(j.arm_a, j.normal), bj = cross(j.arm_b, j.normal);
    const double across_a = cross(at.arm_a, at.t), across_b = cross(at.arm_b, at.t);
    ii = masses + turned(ai, ai, bi, bi), jj = masses + turned(aj, aj, bj, bj);
    ij = masses + turned(ai, aj, bi, bj);
    it = turned(ai, across_a, bi, across_b), jt = turned(aj, across_a, bj, across_b);
    tt = masses + turned(across_a, across_a, across_b, across_b);
    slip = at.tangent_velocity(a, b);
  }
};

/// Which of the points have an impulse.
enum class Touching { both, only_i, only_j };

/// The impulses at those points that change velocities there by so much.
AtPoints solved(const Couplings& k, Touching touching, const AtPoints& by) {
  if (touching == Touching::only_i) return {by.i / k.ii, 0.0};
  if (touching == Touching::only_j) return {0.0, by.j / k.jj};
  const double determinant = k.ii * k.jj - k.ij * k.ij;
  return {(k.jj * by.i - k.ij * by.j) / determinant, (k.ii * by.j - k.ij * by.i) / determinant};
}

struct Together {
  AtPoints normal;
  double across;
};

/// Whether none of these pulls, each point parts as fast as it is to, and friction takes no energy in.
bool holds(const Together& impulses, const Couplings& k, const AtPoints& added) {
  const auto [normal, across] = impulses;
  if (!(normal.i >= 0.0 && normal.j >= 0.0)) return false;
  const double rounding = 1e-12 * (added.i + added.j);
  if (k.ii * normal.i + k.ij * normal.j + k.it * across < added.i - rounding) return false;
  if (k.ij * normal.i + k.jj * normal.j + k.jt * across < added.j - rounding) return false;
  const double slip_after = k.slip + k.it * normal.i + k.jt * normal.j + k.tt * across;
  return across * (k.slip + slip_after) <= 0.0;
}

/// The impulses that add so much along the normal: those without friction, less what each that is across
/// asks for.
struct Response {
  AtPoints alone, less;

  Response(const Couplings& k, Touching touching, const AtPoints& added)
      : alone(solved(k, touching, added)), less(solved(k, touching, {k.it, k.jt})) {}

  Together with(double across) const { return {alone - less * across, across}; }

  /// Where what is across, towards that side, is as much as Coulomb's law lets it be. Nothing where none is
  /// too much: the body jams.
  std::optional<Together> rubbing(double side, const AtPoints& friction) const {
    side = side < 0.0 ? -1.0 : 1.0;
    const double jams = 1.0 + side * friction.dot(less);
    if (!(jams > 0.0)) return std::nullopt;
    return with(side * std::max(friction.dot(alone), 0.0) / jams);
  }
};

bool is_within(const Together& impulses, const AtPoints& friction) {
  return std::abs(impulses.across) <= friction.dot(impulses.normal);
}

/// All at once: what is across stops the slip, or rubs.
std::optional<Together> at_once(const Couplings& k, Touching touching, const AtPoints& added,
                                const AtPoints& friction) {
  const Response response(k, touching, added);
  const AtPoints levers{k.it, k.jt};
  const double stops = -(k.slip + levers.dot(response.alone)) / (k.tt - levers.dot(response.less));
  std::optional<Together> found = response.with(stops);
  if (!is_within(*found, friction)) found = response.rubbing(stops, friction);
  if (!found || !holds(*found, k, added)) return std::nullopt;
  return found;
}

/// First along the normal, and then across.
Together in_turn(const Couplings& k, const AtPoints& normal, const AtPoints& friction) {
  const double limit = friction.dot(normal), slip = k.slip + k.it * normal.i + k.jt * normal.j;
  return {normal, std::clamp(-slip / k.tt, -limit, limit)};
}

/// That share of it, which adds `added` along the normal, or, where a point would pull, the same share of
/// every impulse.
Together part_of(const Together& whole, double share, const Couplings& k, Touching touching,
                 const AtPoints& added, const AtPoints& friction) {
  const Response response(k, touching, added);
  Together part = response.with(share * whole.across);
  if (!is_within(part, friction)) part = response.rubbing(part.across, friction).value_or(response.with(0.0));
  if (part.normal.i >= 0.0 && part.normal.j >= 0.0) return part;
  return {whole.normal * share, share * whole.across};
}

FlatImpact by_points(const Together& together, const AtPoints& friction) {
  const auto [normal, across] = together;
  const double all = friction.dot(normal), its = all > 0.0 ? friction.i * normal.i / all : 0.0;
  return {normal.i, normal.j, its * across, across - its * across};
}

}  // namespace

std::optional<FlatImpact> flat_impact(const PointContact& i, const PointContact& j, const SolverBody& a,
                                      const SolverBody& b, const AtPoints& added, const AtPoints& whole) {
  const Couplings k(i, j, a, b);
  if (!(k.ii * k.jj - k.ij * k.ij > kApart * k.ii * k.jj)) return std::nullopt;
  const AtPoints friction{i.friction, j.friction}, alone = solved(k, Touching::both, added);
  if (!(alone.i >= 0.0 && alone.j >= 0.0)) return std::nullopt;
  if (!(friction.dot(alone) > 0.0)) return FlatImpact{alone.i, alone.j, 0.0, 0.0};
  const double share = (added.i + added.j) / (whole.i + whole.j);
  for (const Touching touching : {Touching::both, Touching::only_i, Touching::only_j})
    if (const std::optional<Together> all = at_once(k, touching, whole, friction))
      return by_points(part_of(*all, share, k, touching, added, friction), friction);
  return by_points(in_turn(k, alone, friction), friction);
}

void apply(const FlatImpact& impact, const PointContact& i, const PointContact& j, SolverBody& a,
           SolverBody& b) {
  arms(i).apply(a, b, impact.normal_i, 0.0), arms(j).apply(a, b, impact.normal_j, 0.0);
  middle(i, j).apply(a, b, 0.0, impact.across_i + impact.across_j);
}

}  // namespace throng
