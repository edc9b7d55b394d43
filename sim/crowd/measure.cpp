// SPDX-License-Identifier: MIT
#include "sim/crowd/measure.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "sim/crowd/inside.h"
#include "sim/crowd/voronoi_density.h"

namespace throng {

namespace {

/// Twice the area of the triangle; above 0 where c is to the left of the way from a to b.
double left_of(const Vec& a, const Vec& b, const Vec& c) {
  const Vec along = b - a, to = c - a;
  return along.x() * to.y() - along.y() * to.x();
}

void count(std::int64_t step, std::int64_t& counter, Measured& measured, std::int64_t times = 1) {
  if (measured.count + measured.back == 0) measured.first = step;
  measured.last = step;
  counter += times;
}

void count_crossings(std::int64_t ways, std::int64_t step, Measured& measured) {
  if (ways != 0) count(step, ways > 0 ? measured.count : measured.back, measured, std::abs(ways));
}

bool is_at_line(const std::array<Vec, 2>& line, const Stride& stride) {
  const Vec off = stride.to - nearest_on_segment(line[0], line[1], stride.to);
  return off.squaredNorm() <= stride.radius * stride.radius;
}

/// Those of `on_lines` who were on this line, or beside this area.
class Known {
 public:
  explicit Known(const OnLines& on_lines)
      : first_(std::ranges::lower_bound(on_lines.before, on_lines.line, {}, &OnLine::line)),
        end_(std::ranges::upper_bound(on_lines.before, on_lines.line, {}, &OnLine::line)) {}

  bool empty() const { return first_ == end_; }
  auto begin() const { return first_; }
  auto end() const { return end_; }

  /// Nothing where he isn't among them.
  OnLine* find(std::uint32_t id) const {
    const auto at = std::ranges::lower_bound(first_, end_, id, {}, &OnLine::id);
    return at != end_ && at->id == id ? &*at : nullptr;
  }

