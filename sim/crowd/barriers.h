// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/box_index.h"
#include "sim/crowd/clearance.h"
#include "sim/crowd/region.h"

/// What agents can't walk through, as one set of segments: the edges of the walkable area, walls and the
/// domain's box, and bodies that move.
namespace throng {

/// A line of points that agents can't cross.
struct BarrierLine {
  std::vector<Vec> points;  ///< m, two or more
  bool closed = false;
};

class Barriers {
 public:
  struct Segment {
    Vec a, b;              ///< m
    std::uint32_t before;  ///< row of the segment that ends at `a`, or kNone
    std::uint32_t after;   ///< row of the segment that begins at `b`, or kNone
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// `reach` (m): how far will mostly be looked; it decides speed, never answers. O(n log n).
  Barriers(std::span<const BarrierLine> lines, double reach);

  /// Those that stand still.
  std::span<const Segment> segments() const { return std::span(segments_).first(still_); }

  /// Adds lines until the next call, which are found too from now on, one by one: O(their segments) for each
  /// question near one of them.
  void set_moving(std::span<const BarrierLine> lines);

  /// Calls f(point) for each place at most `reach` from `p` at which the distance to the barriers has a local
  /// minimum: of a corner that sticks out its tip, once; of a corner to stand in a place on each side; of a
  /// curve in many pieces its nearest place alone. In the order of the segments. O(segments near). Allocates
  /// nothing.
  template <class F>
  void for_each_nearest(const Vec& p, double reach, F&& f) const;

  /// Calls f(segment) for each that stands still and touches the box, ascending, but before those for each of
  /// the lines that move whose box touches it.
  template <class F>
  void for_each_near(const Eigen::AlignedBox2d& box, F&& f) const {
    for (const Moving& line : moving_)
      if (line.box.intersects(box))
        for (std::size_t row = line.first; row < line.end; ++row) f(segments_[row]);
    const Vec half = 0.5 * (box.max() - box.min());
    const double clear = clearance_.at(box.min() + half);
    if (clear * clear > half.squaredNorm()) return;
    index_.for_each_near(box, [&](std::uint32_t row) { f(segments_[row]); });
  }

  /// m: none is nearer to `p`, though they may all be much farther. O(lines that move).
  double clear(const Vec& p) const {
    double clear = clearance_.at(p);
    for (const Moving& line : moving_) clear = std::min(clear, line.box.exteriorDistance(p));
    return clear;
  }

  /// Asks for the memory that `clear` will read of `p`.
  void prefetch(const Vec& p) const { clearance_.prefetch(p); }

  /// Whether the straight way from `p` to `q` meets a segment, be it by touching. Exact.
  bool block(const Vec& p, const Vec& q) const;

  /// Whether a disc of that radius (m) gets straight on from `p` to `q`: it comes nowhere nearer to a segment
  /// than its radius, but to one that it is as near to at one of the ends. Crossing none is exact.
  bool leave_room(const Vec& p, const Vec& q, double radius) const;

  /// m, from `p` to the nearest segment; `most` where that is farther.
  double distance(const Vec& p, double most) const;

 private:
  /// Whether the nearest point of the segment is a local minimum over its line too.
  bool is_minimum(const Segment& segment, const Vec& nearest, const Vec& p) const;

  struct Moving {
    std::size_t first, end;  ///< of the segments
    Eigen::AlignedBox2d box;
  };

  void add(const BarrierLine& line);

  std::vector<Segment> segments_;  // those that move behind those that stand still
  std::size_t still_ = 0;
  std::vector<Moving> moving_;
  broadphase::BoxIndex index_;
  Clearance clearance_;
};

inline bool Barriers::is_minimum(const Segment& segment, const Vec& nearest, const Vec& p) const {
  if (nearest == segment.b && segment.after != kNone) return false;  // left to the next, which begins there
  if (nearest != segment.a || segment.before == kNone) return true;
  const Segment& before = segments_[segment.before];
  return (p - before.b).dot(before.b - before.a) >= 0.0;
}

template <class F>
void Barriers::for_each_nearest(const Vec& p, double reach, F&& f) const {
  const Vec far(reach, reach);
  for_each_near({Vec(p - far), Vec(p + far)}, [&](const Segment& segment) {
    const Vec nearest = nearest_on_segment(segment.a, segment.b, p);
    if ((nearest - p).squaredNorm() <= reach * reach && is_minimum(segment, nearest, p)) f(nearest);
  });
}

}  // namespace throng
