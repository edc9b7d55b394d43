// SPDX-License-Identifier: MIT
#include "sim/crowd/entrance.h"

#include "sim/random.h"

namespace throng {

std::optional<Vec> free_place(const Scene& scene, const Barriers& barriers, Standing& others,
                              const Sampler& entrance, std::uint32_t agent, std::int64_t step,
                              const std::optional<Vec>& companion,
                              const std::function<bool(const Vec&)>& suits) {
  if (entrance.empty()) return std::nullopt;
  const Crowd& crowd = scene.crowd;
  const double radius = scene.bodies.radius[crowd.first + agent];
  const double clear = radius + crowd.groups[crowd.group[agent]].entrance->gap;
  Random random(scene.seed, static_cast<std::uint64_t>(step), crowd.first + agent + 1, Purpose::place);
  const auto is_free = [&](const Vec& p) {
    return entrance.holds(p, radius) && !others.meets(p, clear) && contains(crowd.walkable, p) &&
           !(barriers.distance(p, clear) < clear) && suits(p);
  };
  for (int i = 0; companion && i < kEntranceTries; ++i) {
    const double reach = 2.0 * clear * (1.0 + 0.1 * i), x = random.uniform(-reach, reach);
    const Vec p = *companion + Vec(x, random.uniform(-reach, reach));
    if (is_free(p)) return p;
  }
  for (int i = 0; i < kEntranceTries; ++i)
    if (const Vec p = entrance.draw(random); is_free(p)) return p;
  return std::nullopt;
}

}  // namespace throng
