// SPDX-License-Identifier: MIT
#include "scenarios/motion_parts.h"

namespace throng::scenarios {

namespace {

MotionLink slide(const std::string& name, const Vec& axis, std::uint32_t parent) {
  MotionLink link;
  link.name = name, link.joint = narrowphase::Joint::prismatic, link.axis = axis, link.parent = parent;
  return link;
}

/// A rigid body as a robot: x, then y, then the turn about its origin.
std::vector<MotionLink> body_links(const std::string& name, std::uint32_t shape) {
  std::vector<MotionLink> links{slide(name, {1.0, 0.0}, MotionLink::kNone), slide(name, {0.0, 1.0}, 0), {}};
  links[2].name = name, links[2].shape = shape, links[2].parent = 1;
  return links;
}

}  // namespace

std::string name_or(const toml::table& table, const std::string& fallback) {
  return text(table, "name", fallback);
}

std::vector<double> pose_values(const toml::node& node, double fallback) {
  const Vec at = point(node);
  const toml::array& list = *node.as_array();
  return {at.x(), at.y(), list.size() > 2 ? number(*list.get(2)) : fallback};
}

void read_moving_bodies(const toml::table& root, MotionTask& task, Names& names, Report& report) {
  std::uint32_t first = task.links();
  for_each_table(root, "bodies", report, [&](const toml::table& table, const Path& path) {
    Mover mover;
    mover.name = name_or(table, path.text());
    mover.links = body_links(mover.name, shape_row(task, text(table, "shape", "")));
    double angle = 0.0;
    for (const toml::node& waypoint : *table.get("waypoints")->as_array()) {
      mover.waypoints.push_back(pose_values(waypoint, angle));
      angle = mover.waypoints.back()[2];
    }
    const auto count = static_cast<std::uint32_t>(mover.links.size());
    names.add(mover.name, {first, count}, table, path, report);
    first += count;
    task.movers.push_back(std::move(mover));
  });
}

}  // namespace throng::scenarios
