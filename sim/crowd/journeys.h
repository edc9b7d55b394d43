// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/crowd/least_crowded.h"
#include "sim/crowd/queue_line.h"
#include "sim/crowd/sampler.h"
#include "sim/crowd/standing.h"
#include "sim/crowd/ways.h"
#include "sim/state.h"

/// From leg to leg of their journeys: what agents go for, where they wait and line up, when they go on.
namespace throng {

/// Where an agent wants to walk.
struct Heading {
  Vec towards{0.0, 0.0};  ///< unit vector; zero: nowhere
  double distance;        ///< m, to where it wants to stand; infinite: to no place
};

class Journeys {
 public:
  /// As Ways, which it makes.
  Journeys(const Scene& scene, const Barriers& barriers);

  const Ways& ways() const { return ways_; }

  /// Lets those choose who begin a leg of several options, by weight at random by (seed, stage, id), else as
  /// LeastCrowded; and looks who stands in the queues. O(agents) where there are choices or queues.
  void look(State& state);

  /// Of the agent in this row of the crowd's state. Expects that `look` saw the state. O(1) but at queues and
  /// among barriers.
  Heading heading(const State& state, std::size_t row) const;

  /// Has the memory brought near that `heading` of that agent will read.
  void prefetch(const State& state, std::size_t row) const {
    ways_.to(goal(state, row)).prefetch(position(state, row));
  }

  /// Moves them on: who gets to a goal begins the next leg, or takes a place and stays; who has waited or has
  /// been served leaves its place, and those behind move up. In the order of the rows, where two want the
  /// same. `leaves` becomes 1 for those at the end of their journeys.
  void advance(State& state, std::vector<std::uint8_t>& leaves);

 private:
  using Row = std::size_t;

  std::size_t agent(const State& state, Row row) const {
    return state.id[scene_.crowd.first + row] - std::size_t{1} - scene_.crowd.first;
  }
  const Leg& leg(const State& state, Row row) const {
    return scene_.crowd.leg(agent(state, row), state.crowd.stage[row]);
  }
  std::uint32_t goal(const State& state, Row row) const {
    return scene_.crowd.goal(leg(state, row), state.crowd.option[row]);
  }
  const Vec& position(const State& state, Row row) const { return state.position[scene_.crowd.first + row]; }
  bool is_queueing(const State& state, Row row) const { return leg(state, row).kind == Leg::Kind::queue; }
  std::uint32_t queue(const State& state, Row row) const {
    return leg(state, row).options[state.crowd.option[row]];
  }

  std::uint32_t choice(const State& state, Row row);
  std::uint32_t length(std::uint32_t queue) const { return static_cast<std::uint32_t>(line_[queue].size()); }
  void look_at_queues(const State& state);
  Heading queue_heading(const State& state, Row row) const;
  void keep_order(State& state);
  void serve(State& state, std::vector<std::uint8_t>& done);
  bool is_there(State& state, Row row);
  void line_up(State& state, Row row);
  bool wait(State& state, Row row);
  void take_spot(State& state, Row row);
  void gather_spots(const State& state);
  void begin_leg(State& state, Row row) const;

  const Scene& scene_;
  const Barriers& barriers_;
  Ways ways_;
  LeastCrowded least_crowded_;
  bool chooses_ = false;                            // some leg has a choice
  std::vector<QueueLine> lines_;                    // as Crowd::queues
  std::vector<std::int64_t> service_;               // steps, as Crowd::queues
  std::vector<std::vector<Row>> line_;              // of the queues: who stands in them, from the head
  std::vector<std::unique_ptr<Sampler>> samplers_;  // as Crowd::goals, where agents wait
  Standing spots_;                                  // of those who wait
  bool spots_known_ = false;                        // in this step
};

}  // namespace throng
