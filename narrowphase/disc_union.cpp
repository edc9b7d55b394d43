// SPDX-License-Identifier: MIT
#include "narrowphase/disc_union.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "narrowphase/relative.h"
#include "narrowphase/trigonometry.h"

namespace throng::narrowphase {

namespace {

/// A stretch of a disc's rim, from angle to angle in [-pi, pi].
struct Arc {
  double from, to;
  friend auto operator<=>(const Arc&, const Arc&) = default;
};

bool hides(const Disc& other, const Disc& disc, bool other_comes_first) {
  if (other.centre == disc.centre && other.radius == disc.radius) return other_comes_first;
  return direction(disc.centre - other.centre, {1.0, 0.0}).length + disc.radius <= other.radius;
}

/// Adds the part of the rim that lies in `other`, in two pieces where it runs over pi.
void cover(std::vector<Arc>& covered, const Disc& disc, const Disc& other) {
  const Vec to_other = other.centre - disc.centre;
  const double d = direction(to_other, {1.0, 0.0}).length;
  if (d >= disc.radius + other.radius || d + other.radius <= disc.radius) return;
  const double middle = arc_tangent(to_other.y(), to_other.x());
  const double along =
      (d * d + (disc.radius - other.radius) * (disc.radius + other.radius)) / (2.0 * d * disc.radius);
  const double half = arc_cosine(std::clamp(along, -1.0, 1.0));
  const double from = middle - half, to = middle + half;
  covered.push_back({std::max(from, -std::numbers::pi), std::min(to, std::numbers::pi)});
  if (from < -std::numbers::pi) covered.push_back({from + 2.0 * std::numbers::pi, std::numbers::pi});
  if (to > std::numbers::pi) covered.push_back({-std::numbers::pi, to - 2.0 * std::numbers::pi});
}

/// The stretches of the rim of disc `i` that no other disc covers.
std::vector<Arc> bare_arcs(std::span<const Disc> discs, std::size_t i) {
  std::vector<Arc> covered, bare;
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == i) continue;
    if (hides(discs[j], discs[i], j < i)) return {};
    cover(covered, discs[i], discs[j]);
  }
  std::sort(covered.begin(), covered.end());
  double end = -std::numbers::pi;
  for (const Arc& arc : covered) {
    if (arc.from > end) bare.push_back({end, arc.from});
    end = std::max(end, arc.to);
  }
  if (end < std::numbers::pi) bare.push_back({end, std::numbers::pi});
  return bare;
}

struct Moments {
  double area = 0.0;
  Vec first{0.0, 0.0};
  double second = 0.0;
};

/// The integrals over an arc of (u + r cos t)^k r cos t, k = 1, 2, 3: Green's theorem turns them into area,
/// first and second moment along one axis, whose coordinate is u + r cos t.
struct AxisIntegrals {
  double area, first, second;

  AxisIntegrals(double u, double r, double angle, SinCos from, SinCos to) {
    const double c1 = to.sin - from.sin;
    const double c2 = 0.5 * (angle + (to.sin * to.cos - from.sin * from.cos));
    const double c3 = c1 - (cube(to.sin) - cube(from.sin)) / 3.0;
    const double c4 = 0.75 * c2 + 0.25 * (to.sin * cube(to.cos) - from.sin * cube(from.cos));
    area = r * (u * c1 + r * c2);
    first = r * (u * u * c1 + 2.0 * u * r * c2 + r * r * c3);
    second = r * (u * u * u * c1 + 3.0 * u * u * r * c2 + 3.0 * u * r * r * c3 + r * r * r * c4);
  }

 private:
  static double cube(double x) { return x * x * x; }
};

/// y = v + r cos(t - pi/2): the same integrals with the angle turned by a quarter.
SinCos quarter_back(SinCos t) {
  return {-t.cos, t.sin};
}

void add(Moments& m, const Disc& disc, const Vec& origin, const Arc& arc) {
  const SinCos from = sin_cos(arc.from), to = sin_cos(arc.to);
  const double angle = arc.to - arc.from;
  const Vec centre = disc.centre - origin;
  const AxisIntegrals x(centre.x(), disc.radius, angle, from, to);
  const AxisIntegrals y(centre.y(), disc.radius, angle, quarter_back(from), quarter_back(to));
  m.area += 0.5 * (x.area + y.area);
  m.first += 0.5 * Vec(x.first, y.first);
  m.second += (x.second + y.second) / 3.0;
}

Moments moments(std::span<const Disc> discs, const std::vector<std::vector<Arc>>& bare, const Vec& origin) {
  Moments m;
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (const Arc& arc : bare[i]) add(m, discs[i], origin, arc);
  return m;
}

}  // namespace

MassProperties mass_properties(std::span<const Disc> discs) {
  std::vector<std::vector<Arc>> bare;
  for (std::size_t i = 0; i < discs.size(); ++i) bare.push_back(bare_arcs(discs, i));
  const Moments about_disc = moments(discs, bare, discs[0].centre);
  const Vec centroid = discs[0].centre + about_disc.first / about_disc.area;
  const Moments m = moments(discs, bare, centroid);
  return {m.area, centroid, m.second / m.area};
}

}  // namespace throng::narrowphase
