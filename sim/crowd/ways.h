// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/distance_field.h"
#include "sim/crowd/floor_plan.h"
#include "sim/crowd/inside.h"
#include "sim/crowd/size_classes.h"
#include "sim/input_error.h"
#include "sim/scene.h"

namespace throng {

/// Where an agent wants to walk.
struct Heading {
  Vec towards{0.0, 0.0};  ///< once divided by its length, that is; zero: nowhere
  double distance;        ///< m, to where it wants to stand; infinite: to no place
  double square = 1.0;    ///< of how long `towards` is
};

inline constexpr double kFree = std::numeric_limits<double>::infinity();

inline Heading straight_to(const Vec& from, const Vec& to, double distance) {
  const double length = (to - from).norm();
  return {length > 0.0 ? Vec((to - from) / length) : Vec(0.0, 0.0), distance};
}

/// "agent 3 of 20 (id 23, radius 0.2 m)" of its group, for messages; `row` is that of the body.
std::string agent_name(const Scene& scene, std::uint32_t row);

/// No way leads an agent to a goal of its group's, or there would be too many ways to keep.
struct NoWay : InputError {
  NoWay(std::uint32_t its, const std::string& why)
      : InputError("agents[" + std::to_string(its) + "]: " + why), group(its), reason(why) {}
  std::uint32_t group;  ///< AgentGroup::index
  std::string reason;
};

/// The ways to all goals that a scene's agents have: a distance field each, shared by all of like size who go
/// there, on floor plans that goals of agents of the same sizes share. Where areas open and close, a field
/// for each of the goal's phases.
class Ways {
 public:
  /// Throws NoWay that names group, agent and place where no way leads from an agent to one of its goals, or
  /// from anywhere that one may appear to all of them, and before any is made where all would take more than
  /// kMostWaysBytes. `scene` and `barriers` must outlive this.
  Ways(const Scene& scene, const Barriers& barriers);

  /// Whether any goal opens or closes.
  bool change() const { return changes_; }

  /// From here on the ways are those of this step. O(1) where no goal opens or closes.
  void look(std::int64_t step);

  /// Whether all who have the goal, which some agent has, have the same ways to it, whatever their radii.
  bool suit_all(std::uint32_t goal) const { return goals_[goal].sizes.size() == 1; }

  /// Of agents of that radius (m), if the ways don't suit all. Expects a goal that such an agent has.
  const DistanceField& to(std::uint32_t goal, double radius) const {
    const Goal& its = goals_[goal];
    return its.now->fields[its.size(radius)];
  }

  /// Whether anybody gets into the goal now, which some agent has.
  bool is_open(std::uint32_t goal) const { return goals_[goal].now->is_open; }

  /// Whether `p` is in what is open of the goal, which some agent has.
  bool is_in(std::uint32_t goal, const Vec& p) const { return is_open(goal) && goals_[goal].now->inside(p); }

  /// Whether the straight way from `a` to `b` meets the border of what is open of the goal. As
  /// Inside::meets_border.
  bool meets_border(std::uint32_t goal, const Vec& a, const Vec& b) const {
    return is_open(goal) && goals_[goal].now->inside.meets_border(a, b);
  }

  /// False of most whose straight way from `a` to `b` neither meets what is open of the goal nor ends as good
  /// as in it; expects that it is open. O(1).
  bool may_reach(std::uint32_t goal, const Vec& a, const Vec& b) const {
    return goals_[goal].now->reach.intersects(Eigen::AlignedBox2d(a.cwiseMin(b), a.cwiseMax(b)));
  }

  /// Whether some who go there are as good as in it beside it.
  bool has_strips(std::uint32_t goal) const { return is_open(goal) && !goals_[goal].now->strips.empty(); }

  /// Whether one of that radius (m) at `p` is within his width of an area of the goal that has no room for
  /// him, or, where he has `stood` there, for him alone, and no wall between them: forces of walls, or
  /// others, may let him get no nearer. O(edges).
  bool is_at_strip(std::uint32_t goal, double radius, const Vec& p, bool stood) const;

  /// Whether ways lead one of the group, of that radius, from there to all goals of its journey, at any time.
  bool lead_on(const AgentGroup& group, double radius, const Vec& place) const;

 private:
  struct Plan {
    double largest;  ///< m, radius of those who walk on it
    FloorPlan floor;
  };
  /// An area that has no room for some who go there, or for one of them alone.
  struct Strip {
    Region region;
    Eigen::AlignedBox2d box;
    double largest;  ///< m, radius of those who have room in it; to within a thousandth of the largest one
    double two;      ///< m, radius of those two of whom have room, middle by middle
  };
  struct Phase {
    std::int64_t from;  ///< step
    double time;        ///< s
    bool is_open;
    std::vector<DistanceField> fields;  ///< as Goal::sizes
    Inside inside;
    std::vector<Strip> strips;
    Eigen::AlignedBox2d reach;  ///< m, holds all who are in it, or as good as that
  };
  struct Goal {
    std::vector<SizeClass> sizes;  ///< of those who go there
    std::vector<Phase> phases;     ///< in their order
    const Phase* now = nullptr;

    std::size_t size(double radius) const {
      std::size_t size = 0;
      while (size + 1 < sizes.size() && sizes[size].largest < radius) ++size;
      return size;
    }
  };

  void add_phase(std::uint32_t goal, const GoalPhase& phase);
  std::vector<Strip> strips(std::uint32_t goal, const GoalPhase& phase) const;
  Eigen::AlignedBox2d reach(std::uint32_t goal, const GoalPhase& phase, bool has_strips) const;
  const FloorPlan& plan(double largest);
  std::optional<std::size_t> dead_end(std::uint32_t goal, double radius, const Vec& place) const;
  bool lead_on_from_any(const AgentGroup& group, std::uint32_t agent) const;
  void expect_ways() const;
  std::string why(std::uint32_t goal, std::size_t phase, const AgentGroup& group, std::uint32_t agent) const;
  [[noreturn]] void fail_at(const AgentGroup& group, std::uint32_t agent) const;

  const Scene& scene_;
  const Barriers& barriers_;
  std::vector<std::unique_ptr<Plan>> plans_;
  std::vector<Goal> goals_;  // as Crowd::goals; empty where no agent goes
  bool changes_ = false;
};

}  // namespace throng
