// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/crowd/barriers.h"
#include "sim/crowd/crowd_cells.h"
#include "sim/crowd/journeys.h"
#include "sim/crowd/measuring.h"
#include "sim/crowd/model.h"
#include "sim/crowd/movers.h"
#include "sim/crowd/slide.h"
#include "sim/scene.h"
#include "sim/state.h"
#include "sim/workers.h"

/// The step of a crowd: look, steer, walk, measure, leave. Each reads what the one before it wrote; in none
/// does an agent see what another one did in the same step, so that neither order nor threads matter.
namespace throng {

/// What stops the scene's agents and stands still: its walls, static bodies and the domain's box.
std::vector<BarrierLine> barrier_lines(const Scene& scene);

class Walk {
 public:
  /// Throws as Ways. Nothing happens where there are no agents. `scene` must outlive this.
  explicit Walk(const Scene& scene);

  /// Brings the agents into the order in which they stand, lets choose who has a choice of goals, and finds
  /// each one's way.
  void look(State& state, Workers& workers);

  /// Asks the models for the agents' velocities, all from the state as it is.
  void steer(const State& state, Workers& workers);

  /// Walks for dt with these velocities, without getting into barriers, moves the kinematic bodies, which
  /// push who is in their way, and counts whom a barrier was in the way of, and who was squeezed between one
  /// and a body. Barriers win over bodies, and bodies over agents.
  void walk(State& state, Workers& workers);

  /// Measures the steps that they have just walked, where the scene measures anything.
  void measure(State& state);

  /// Moves the agents on in their journeys; who is at the end of his leaves the state.
  void leave(State& state, Workers& workers);

  /// Brings in those who are due, where there is room: others of their group wait behind who finds none.
  void appear(State& state);

 private:
  /// Of the agents, by place in the cells.
  struct Ranks {
    std::vector<double> x, y, velocity_x, velocity_y, towards_x, towards_y, radius, desired_speed, id, clear;
    std::vector<double> square;        // of how long `towards` is, before it is made a unit vector
    std::vector<std::uint32_t> model;  // row of models_

    void resize(std::size_t n);
  };

  /// What the scene says of an agent.
  struct Known {
    double radius, desired_speed, start;  ///< m, m/s, s
    std::uint32_t id = 0, group, model;   ///< rows of Crowd::groups, of models_
  };

  void make_models();
  void add_model(const AgentGroup& group, std::uint32_t agent);
  void sort(const State& state);
  void let_rows_follow(State& state, Workers& workers);
  const Known& known(const State& state, std::size_t row);
  void prefetch(const State& state, std::size_t place) const;
  void rank(const State& state, std::size_t place);
  void make_unit(std::size_t begin, std::size_t end);
  bool is_due(const State& state, std::size_t group) const;
  /// Some who appear together: which of their group's, and where the first of them has appeared.
  struct Company {
    std::uint32_t number;
    Vec place;
  };
  bool bring_in(State& state, std::size_t group, std::optional<Company>& company);
  struct Hindered {
    bool corrected, squeezed;
  };
  Hindered walk_one(State& state, std::size_t place, std::size_t row) const;
  Moved go(std::size_t place, const Vec& by, bool& squeezed) const;
  Moved go_among_bodies(const Vec& from, const Vec& by, double core, bool& squeezed) const;
  std::size_t agent(const State& state, std::size_t row) const { return agent_of(scene_, state, row); }
  /// The row of who has that place in the cells.
  std::size_t row(std::size_t place) const { return scene_.crowd.first + cells_.row()[place]; }
  std::size_t present(const State& state) const { return state.crowd.stand.size(); }

  const Scene& scene_;
  Barriers barriers_;
  Movers movers_;
  std::optional<Barriers> seen_;                       // with the bodies that move, where there are such
  std::optional<Journeys> journeys_;                   // where there are agents
  std::vector<std::unique_ptr<WalkingModel>> models_;  // each once, with its parameters; then agents' own
  std::size_t shared_ = 0;                             // of models_, those whose agents are asked together
  std::vector<double> cores_;                          // likewise: WalkingModel::core
  std::vector<std::uint8_t> stand_at_will_;            // likewise: WalkingModel::stands_at_will
  std::vector<std::uint32_t> model_;                   // row of models_, of the first one of Crowd::groups
  std::vector<std::unique_ptr<Sampler>> entrances_;    // as Crowd::groups, where agents appear
  Largest largest_;
  double reach_ = 0.0;        // m
  bool rows_follow_ = false;  // where they stand, from time to time
  std::vector<Known> known_;  // by row: of him whose id it is
  CrowdCells cells_;
  Ranks ranks_;
  std::vector<std::uint32_t> places_;                // those of each model together
  std::vector<Vec> velocity_;                        // by place
  std::vector<std::uint8_t> may_be_there_, leaves_;  // by row
  Standing standing_;                                // who is there when others appear
  Measuring measuring_;
};

}  // namespace throng
