// SPDX-License-Identifier: MIT
#include "sim/crowd/entrance.h"

#include <algorithm>

#include "sim/random.h"

namespace throng {

namespace {

struct Disc {
  Vec centre;     // m
  double radius;  // m
};

/// Who is there and could be in the way of discs of that radius in the box.
std::vector<Disc> others_near(const Scene& scene, const State& state, const Eigen::AlignedBox2d& box,
                              double radius) {
  std::vector<Disc> others;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    const double their = scene.bodies.radius[state.id[row] - std::size_t{1}], reach = radius + their;
    if (box.squaredExteriorDistance(state.position[row]) < reach * reach)
      others.push_back({state.position[row], their});
  }
  return others;
}

}  // namespace

std::optional<Vec> free_place(const Scene& scene, const Barriers& barriers, const State& state,
                              const Entrance& entrance, std::uint32_t agent,
                              const std::function<bool(const Vec&)>& suits) {
  const double radius = scene.bodies.radius[agent], clear = radius + entrance.gap;
  const Eigen::AlignedBox2d box = bounds(entrance.within);
  const std::vector<Disc> others = others_near(scene, state, box, clear);
  Random random(scene.seed, static_cast<std::uint64_t>(state.step), agent + 1, Purpose::place);
  for (int i = 0; i < kEntranceTries; ++i) {
    const double x = random.uniform(box.min().x(), box.max().x());
    const Vec p(x, random.uniform(box.min().y(), box.max().y()));
    const bool meets = std::any_of(others.begin(), others.end(), [&](const Disc& other) {
      const double reach = clear + other.radius;
      return (p - other.centre).squaredNorm() < reach * reach;
    });
    if (!meets && contains(entrance.within, p) &&
        (nearest_on_border(entrance.within, p) - p).norm() >= radius && contains(scene.crowd.walkable, p) &&
        !(barriers.distance(p, clear) < clear) && suits(p))
      return p;
  }
  return std::nullopt;
}

void add_agent(State& state, std::uint32_t agent, const Vec& place) {
  state.id.push_back(agent + 1);
  state.position.push_back(place), state.velocity.push_back(Vec(0.0, 0.0));
  state.angle.push_back(0.0), state.spin.push_back(0.0);
  state.crowd.stand.push_back(place), state.crowd.stand_step.push_back(state.step);
  state.crowd.stage.push_back(0);
}

}  // namespace throng
