// SPDX-License-Identifier: MIT
#include "sim/crowd/region.h"

#include <algorithm>

#include "narrowphase/orientation.h"

namespace throng {

namespace {

/// Calls f(a, b) for each edge.
template <class F>
void for_each_edge(const Region& region, F f) {
  for (const std::vector<Vec>& ring : region.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) f(ring[i], ring[(i + 1) % ring.size()]);
}

}  // namespace

bool contains(const Region& region, const Vec& p) {
  bool inside = false;
  for_each_edge(region, [&](const Vec& a, const Vec& b) {
    if ((a.y() > p.y()) == (b.y() > p.y())) return;
    const bool up = b.y() > a.y();
    if (narrowphase::orientation(up ? a : b, up ? b : a, p) > 0) inside = !inside;
  });
  return inside;
}

Vec nearest_on_segment(const Vec& a, const Vec& b, const Vec& p) {
  const Vec along = b - a;
  const double length2 = along.squaredNorm();
  if (!(length2 > 0.0)) return a;
  const double t = (p - a).dot(along) / length2;
  if (t <= 0.0) return a;
  if (t >= 1.0) return b;
  return a + t * along;
}

Vec nearest_on_border(const Region& region, const Vec& p) {
  Vec nearest = region.rings.front().front();
  double least = (nearest - p).squaredNorm();
  for_each_edge(region, [&](const Vec& a, const Vec& b) {
    const Vec q = nearest_on_segment(a, b, p);
    const double d = (q - p).squaredNorm();
    if (d < least) nearest = q, least = d;
  });
  return nearest;
}

Eigen::AlignedBox2d bounds(const Region& region) {
  Eigen::AlignedBox2d box;
  for (const std::vector<Vec>& ring : region.rings)
    for (const Vec& point : ring) box.extend(point);
  return box;
}

}  // namespace throng
