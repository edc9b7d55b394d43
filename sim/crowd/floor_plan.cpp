// SPDX-License-Identifier: MIT
#include "sim/crowd/floor_plan.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/crossing.h"
#include "sim/crowd/inside.h"

namespace throng {

namespace {

/// Columns or rows from `low` to `high`, no farther than the plan goes.
struct Span {
  int first, last;
  Span(double low, double high, int count)
      : first(static_cast<int>(std::clamp(std::ceil(low), 0.0, static_cast<double>(count)))),
        last(static_cast<int>(std::clamp(std::floor(high), -1.0, count - 1.0))) {}
};

/// Where the region's rings cross the line of this height, ascending.
void find_crossings(const Region& region, double y, std::vector<double>& at) {
  at.clear();
  for (const std::vector<Vec>& ring : region.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() > y) != (b.y() > y)) at.push_back(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
    }
  std::sort(at.begin(), at.end());
}

void fill_inside(const Region& walkable, FloorPlan& plan) {
  std::vector<double> at;
  for (int row = 0; row < plan.rows; ++row) {
    find_crossings(walkable, plan.origin.y() + plan.cell * row, at);
    for (std::size_t k = 0; k + 1 < at.size(); k += 2) {
      const Span span((at[k] - plan.origin.x()) / plan.cell, (at[k + 1] - plan.origin.x()) / plan.cell,
                      plan.columns);
      for (int column = span.first; column <= span.last; ++column)
        plan.footing[static_cast<std::size_t>(row) * plan.columns + column] = Footing::free;
    }
  }
}

/// Takes the footing of the nodes within `reach` of the segment down to `footing`.
void mark_near(const Vec& a, const Vec& b, double reach, Footing footing, FloorPlan& plan) {
  const Vec low = (a.cwiseMin(b) - plan.origin) / plan.cell, high = (a.cwiseMax(b) - plan.origin) / plan.cell;
  const double far = reach / plan.cell;
  const Span rows(low.y() - far, high.y() + far, plan.rows);
  const Vec along = b - a;
  for (int row = rows.first; row <= rows.last; ++row) {
    // the part of the segment within `reach` of this row
    double from = low.x(), to = high.x();
    if (along.y() != 0.0) {
      const double y = plan.origin.y() + plan.cell * row;
      const double s = std::clamp((y - reach - a.y()) / along.y(), 0.0, 1.0);
      const double t = std::clamp((y + reach - a.y()) / along.y(), 0.0, 1.0);
      const double x = (a.x() + s * along.x() - plan.origin.x()) / plan.cell;
      const double z = (a.x() + t * along.x() - plan.origin.x()) / plan.cell;
      from = std::min(x, z), to = std::max(x, z);
    }
    const Span columns(from - far, to + far, plan.columns);
    for (int column = columns.first; column <= columns.last; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * plan.columns + column;
      const Vec p = plan.node(i);
      const double gap2 = (nearest_on_segment(a, b, p) - p).squaredNorm();
      if (gap2 <= reach * reach) plan.footing[i] = std::min(plan.footing[i], footing);
    }
  }
}

/// The shortest way between two segments, as two points.
std::pair<Vec, Vec> bridge(const Barriers::Segment& one, const Barriers::Segment& other) {
  std::pair<Vec, Vec> best{one.a, nearest_on_segment(other.a, other.b, one.a)};
  const auto offer = [&](const Vec& p, const Vec& q) {
    if ((p - q).squaredNorm() < (best.first - best.second).squaredNorm()) best = {p, q};
  };
  offer(one.b, nearest_on_segment(other.a, other.b, one.b));
  offer(nearest_on_segment(one.a, one.b, other.a), other.a);
  offer(nearest_on_segment(one.a, one.b, other.b), other.b);
  return best;
}

/// Nobody as wide as `closed` passes between two points of barriers that are less than that apart: his middle
/// would cross the straight way between them, and be nearer to one of them than half his width.
void close_narrow(const Barriers& barriers, double closed, FloorPlan& plan) {
  const Vec far(closed, closed);
  for (const Barriers::Segment& one : barriers.segments()) {
    const Eigen::AlignedBox2d box(Vec(one.a.cwiseMin(one.b) - far), Vec(one.a.cwiseMax(one.b) + far));
    barriers.for_each_near(box, [&](const Barriers::Segment& other) {
      if (&other <= &one) return;
      const auto [p, q] = bridge(one, other);
      if ((p - q).squaredNorm() <= closed * closed) mark_near(p, q, 0.5 * plan.cell, Footing::closed, plan);
    });
  }
}

/// Of a side of the floor's box, with some beyond.
double nodes_along(double side, double cell) {
  return std::ceil(side / cell) + 3.0;
}

}  // namespace

std::vector<double> passages(const Region& walkable, const Barriers& barriers, double least, double most) {
  std::vector<double> widths;
  const Inside inside(walkable);
  const Vec far(most, most);
  for (const Barriers::Segment& one : barriers.segments()) {
    const Eigen::AlignedBox2d box(Vec(one.a.cwiseMin(one.b) - far), Vec(one.a.cwiseMax(one.b) + far));
    barriers.for_each_near(box, [&](const Barriers::Segment& other) {
      if (&other <= &one || narrowphase::segments_meet(one.a, one.b, other.a, other.b)) return;
      const auto [p, q] = bridge(one, other);
      const double width = (p - q).norm();
      if (width >= least && width <= most && inside(p + 0.5 * (q - p))) widths.push_back(width);
    });
  }
  std::ranges::sort(widths);
  widths.erase(std::unique(widths.begin(), widths.end()), widths.end());
  return widths;
}

Resolution resolution_for(const Region& walkable, const Barriers& barriers, double radius) {
  const double widest = 4.0 * radius;
  const std::vector<double> open = passages(walkable, barriers, closed_to(radius), widest);
  const double passage = open.empty() ? widest : open.front();
  const Vec sizes = bounds(walkable).sizes();
  const double finest = std::sqrt(sizes.x() * sizes.y() / kMostNodes);
  const double cell = std::max({passage / 8.0, finest, sizes.maxCoeff() / kMostNodes});
  return {cell, std::max(std::min(radius, 0.5 * passage - 2.0 * cell), 0.5 * cell)};
}

double plan_nodes(const Region& walkable, const Resolution& resolution) {
  const Vec sizes = bounds(walkable).sizes();
  return nodes_along(sizes.x(), resolution.cell) * nodes_along(sizes.y(), resolution.cell);
}

FloorPlan floor_plan(const Region& walkable, const Barriers& barriers, const Resolution& resolution,
                     double closed) {
  const Eigen::AlignedBox2d box = bounds(walkable);
  FloorPlan plan;
  plan.cell = resolution.cell;
  plan.clearance = resolution.clearance;
  plan.origin = box.min() - Vec(plan.cell, plan.cell);
  plan.columns = static_cast<int>(nodes_along(box.sizes().x(), plan.cell));
  plan.rows = static_cast<int>(nodes_along(box.sizes().y(), plan.cell));
  plan.footing.assign(static_cast<std::size_t>(plan.columns) * static_cast<std::size_t>(plan.rows),
                      Footing::none);
  fill_inside(walkable, plan);
  for (const Barriers::Segment& segment : barriers.segments()) {
    mark_near(segment.a, segment.b, plan.clearance, Footing::close, plan);
    mark_near(segment.a, segment.b, std::min(plan.clearance, 0.75 * plan.cell), Footing::tight, plan);
    mark_near(segment.a, segment.b, 0.0, Footing::none, plan);
  }
  close_narrow(barriers, closed, plan);
  return plan;
}

}  // namespace throng
