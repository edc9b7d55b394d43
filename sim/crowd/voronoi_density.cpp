// SPDX-License-Identifier: MIT
#include "sim/crowd/voronoi_density.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/convex.h"
#include "sim/crowd/body_solids.h"

namespace throng {

namespace {

/// What of the ring is where `inside` (m) is not below 0, which is linear: Sutherland and Hodgman, "Reentrant
/// polygon clipping" (CACM 1974).
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

}  // namespace

VoronoiDensity::VoronoiDensity(const Region& floor, const Region& area, double size, double cutoff)
    : piece_(floor, area), near_(bounds(area)), size_(size), disc_(round_outline({0.0, 0.0}, cutoff)) {
  const double reach = disc_[0].x();
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
    const auto [whole, in_area] = piece_.sizes(cell_, agents_[agent]);
    if (whole > 0.0) sum += in_area / whole;
  }
  return sum / size_;
}

}  // namespace throng
