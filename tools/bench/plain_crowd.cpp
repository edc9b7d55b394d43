// SPDX-License-Identifier: MIT
#include "tools/bench/plain_crowd.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nanoflann.hpp>

#include "sim/crowd/model.h"
#include "sim/crowd/orca.h"
#include "sim/crowd/slide.h"
#include "sim/crowd/velocity_obstacle.h"
#include "sim/crowd/walk.h"
#include "sim/random.h"
#include "tools/bench/dataset.h"
#include "tools/bench/plain_velocity.h"

namespace throng::bench {

struct PlainCrowd::Near {
  using Metric = nanoflann::L2_Simple_Adaptor<double, Dataset, double, std::uint32_t>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Dataset, 2, std::uint32_t>;

  explicit Near(const std::vector<Vec>& points)
      : cloud{points}, tree(2, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {
    tree.buildIndex();
  }

  /// Calls f(row, vector there, distance) for the others within `reach` and behind no wall, the nearest
  /// `most`.
  template <class F>
  void for_each(std::uint32_t own, double reach, std::size_t most, const Barriers& walls, F f) const {
    const Vec& p = cloud.points[own];
    std::vector<std::pair<std::uint32_t, double>> found;
    tree.radiusSearch(p.data(), reach * reach, found, nanoflann::SearchParams());
    std::size_t count = 0;
    for (const auto& [row, square] : found)
      if (row != own && !walls.block(p, cloud.points[row]) && count++ < most)
        f(row, Vec(cloud.points[row] - p), std::sqrt(square));
  }

  Dataset cloud;
  Tree tree;
};

PlainCrowd::PlainCrowd(const Scene& scene)
    : scene_(scene),
      model_(walking_models()[scene.crowd.groups[0].model].name),
      barriers_(barrier_lines(scene), 1.0),
      goals_(scene.crowd.goals.size()),
      position_(scene.bodies.position),
      velocity_(scene.bodies.velocity) {
  double largest = 0.0;
  for (const double radius : scene.bodies.radius) largest = std::max(largest, radius);
  for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
    const Resolution resolution = resolution_for(scene.crowd.walkable, barriers_, largest);
    goals_[goal].plan =
        std::make_unique<FloorPlan>(floor_plan(scene.crowd.walkable, barriers_, resolution, 2.0 * largest));
    goals_[goal].field =
        std::make_unique<DistanceField>(*goals_[goal].plan, barriers_, scene.crowd.goals[goal].region);
  }
}

PlainCrowd::~PlainCrowd() = default;

std::span<const double> PlainCrowd::parameters(std::uint32_t agent) const {
  const AgentGroup& group = scene_.crowd.groups[scene_.crowd.group[agent]];
  return group.parameters_of(agent - group.first);
}

Vec PlainCrowd::towards(std::uint32_t agent) const {
  const std::uint32_t goal = scene_.crowd.goal(scene_.crowd.leg(agent, 0), 0);
  return goals_[goal].field->direction(position_[agent]);
}

void PlainCrowd::step() {
  near_ = std::make_unique<Near>(position_);
  std::vector<Vec> next(position_.size());
  for (std::uint32_t agent = 0; agent < next.size(); ++agent)
    next[agent] = model_ == "social_force"           ? social_force(agent)
                  : model_ == "collision_free_speed" ? free_speed(agent)
                                                     : orca(agent);
  for (std::size_t agent = 0; agent < next.size(); ++agent) {
    const double core = model_ == "social_force" ? 0.5 : 1.0;
    const Vec from = position_[agent];
    const Moved moved =
        slide(barriers_, from, scene_.time.dt * next[agent], core * scene_.bodies.radius[agent]);
    position_[agent] = moved.to;
    velocity_[agent] = moved.corrected ? Vec((moved.to - from) / scene_.time.dt) : next[agent];
  }
  ++step_;
}

Vec PlainCrowd::free_speed(std::uint32_t agent) const {
  const std::span<const double> v = parameters(agent);
  const double time_gap = v[0], strength = v[1], range = v[2], wall_strength = v[3], wall_range = v[4];
  const std::vector<double>& radius = scene_.bodies.radius;
  Vec heading = towards(agent);
  near_->for_each(agent, v[5], position_.size(), barriers_,
                  [&](std::uint32_t other, const Vec& to, double distance) {
                    const double gap = distance - radius[agent] - radius[other];
                    if (gap <= 16.0 * range) heading -= strength * std::exp(-gap / range) * to / distance;
                  });
  barriers_.for_each_nearest(position_[agent], radius[agent] + 16.0 * wall_range, [&](const Vec& q) {
    const Vec out = position_[agent] - q;
    heading += wall_strength * std::exp((radius[agent] - out.norm()) / wall_range) * out.normalized();
  });
  heading.normalize();
  double gap = std::numeric_limits<double>::infinity();
  near_->for_each(
      agent, v[5], position_.size(), barriers_, [&](std::uint32_t other, const Vec& to, double distance) {
        const double width = radius[agent] + radius[other];
        if (heading.dot(to) >= 0.0 && std::abs(heading.x() * to.y() - heading.y() * to.x()) <= width)
          gap = std::min(gap, distance - width);
      });
  return std::max(0.0, std::min(scene_.crowd.desired_speed[agent], gap / time_gap)) * heading;
}

Vec PlainCrowd::social_force(std::uint32_t agent) const {
  const std::span<const double> v = parameters(agent);
  const double mass = v[0], reaction = v[1], strength = v[2], range = v[3], stiffness = v[4], friction = v[5];
  const std::vector<double>& radius = scene_.bodies.radius;
  const Vec& own = velocity_[agent];
  Vec force = mass / reaction * (scene_.crowd.desired_speed[agent] * towards(agent) - own), rub(0.0, 0.0);
  Eigen::Matrix2d damping = Eigen::Matrix2d::Zero();
  const auto act = [&](double depth, const Vec& away, const Vec& slip, double share) {
    force += strength * std::exp(depth / range) * away;
    if (depth <= 0.0) return;
    const Vec along(-away.y(), away.x());
    force += stiffness * depth * away;
    rub += friction * depth * slip.dot(along) * along;
    damping += share * friction * depth * along * along.transpose();
  };
  near_->for_each(agent, v[6], position_.size(), barriers_,
                  [&](std::uint32_t other, const Vec& to, double distance) {
                    const double depth = radius[agent] + radius[other] - distance;
                    if (depth >= -16.0 * range) act(depth, -to / distance, velocity_[other] - own, 2.0);
                  });
  barriers_.for_each_nearest(position_[agent], radius[agent] + 16.0 * range, [&](const Vec& q) {
    const Vec out = position_[agent] - q;
    act(radius[agent] - out.norm(), out.normalized(), -own, 1.0);
  });
  const double rate = scene_.time.dt / mass;
  return own + (Eigen::Matrix2d::Identity() + rate * damping).inverse() * (rate * (force + rub));
}

Vec PlainCrowd::orca(std::uint32_t agent) const {
  const std::span<const double> v = parameters(agent);
  const std::vector<double>& radius = scene_.bodies.radius;
  std::vector<HalfPlane> planes, room;
  for (const Barriers::Segment& wall : barriers_.segments()) {
    const Vec out = position_[agent] - nearest_on_segment(wall.a, wall.b, position_[agent]);
    if (out.norm() > radius[agent] + v[1] * v[4]) continue;
    if (out.norm() <= radius[agent]) {
      planes.push_back({out.normalized(), 0.0});
      continue;
    }
    const auto [point, normal] =
        escape(wall.a - position_[agent], wall.b - position_[agent], radius[agent], v[1], velocity_[agent]);
    planes.push_back({normal, normal.dot(point)});
  }
  const std::size_t walls = planes.size();
  near_->for_each(
      agent, v[2], static_cast<std::size_t>(v[3]), barriers_,
      [&](std::uint32_t other, const Vec& to, double distance) {
        const double width = radius[agent] + radius[other];
        const Vec relative = velocity_[agent] - velocity_[other];
        Escape out;
        if (distance > width) {
          out = escape(to, to, width, v[0], relative);
        } else {
          out.normal = (relative - to / scene_.time.dt).normalized();
          out.point = to / scene_.time.dt + width / scene_.time.dt * out.normal;
        }
        planes.push_back({out.normal, out.normal.dot(velocity_[agent] + 0.5 * (out.point - relative))});
      });
  Random random(scene_.seed, static_cast<std::uint64_t>(step_), agent + 1, Purpose::doubt);
  const double x = random.uniform(-kOrcaDoubt, kOrcaDoubt);
  const double y = random.uniform(-kOrcaDoubt, kOrcaDoubt);
  const Vec wanted = scene_.crowd.desired_speed[agent] * (towards(agent) + Vec(x, y));
  return plain_velocity(planes, walls, v[4], wanted, room);
}

}  // namespace throng::bench
