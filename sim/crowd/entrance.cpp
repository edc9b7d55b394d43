// SPDX-License-Identifier: MIT
#include "sim/crowd/entrance.h"

#include "sim/random.h"

namespace throng {

std::optional<Vec> free_place(const Scene& scene, const Barriers& barriers, Standing& others,
                              const Sampler& entrance, std::uint32_t agent, std::int64_t step,
                              const std::function<bool(const Vec&)>& suits) {
  if (entrance.empty()) return std::nullopt;
  const Crowd& crowd = scene.crowd;
  const double radius = scene.bodies.radius[crowd.first + agent];
  const double clear = radius + crowd.groups[crowd.group[agent]].entrance->gap;
  Random random(scene.seed, static_cast<std::uint64_t>(step), crowd.first + agent + 1, Purpose::place);
  for (int i = 0; i < kEntranceTries; ++i) {
    const Vec p = entrance.draw(random);
    if (entrance.holds(p, radius) && !others.meets(p, clear) && contains(crowd.walkable, p) &&
        !(barriers.distance(p, clear) < clear) && suits(p))
      return p;
  }
  return std::nullopt;
}

}  // namespace throng
