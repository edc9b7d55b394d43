// SPDX-License-Identifier: MIT
#include <filesystem>

#include "scenarios/load.h"
#include "scenarios/motion_parts.h"

namespace throng::scenarios {

namespace {

using narrowphase::Convex;

MotionShape line_shape(const std::vector<Vec>& line, bool closed) {
  MotionShape shape;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i)
    shape.parts.push_back(narrowphase::segment(line[i], line[(i + 1) % line.size()]));
  return shape;
}

/// How a scene's body looks.
MotionShape body_shape(const Scene& scene, std::size_t row) {
  const Shape& shape = scene.shapes[scene.bodies.shape[row]];
  if (shape.kind == ShapeKind::disc) return {"", {narrowphase::disc(scene.bodies.radius[row])}, {}};
  MotionShape result{"", shape.parts, {}};
  if (shape.outline.empty()) return result;
  result.rings.push_back(shape.outline);
  result.rings.insert(result.rings.end(), shape.holes.begin(), shape.holes.end());
  return result;
}

class ObstacleReader {
 public:
  ObstacleReader(MotionTask& task, Names& names, Report& report)
      : task_(task), names_(names), report_(report), links_(task.links()) {}

  void add(Obstacle obstacle, const toml::node& node, const Path& path) {
    const auto solid = static_cast<std::uint32_t>(links_ + task_.obstacles.size());
    names_.add(obstacle.name, {solid, 1}, node, path, report_);
    task_.obstacles.push_back(std::move(obstacle));
  }

  void add(MotionShape shape, std::string name, const Vec& at, double angle, const toml::node& node,
           const Path& path) {
    task_.shapes.push_back(std::move(shape));
    add({std::move(name), static_cast<std::uint32_t>(task_.shapes.size() - 1), at, angle}, node, path);
  }

  void add_walls(const std::vector<Wall>& walls, const std::string& of, const toml::node& node,
                 const Path& path) {
    for (std::size_t i = 0; i < walls.size(); ++i)
      add(line_shape(walls[i].points, walls[i].closed), of + "walls[" + std::to_string(i) + "]", {0.0, 0.0},
          0.0, node, path);
  }

  void add_scene(const Scene& scene, const toml::node& node, const Path& path) {
    if (scene.domain.kind == DomainKind::periodic)
      return report_.error(node, path.text(), "must have no domain.periodic: its sides would be no walls");
    for (std::size_t row = 0; row < scene.bodies.size(); ++row)
      add(body_shape(scene, row), "surroundings.bodies[" + std::to_string(row) + "]",
          scene.bodies.position[row], scene.bodies.angle[row], node, path);
    add_walls(scene.walls, "surroundings.", node, path);
    if (scene.domain.kind != DomainKind::box) return;
    const Vec &low = scene.domain.min, &high = scene.domain.max;
    add(line_shape({low, {high.x(), low.y()}, high, {low.x(), high.y()}}, true), "surroundings.box",
        {0.0, 0.0}, 0.0, node, path);
  }

  /// All obstacles by one name.
  void close() { names_.add_obstacles({links_, static_cast<std::uint32_t>(task_.obstacles.size())}); }

 private:
  MotionTask& task_;
  Names& names_;
  Report& report_;
  std::uint32_t links_;
};

/// The first error of a scenario that can't be used, and how many there are.
std::string first_error(const Loaded& loaded, const std::string& file) {
  for (const Diagnostic& diagnostic : loaded.diagnostics)
    if (diagnostic.severity == Diagnostic::Severity::error) {
      std::string line = to_string({&diagnostic, 1}, file);
      line.pop_back();
      return "can't be used, with " + std::to_string(loaded.errors()) +
             (loaded.errors() == 1 ? " error: " : " errors: ") + line;
    }
  return "";
}

void read_surroundings(const toml::node& node, const std::string& file, ObstacleReader& obstacles,
                       Report& report) {
  const Path root, path(root, "surroundings");
  const std::string name = (std::filesystem::path(file).parent_path() / node.as_string()->get()).string();
  const Loaded loaded = load_scenario(name);
  if (loaded.errors() > 0) return report.error(node, path.text(), first_error(loaded, name));
  obstacles.add_scene(loaded.scene, node, path);
}

}  // namespace

void read_obstacles(const toml::table& root, const std::string& file, MotionTask& task, Names& names,
                    Report& report) {
  ObstacleReader obstacles(task, names, report);
  for_each_table(root, "obstacles", report, [&](const toml::table& table, const Path& path) {
    Obstacle obstacle{name_or(table, path.text()), shape_row(task, text(table, "shape", ""))};
    if (const toml::node* at = table.get("at")) obstacle.at = point(*at);
    obstacle.angle = number(table, "angle", 0.0);
    obstacles.add(std::move(obstacle), table, path);
  });
  Scene lines;
  read_walls(root, lines, report);
  if (const toml::node* walls = root.get("walls"))
    obstacles.add_walls(lines.walls, "", *walls, Path(Path(), "walls"));
  if (const toml::node* node = good(root, "surroundings", report))
    read_surroundings(*node, file, obstacles, report);
  obstacles.close();
}

void read_may_touch(const toml::table& root, MotionTask& task, const Names& names, Report& report) {
  const toml::node* node = root.get("may_touch");
  if (!node || report.bad(*node)) return;
  const Path root_path, list_path(root_path, "may_touch");
  std::size_t i = 0;
  for (const toml::node& pair : *node->as_array()) {
    const Path pair_path(list_path, i++);
    const Solids* solids[2];
    for (std::size_t k : {0, 1}) {
      const toml::node& entry = *pair.as_array()->get(k);
      const std::string& name = entry.as_string()->get();
      if (solids[k] = names.find(name); solids[k]) continue;
      report.error(entry, Path(pair_path, k).text(),
                   "nothing is called " + in_quotes(name) + nearest_or_all(name, names.some()));
    }
    if (solids[0] && solids[1]) task.may_touch.emplace_back(*solids[0], *solids[1]);
  }
}

}  // namespace throng::scenarios
