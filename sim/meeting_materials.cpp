// SPDX-License-Identifier: MIT
#include "sim/meeting_materials.h"

#include <cstdint>

namespace throng {

std::vector<std::pair<std::size_t, std::size_t>> meeting_materials(const Scene& scene) {
  const std::size_t count = scene.materials.size();
  std::vector<std::uint8_t> dynamic(count, 0), there(count, 0);
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) {
    if (scene.bodies.kind[row] == BodyKind::dynamic) dynamic[scene.bodies.material[row]] = 1;
    there[scene.bodies.material[row]] = 1;
  }
  for (const Wall& wall : scene.walls) there[wall.material] = 1;
  if (scene.domain.kind == DomainKind::box) there[0] = 1;
  std::vector<std::pair<std::size_t, std::size_t>> meeting;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (dynamic[a] && there[b]) meeting.emplace_back(a, b);
  return meeting;
}

std::string rolling_refusal(const Scene& scene, const std::string& why) {
  for (const auto& [a, b] : meeting_materials(scene))
    for (const std::size_t row : {a, b})
      if (const Material& material = scene.materials[row]; material.rolling_resistance > 0.0)
        return "materials." + material.name + ".rolling_resistance: " + why;
  return "";
}

}  // namespace throng
