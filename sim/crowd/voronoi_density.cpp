// SPDX-License-Identifier: MIT
#include "sim/crowd/voronoi_density.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "narrowphase/convex.h"
#include "sim/crowd/body_solids.h"

namespace throng {

namespace {

constexpr double kRounding = 1e-9;  // of a length's square

/// What of the ring is where `inside` (m) is not below 0, which is linear: Sutherland and Hodgman, "Reentrant
/// polygon clipping" (CACM 1974). False where that is all of it.
template <class F>
bool clip(std::vector<Vec>& ring, F inside) {
  thread_local std::vector<double> depth;
  thread_local std::vector<Vec> kept;
  depth.clear();
  for (const Vec& corner : ring) depth.push_back(inside(corner));
  if (std::ranges::all_of(depth, [](double each) { return each >= 0.0; })) return false;
  kept.clear();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t next = i + 1 < ring.size() ? i + 1 : 0;
    const double from = depth[i], to = depth[next];
    if (from >= 0.0) kept.push_back(ring[i]);
    if ((from >= 0.0) != (to >= 0.0)) kept.push_back(ring[i] + from / (from - to) * (ring[next] - ring[i]));
  }
  ring.swap(kept);
  return true;
}

}  // namespace

VoronoiDensity::VoronoiDensity(const Region& floor, const Region& area, double size, double cutoff)
    : piece_(floor, area),
      near_(bounds(area)),
      size_(size),
      cutoff_(cutoff),
      disc_(round_outline({0.0, 0.0}, cutoff)) {
  const double reach = disc_[0].x();
  near_.min() -= Vec(reach, reach), near_.max() += Vec(reach, reach);
}

/// m², how far its corners are from the agent.
double VoronoiDensity::farthest() const {
  double most = 0.0;
  for (const Vec& corner : cell_) most = std::max(most, corner.squaredNorm());
  return most;
}

/// Takes from it what is the others'. Nearest first: soon nobody else's half plane can reach the cell.
void VoronoiDensity::leave_to_others() {
  double farthest = this->farthest();
  for (const Other& other : others_) {
    if (other.square > 4.0 * farthest * (1.0 + kRounding)) break;
    const double half = 0.5 * other.square;
    if (clip(cell_, [&](const Vec& q) { return half - other.to.dot(q); })) farthest = this->farthest();
  }
}

/// Those within `reach` (m), nearest first.
void VoronoiDensity::find_others(const Vec& p, double reach) {
  others_.clear();
  cells_.for_each_stretch(p, reach, [&](std::size_t first, std::size_t end) {
    for (std::size_t place = first; place < end; ++place) {
      const Vec to = agents_[cells_.row()[place]] - p;
      const double square = to.squaredNorm();
      if (square > 0.0 && square < reach * reach) others_.push_back({square, place, to});
    }
  });
  std::ranges::sort(others_, {}, [](const Other& other) { return std::pair(other.square, other.place); });
}

/// In a dense crowd those near by end a cell, long before the cut-off does: a square has fewer corners to
/// clip than its polygon.
void VoronoiDensity::make_cell(std::size_t agent) {
  const double far = disc_[0].x();
  for (const double reach : {far, 2.0 * far}) {
    find_others(agents_[agent], reach);
    cell_ = {{far, -far}, {far, far}, {-far, far}, {-far, -far}};
    leave_to_others();
    const double farthest = this->farthest();
    if (farthest <= cutoff_ * cutoff_ && 4.0 * farthest * (1.0 + kRounding) <= reach * reach) return;
  }
  cell_ = disc_;
  leave_to_others();
}

double VoronoiDensity::density(std::span<const Vec> position) {
  const double far = 2.0 * disc_[0].x();
  agents_.clear();
  for (const Vec& p : position)
    if (near_.squaredExteriorDistance(p) <= far * far) agents_.push_back(p);
  cells_.sort(agents_, 0.5 * far);
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
