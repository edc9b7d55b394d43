// SPDX-License-Identifier: MIT
#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

/// A number as it stands, or { uniform = [low, high] }.
Uniform read_uniform(const toml::node& node, const Path& path, Report& report) {
  if (!node.is_table()) return {number(node), number(node)};
  const toml::node& bounds = *node.as_table()->get("uniform");
  const Vec v = point(bounds);
  if (!(v.x() <= v.y()))
    report.error(bounds, Path(path, "uniform").text(), "must have its lower bound first");
  return {v.x(), v.y()};
}

class ShapeReader {
 public:
  ShapeReader(const toml::table& table, const Path& path, Report& report)
      : table_(table), path_(path), report_(report) {}

  void read(Shape& shape, ShapeDraw& draw) {
    if (const toml::node* node = table_.get("disc")) read_disc(*node->as_table(), draw);
    (void)shape;
  }

 private:
  void read_disc(const toml::table& disc, ShapeDraw& draw) {
    const Path disc_path(path_, "disc");
    draw.radius = read_uniform(*disc.get("radius"), Path(disc_path, "radius"), report_);
  }

  const toml::table& table_;
  const Path& path_;
  Report& report_;
};

}  // namespace

std::vector<ShapeDraw> read_shapes(const toml::table& root, Scene& scene, Report& report) {
  std::vector<ShapeDraw> draws;
  const toml::node* node = root.get("shapes");
  if (!node || !node->is_table()) return draws;
  const Path root_path, shapes_path(root_path, "shapes");
  for (const auto& [name, entry] : *node->as_table()) {
    Shape& shape = scene.shapes.emplace_back();
    shape.name = name.str();
    ShapeDraw& draw = draws.emplace_back();
    const Path path(shapes_path, name.str());
    if (!report.bad(entry)) ShapeReader(*entry.as_table(), path, report).read(shape, draw);
  }
  return draws;
}

}  // namespace throng::scenarios
