// SPDX-License-Identifier: MIT
#include "sim/crowd/collision_free_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/crowd/exponential.h"

namespace throng {

namespace {

constexpr ModelParameter kParameters[] = {
    {"time_gap", 1.0, 1e-2, 1e2, "s", "To the one ahead: speed is the gap over it, s."},
    {"neighbour_strength", 8.0, 0.0, 1e3, "", "Of the turning away from others who touch."},
    {"neighbour_range", 0.1, 1e-3, 1e2, "m", "Over which that falls by e, m."},
    {"wall_strength", 5.0, 0.0, 1e3, "", "Of the turning away from barriers that are touched."},
    {"wall_range", 0.02, 1e-3, 1e2, "m", "Over which that falls by e, m."},
    {"cutoff", 3.0, 0.0, 1e3, "m", "How far others are looked at, centre to centre, m."}};

constexpr double kNegligible = 16.0;  // ranges: e^-16 of the strength
constexpr double kMost = 700.0;       // exponent

class CollisionFreeSpeed : public WalkingModel {
 public:
  explicit CollisionFreeSpeed(std::span<const double> v)
      : time_gap_(v[0]),
        strength_(v[1]),
        range_(v[2]),
        wall_strength_(v[3]),
        wall_range_(v[4]),
        cutoff_(v[5]) {}

  Vec velocity(const CrowdView& crowd, std::uint32_t row) const override {
    const Vec heading = this->heading(crowd, row);
    const double speed = std::min(crowd.desired_speed[row], gap_ahead(crowd, row, heading) / time_gap_);
    return std::max(0.0, speed) * heading;
  }

  double reach(double) const override { return cutoff_; }

  double longest_step(double radius, double desired_speed) const override {
    const double half = 0.5 * time_gap_;
    if (!(desired_speed > 0.0)) return half;
    return std::min(half, 2.0 * radius * (std::sqrt(2.0) - 1.0) / (desired_speed * std::sqrt(2.0)));
  }

 private:
  Vec heading(const CrowdView& crowd, std::uint32_t row) const {
    const Vec& p = crowd.position[row];
    const double radius = crowd.radius[row];
    Vec sum = crowd.towards[row];
    for_each_other(crowd, row, [&](std::uint32_t other, double distance, const Vec& to) {
      const double gap = distance - radius - crowd.radius[other];
      if (gap > kNegligible * range_) return;
      sum -= strength_ * exponential(std::min(-gap / range_, kMost)) * to;
    });
    crowd.barriers.for_each_nearest(p, radius + kNegligible * wall_range_, [&](const Vec& q) {
      const double distance = (p - q).norm();
      if (distance > 0.0)
        sum += wall_strength_ * exponential(std::min((radius - distance) / wall_range_, kMost)) *
               ((p - q) / distance);
    });
    const double length = sum.norm();
    return length > 0.0 ? Vec(sum / length) : Vec(0.0, 0.0);
  }

  /// m, to the nearest one whom walking on along `heading` would run into.
  double gap_ahead(const CrowdView& crowd, std::uint32_t row, const Vec& heading) const {
    double least = std::numeric_limits<double>::infinity();
    for_each_other(crowd, row, [&](std::uint32_t other, double distance, const Vec& to) {
      const double width = crowd.radius[row] + crowd.radius[other];
      const double across = std::abs(heading.x() * to.y() - heading.y() * to.x());
      if (heading.dot(to) >= 0.0 && across * distance <= width) least = std::min(least, distance - width);
    });
    return least;
  }

  /// Calls f(row, distance, unit vector there); two in one place part along x.
  template <class F>
  void for_each_other(const CrowdView& crowd, std::uint32_t row, F f) const {
    for (std::size_t k = crowd.near.begin[row]; k < crowd.near.begin[row + 1]; ++k) {
      const double distance = crowd.near.distance[k];
      if (distance > cutoff_) return;
      const std::uint32_t other = crowd.near.row[k];
      const Vec to = crowd.position[other] - crowd.position[row];
      f(other, distance, distance > 0.0 ? Vec(to / distance) : Vec(row < other ? 1.0 : -1.0, 0.0));
    }
  }

  double time_gap_, strength_, range_, wall_strength_, wall_range_, cutoff_;
};

}  // namespace

ModelKind collision_free_speed() {
  return {"collision_free_speed", "Speed by the gap ahead, of Tordeux, Chraibi and Seyfried (2016).",
          kParameters, [](std::span<const double> values) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<CollisionFreeSpeed>(values);
          }};
}

}  // namespace throng
