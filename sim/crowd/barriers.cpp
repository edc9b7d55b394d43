// SPDX-License-Identifier: MIT
#include "sim/crowd/barriers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "narrowphase/crossing.h"

namespace throng {

namespace {

using Segment = Barriers::Segment;
using Coordinates = std::pair<double, double>;  // m

Coordinates coordinates(const Vec& p) {
  return {p.x(), p.y()};
}

constexpr double kSquareRounding = 1e-9;  // of a squared distance

}  // namespace

Barriers::Barriers(std::span<const BarrierLine> lines, double reach) {
  for (const BarrierLine& line : lines) add(line);
  drop_repeated();
  join();
  still_ = segments_.size();
  std::vector<broadphase::Extent> extents;
  Eigen::AlignedBox2d bounds;
  for (const Segment& segment : segments_) {
    extents.push_back(broadphase::Extent::of_segment(segment.a, segment.b));
    bounds.extend(segment.a), bounds.extend(segment.b);
  }
  index_.build(extents, 2.0 * reach);
  clearance_ = Clearance(index_, bounds, reach);
}

void Barriers::add(const BarrierLine& line) {
  const std::size_t points = line.points.size(), count = line.closed ? points : points - 1;
  const auto first = static_cast<std::uint32_t>(2 * segments_.size());
  const auto last = static_cast<std::uint32_t>(first + 2 * count - 1);
  for (std::uint32_t end = first; end < last; end += 2) {
    const std::size_t i = (end - first) / 2;
    segments_.push_back({line.points[i], line.points[(i + 1) % points],
                         end > first   ? end - 1
                         : line.closed ? last
                                       : end,
                         end + 1 < last ? end + 2
                         : line.closed  ? first
                                        : end + 1});
  }
}

/// Keeps of each the first, whichever way round.
void Barriers::drop_repeated() {
  const auto ends = [](const Segment& s) {
    const auto a = coordinates(s.a), b = coordinates(s.b);
    return a < b ? std::pair(a, b) : std::pair(b, a);
  };
  std::set<std::pair<Coordinates, Coordinates>> known;
  std::erase_if(segments_, [&](const Segment& segment) { return !known.insert(ends(segment)).second; });
}

/// Makes rings of all ends that are at one place, whatever line they are of.
void Barriers::join() {
  std::vector<std::uint32_t> ends(2 * segments_.size());
  std::iota(ends.begin(), ends.end(), 0);
  const auto place = [&](std::uint32_t end) { return coordinates(segments_[end / 2].end(end)); };
  std::ranges::stable_sort(ends, {}, place);
  for (std::size_t i = 0; i < ends.size();) {
    std::size_t after = i + 1;
    while (after < ends.size() && place(ends[after]) == place(ends[i])) ++after;
    for (std::size_t k = i; k < after; ++k) {
      Segment& segment = segments_[ends[k] / 2];
      (ends[k] % 2 == 0 ? segment.at_a : segment.at_b) = ends[k + 1 < after ? k + 1 : i];
    }
    i = after;
  }
}

void Barriers::set_moving(std::span<const BarrierLine> lines) {
  segments_.resize(still_);
  moving_.clear();
  for (const BarrierLine& line : lines) {
    Moving moving{segments_.size(), 0, {}};
    for (const Vec& point : line.points) moving.box.extend(point);
    add(line);
    moving.end = segments_.size();
    moving_.push_back(moving);
  }
}

bool Barriers::block(const Vec& p, const Vec& q) const {
  bool blocked = false;
  for_each_near({Vec(p.cwiseMin(q)), Vec(p.cwiseMax(q))}, [&](const Segment& segment) {
    blocked = blocked || narrowphase::segments_meet(p, q, segment.a, segment.b);
  });
  return blocked;
}

bool Barriers::leave_room(const Vec& p, const Vec& q, double radius) const {
  bool room = true;
  const Vec far(radius, radius);
  const auto gap2 = [](const Vec& a, const Vec& b, const Vec& x) {
    return (nearest_on_segment(a, b, x) - x).squaredNorm();
  };
  for_each_near({Vec(p.cwiseMin(q) - far), Vec(p.cwiseMax(q) + far)}, [&](const Segment& segment) {
    const Vec &a = segment.a, &b = segment.b;
    const double ends = std::min({gap2(a, b, p), gap2(a, b, q), radius * radius});
    const double between = std::min(gap2(p, q, a), gap2(p, q, b));
    room = room && between >= ends * (1.0 - kSquareRounding) && !narrowphase::segments_meet(p, q, a, b);
  });
  return room;
}

double Barriers::distance(const Vec& p, double most) const {
  double least = most * most;
  const Vec far(most, most);
  for_each_near({Vec(p - far), Vec(p + far)}, [&](const Segment& segment) {
    least = std::min(least, (nearest_on_segment(segment.a, segment.b, p) - p).squaredNorm());
  });
  return std::sqrt(least);
}

}  // namespace throng
