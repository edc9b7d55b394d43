// SPDX-License-Identifier: MIT
#include <algorithm>

#include "narrowphase/decompose.h"
#include "narrowphase/disc_union.h"
#include "narrowphase/polygon.h"
#include "scenarios/limits.h"
#include "scenarios/path.h"
#include "scenarios/read.h"
#include "scenarios/read_polygon.h"

namespace throng::scenarios {

namespace {

/// A number as it stands, or { uniform = [low, high] }.
Uniform read_uniform(const toml::node& node, const Path& path, Report& report) {
  if (!node.is_table()) return {number(node), number(node)};
  const toml::node& bounds = *node.as_table()->get("uniform");
  const Vec v = point(bounds);
  if (!(v.x() <= v.y())) report.error(bounds, Path(path, "uniform").text(), lower_first(v));
  return {v.x(), v.y()};
}

class ShapeReader {
 public:
  ShapeReader(const toml::table& table, const Path& path, Report& report)
      : table_(table), path_(path), report_(report) {}

  void read(Shape& shape, ShapeDraw& draw) {
    if (const toml::node* node = table_.get("disc")) read_disc(*node->as_table(), shape, draw);
    if (const toml::node* node = table_.get("polygon")) read_polygon(*node, shape);
    if (const toml::node* node = table_.get("discs")) read_composite(*node, shape);
    const toml::node* holes = table_.get("holes");
    if (holes && !table_.contains("polygon")) fail(*holes, Path(path_, "holes"), "only a polygon has holes");
  }

 private:
  void read_disc(const toml::table& disc, Shape& shape, ShapeDraw& draw) {
    const Path disc_path(path_, "disc");
    shape.kind = ShapeKind::disc;
    draw.radius = read_uniform(*disc.get("radius"), Path(disc_path, "radius"), report_);
  }

  void read_polygon(const toml::node& node, Shape& shape) {
    PolygonReader polygon(table_, path_, report_);
    std::vector<std::vector<Vec>> rings = polygon.read();
    if (rings.empty()) return;
    shape.kind = ShapeKind::polygon;
    const narrowphase::MassProperties mass = narrowphase::mass_properties(rings);
    if (!(mass.area >= kLeastLeft * narrowphase::mass_properties(rings[0]).area))
      return fail(*table_.get("holes"), Path(path_, "holes"),
                  "must leave at least " + to_text(kLeastLeft) + " of the polygon's area");
    if (!take_mass(mass, node, Path(path_, "polygon"), shape)) return;
    for (std::vector<Vec>& ring : rings)
      for (Vec& vertex : ring) vertex -= shape.centre;
    const narrowphase::CleanedRings cleaned =
        narrowphase::clean(rings);  // the move may have rounded a sliver away
    if (!cleaned.refusal.text.empty()) return polygon.fail(cleaned.refusal);
    shape.parts = narrowphase::decompose(cleaned.rings);
    shape.outline = cleaned.rings[0];
    shape.holes.assign(cleaned.rings.begin() + 1, cleaned.rings.end());
    for (const Vec& vertex : shape.outline) shape.radius = std::max(shape.radius, vertex.norm());
  }

  void read_composite(const toml::node& node, Shape& shape) {
    shape.kind = ShapeKind::composite;
    std::vector<narrowphase::Disc> discs;
    for (const toml::node& entry : *node.as_array())
      discs.push_back({point(entry), number(*entry.as_array()->get(2))});
    if (!take_mass(narrowphase::mass_properties(discs), node, Path(path_, "discs"), shape)) return;
    for (const narrowphase::Disc& disc : discs) {
      const Vec centre = disc.centre - shape.centre;
      shape.parts.push_back(narrowphase::disc(disc.radius, centre));
      shape.radius = std::max(shape.radius, centre.norm() + disc.radius);
    }
  }

  /// False, and reported, where the shape is too small to have a mass.
  bool take_mass(const narrowphase::MassProperties& mass, const toml::node& node, const Path& path,
                 Shape& shape) {
    shape.area = mass.area, shape.centre = mass.centroid, shape.gyration2 = mass.gyration2;
    if (!(shape.area >= kLeastArea))
      fail(node, path,
           "must have an area of at least " + to_text(kLeastArea) + " m^2, and has " + to_text(shape.area));
    else if (!(shape.gyration2 >= kLeastArea))
      fail(node, path,
           "must have a squared radius of gyration of at least " + to_text(kLeastArea) + " m^2, and has " +
               to_text(shape.gyration2));
    else
      return true;
    return false;
  }

  void fail(const toml::node& node, const Path& path, std::string message) {
    report_.error(node, path.text(), std::move(message));
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
  if (!check_total(*node->as_table(), shapes_path, report)) return draws;
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
