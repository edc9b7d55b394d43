// SPDX-License-Identifier: MIT
#include <algorithm>

#include "narrowphase/relative.h"
#include "scenarios/motion_parts.h"

namespace throng::scenarios {

namespace {

class RobotReader {
 public:
  RobotReader(const toml::table& table, const Path& path, const MotionTask& task, Report& report)
      : table_(table), path_(path), task_(task), report_(report) {}

  Mover read() {
    mover_.name = name_or(table_, path_.text());
    if (const toml::node* base = table_.get("base")) {
      const std::vector<double> pose = pose_values(*base, 0.0);
      mover_.base = {pose[0], pose[1]}, mover_.base_angle = pose[2];
    }
    const Path links_path(path_, "links");
    std::size_t i = 0;
    for (const toml::node& link : *table_.get("links")->as_array())
      read_link(*link.as_table(), Path(links_path, i++));
    if (mover_.links.empty()) fail(*table_.get("links"), links_path, "must have one or more");
    if (!failed_) read_waypoints();
    return std::move(mover_);
  }

 private:
  void read_link(const toml::table& table, const Path& path) {
    MotionLink link;
    own_names_.push_back(name_or(table, "links[" + std::to_string(own_names_.size()) + "]"));
    link.name = mover_.name + "." + own_names_.back();
    if (table.contains("shape")) link.shape = shape_row(task_, text(table, "shape", ""));
    const std::string joint = text(table, "joint", "revolute");
    if (joint == "prismatic") link.joint = narrowphase::Joint::prismatic;
    if (joint == "fixed")
      link.lower = link.upper = 0.0;
    else
      moving_.push_back(mover_.links.size());
    link.parent = read_parent(table, path);
    if (const toml::node* at = table.get("at")) link.at = point(*at);
    link.angle = number(table, "angle", 0.0);
    read_axis(table, path, link);
    if (joint != "fixed")
      read_limits(table, path, link);
    else if (const toml::node* node = table.get("limits"))
      fail(*node, Path(path, "limits"), "a fixed joint has no limits");
    mover_.links.push_back(std::move(link));
  }

  std::uint32_t read_parent(const toml::table& table, const Path& path) {
    const std::size_t own = mover_.links.size();
    const toml::node* node = table.get("parent");
    if (!node) return own == 0 ? MotionLink::kNone : static_cast<std::uint32_t>(own - 1);
    if (node->is_integer()) {
      const double index = number(*node);
      if (index < static_cast<double>(own)) return static_cast<std::uint32_t>(index);
      fail(*node, Path(path, "parent"), "must be the number of a link before this one, counted from 0");
      return MotionLink::kNone;
    }
    const std::string& name = node->as_string()->get();
    if (name == kBase) return MotionLink::kNone;
    std::vector<std::string> before(own_names_.begin(), own_names_.end() - 1);
    const auto found = std::find(before.begin(), before.end(), name);
    if (found != before.end()) return static_cast<std::uint32_t>(found - before.begin());
    before.push_back(kBase);
    fail(
        *node, Path(path, "parent"),
        "there is no " + in_quotes(name) + " among the links before this one" + nearest_or_all(name, before));
    return MotionLink::kNone;
  }

  void read_axis(const toml::table& table, const Path& path, MotionLink& link) {
    const toml::node* node = table.get("axis");
    if (!node) return;
    const Vec axis = point(*node);
    const narrowphase::Direction unit = narrowphase::direction(axis, {1.0, 0.0});
    if (link.joint == narrowphase::Joint::revolute)
      fail(*node, Path(path, "axis"), "only a prismatic joint has an axis");
    else if (!(unit.length > 0.0))
      fail(*node, Path(path, "axis"), "must not be [0, 0]");
    else
      link.axis = unit.unit;
  }

  void read_limits(const toml::table& table, const Path& path, MotionLink& link) {
    const toml::node* node = table.get("limits");
    if (!node) return;
    const Vec limits = point(*node);
    link.lower = limits.x(), link.upper = limits.y();
    if (!(link.lower <= link.upper)) fail(*node, Path(path, "limits"), lower_first(limits));
  }

  void read_waypoints() {
    const Path waypoints_path(path_, "waypoints");
    std::size_t i = 0;
    for (const toml::node& node : *table_.get("waypoints")->as_array()) {
      const Path path(waypoints_path, i++);
      const toml::array& list = *node.as_array();
      if (list.size() != moving_.size()) {
        fail(node, path,
             "must be a list of joint values, one a joint that moves: " + std::to_string(moving_.size()) +
                 ", and is of " + std::to_string(list.size()));
        continue;
      }
      std::vector<double>& values = mover_.waypoints.emplace_back(mover_.links.size(), 0.0);
      for (std::size_t k = 0; k < list.size(); ++k)
        values[moving_[k]] = joint_value(*list.get(k), Path(path, k), moving_[k]);
    }
  }

  double joint_value(const toml::node& node, const Path& path, std::size_t k) {
    const MotionLink& link = mover_.links[k];
    const double value = number(node);
    if (!(value >= link.lower && value <= link.upper))
      fail(node, path,
           "must be within the limits of " + link.name + ", " + to_text(link.lower) + " to " +
               to_text(link.upper) + ", and is " + to_text(value));
    return value;
  }

  void fail(const toml::node& node, const Path& path, std::string message) {
    report_.error(node, path.text(), std::move(message));
    failed_ = true;
  }

  static constexpr const char* kBase = "base";

  const toml::table& table_;
  const Path& path_;
  const MotionTask& task_;
  Report& report_;
  Mover mover_;
  std::vector<std::string> own_names_;  // of the links, without the robot's
  std::vector<std::size_t> moving_;     // links whose joints are not fixed
  bool failed_ = false;
};

/// The robot's name, and its links'.
void add_names(const Mover& mover, std::uint32_t first, const toml::table& table, const Path& path,
               Names& names, Report& report) {
  const auto count = static_cast<std::uint32_t>(mover.links.size());
  names.add(mover.name, {first, count}, table, path, report);
  const Path links_path(path, "links");
  for (std::uint32_t i = 0; i < count; ++i)
    names.add(mover.links[i].name, {first + i, 1}, *table.get("links")->as_array()->get(i),
              Path(links_path, i), report);
}

}  // namespace

void read_robots(const toml::table& root, MotionTask& task, Names& names, Report& report) {
  std::uint32_t first = task.links();
  for_each_table(root, "robots", report, [&](const toml::table& table, const Path& path) {
    Mover mover = RobotReader(table, path, task, report).read();
    add_names(mover, first, table, path, names, report);
    first += static_cast<std::uint32_t>(mover.links.size());
    task.movers.push_back(std::move(mover));
  });
}

}  // namespace throng::scenarios
