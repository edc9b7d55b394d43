// SPDX-License-Identifier: MIT
#include "sim/crowd/inside.h"

#include <algorithm>

#include "narrowphase/crossing.h"
#include "narrowphase/orientation.h"

namespace throng {

namespace {

constexpr double kMostEntries = 15.0;  // of an edge, on average, beside the first and the last

}  // namespace

void Inside::set(const Region& region) {
  bounds_ = bounds(region);
  edges_.clear();
  double heights = 0.0;
  for (const std::vector<Vec>& ring : region.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec &a = ring[i], &b = ring[(i + 1) % ring.size()];
      edges_.push_back(a.y() < b.y() ? Edge{a, b} : Edge{b, a});
      heights += edges_.back().high.y() - edges_.back().low.y();
    }
  if (!(heights > 0.0)) edges_.clear();  // flat: it holds nothing
  if (edges_.empty()) return;
  const double count = static_cast<double>(edges_.size()), height = bounds_.sizes().y();
  const double strips = std::clamp(kMostEntries * count * (height / heights), 1.0, count);
  per_strip_ = strips / height;
  start_.assign(static_cast<std::size_t>(strips) + 2, 0);
  for (const Edge& edge : edges_)
    for (std::size_t i = strip(edge.low.y()); i <= strip(edge.high.y()); ++i) ++start_[i + 1];
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
  row_.resize(start_.back());
  next_ = start_;
  for (std::uint32_t row = 0; row < edges_.size(); ++row)
    for (std::size_t i = strip(edges_[row].low.y()); i <= strip(edges_[row].high.y()); ++i)
      row_[next_[i]++] = row;
}

std::size_t Inside::strip(double y) const {
  return std::min(static_cast<std::size_t>((y - bounds_.min().y()) * per_strip_), start_.size() - 2);
}

bool Inside::operator()(const Vec& p) const {
  if (edges_.empty() || !bounds_.contains(p)) return false;
  bool inside = false;
  const std::size_t its = strip(p.y());
  for (std::uint32_t i = start_[its]; i < start_[its + 1]; ++i) {
    const Edge& edge = edges_[row_[i]];
    if (edge.low.y() <= p.y() && p.y() < edge.high.y() &&
        narrowphase::orientation(edge.low, edge.high, p) > 0)
      inside = !inside;
  }
  return inside;
}

bool Inside::meets_border(const Vec& a, const Vec& b) const {
  const Eigen::AlignedBox2d box(a.cwiseMin(b), a.cwiseMax(b));
  if (edges_.empty() || !bounds_.intersects(box)) return false;
  const std::size_t first = strip(std::max(box.min().y(), bounds_.min().y()));
  const std::size_t last = strip(std::min(box.max().y(), bounds_.max().y()));
  for (std::uint32_t i = start_[first]; i < start_[last + 1]; ++i)
    if (const Edge& edge = edges_[row_[i]];
        edge.comes_to(box) && narrowphase::segments_meet(a, b, edge.low, edge.high))
      return true;
  return false;
}

}  // namespace throng
