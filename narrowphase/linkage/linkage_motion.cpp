// SPDX-License-Identifier: MIT
#include "narrowphase/linkage/linkage_motion.h"

#include <algorithm>
#include <cmath>

#include "narrowphase/relative.h"
#include "narrowphase/trigonometry.h"

namespace throng::narrowphase {

namespace {

constexpr double kThousandSums = 0x1p-44;  // the rounding of as many,
constexpr double kOneSum = 0x1p-52;        // and of one, twice over

Vec crossed(double spin, const Vec& arm) {
  return {-spin * arm.y(), spin * arm.x()};
}

/// Farther than any of its points is from the link's origin. m.
double reach(const Link& link) {
  return link.shape == nullptr ? 0.0 : link.shape->tree.nodes[0].far;
}

}  // namespace

void LinkageMotion::Run::join(const Run& arms) {
  arm += arms.arm;
  slide += arms.slide;
  size += arms.size;
  slid += arms.slid;
}

double LinkageMotion::Run::speed(double seen_by) const {
  const double turn = spin - seen_by;
  const double at_first = length(crossed(turn, arm) + slide);
  const double at_last = length(crossed(turn, arm + slide) + slide);
  return std::max(at_first, at_last) + kThousandSums * (std::abs(turn) * size + slid);
}

double LinkageMotion::Run::acceleration(double seen_by) const {
  const double turn = std::abs(spin - seen_by);
  const double farthest = std::max(length(arm), length(arm + slide));
  return turn * (turn * farthest + 2.0 * length(slide)) + kThousandSums * turn * (turn * size + slid);
}

void LinkageMotion::reset(std::span<const Link> linkage, std::span<const double> from,
                          std::span<const double> to) {
  linkage_ = linkage;
  states_.resize(linkage.size());
  slack_ = 0.0;
  for (std::uint32_t i = 0; i < linkage.size(); ++i) {
    const double value = from[i], change = to[i] - from[i];
    const LinkState parent = linkage[i].parent == kWorld ? LinkState{} : states_[linkage[i].parent];
    states_[i] = hung(linkage[i], parent, value, change);
    slack_ = std::max(slack_, 8.0 * (states_[i].error + reach(linkage[i]) * turned_off(states_[i])));
  }
}

/// By how much the link's angle may be off at any time, sine and cosine included. rad.
double LinkageMotion::turned_off(const LinkState& state) {
  return state.blur + 0x1p-50 * (1.0 + std::abs(state.angle) + std::abs(state.spin));
}

LinkageMotion::LinkState LinkageMotion::hung(const Link& link, const LinkState& parent, double value,
                                             double change) {
  const bool revolute = link.joint == Joint::revolute;
  const double mounted = parent.angle + link.angle;
  LinkState state;
  state.arm = offset(link, value);
  state.slide = revolute ? Vec(0.0, 0.0) : Vec(change * link.axis);
  state.angle = mounted + (revolute ? value : 0.0);
  state.spin = parent.spin + (revolute ? change : 0.0);
  state.blur = parent.blur + kOneSum * (std::abs(mounted) + std::abs(state.angle) + std::abs(state.spin) +
                                        (revolute ? std::abs(change) : 0.0));
  const Pose turn = throng::narrowphase::pose({0.0, 0.0}, parent.angle);
  const double slid = length(state.slide), size = length(state.arm) + slid;
  state.last = {parent.spin, turn.rotate(state.arm), turn.rotate(state.slide), size, slid};
  state.run = state.last;
  state.before = parent.before, state.bent = parent.bent;
  if (parent.run.spin == parent.spin) {
    state.run = parent.run;
    state.run.join(state.last);
  } else {
    state.before += parent.run.speed(0.0), state.bent += parent.run.acceleration(0.0);
  }
  state.reach = parent.reach + size;
  state.error = parent.error + size * turned_off(parent) + 0x1p-51 * state.reach +
                (revolute ? 0.0 : kOneSum * (std::abs(value) + size));
  return state;
}

void LinkageMotion::place(double time, std::span<Pose> poses) const {
  for (std::uint32_t i = 0; i < states_.size(); ++i)
    poses[i] = hung(i, linkage_[i].parent == kWorld ? Pose{} : poses[linkage_[i].parent], time, kWorld);
}

Pose LinkageMotion::pose(std::uint32_t link, double time, std::uint32_t seen_from) const {
  return link == seen_from ? Pose{}
                           : hung(link, pose(linkage_[link].parent, time, seen_from), time, seen_from);
}

Pose LinkageMotion::hung(std::uint32_t link, const Pose& parent, double time, std::uint32_t seen_from) const {
  const LinkState& state = states_[link];
  return throng::narrowphase::pose(parent * (state.arm + time * state.slide),
                                   (state.angle - angle(seen_from)) + time * (state.spin - spin(seen_from)));
}

LinkageMotion::Moving LinkageMotion::moving(std::uint32_t link, double time, std::uint32_t seen_from) const {
  if (link == seen_from) return {};
  const std::uint32_t on = linkage_[link].parent;
  const Moving parent = moving(on, time, seen_from);
  const Pose stands = hung(link, parent.pose, time, seen_from);
  const Vec by_turning = crossed(spin(on) - spin(seen_from), stands.position - parent.pose.position);
  return {stands, parent.velocity + by_turning + parent.pose.rotate(states_[link].slide)};
}

LinkageMotion::Instant LinkageMotion::at(const LinkPair& pair, const PairBounds& bounds, double time) const {
  const std::uint32_t top = nearest_common_ancestor(linkage_, pair);
  const Moving a = moving(pair.a, time, top), b = moving(pair.b, time, top);
  const Vec offset = b.pose.position - a.pose.position;
  const Vec velocity = b.velocity - a.velocity - crossed(bounds.seen_by - spin(top), offset);
  return {a.pose, b.pose, {bounds.spin_a, bounds.spin_b, velocity, bounds.rate.shift, bounds.acceleration}};
}

PairBounds LinkageMotion::bounds(const LinkPair& pair) {
  const LinkState& a = states_[pair.a];
  if (pair.b == kWorld)
    return {0.0,
            {a.before + a.run.speed(0.0), std::abs(a.spin), 0.0},
            a.spin,
            0.0,
            a.bent + a.run.acceleration(0.0)};
  const std::uint32_t ancestor = nearest_common_ancestor(linkage_, pair);
  collect_runs(pair, ancestor);
  const PairBounds by_ancestor = bounds(pair, spin(ancestor)), by_median = bounds(pair, median_spin(pair));
  const double of_a = reach(linkage_[pair.a]), of_b = reach(linkage_[pair.b]);
  return by_median.rate.of(of_a, of_b) < by_ancestor.rate.of(of_a, of_b) ? by_median : by_ancestor;
}

PairBounds LinkageMotion::bounds(const LinkPair& pair, double seen_by) const {
  const double spin_a = spin(pair.a) - seen_by, spin_b = spin(pair.b) - seen_by;
  PairBounds bounds{seen_by, {0.0, std::abs(spin_a), std::abs(spin_b)}, spin_a, spin_b, 0.0};
  for (const Run& run : runs_)
    bounds.rate.shift += run.speed(seen_by), bounds.acceleration += run.acceleration(seen_by);
  return bounds;
}

void LinkageMotion::climb(std::uint32_t& link, double sign) {
  Run arm = states_[link].last;
  arm.arm *= sign, arm.slide *= sign;
  if (runs_.size() > first_of_side_ && runs_.back().spin == arm.spin)
    runs_.back().join(arm);
  else
    runs_.push_back(arm);
  link = linkage_[link].parent;
}

void LinkageMotion::collect_runs(LinkPair links, std::uint32_t ancestor) {
  runs_.clear();
  first_of_side_ = 0;
  while (links.a != ancestor) climb(links.a, -1.0);
  first_of_side_ = runs_.size();
  while (links.b != ancestor) climb(links.b, 1.0);
  if (first_of_side_ == 0 || first_of_side_ == runs_.size()) return;
  runs_[first_of_side_ - 1].join(runs_.back());  // both hang on the ancestor
  runs_.pop_back();
}

double LinkageMotion::median_spin(const LinkPair& links) {
  spins_.clear();
  double total = 0.0, so_far = 0.0;
  const auto add = [&](double spin, double weight) { spins_.emplace_back(spin, weight), total += weight; };
  add(states_[links.a].spin, reach(linkage_[links.a]));
  add(states_[links.b].spin, reach(linkage_[links.b]));
  for (const Run& run : runs_) add(run.spin, std::max(length(run.arm), length(run.arm + run.slide)));
  std::sort(spins_.begin(), spins_.end());
  for (const auto& [spin, weight] : spins_)
    if (so_far += weight; 2.0 * so_far >= total) return spin;
  return spins_.back().first;
}

}  // namespace throng::narrowphase
