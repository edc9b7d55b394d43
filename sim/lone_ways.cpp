// SPDX-License-Identifier: MIT
#include "sim/lone_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/surroundings.h"

namespace throng {

namespace {

using Box = Surroundings::Box;
using Side = Surroundings::Side;

constexpr double kSlack = 1e-6;  // radii, by which a body may be in a wall as it begins
constexpr double kTips = 0.99;   // of the lever at which a body tips over
const char* const kLeaves = "a body may leave the periodic domain, and what it meets behind isn't looked for";
const char* const kSensitive = ": the way is sensitive to where it is met";

/// m, from the beginning.
struct Range {
  double low = 0.0, high = 0.0;

  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};
/// Of v t + g t² / 2 until `until`.
Range thrown(double v, double g, double until) {
  Range range;
  range.add(v * until + 0.5 * g * until * until);
  if (const double top = -v / g; top > 0.0 && top < until) range.add(0.5 * v * top);
  return range;
}

/// m, that one gets who has up to v that way, and is pulled by g; who rolls uphill gets half as high again as
/// who is thrown.
double farthest(double v, double g, double until) {
  const double up = v * until + 0.5 * std::max(g, 0.0) * until * until;
  return g < 0.0 ? std::min(up, v * v / -g) : up;
}

/// A body to be looked at.
class Lone {
 public:
  Lone(const Scene& scene, const Plan& plan, const Surroundings& all, std::size_t row)
      : scene_(scene),
        plan_(plan),
        all_(all),
        row_(row),
        at_(all.frame(scene.bodies.position[row])),
        v_(all.frame(scene.bodies.velocity[row])),
        g_(all.frame(scene.gravity)),
        radius_(scene.bodies.radius[row]),
        slack_(kSlack * radius_),
        until_(scene.time.until) {}

  LoneWay way() {
    set_reach(thrown(v_.x(), g_.x(), until_), thrown(v_.y(), g_.y(), until_));
    if (!plan_.contacts()) return way_;
    if (leaves_domain()) return doubted(kLeaves);
    if (!reaches_others() && !reaches_sides(within(-slack_), [](const Side&) { return true; })) return way_;
    if (!all_.square) return doubted(std::string("walls are not square to each other") + kSensitive);
    if (is_disc())
      bounce();
    else
      slide();
    if (way_.doubt.empty() && leaves_domain()) doubted(kLeaves);
    return way_;
  }

  /// Whether a wall that it stands on ends under it.
  bool overhangs() const {
    for (int axis = 0; axis < 2; ++axis)
      for (const double down : {-1.0, 1.0})
        if (overhangs(axis, down, foot(axis, down))) return true;
    return false;
  }

 private:
  bool is_disc() const { return shape().kind == ShapeKind::disc; }
  const Shape& shape() const { return scene_.shapes[scene_.bodies.shape[row_]]; }

  LoneWay doubted(const std::string& why) {
    way_.doubt = why;
    return way_;
  }

  const Surface& surface(const Side& side) const {
    return plan_.surface(scene_.bodies.material[row_], side.material);
  }

  void set_reach(const Range& x, const Range& y) {
    way_.reach = Box(Vec(at_.x() + x.low - radius_, at_.y() + y.low - radius_),
                     Vec(at_.x() + x.high + radius_, at_.y() + y.high + radius_));
  }

  /// What it may get to, and not only just.
  Box within(double margin) const {
    return Box(way_.reach.min().array() + margin, way_.reach.max().array() - margin);
  }
  bool reaches_others() const {
    return std::ranges::any_of(all_.others, [&](const Box& other) { return way_.reach.intersects(other); });
  }
  /// Whether a wall is `within` for which `counts` holds.
  template <class F>
  bool reaches_sides(const Box& within, F counts) const {
    return std::ranges::any_of(
        all_.sides, [&](const Side& side) { return counts(side) && within.intersects(side.box()); });
  }
  bool leaves_domain() const {
    const Domain& domain = scene_.domain;
    return domain.kind == DomainKind::periodic && !Box(domain.min, domain.max).contains(way_.reach);
  }

  /// The nearest side of axis `across` in that direction, or none.
  const Side* nearest(int across, double direction) const {
    const Side* found = nullptr;
    for (const Side& side : all_.sides) {
      const double gap = direction * (side.at - at_[across]) - radius_, here = at_[1 - across];
      if (side.across != across || gap < -slack_ || here < side.from || here > side.to) continue;
      if (!found || direction * (found->at - side.at) > 0.0) found = &side;
    }
    return found;
  }

