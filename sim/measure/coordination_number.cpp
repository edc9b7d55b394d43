// SPDX-License-Identifier: MIT
#include "sim/measure/coordination_number.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace throng {

double coordination_number(const Scene& scene, std::span<const ContactRow> contacts) {
  const auto is_dynamic = [&](std::uint32_t id) {
    return id > 0 && scene.bodies.kind[id - 1] == BodyKind::dynamic;
  };
  const auto is_disc = [&](std::uint32_t id) {
    return scene.shapes[scene.bodies.shape[id - 1]].kind == ShapeKind::disc;
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  double ends = 0.0;
  for (const ContactRow& row : contacts)
    if (!row.presses)
      continue;
    else if (row.b == 0 && is_disc(row.a))
      ends += 1.0;
    else
      pairs.push_back({row.a, row.b});
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [a, b] : pairs) ends += double(is_dynamic(a)) + double(is_dynamic(b));
  return ends / static_cast<double>(std::ranges::count(scene.bodies.kind, BodyKind::dynamic));
}

}  // namespace throng
