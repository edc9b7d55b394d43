// SPDX-License-Identifier: MIT
#include <algorithm>

#include "scenarios/path.h"
#include "scenarios/read.h"
#include "scenarios/wkt.h"

namespace throng::scenarios {

namespace {

/// Drops points that repeat the one before; true where some did.
bool drop_repeats(Wall& wall) {
  const std::size_t before = wall.points.size();
  wall.points.erase(std::unique(wall.points.begin(), wall.points.end()), wall.points.end());
  while (wall.closed && wall.points.size() > 1 && wall.points.front() == wall.points.back())
    wall.points.pop_back();
  return wall.points.size() < before;
}

void add_wall(Wall wall, const toml::node& node, const Path& path, Scene& scene, Report& report) {
  if (wall.closed && wall.points.size() > 3 && wall.points.front() == wall.points.back())
    wall.points.pop_back();  // many people close their polygons by hand
  if (drop_repeats(wall))
    report.warning(node.source(), path.text(), "points that repeat the one before were dropped");
  if (const std::string fault = too_short(wall.points, wall.closed); !fault.empty())
    return report.error(node, path.text(), fault);
  if (wall.points.size() >= (wall.closed ? 3 : 2)) return scene.walls.push_back(std::move(wall));
  report.error(node, path.text(),
               std::string("must have at least ") + (wall.closed ? "3" : "2") + " different points");
}

void add_wkt(const toml::node& node, std::uint32_t material, const Path& path, Scene& scene, Report& report) {
  Wkt wkt = read_wkt(node.as_string()->get());
  if (!wkt.refusal.empty()) return report.error(node, path.text(), wkt.refusal);
  for (WktLine& line : wkt.lines)
    add_wall({std::move(line.points), line.closed, material}, node, path, scene, report);
}

}  // namespace

void read_walls(const toml::table& root, Scene& scene, Report& report) {
  const toml::node* node = root.get("walls");
  if (!node || !node->is_array()) return;
  const Path root_path, walls_path(root_path, "walls");
  std::size_t index = 0;
  for (const toml::node& entry : *node->as_array()) {
    const Path path(walls_path, index++);
    if (report.bad(entry)) continue;
    const toml::table& table = *entry.as_table();
    const std::uint32_t material = material_row(table, scene);
    for (const char* key : {"segment", "polyline", "polygon"})
      if (const toml::node* line = table.get(key))
        add_wall({points(*line), std::string_view(key) == "polygon", material}, *line, Path(path, key), scene,
                 report);
    if (const toml::node* wkt = table.get("wkt")) add_wkt(*wkt, material, Path(path, "wkt"), scene, report);
  }
}

}  // namespace throng::scenarios