  /// How far a disc gets along an axis, whatever it hits and rubs on.
  Range roams(int axis) const {
    const double turns = plan_.friction ? std::abs(scene_.bodies.spin[row_]) * radius_ : 0.0;
    const double up = plan_.restitution ? std::abs(v_[axis]) : std::max(v_[axis], 0.0);
    const double down = plan_.restitution ? std::abs(v_[axis]) : std::max(-v_[axis], 0.0);
    return {-farthest(down + turns, -g_[axis], until_), farthest(up + turns, g_[axis], until_)};
  }

  /// Walls that it may get to end its way there.
  void stop_at_walls(Range (&range)[2]) {
    for (int axis = 0; axis < 2; ++axis) {
      const Side *low = nearest(axis, -1.0), *high = nearest(axis, 1.0);
      if (low && low->at + radius_ - at_[axis] + slack_ > range[axis].low)
        range[axis].low = std::min(low->at + radius_ - at_[axis], 0.0), stops_[axis][0] = low;
      if (high && high->at - radius_ - at_[axis] - slack_ < range[axis].high)
        range[axis].high = std::max(high->at - radius_ - at_[axis], 0.0), stops_[axis][1] = high;
    }
  }

  bool stops(int axis) const { return stops_[axis][0] || stops_[axis][1]; }

  /// Whether all walls that stop it do so wherever it gets to them, and nothing else is within reach.
  bool is_held(const Range (&range)[2]) const {
    for (int axis = 0; axis < 2; ++axis)
      for (const Side* side : stops_[axis])
        if (side && (side->from > at_[1 - axis] + range[1 - axis].low - radius_ + slack_ ||
                     side->to < at_[1 - axis] + range[1 - axis].high + radius_ - slack_))
          return false;
    return !reaches_sides(within(slack_), [&](const Side& side) {
      return &side != stops_[side.across][0] && &side != stops_[side.across][1];
    });
  }

  /// Whether it lies on the side in that direction from the first, and goes on to.
  bool lies(int axis, int which) const {
    const double direction = which == 0 ? -1.0 : 1.0;
    return direction * (stops_[axis][which]->at - at_[axis]) - radius_ < slack_ && v_[axis] == 0.0 &&
           direction * g_[axis] > 0.0;
  }

  void bounce() {
    Range range[2] = {roams(0), roams(1)};
    stop_at_walls(range);
    set_reach(range[0], range[1]);
    if (reaches_others())
      return void(doubted(std::string("static bodies have corners or are round") + kSensitive));
    if (!is_held(range))
      return void(doubted(std::string("a disc may get to the end of a wall") + kSensitive));
    if (plan_.friction && stops(0) && stops(1))
      return void(
          doubted("a disc may rub on two walls at once, and it matters which of them holds it first"));
    hit(range);
    if (way_.impact > 0.0 && plan_.restitution && !is_square(scene_.gravity, all_.frame.along))
      doubted(std::string("what bounces falls askew to the walls") + kSensitive);
  }

  /// How fast it may hit what it doesn't lie on.
  void hit(const Range (&range)[2]) {
    const double turns = plan_.friction ? std::abs(scene_.bodies.spin[row_]) * radius_ : 0.0;
    Vec speed(0.0, 0.0);
    bool hits = false;
    for (int axis = 0; axis < 2; ++axis) {
      const double drop = g_[axis] > 0.0 ? range[axis].high : -range[axis].low;
      speed[axis] = std::sqrt(v_[axis] * v_[axis] + 2.0 * std::abs(g_[axis]) * drop) + turns;
      for (int which = 0; which < 2; ++which) hits = hits || (stops_[axis][which] && !lies(axis, which));
    }
    way_.impact = hits ? speed.norm() : 0.0;
  }

  /// The points with which it is lowest along `down` of an axis: from where to where of the other one, and
  /// how much lower than its centre.
  struct Foot {
    double low, high, depth;  // m
  };
  Foot foot(int axis, double down) const {
    if (is_disc()) return {0.0, 0.0, radius_};
    const narrowphase::Pose pose = narrowphase::pose({0.0, 0.0}, scene_.bodies.angle[row_]);
    Foot foot{0.0, 0.0, -std::numeric_limits<double>::infinity()};
    for (const narrowphase::Convex& part : shape().parts)
      for (const Vec& vertex : part.vertices) {
        const Vec point = all_.frame(pose.rotate(vertex));
        const double depth = down * point[axis] + part.radius, at = point[1 - axis];
        if (depth > foot.depth + slack_) foot = {at, at, depth};
        if (depth > foot.depth - slack_)
          foot.low = std::min(foot.low, at), foot.high = std::max(foot.high, at);
      }
    return foot;
  }

