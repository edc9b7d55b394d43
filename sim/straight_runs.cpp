// SPDX-License-Identifier: MIT
#include "sim/straight_runs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "broadphase/box_index.h"
#include "narrowphase/weld.h"
#include "sim/contact/contact.h"

namespace throng {

namespace {

/// The points that one straight line from `start` can pass within `slack`: a wedge that narrows with each.
class Wedge {
 public:
  Wedge(const Vec& start, double slack) : start_(start), slack_(slack) {}

  /// Whether the line may end at `point` and pass all those before; if so, it goes on from there.
  bool take(const Vec& point) {
    const Vec way = point - start_;
    const double length = way.norm();
    const bool first = length_ == 0.0;
    if (!first && !(length > length_ && cross(right_, way) >= 0.0 && cross(way, left_) >= 0.0)) return false;
    const Vec aside = (slack_ / length) * tangent(way);
    if (first || cross(right_, way - aside) > 0.0) right_ = way - aside;
    if (first || cross(way + aside, left_) > 0.0) left_ = way + aside;
    length_ = length;
    return true;
  }

 private:
  Vec start_, right_{0.0, 0.0}, left_{0.0, 0.0};
  double slack_, length_ = 0.0;
};

/// Straight pieces one after the other, their ends at 2 i and 2 i + 1.
struct Pieces {
  std::vector<Vec> ends;
  std::vector<std::uint32_t> material;

  void add(const Vec& from, const Vec& to, std::uint32_t of) {
    ends.push_back(from), ends.push_back(to);
    material.push_back(of);
  }
};

Pieces pieces_of(std::span<const Wall> walls) {
  Pieces pieces;
  for (const Wall& wall : walls)
    for (std::size_t i = 0; i + (wall.closed ? 0 : 1) < wall.points.size(); ++i)
      pieces.add(wall.points[i], wall.points[(i + 1) % wall.points.size()], wall.material);
  return pieces;
}

/// Whether `point` lies between a and b, but not within `slack` of either.
bool is_within(const Vec& point, const Vec& a, const Vec& b, double slack) {
  const Vec way = b - a;
  const double length = way.norm(), along = way.dot(point - a);
  return std::abs(cross(way, point - a)) <= slack * length && along > slack * length &&
         along < length * (length - slack);
}

/// The same pieces, cut where a wall ends on one of them: there three meet.
Pieces cut_at_ends(const Pieces& whole, double slack) {
  std::vector<broadphase::Extent> extents;
  for (std::size_t i = 0; i < whole.ends.size(); i += 2)
    extents.push_back(broadphase::Extent::of_segment(whole.ends[i], whole.ends[i + 1]));
  broadphase::BoxIndex index;
  index.build(extents);
  std::vector<std::vector<Vec>> cuts(extents.size());
  for (const Vec& end : whole.ends)
    index.for_each_near(broadphase::Box(end.array() - slack, end.array() + slack), [&](std::uint32_t i) {
      if (is_within(end, whole.ends[2 * i], whole.ends[2 * i + 1], slack)) cuts[i].push_back(end);
    });
  Pieces result;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    Vec from = whole.ends[2 * i];
    std::ranges::sort(cuts[i], {}, [&](const Vec& cut) { return (cut - whole.ends[2 * i]).squaredNorm(); });
    cuts[i].push_back(whole.ends[2 * i + 1]);
    for (const Vec& cut : cuts[i]) {
      if ((cut - from).norm() > slack) result.add(from, cut, whole.material[i]);
      from = cut;
    }
  }
  return result;
}

/// How pieces hang together.
class Chains {
 public:
  Chains(const Pieces& pieces, double slack)
      : ends_(pieces.ends), number_(narrowphase::weld(ends_)), material_(pieces.material), slack_(slack) {
    meeting_.resize(ends_.size()), done_.resize(material_.size());
    leave_out_what_stands_twice();
    for (std::uint32_t end = 0; end < ends_.size(); ++end) {
      if (done_[end / 2]) continue;
      Meeting& here = meeting_[number_[end]];
      if (here.count < 2) here.end[here.count] = end;
      ++here.count;
    }
  }

  std::vector<StraightRun> runs() {
    std::vector<StraightRun> result;
    for (std::uint32_t piece = 0; piece < material_.size(); ++piece)
      if (!done_[piece]) add_chain(first_end(2 * piece), result);
    return result;
  }

 private:
  struct Meeting {
    std::uint32_t count = 0;
    std::array<std::uint32_t, 2> end{};
  };
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  void leave_out_what_stands_twice() {
    std::set<std::array<std::uint32_t, 3>> there;
    for (std::uint32_t piece = 0; piece < material_.size(); ++piece) {
      const auto [from, to] = std::minmax(number_[2 * piece], number_[2 * piece + 1]);
      done_[piece] = !there.insert({from, to, material_[piece]}).second;
    }
  }

  /// The end of the only other piece that goes on from there, of the same material; or none.
  std::uint32_t onward(std::uint32_t end) const {
    const Meeting& here = meeting_[number_[end]];
    if (here.count != 2) return kNone;
    const std::uint32_t other = here.end[here.end[0] == end];
    return material_[other / 2] == material_[end / 2] ? other : kNone;
  }

  /// Where the chain begins that `end` belongs to; of a ring, there.
  std::uint32_t first_end(std::uint32_t end) const {
    std::uint32_t at = end;
    for (std::uint32_t back = onward(at); back != kNone; back = onward(at)) {
      at = back ^ 1u;
      if (at == end) break;
    }
    return at;
  }

  void add_chain(std::uint32_t end, std::vector<StraightRun>& result) {
    Wedge wedge(ends_[end], slack_);
    bool begun = false;
    for (; end != kNone && !done_[end / 2]; end = onward(end ^ 1u)) {
      const Vec &from = ends_[end], &to = ends_[end ^ 1u];
      done_[end / 2] = true;
      if (begun && wedge.take(to)) {
        result.back().to = to;
        continue;
      }
      result.push_back({from, to, material_[end / 2]});
      wedge = Wedge(from, slack_);
      begun = wedge.take(to);
    }
  }

  std::vector<Vec> ends_;
  std::vector<std::uint32_t> number_, material_;
  std::vector<Meeting> meeting_;
  std::vector<bool> done_;
  double slack_;
};

}  // namespace

std::vector<StraightRun> straight_runs(std::span<const Wall> walls) {
  const Pieces pieces = pieces_of(walls);
  const double slack = narrowphase::rounding(pieces.ends);
  return Chains(cut_at_ends(pieces, slack), slack).runs();
}

}  // namespace throng
