// SPDX-License-Identifier: MIT
#include "sim/crowd/measure.h"

namespace throng {

namespace {

/// Twice the area of the triangle; above 0 where c is to the left of the way from a to b.
double left_of(const Vec& a, const Vec& b, const Vec& c) {
  const Vec along = b - a, to = c - a;
  return along.x() * to.y() - along.y() * to.x();
}

void count(std::int64_t step, std::int64_t& counter, Measured& measured) {
  if (measured.count + measured.back == 0) measured.first = step;
  measured.last = step;
  ++counter;
}

void measure_line(const Measure& measure, std::span<const Stride> strides, std::int64_t step,
                  Measured& measured) {
  for (const Stride& stride : strides) {
    const int way = crossing(measure.line, stride.from, stride.to);
    if (way == 0) continue;
    count(step, way > 0 ? measured.count : measured.back, measured);
    ++measured.samples;
    measured.speed += stride.speed;
  }
}

void measure_area(const Measure& measure, std::span<const Stride> strides, std::int64_t step,
                  Measured& measured) {
  const Eigen::AlignedBox2d box = bounds(measure.area);
  const auto is_in = [&](const Vec& p) { return box.contains(p) && contains(measure.area, p); };
  for (const Stride& stride : strides) {
    if (!is_in(stride.to)) continue;
    if (measured.steps == 0 || !is_in(stride.from)) count(step, measured.count, measured);
    ++measured.samples;
    measured.speed += stride.speed;
  }
}

}  // namespace

int crossing(const std::array<Vec, 2>& line, const Vec& from, const Vec& to) {
  const bool was_left = left_of(line[0], line[1], from) > 0.0, is_left = left_of(line[0], line[1], to) > 0.0;
  if (was_left == is_left) return 0;
  const bool passes = (left_of(from, to, line[0]) > 0.0) != (left_of(from, to, line[1]) > 0.0);
  return passes ? (was_left ? 1 : -1) : 0;
}

void measure(const Measure& measure, std::span<const Stride> strides, std::int64_t step, Measured& measured) {
  if (!measure.is_on(step)) return;
  measure.area.empty() ? measure_line(measure, strides, step, measured)
                       : measure_area(measure, strides, step, measured);
  ++measured.steps;
}

void measure_entry(const Measure& measure, const Vec& place, std::int64_t step, Measured& measured) {
  if (measure.is_on(step) && contains(measure.area, place)) count(step, measured.count, measured);
}

Reading reading(const Measure& measure, const Measured& measured, double dt) {
  Reading result{measured.count + measured.back, {}, {}, {}};
  if (measured.samples > 0) result.speed = measured.speed / static_cast<double>(measured.samples);
  if (measure.area.empty()) {
    const double between = static_cast<double>(measured.last - measured.first) * dt;
    if (between > 0.0) result.flow = static_cast<double>(result.count - 1) / between;
  } else if (measured.steps > 0) {
    result.density =
        static_cast<double>(measured.samples) / static_cast<double>(measured.steps) / measure.size;
    result.flow = *result.density * result.speed.value_or(0.0);
  }
  return result;
}

}  // namespace throng