  /// The side that it lies on with that foot, or none.
  const Side* floor(int axis, double down, const Foot& foot) const {
    const double at = at_[axis] + down * foot.depth, here = at_[1 - axis];
    for (const Side& side : all_.sides)
      if (side.across == axis && std::abs(side.at - at) < slack_ && side.from < here && side.to > here)
        return &side;
    return nullptr;
  }

  bool overhangs(int axis, double down, const Foot& on) const {
    const double at = at_[axis] + down * on.depth;
    const double low = at_[1 - axis] + on.low, high = at_[1 - axis] + on.high;
    return std::ranges::any_of(all_.sides, [&](const Side& side) {
      return side.across == axis && std::abs(side.at - at) < slack_ && side.from <= high && side.to >= low &&
             (side.from > low + slack_ || side.to < high - slack_);
    });
  }

  void slide() {
    for (int axis = 0; axis < 2; ++axis) {
      if (g_[axis] == 0.0 || v_[axis] != 0.0 || scene_.bodies.spin[row_] != 0.0) continue;
      const double down = g_[axis] > 0.0 ? 1.0 : -1.0;
      const Foot on = foot(axis, down);
      if (const Side* side = floor(axis, down, on)) return slide_on(*side, on);
    }
    doubted(std::string("what isn't a disc may land on a corner") + kSensitive);
  }

  /// How far it slides along `axis`, which rubs by `rub` (m/s²).
  Range slid(int axis, double rub) const {
    const double v = v_[axis], g = g_[axis];
    Range range;
    double x = 0.0, left = until_;
    if (v != 0.0) {
      const double a = g - std::copysign(rub, v), stops = a * v < 0.0 ? std::min(-v / a, left) : left;
      x = v * stops + 0.5 * a * stops * stops, left -= stops;
      range.add(x);
    }
    if (std::abs(g) > rub) range.add(x + 0.5 * (g - std::copysign(rub, g)) * left * left);
    return range;
  }

  void slide_on(const Side& side, const Foot& on) {
    const int along = 1 - side.across;
    const double press = std::abs(g_[side.across]), rub = surface(side).friction * press;
    const Range range = slid(along, rub), none;
    along == 0 ? set_reach(range, none) : set_reach(none, range);
    const double lever = v_[along] != 0.0 ? rub : std::min(rub, std::abs(g_[along]));
    if (lever * on.depth >= kTips * press * std::min(-on.low, on.high))
      return void(doubted(std::string("what isn't a disc may tip over") + kSensitive));
    if (plan_.restitution) return void(doubted(std::string("what bounces isn't a disc") + kSensitive));
    const double low = at_[along] + range.low + on.low, high = at_[along] + range.high + on.high;
    const bool beside = reaches_sides(within(slack_), [&](const Side& other) { return &other != &side; });
    if (side.from > low + slack_ || side.to < high - slack_ || beside || reaches_others())
      doubted(std::string("what isn't a disc may get to the end of a wall, or to another") + kSensitive);
  }

  const Scene& scene_;
  const Plan& plan_;
  const Surroundings& all_;
  std::size_t row_;
  Vec at_, v_, g_;  // in the frame
  double radius_, slack_, until_;
  const Side* stops_[2][2] = {};  // of each axis the lower and the upper wall that it may get to
  LoneWay way_;
};

}  // namespace

std::vector<LoneWay> lone_ways(const Scene& scene, const Plan& plan) {
  const Surroundings all = surroundings(scene);
  std::vector<LoneWay> ways(scene.bodies.size());
  for_dynamic(scene, [&](std::size_t row) { ways[row] = Lone(scene, plan, all, row).way(); });
  return ways;
}

std::string doubt_of_obstacles(const Scene& scene, const Plan& plan) {
  const Surroundings all = surroundings(scene);
  if (std::ranges::count(scene.bodies.kind, BodyKind::fixed) > 0)
    return std::string("static bodies have corners or are round") + kSensitive;
  if (!all.square) return std::string("walls are not square to each other") + kSensitive;
  bool overhangs = false;
  for_dynamic(scene,
              [&](std::size_t row) { overhangs = overhangs || Lone(scene, plan, all, row).overhangs(); });
  return overhangs ? std::string("a body stands over the end of a wall") + kSensitive : "";
}

}  // namespace throng
