// SPDX-License-Identifier: MIT
#include "tools/motion_system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>

#include "narrowphase/distance.h"
#include "scenarios/limits.h"
#include "sim/input_error.h"

namespace throng::tools {

namespace {

using narrowphase::Convex;
using narrowphase::kWorld;
using narrowphase::Link;
using narrowphase::LinkPair;
using narrowphase::Pose;

Link link_of(const MotionLink& named) {
  Link link;
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

}  // namespace

MotionSystem::MotionSystem(const MotionTask& task, double margin, Pairs pairs)
    : task_(task), margin_(margin), most_(margin) {
  grown_.resize(task.shapes.size());
  shapes_.resize(task.shapes.size());
  add_movers();
  add_obstacles();
  scene_.linkage = linkage_;
  add_pairs(pairs);
  scene_.pairs = pairs_;
  check_size(pairs == Pairs::all ? 0 : pairs_.size());
  for (std::size_t i = 0; i < task.waypoints(); ++i) {
    for (const Mover& mover : task.movers)
      path_.insert(path_.end(), mover.waypoints[i].begin(), mover.waypoints[i].end());
    path_.insert(path_.end(), obstacle_links_.size(), 0.0);
  }
}

void MotionSystem::grow(double margin) {
  assert(margin <= most_);
  margin_ = margin;
  for (std::vector<Convex>& parts : grown_) parts.clear();
  for (std::uint32_t row = 0; row < shapes_.size(); ++row)
    if (!shapes_[row].parts.empty()) shapes_[row] = narrowphase::parts_bvh(grown(row));
  build_obstacles();
}

double MotionSystem::rounding() const {
  double lengths = scene_.obstacles ? scene_.obstacles->tree.nodes[0].far : 0.0, turned = 1.0;
  for (const Link& link : linkage_) {
    lengths += link.at.norm() + (link.shape ? link.shape->tree.nodes[0].far : 0.0);
    turned += std::abs(link.angle);
  }
  for (std::size_t i = 0; i < linkage_.size(); ++i) {
    double farthest = 0.0;  // a turn or a slide
    for (std::size_t k = 0; k < task_.waypoints(); ++k)
      farthest = std::max(farthest, std::abs(waypoint(k)[i]));
    turned += farthest, lengths += linkage_[i].joint == narrowphase::Joint::prismatic ? farthest : 0.0;
  }
  return 0x1p-40 * lengths * turned;
}

std::span<const Convex> MotionSystem::grown(std::uint32_t row) {
  const std::vector<Convex>& parts = task_.shapes[row].parts;
  if (margin_ == 0.0) return parts;
  std::vector<Convex>& result = grown_[row];
  if (!result.empty()) return result;
  result = parts;
  for (Convex& part : result)
    part.radius = std::nextafter(part.radius + 0.5 * margin_, std::numeric_limits<double>::infinity());
  return result;
}

const narrowphase::PartsBvh* MotionSystem::shape(std::uint32_t row) {
  narrowphase::PartsBvh& shape = shapes_[row];
  if (shape.parts.empty()) shape = narrowphase::parts_bvh(grown(row));
  return &shape;
}

void MotionSystem::add_movers() {
  for (const Mover& mover : task_.movers) {
    std::vector<Link> robot;
    for (const MotionLink& link : mover.links) {
      robot.push_back(link_of(link));
      if (link.shape != MotionLink::kNone) robot.back().shape = shape(link.shape);
    }
    mount(linkage_, robot, mover.base, mover.base_angle);
  }
  moving_ = static_cast<std::uint32_t>(linkage_.size());
}

bool MotionSystem::are_all_obstacles(const Solids& solids) const {
  return solids.first == moving_ && solids.count == task_.obstacles.size();
}

void MotionSystem::add_obstacles() {
  std::set<std::uint32_t> named;
  for (const auto& [a, b] : task_.may_touch)
    for (const Solids& solids : {a, b})
      if (solids.first >= moving_ && !are_all_obstacles(solids)) named.insert(solids.first - moving_);
  for (std::uint32_t i = 0; i < task_.obstacles.size(); ++i) {
    const Obstacle& obstacle = task_.obstacles[i];
    if (named.contains(i)) {
      obstacle_links_.push_back(i);
      Link link;
      link.shape = shape(obstacle.shape), link.at = obstacle.at, link.angle = obstacle.angle;
      link.lower = link.upper = 0.0;
      linkage_.push_back(link);
    } else {
      for (std::size_t part = 0; part < task_.shapes[obstacle.shape].parts.size(); ++part)
        obstacle_of_.push_back(i);
    }
  }
  build_obstacles();
}

void MotionSystem::build_obstacles() {
  parts_.clear();
  for (std::size_t row = 0; row < obstacle_of_.size();) {
    const Obstacle& obstacle = task_.obstacles[obstacle_of_[row]];
    for (const Convex& part : grown(obstacle.shape)) parts_.push_back(placed(part, obstacle));
    row = parts_.size();
  }
  if (parts_.empty()) return;
  obstacles_ = narrowphase::parts_bvh(parts_);
  scene_.obstacles = &obstacles_;
}

std::vector<std::uint32_t> MotionSystem::links_of(const Solids& solids) const {
  std::vector<std::uint32_t> links;
  const bool all = are_all_obstacles(solids);
  for (std::uint32_t i = solids.first; solids.first < moving_ && i < solids.first + solids.count; ++i)
    links.push_back(i);
  for (std::uint32_t k = 0; solids.first >= moving_ && k < obstacle_links_.size(); ++k)
    if (all || obstacle_links_[k] == solids.first - moving_) links.push_back(moving_ + k);
  if (all) links.push_back(kWorld);
  return links;
}

MotionSystem::LinkPairs MotionSystem::pairs_that_may_touch() const {
  const auto key = [](const Solids& solids) { return std::pair(solids.first, solids.count); };
  std::set<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint32_t, std::uint32_t>>> known;
  LinkPairs pairs;
  for (const auto& [first, second] : task_.may_touch) {
    if (!known.emplace(key(first), key(second)).second) continue;
    const std::vector<std::uint32_t> others = links_of(second);
    for (const std::uint32_t a : links_of(first))
      for (const std::uint32_t b : others)
        if (std::min(a, b) < moving_) pairs.emplace(std::min(a, b), std::max(a, b));
  }
  return pairs;
}

void MotionSystem::add_pairs(Pairs pairs) {
  constexpr std::size_t kEffort = 1000;  // distances a pair, to prove that limits keep it apart
  const LinkPairs may_touch = pairs_that_may_touch();
  std::vector<LinkPair> excluded;
  for (const auto& [a, b] : may_touch) excluded.push_back({a, b});
  pairs_ = pairs_to_check(std::span(linkage_).first(moving_), scene_.obstacles != nullptr, excluded,
                          pairs == Pairs::all ? 0 : kEffort);
  for (std::uint32_t a = 0; a < moving_; ++a)
    for (std::uint32_t k = 0; k < obstacle_links_.size(); ++k)
      if (linkage_[a].shape && !may_touch.contains({a, moving_ + k})) pairs_.push_back({a, moving_ + k});
}

void MotionSystem::check_size(std::size_t pairs) const {
  const std::size_t all = linkage_.size() + pairs, most = scenarios::kMostAtOnce;
  if (all > most / segments())
    throw InputError(std::to_string(linkage_.size()) + " links and " + std::to_string(pairs) +
                     " pairs that may not touch, times " + std::to_string(segments()) +
                     " segments, are more than " + std::to_string(most) +
                     ": ask in several files, or let touch who may");
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
  if (link >= moving_) return task_.obstacles[obstacle_links_[link - moving_]].name;
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
