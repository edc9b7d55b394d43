// SPDX-License-Identifier: MIT
#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

void read_walls(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = root.get("walls");
  if (!node || !node->is_array()) return;
  for (const toml::node& entry : *node->as_array()) {
    if (report.bad(entry)) continue;
    const toml::table& table = *entry.as_table();
    const std::uint32_t material = material_row(table, scene);
    for (const char* key : {"segment", "polyline", "polygon"})
      if (const toml::node* line = table.get(key))
        scene.walls.push_back({points(*line), std::string_view(key) == "polygon", material});
  }
}

}  // namespace throng::scenarios
