// SPDX-License-Identifier: MIT
#include "sim/crowd/social_force.h"

#include <algorithm>
#include <cmath>

#include "sim/crowd/exponential.h"

namespace throng {

namespace {

constexpr ModelParameter kParameters[] = {
    {"mass", 80.0, 1.0, 1e4, "kg", "Mass, kg."},
    {"reaction_time", 0.5, 1e-3, 1e3, "s", "In which the velocity adapts to the desired one, s."},
    {"strength", 2000.0, 0.0, 1e6, "N", "Of the repulsion where two agents just touch, N."},
    {"range", 0.08, 1e-4, 1e3, "m", "Over which the repulsion falls by e, m."},
    {"stiffness", 1.2e5, 0.0, 1e9, "kg/s^2", "Of bodies in touch, kg/s^2."},
    {"friction", 2.4e5, 0.0, 1e9, "kg/(m s)", "Of bodies in touch, kg/(m s)."},
    {"cutoff", 2.5, 0.0, 1e3, "m", "How far others are looked at, centre to centre, m."}};

constexpr double kNegligible = 16.0;  // ranges: what repels less than e^-16 of the strength is left out
constexpr double kTouching = 6.0;     // as many discs of one size may touch one

class SocialForce : public WalkingModel {
 public:
  explicit SocialForce(std::span<const double> v)
      : mass_(v[0]),
        reaction_time_(v[1]),
        strength_(v[2]),
        range_(v[3]),
        stiffness_(v[4]),
        friction_(v[5]),
        cutoff_(v[6]) {}

  Vec velocity(const CrowdView& crowd, std::uint32_t row) const override {
    const Vec &p = crowd.position[row], &v = crowd.velocity[row];
    const double radius = crowd.radius[row];
    Vec force = (mass_ / reaction_time_) * (crowd.desired_speed[row] * crowd.towards[row] - v);
    for (std::size_t k = crowd.near.begin[row]; k < crowd.near.begin[row + 1]; ++k) {
      const double distance = crowd.near.distance[k];
      if (distance > cutoff_) break;
      const std::uint32_t other = crowd.near.row[k];
      const double depth = radius + crowd.radius[other] - distance;
      if (depth < -kNegligible * range_) continue;
      const Vec away =
          distance > 0.0 ? Vec((p - crowd.position[other]) / distance) : Vec(row < other ? -1.0 : 1.0, 0.0);
      force += contact(depth, away, crowd.velocity[other] - v, 0.5 / crowd.dt);
    }
    crowd.barriers.for_each_nearest(p, radius + kNegligible * range_, [&](const Vec& q) {
      const double distance = (p - q).norm();
      if (distance > 0.0) force += contact(radius - distance, (p - q) / distance, -v, 1.0 / crowd.dt);
    });
    return v + crowd.dt / mass_ * force;
  }

  double reach(double largest_radius) const override {
    return std::min(cutoff_, 2.0 * largest_radius + kNegligible * range_);
  }
  double core() const override { return 0.5; }
  double longest_step(double, double) const override {
    return std::min(reaction_time_, 2.0 / std::sqrt(kTouching * stiffness_ / mass_));
  }

 private:
  /// N, at this depth (m, below 0: a gap), from what moves past at `slip` (m/s). Friction may end the slip at
  /// `most` (1/s) at the fastest.
  Vec contact(double depth, const Vec& away, const Vec& slip, double most) const {
    double push = strength_ * exponential(std::min(depth / range_, 700.0));
    if (depth <= 0.0) return push * away;
    push += stiffness_ * depth;
    const Vec along(-away.y(), away.x());
    const double rub = std::min(friction_ * depth, mass_ * most);
    return push * away + rub * slip.dot(along) * along;
  }

  double mass_, reaction_time_, strength_, range_, stiffness_, friction_, cutoff_;
};

}  // namespace

ModelKind social_force() {
  return {"social_force", "Forces of Helbing, Farkas and Vicsek (2000).", kParameters,
          [](std::span<const double> values) -> std::unique_ptr<WalkingModel> {
            return std::make_unique<SocialForce>(values);
          }};
}

}  // namespace throng