 private:
  std::vector<OnLine>::iterator first_, end_;
};

void measure_line(const Measure& measure, std::span<const Stride> strides, std::int64_t step,
                  Measured& measured, const OnLines& on_lines) {
  const Known known(on_lines);
  for (const Stride& stride : strides) {
    const int way = crossing(measure.line, stride.from, stride.to);
    if (way == 0 && (known.empty() || !is_at_line(measure.line, stride))) continue;
    OnLine* const sways = known.find(stride.id);
    if (way == 0 && !sways) continue;
    std::int32_t uncounted = 0;
    if (sways) {
      uncounted = std::exchange(sways->uncounted, 0) + way;
    } else {
      count_crossings(way, step, measured);
      ++measured.samples;
      measured.speed += stride.speed;
    }
    if (is_at_line(measure.line, stride))
      on_lines.after.push_back({on_lines.line, stride.id, uncounted});
    else
      count_crossings(uncounted, step, measured);
  }
  for (const OnLine& gone : known) count_crossings(gone.uncounted, step, measured);
}

bool is_beside(const Region& area, const Stride& stride) {
  return (nearest_on_border(area, stride.to) - stride.to).squaredNorm() <= stride.radius * stride.radius;
}

void measure_area(const Measure& measure, std::span<const Stride> strides, std::int64_t step,
                  Measured& measured, const OnLines& on_lines) {
  thread_local Inside is_in;
  is_in.set(measure.area);
  const Known known(on_lines);
  for (const Stride& stride : strides) {
    bool was_in = is_in(stride.from) || known.find(stride.id);
    if (!is_in(stride.to)) {
      if (!was_in && is_in.meets_border(stride.from, stride.to))
        count(step, measured.count, measured), was_in = true;
      if (was_in && is_beside(measure.area, stride)) on_lines.after.push_back({on_lines.line, stride.id, 0});
      continue;
    }
    if (measured.steps == 0 || !was_in) count(step, measured.count, measured);
    ++measured.samples;
    measured.speed += stride.speed;
  }
}

constexpr double kUnmeasured = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kLineColumns[] = {"count", "forward", "back", "flow", "speed"};
constexpr const char* kAreaColumns[] = {"count", "density", "speed", "flow", "density_voronoi"};

/// Density, speed and flow in an area.
std::array<double, 3> measure_instant(const Measure& measure, const Instant& instant) {
  if (!measure.is_on(instant.step)) return {kUnmeasured, kUnmeasured, kUnmeasured};
  const Inside is_in(measure.area);
  double agents = 0.0, sum = 0.0;
  for (std::size_t row = 0; row < instant.position.size(); ++row) {
    const Vec& p = instant.position[row];
    if (!is_in(p)) continue;
    ++agents;
    sum += instant.velocity[row].norm();
  }
  const double density = agents / measure.size;
  return {density, agents > 0.0 ? sum / agents : kUnmeasured, agents > 0.0 ? sum / measure.size : 0.0};
}

double voronoi_instant(const Measure& measure, const Instant& instant) {
  if (!measure.is_on(instant.step)) return kUnmeasured;
  return VoronoiDensity(instant.floor, measure.ground, measure.size, measure.cutoff)
      .density(instant.position);
}

}  // namespace

int crossing(const std::array<Vec, 2>& line, const Vec& from, const Vec& to) {
  const bool was_left = left_of(line[0], line[1], from) > 0.0, is_left = left_of(line[0], line[1], to) > 0.0;
  if (was_left == is_left) return 0;
  const bool passes = (left_of(from, to, line[0]) > 0.0) != (left_of(from, to, line[1]) > 0.0);
  return passes ? (was_left ? 1 : -1) : 0;
}

void measure(const Measure& measure, std::span<const Stride> strides, std::int64_t step, Measured& measured,
             const OnLines& on_lines) {
  if (!measure.is_on(step)) return;
  const auto first = static_cast<std::ptrdiff_t>(on_lines.after.size());
  measure.area.empty() ? measure_line(measure, strides, step, measured, on_lines)
                       : measure_area(measure, strides, step, measured, on_lines);
  std::ranges::sort(on_lines.after.begin() + first, on_lines.after.end(), {}, &OnLine::id);
  ++measured.steps;
}

void measure_entry(const Measure& measure, const Vec& place, std::int64_t step, Measured& measured) {
  if (measure.is_on(step) && contains(measure.area, place)) count(step, measured.count, measured);
}

Reading reading(const Measure& measure, const Measured& measured, double dt) {
  Reading result{measured.count + measured.back, {}, {}, {}, {}};
  if (measured.samples > 0) result.speed = measured.speed / static_cast<double>(measured.samples);
  if (measure.area.empty()) {
    const double between = static_cast<double>(measured.last - measured.first) * dt;
    if (between > 0.0) result.flow = static_cast<double>(result.count - 1) / between;
  } else if (measured.steps > 0) {
    result.density =
        static_cast<double>(measured.samples) / static_cast<double>(measured.steps) / measure.size;
    result.flow = *result.density * result.speed.value_or(0.0);
    if (measure.cutoff > 0.0) result.density_voronoi = measured.voronoi / static_cast<double>(measured.steps);
  }
  return result;
}

std::span<const char* const> columns(const Measure& measure) {
  if (measure.area.empty()) return kLineColumns;
  const std::span<const char* const> all(kAreaColumns);
  return measure.cutoff > 0.0 ? all : all.first(all.size() - 1);
}

void append_columns(const Measure& measure, const Measured& measured, const Instant& instant,
                    std::vector<double>& row) {
  const Reading read = reading(measure, measured, instant.dt);
  row.push_back(static_cast<double>(read.count));
  if (measure.area.empty()) {
    for (const std::int64_t count : {measured.count, measured.back})
      row.push_back(static_cast<double>(count));
    row.push_back(read.flow.value_or(kUnmeasured));
    row.push_back(read.speed.value_or(kUnmeasured));
    return;
  }
  const std::array<double, 3> now = measure_instant(measure, instant);
  row.insert(row.end(), now.begin(), now.end());
  if (measure.cutoff > 0.0) row.push_back(voronoi_instant(measure, instant));
}

}  // namespace throng
