// SPDX-License-Identifier: MIT
#include "sim/crowd/voronoi_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "narrowphase/convex.h"

namespace throng {

namespace {

constexpr int kSides = 64;

double signed_area(std::span<const Vec> ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

/// What of the ring is where `inside` (m) is not below 0, which is linear: Sutherland and Hodgman, "Reentrant
/// polygon clipping" (CACM 1974). Pieces stay joined by edges there and back, which add no area.
template <class F>
void clip(std::vector<Vec>& ring, F inside) {
  thread_local std::vector<Vec> kept;
  kept.clear();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const double from = inside(a), to = inside(b);
    if (from >= 0.0) kept.push_back(a);
    if ((from >= 0.0) != (to >= 0.0)) kept.push_back(a + from / (from - to) * (b - a));
  }
  ring.swap(kept);
}

/// Whether the ring adds to the region, not a hole: an even number of the others encloses it.
bool is_outer(const Region& region, std::size_t ring) {
  bool outer = true;
  for (std::size_t other = 0; other < region.rings.size(); ++other)
    if (other != ring && contains(Region{{region.rings[other]}}, region.rings[ring].front())) outer = !outer;
  return outer;
}

/// Outer rings counter-clockwise, holes clockwise.
Region turned(Region region) {
  std::vector<bool> outer;
  for (std::size_t i = 0; i < region.rings.size(); ++i) outer.push_back(is_outer(region, i));
  for (std::size_t i = 0; i < region.rings.size(); ++i)
    if ((signed_area(region.rings[i]) > 0.0) != outer[i]) std::ranges::reverse(region.rings[i]);
  return region;
}

/// As common_area, of a region whose rings are turned.
double area_in(std::span<const Vec> convex, const Region& turned) {
  thread_local std::vector<Vec> part;
  double area = 0.0;
  Eigen::AlignedBox2d box;
  for (const Vec& p : convex) box.extend(p);
  for (const std::vector<Vec>& ring : turned.rings) {
    part = ring;
    for (std::size_t i = 0; i < convex.size() && !part.empty(); ++i) {
      const Vec &a = convex[i], along = convex[(i + 1) % convex.size()] - a;
      clip(part, [&](const Vec& p) { return along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x()); });
    }
    for (Vec& p : part) p -= box.min();  // far from the origin, areas would lose their digits
    area += signed_area(part);
  }
  return area;
}

}  // namespace

double common_area(std::span<const Vec> convex, const Region& region) {
  return area_in(convex, turned(region));
}

VoronoiDensity::VoronoiDensity(Region floor, Region area, double size, double cutoff)
    : floor_(turned(std::move(floor))), area_(turned(std::move(area))), near_(bounds(area_)), size_(size) {
  constexpr double kSide = 2.0 * std::numbers::pi / kSides;
  const double reach = cutoff / narrowphase::pose({0.0, 0.0}, 0.5 * kSide).cos;
  for (int i = 0; i < kSides; ++i)
    disc_.push_back(narrowphase::pose({0.0, 0.0}, i * kSide) * Vec(reach, 0.0));
  near_.min() -= Vec(reach, reach), near_.max() += Vec(reach, reach);
}

void VoronoiDensity::make_cell(std::size_t agent) {
  const Vec& p = agents_[agent];
  const double reach = 2.0 * disc_[0].x();
  cell_ = disc_;
  cells_.for_each_stretch(p, reach, [&](std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end; ++place) {
      const Vec to = agents_[cells_.row()[place]] - p;
      const double half = 0.5 * to.squaredNorm();
      if (half > 0.0 && to.squaredNorm() < reach * reach)
        clip(cell_, [&](const Vec& q) { return half - to.dot(q); });
    }
  });
  for (Vec& q : cell_) q += p;
}

double VoronoiDensity::density(std::span<const Vec> position) {
  const double far = 2.0 * disc_[0].x();
  agents_.clear();
  for (const Vec& p : position)
    if (near_.squaredExteriorDistance(p) <= far * far) agents_.push_back(p);
  cells_.sort(agents_, far);
  double sum = 0.0;
  for (std::size_t agent = 0; agent < agents_.size(); ++agent) {
    if (!near_.contains(agents_[agent])) continue;
    make_cell(agent);
    const double whole = area_in(cell_, floor_);
    if (whole > 0.0) sum += area_in(cell_, area_) / whole;
  }
  return sum / size_;
}

}  // namespace throng
