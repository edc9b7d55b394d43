// SPDX-License-Identifier: MIT
#include "narrowphase/decompose.h"
#include "scenarios/motion_parts.h"
#include "scenarios/read_polygon.h"

namespace throng::scenarios {

namespace {

using narrowphase::Convex;

class MotionShapeReader {
 public:
  MotionShapeReader(const toml::table& table, const Path& path, Report& report)
      : table_(table), path_(path), report_(report), radius_(number(table, "radius", 0.0)) {}

  void read(MotionShape& shape) {
    const bool polygon = table_.contains("polygon");
    if (!polygon) refuse("holes", "only a polygon has holes");
    if (!polygon && !table_.contains("segment")) refuse("radius", "only a polygon or a segment is rounded");
    if (polygon) read_polygon(shape);
    if (const toml::node* node = table_.get("segment")) shape.parts = read_segment(*node);
    if (const toml::node* node = table_.get("discs")) shape.parts = read_discs(*node);
    if (const toml::node* node = table_.get("disc"))
      shape.parts = {narrowphase::disc(number(*node->as_table()->get("radius")))};
  }

 private:
  void refuse(std::string_view key, std::string message) {
    if (const toml::node* node = table_.get(key))
      report_.error(*node, Path(path_, key).text(), std::move(message));
  }

  void read_polygon(MotionShape& shape) {
    std::vector<std::vector<Vec>> rings = PolygonReader(table_, path_, report_).read();
    if (rings.empty()) return;
    shape.parts = narrowphase::decompose(rings, radius_);
    if (radius_ == 0.0) shape.rings = std::move(rings);
  }

  std::vector<Convex> read_segment(const toml::node& node) {
    const std::vector<Vec> ends = points(node);
    if (const std::string fault = too_short(ends, false); !fault.empty())
      report_.error(node, Path(path_, "segment").text(), fault);
    else if (ends[0] == ends[1])
      report_.error(node, Path(path_, "segment").text(), "must have two different ends");
    else
      return {narrowphase::segment(ends[0], ends[1], radius_)};
    return {};
  }

  static std::vector<Convex> read_discs(const toml::node& node) {
    std::vector<Convex> parts;
    for (const toml::node& disc : *node.as_array())
      parts.push_back(narrowphase::disc(number(*disc.as_array()->get(2)), point(disc)));
    return parts;
  }

  const toml::table& table_;
  const Path& path_;
  Report& report_;
  double radius_;  // m
};

}  // namespace

void read_motion_shapes(const toml::table& root, MotionTask& task, Report& report) {
  const toml::node* node = root.get("shapes");
  if (!node || !node->is_table()) return;
  const Path root_path, shapes_path(root_path, "shapes");
  if (!check_total(*node->as_table(), shapes_path, report)) return;
  for (const auto& [name, entry] : *node->as_table()) {
    MotionShape& shape = task.shapes.emplace_back();
    shape.name = name.str();
    const Path path(shapes_path, name.str());
    if (!report.bad(entry)) MotionShapeReader(*entry.as_table(), path, report).read(shape);
  }
}

std::uint32_t shape_row(const MotionTask& task, const std::string& name) {
  const auto found =
      std::lower_bound(task.shapes.begin(), task.shapes.end(), name,
                       [](const MotionShape& shape, const std::string& n) { return shape.name < n; });
  return static_cast<std::uint32_t>(found - task.shapes.begin());
}

}  // namespace throng::scenarios
