// SPDX-License-Identifier: MIT
#include "tools/motion_system.h"

#include <algorithm>
#include <set>

#include "narrowphase/distance.h"

namespace throng::tools {

namespace {

using narrowphase::Convex;
using narrowphase::kWorld;
using narrowphase::Link;
using narrowphase::LinkPair;
using narrowphase::Pose;

Link link_of(const MotionLink& named, const std::vector<narrowphase::PartsBvh>& shapes) {
  Link link;
  if (named.shape != MotionLink::kNone) link.shape = &shapes[named.shape];
  if (named.parent != MotionLink::kNone) link.parent = named.parent;
  link.joint = named.joint;
  link.at = named.at, link.angle = named.angle, link.axis = named.axis;
  link.lower = named.lower, link.upper = named.upper;
  return link;
}

/// An obstacle's part in the world's frame, each vertex rounded once.
Convex placed(const Convex& part, const Obstacle& obstacle) {
  const Pose pose = narrowphase::pose(obstacle.at, obstacle.angle);
  std::vector<Vec> vertices;
  for (const Vec& vertex : part.vertices) vertices.push_back(pose * vertex);
  return narrowphase::convex(std::move(vertices), part.radius);
}

bool is_all(const Solids& solids, std::uint32_t links, std::size_t obstacles) {
  return solids.first == links && solids.count == obstacles;
}

/// Calls visit(a, b) for each two of the pairs that may touch, but for links and all obstacles.
template <class Visit>
void for_each_pair(const MotionTask& task, std::uint32_t links, Visit visit) {
  const auto wide = [&](const Solids& solids) { return is_all(solids, links, task.obstacles.size()); };
  const auto key = [](const Solids& solids) { return std::pair(solids.first, solids.count); };
  std::set<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>>> known;
  for (const auto& [a, b] : task.may_touch) {
    if (wide(a) || wide(b) || !known.emplace(key(a), key(b)).second) continue;
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i)
      for (std::uint32_t k = b.first; k < b.first + b.count; ++k) visit(std::min(i, k), std::max(i, k));
  }
}

}  // namespace

MotionSystem::MotionSystem(const MotionTask& task) : task_(task) {
  for (const MotionShape& shape : task.shapes) shapes_.push_back(narrowphase::parts_bvh(shape.parts));
  add_movers();
  add_obstacles();
  scene_.linkage = linkage_;
  add_pairs();
  scene_.pairs = pairs_;
  for (std::size_t i = 0; i < task.waypoints(); ++i) {
    for (const Mover& mover : task.movers)
      path_.insert(path_.end(), mover.waypoints[i].begin(), mover.waypoints[i].end());
    path_.insert(path_.end(), apart_.size(), 0.0);
  }
}

void MotionSystem::add_movers() {
  for (const Mover& mover : task_.movers) {
    std::vector<Link> robot;
    for (const MotionLink& link : mover.links) robot.push_back(link_of(link, shapes_));
    mount(linkage_, robot, mover.base, mover.base_angle);
  }
  moving_ = static_cast<std::uint32_t>(linkage_.size());
}

void MotionSystem::add_obstacles() {
  std::set<std::uint32_t> apart;
  for (const auto& [a, b] : task_.may_touch)
    for (const Solids& solids : {a, b})
      if (solids.first >= moving_ && !is_all(solids, moving_, task_.obstacles.size()))
        apart.insert(solids.first - moving_);
  for (std::uint32_t i = 0; i < task_.obstacles.size(); ++i) {
    const Obstacle& obstacle = task_.obstacles[i];
    if (apart.contains(i)) {
      apart_.push_back(i);
      Link link;
      link.shape = &shapes_[obstacle.shape], link.at = obstacle.at, link.angle = obstacle.angle;
      link.lower = link.upper = 0.0;
      linkage_.push_back(link);
      continue;
    }
    for (const Convex& part : task_.shapes[obstacle.shape].parts) {
      parts_.push_back(placed(part, obstacle));
      obstacle_of_.push_back(i);
    }
  }
  if (parts_.empty()) return;
  obstacles_ = narrowphase::parts_bvh(parts_);
  scene_.obstacles = &obstacles_;
}

void MotionSystem::add_pairs() {
  std::set<std::pair<std::uint32_t, std::uint32_t>> may_touch;  // of links, an obstacle apart, kWorld
  for_each_pair(task_, moving_, [&](std::uint32_t a, std::uint32_t b) {
    const auto apart = std::lower_bound(apart_.begin(), apart_.end(), b - moving_);
    if (a >= moving_) return;
    if (b < moving_)
      may_touch.emplace(a, b);
    else if (apart != apart_.end() && *apart == b - moving_)
      may_touch.emplace(a, moving_ + (apart - apart_.begin()));
  });
  for (const auto& [a, b] : task_.may_touch)
    for (const auto& [links, all] : {std::pair(a, b), std::pair(b, a)})
      if (is_all(all, moving_, task_.obstacles.size()) && links.first < moving_)
        for (std::uint32_t i = links.first; i < links.first + links.count; ++i) may_touch.emplace(i, kWorld);
  std::vector<LinkPair> excluded;
  for (const auto& [a, b] : may_touch) excluded.push_back({a, b});
  pairs_ = pairs_to_check(std::span(linkage_).first(moving_), scene_.obstacles != nullptr, excluded);
  for (std::uint32_t a = 0; a < moving_; ++a)
    for (std::uint32_t k = 0; k < apart_.size(); ++k)
      if (linkage_[a].shape && !may_touch.contains({a, moving_ + k})) pairs_.push_back({a, moving_ + k});
}

std::span<const double> MotionSystem::waypoint(std::size_t i) const {
  return path().subspan(i * linkage_.size(), linkage_.size());
}

std::vector<double> MotionSystem::values(std::size_t segment, double fraction) const {
  const std::span<const double> from = waypoint(segment), to = waypoint(segment + 1);
  std::vector<double> result(from.begin(), from.end());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += fraction * (to[i] - from[i]);
  return result;
}

std::vector<Pose> MotionSystem::poses(std::size_t segment, double fraction) const {
  std::vector<Pose> result(linkage_.size());
  place_links(linkage_, values(segment, fraction), result);
  return result;
}

std::string MotionSystem::link_name(std::uint32_t link) const {
  if (link >= moving_) return task_.obstacles[apart_[link - moving_]].name;
  for (const Mover& mover : task_.movers) {
    if (link < mover.links.size()) return mover.links[link].name;
    link -= static_cast<std::uint32_t>(mover.links.size());
  }
  return "";
}

std::pair<std::string, std::string> MotionSystem::names(const LinkPair& pair, std::uint32_t part) const {
  if (pair.b != kWorld) return {link_name(pair.a), link_name(pair.b)};
  return {link_name(pair.a), part == kNoPart ? "obstacles" : task_.obstacles[obstacle_of_[part]].name};
}

narrowphase::Separation MotionSystem::separation(const LinkPair& pair, std::uint32_t part_a,
                                                 std::uint32_t part_b, std::size_t segment,
                                                 double fraction) const {
  const std::vector<Pose> stand = poses(segment, fraction);
  const auto [a, b] = shapes(scene_, pair);
  return narrowphase::separation(a->parts[part_a], stand[pair.a], b->parts[part_b],
                                 pair.b == kWorld ? Pose{} : stand[pair.b]);
}

}  // namespace throng::tools
