// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/crowd/least_crowded.h"
#include "sim/crowd/queues.h"
#include "sim/crowd/sampler.h"
#include "sim/crowd/standing.h"
#include "sim/crowd/stuck.h"
#include "sim/crowd/ways.h"
#include "sim/state.h"

/// From leg to leg of their journeys: what agents go for, where they wait and line up, when they go on.
namespace throng {

class Journeys {
 public:
  /// As Ways, which it makes.
  Journeys(const Scene& scene, const Barriers& barriers);

  const Ways& ways() const { return ways_; }

  /// Lets those choose who begin a leg of several options, once they set out, or whose goal has closed while
  /// another is open, of the open ones: by weight at random by (seed, stage, id), later also by the step,
  /// else as LeastCrowded; and looks who stands in the queues. O(agents) where there are choices or queues.
  void look(State& state);

  /// Of the agent in this row of the crowd's state, who is of that group. Expects that `look` saw the state.
  /// O(1) but at queues and among barriers.
  Heading heading(const State& state, std::size_t row, std::uint32_t group) const;

  /// Whether he has a place, is as good as there, which is `distance` (m) away, and stands.
  bool has_settled(const State& state, std::size_t row, double distance) const;

  /// Whether he has left the place where he last did so: his goal is nearer than from there, by his radius
  /// or half of what a slow one walks in kStuckTime, or he is farther from there than those get who go aside.
  /// Always, where he has no goal yet.
  bool gets_on(const State& state, std::size_t row) const;

  /// Has the memory brought near that `heading` of that agent will read.
  void prefetch(const State& state, std::size_t row, std::uint32_t group) const {
    if (!is_decided(state, row)) return;
    const Leg& leg = scene_.crowd.groups[group].journey[state.crowd.stage[row]];
    way(state, row, scene_.crowd.goal(leg, state.crowd.option[row])).prefetch(position(state, row));
  }

  /// Whether the agent in this row, who is of that group and has walked for a step, may have got to where he
  /// wants to be, or be over with waiting. False of who hasn't set out, wherever he stands, and of who is on
  /// his way to an open goal and hasn't reached it, nor another that he could leave from. O(1) but near
  /// goals.
  bool may_be_there(const State& state, std::size_t row, std::uint32_t group) const;

  /// Moves on those of whom that is so: who gets to a goal begins the next leg, or takes a place and stays;
  /// who has waited or has been served leaves its place, and those behind move up. In the order of the rows,
  /// where two want the same. `leaves` becomes 1 for those at the end of their journeys.
  void advance(State& state, std::span<const std::uint8_t> may_be_there, std::vector<std::uint8_t>& leaves);

 private:
  using Row = std::size_t;

  std::size_t agent(const State& state, Row row) const {
    return agent_of(scene_, state, scene_.crowd.first + row);
  }
  const Leg& leg(const State& state, Row row) const {
    return scene_.crowd.leg(agent(state, row), state.crowd.stage[row]);
  }
  /// Whether no leg is left to him: he leaves in this step.
  bool is_at_the_end(const State& state, Row row) const {
    const AgentGroup& group = scene_.crowd.groups[scene_.crowd.group[agent(state, row)]];
    return state.crowd.stage[row] == group.journey.size();
  }
  static bool is_decided(const State& state, Row row) { return state.crowd.option[row] != kUndecided; }
  std::uint32_t goal(const State& state, Row row) const {
    return scene_.crowd.goal(leg(state, row), state.crowd.option[row]);
  }
  const Vec& position(const State& state, Row row) const { return state.position[scene_.crowd.first + row]; }
  double radius(const State& state, Row row) const {
    return scene_.bodies.radius[scene_.crowd.first + agent(state, row)];
  }
  /// m, where his last step began, to rounding.
  Vec from(const State& state, Row row) const {
    return position(state, row) - scene_.time.dt * state.velocity[scene_.crowd.first + row];
  }
  /// Whether he is in what is open of his goal, as good as that, or has just stepped over it.
  bool has_reached(const State& state, Row row) const {
    return is_in(state, row) || ways_.meets_border(goal(state, row), from(state, row), position(state, row));
  }
  /// Whether he is to leave from one of several goals, and is in any of them that is open, or has just
  /// stepped over it: others may have carried him there.
  bool has_reached_another(const State& state, Row row, std::uint32_t group) const;
  /// Whether he is in what is open of his goal, or as good as that. Where one alone can be at a time others
  /// stand round him in an arch, and he doesn't get out: who has stood there for a while has been there, too.
  bool is_in(const State& state, Row row) const {
    const std::uint32_t its = goal(state, row);
    const Vec& p = position(state, row);
    if (ways_.is_in(its, p)) return true;
    return ways_.has_strips(its) &&
           ways_.is_at_strip(its, radius(state, row), p, time_stood(scene_, state, row) >= kHesitation);
  }
  /// His to that goal.
  const DistanceField& way(const State& state, Row row, std::uint32_t goal) const {
    return ways_.to(goal, ways_.suit_all(goal) ? 0.0 : radius(state, row));
  }
  double since(const State& state, std::int64_t step) const {
    return static_cast<double>(state.step - step) * scene_.time.dt;
  }

  bool stands_at(const State& state, Row row, std::int64_t step) const;
  bool stands_yet(const State& state, Row row) const { return stands_at(state, row, state.step); }
  std::uint32_t choice(const State& state, Row row);
  std::uint32_t drawn(const State& state, Row row) const;
  void heed_openings(State& state) const;
  bool is_open(const Leg& leg, std::size_t option) const {
    return ways_.is_open(scene_.crowd.goal(leg, option));
  }
  bool is_there(State& state, Row row);
  bool wait(State& state, Row row);
  void begin_to_wait(State& state, Row row);
  bool is_among(const State& state, Row row, std::uint32_t goal);
  bool is_among_several(const State& state, Row row);
  bool is_behind_one(const State& state, Row row);
  bool is_kept_out(const State& state, Row row);
  bool is_off_spot(const State& state, Row row) const;
  void wait_for_opening(State& state, Row row);
  template <class F>
  void for_each_free_spot(const State& state, Row row, F&& f);
  Vec free_spot(const State& state, Row row);
  Vec spot_within_reach(const State& state, Row row);
  void stay(State& state, Row row, const Vec& spot);
  void gather_spots(const State& state);
  bool has_room(const State& state, Row row, const Vec& p);
  bool is_way_clear(const State& state, Row row, const Vec& to);
  void look_for_room(State& state, Row row);
  void go_to(State& state, Row row, const Vec& spot);
  void begin_leg(State& state, Row row) const;

  const Scene& scene_;
  const Barriers& barriers_;
  Ways ways_;
  LeastCrowded least_crowded_;
  Queues queues_;
  bool chooses_ = false;                            // some leg has a choice
  std::vector<std::unique_ptr<Sampler>> samplers_;  // as Crowd::goals, where agents wait
  std::vector<Standing> spots_;                     // likewise: of those who wait there
  std::vector<Standing> walkers_;                   // likewise: those on their way there
  bool spots_known_ = false;                        // in this step
};

}  // namespace throng
