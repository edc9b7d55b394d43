// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/collisions.h"
#include "sim/contact_row.h"
#include "sim/plan.h"
#include "sim/scene.h"
#include "sim/simulation_error.h"
#include "sim/state.h"

namespace throng {

/// A step that was given up because somebody wants the run to end: the simulation has the state of the step
/// before, and can't go on.
struct Interrupted {};

/// One run of a scene by the engine that the scene names.
class Simulation {
 public:
  virtual ~Simulation() = default;

  /// Advances by dt. Throws SimulationError where the run can't go on, and Interrupted as heed() says.
  virtual void step() = 0;

  /// From now on a step that takes long asks `stop` now and then, and throws Interrupted where it says true.
  /// Most engines' steps don't take long.
  virtual void heed(bool (*)()) {}

  virtual const State& state() const = 0;

  /// Takes over a state that a simulation of this scene had, to go on with the bits that it would have given.
  /// Returns false, and changes nothing, where the engine keeps more than State holds: only stepping there
  /// from the start gives the same bits then. Expects all of the state, with its contacts.
  virtual bool restore(const State& state) = 0;

  /// Points at which bodies pressed on each other or on obstacles in the last step, or have since they sleep.
  virtual std::size_t contacts() const = 0;

  /// Replaces `rows` by them: contacts() of them, or before the first step here those of bodies that sleep;
  /// and where `record.fields` has contacts by those, too, that pressed in the step and don't at its end.
  virtual void list_contacts(std::vector<ContactRow>& rows) const = 0;

  /// Those so far; null where the engine doesn't count them one by one.
  virtual const Collisions* collisions() const { return nullptr; }

  /// Whom each recorded sensor of the scene sensed in the state that there is; nothing for those that weren't
  /// due.
  virtual std::span<const Sensed> sensed() const = 0;

  /// Name and total time (s) of each stage that ran.
  virtual std::vector<std::pair<std::string, double>> stage_times() const = 0;
};

/// `scene` must outlive the simulation. Throws InputError where the engine can't run the scene, or soft
/// contacts can't, with the reason.
std::unique_ptr<Simulation> simulation(const Scene& scene, int threads = 1);

}  // namespace throng
