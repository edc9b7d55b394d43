// SPDX-License-Identifier: MIT
#include <algorithm>

#include "narrowphase/decompose.h"
#include "narrowphase/disc_union.h"
#include "narrowphase/holes.h"
#include "narrowphase/polygon.h"
#include "scenarios/limits.h"
#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

/// A ring of a polygon, and where it stands.
struct Place {
  const toml::node* node;
  std::string path;
};

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
    add_ring(node, Path(path_, "polygon"));
    if (const toml::node* holes = table_.get("holes")) add_holes(*holes, Path(path_, "holes"));
    if (failed_) return;
    narrowphase::CleanedRings cleaned = narrowphase::clean(rings_);
    for (const narrowphase::RingNote& repair : cleaned.repairs)
      report_.warning(places_[repair.ring].node->source(), places_[repair.ring].path, repair.text);
    if (!cleaned.refusal.text.empty()) return fail(cleaned.refusal);
    shape.kind = ShapeKind::polygon;
    const narrowphase::MassProperties mass = narrowphase::mass_properties(cleaned.rings);
    if (!(mass.area >= kLeastLeft * narrowphase::mass_properties(cleaned.rings[0]).area))
      return fail(*table_.get("holes"), Path(path_, "holes"),
                  "must leave at least " + to_text(kLeastLeft) + " of the polygon's area");
    if (!take_mass(mass, node, Path(path_, "polygon"), shape)) return;
    for (std::vector<Vec>& ring : cleaned.rings)
      for (Vec& vertex : ring) vertex -= shape.centre;
    cleaned = narrowphase::clean(cleaned.rings);  // the move may have rounded a sliver away
    if (!cleaned.refusal.text.empty()) return fail(cleaned.refusal);
    shape.parts = narrowphase::decompose(cleaned.rings);
    shape.outline = cleaned.rings[0];
    shape.holes.assign(cleaned.rings.begin() + 1, cleaned.rings.end());
    for (const Vec& vertex : shape.outline) shape.radius = std::max(shape.radius, vertex.norm());
  }

  void add_ring(const toml::node& node, const Path& path) {
    rings_.push_back(points(node));
    places_.push_back({&node, path.text()});
    if (const std::string fault = too_short(rings_.back(), true); !fault.empty()) fail(node, path, fault);
  }

  void add_holes(const toml::node& node, const Path& path) {
    std::size_t vertices = rings_[0].size();
    for (std::size_t i = 0; i < node.as_array()->size(); ++i) {
      add_ring(*node.as_array()->get(i), Path(path, i));
      vertices += rings_.back().size();
    }
    if (vertices > kMostVertices)
      fail(node, path, "makes more than " + std::to_string(kMostVertices) + " vertices with the polygon's");
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
    failed_ = true;
  }

  void fail(const narrowphase::RingNote& refusal) {
    report_.error(*places_[refusal.ring].node, places_[refusal.ring].path, refusal.text);
  }

  const toml::table& table_;
  const Path& path_;
  Report& report_;
  std::vector<std::vector<Vec>> rings_;  // of a polygon, its outline first
  std::vector<Place> places_;            // of these
  bool failed_ = false;
};

std::size_t count_vertices(const toml::table& shape) {
  std::size_t count = 0;
  for (const char* key : {"polygon", "discs"})
    if (const toml::node* list = shape.get(key)) count += list->as_array()->size();
  if (const toml::node* holes = shape.get("holes"))
    for (const toml::node& hole : *holes->as_array()) count += hole.as_array()->size();
  return count;
}

/// Counted before any geometry is done, whose cost grows faster. False, and reported, where it is too much.
bool check_total(const toml::table& shapes, const Path& path, Report& report) {
  std::size_t total = 0;
  for (const auto& [name, entry] : shapes) {
    if (report.bad(entry)) continue;
    total += count_vertices(*entry.as_table());
    if (total <= kMostInShapes) continue;
    report.error(entry, Path(path, name.str()).text(),
                 "makes more than " + std::to_string(kMostInShapes) + " vertices and discs in all shapes");
    return false;
  }
  return true;
}

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
