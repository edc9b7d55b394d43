// SPDX-License-Identifier: MIT
// The step is the story. Of bodies: wake, find pairs, then fly from collision to collision, or find contacts
// (and, as a run begins, what they bear) and solve in substeps, or be pushed by soft contacts in substeps.
// All of it again where bodies got farther than pairs were looked for, or, under guard, where they may have
// got into each other's hearts. Then store, fall asleep. Of agents: look, steer, walk (kinematic bodies among
// them, which push them), measure, leave, appear. Of both: sense.
#include "sim/step.h"

#include <atomic>
#include <string>

#include "sim/learn_loads.h"
#include "sim/periodic.h"
#include "sim/simulation_error.h"
#include "sim/stage_clock.h"
#include "sim/substep.h"

namespace throng {

namespace {

/// At a step in which a body is hit so hard that it gets where nobody was looked for: after some of them all
/// are looked at as far as the farthest one got.
constexpr int kAttempts = 20, kLocalAttempts = 4;

/// Where more move no step is so short that to read the clock takes as long as a stage.
constexpr std::size_t kFew = 64;

/// No velocity is -0: FaceBlocks' lanes without a face would make it 0. What doesn't turn has a spin and a
/// turn of 0 for ever.
void load(const Plan& plan, const State& state, Rows awake, BodyRows<SolverBody> bodies) {
  awake.for_each([&](std::uint32_t i) {
    bodies[i].position = state.position[i];
    bodies[i].velocity = state.velocity[i].array() + 0.0;
    if (!plan.rotation) return;
    bodies[i].spin = state.spin[i] + 0.0;
    bodies[i].turn = 0.0;
  });
}

/// False where a body can't go on; that one is left where it got.
bool store(const Scene& scene, const Plan& plan, BodyRows<const SolverBody> bodies, std::uint32_t i,
           State& state) {
  state.position[i] = bodies[i].position;
  state.velocity[i] = bodies[i].velocity;
  if (plan.rotation) {
    state.spin[i] = bodies[i].spin;
    state.angle[i] += bodies[i].turn;
  }
  const bool goes_on = can_go_on(state, i);
  if (plan.periodic && goes_on) state.position[i] = wrapped(state.position[i], scene.domain);
  return goes_on;
}

void check_all(const State& state, const Workspace& work) {
  work.sleepers.bodies().for_each([&](std::uint32_t i) { check_body(state, i); });
}

/// Throws of the first body that can't go on, whoever stored it. Not by parts: what threads write at the same
/// time would stand side by side.
void store_all(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  std::atomic<bool> all_go_on = true;
  const Rows rows = work.sleepers.bodies();
  const BodyRows<const SolverBody> bodies = work.bodies;
  work.workers.for_ranges(rows.size(), [&](std::size_t begin, std::size_t end) {
    bool all = true;
    for (std::size_t i = begin; i < end; ++i) {
      if (plan.sleep) work.sleepers.watch(state, rows[i], bodies[rows[i]]);
      all &= store(scene, plan, bodies, rows[i], state);
    }
    if (!all) all_go_on = false;
  });
  if (!all_go_on) check_all(state, work);
}

/// As store_all(), of those that flew.
void land(State& state, Workspace& work) {
  if (!work.flights.land(state, work.workers)) check_all(state, work);
}

[[noreturn]] void fail_at_chain(const State& state) {
  throw SimulationError("step " + std::to_string(state.step + 1) +
                        ": bodies hit one another on and on within it: take a shorter dt");
}

/// Agents choose their velocity and walk.
void step_crowd(const Plan& plan, State& state, Workspace& work) {
  StageClock clock;
  work.crowd.look(state, work.workers);
  clock.lap(work.times.look);
  work.crowd.steer(state, work.workers);
  clock.lap(work.times.steer);
  ++state.step;
  work.crowd.walk(state, work.workers);
  clock.lap(work.times.walk);
  if (plan.measures) {
    work.crowd.measure(state);
    clock.lap(work.times.measure);
  }
  work.crowd.leave(state, work.workers);
  clock.lap(work.times.leave);
  if (!plan.entrances) return;
  work.crowd.appear(state);
  clock.lap(work.times.appear);
}

/// Bodies that nothing but collisions turns aside. False where there is more to it.
bool fly(const Scene& scene, const State& state, Workspace& work, StageClock& clock) {
  if (!work.candidates.serve(state, scene.time.dt)) work.candidates.find(state, scene.time.dt);
  clock.lap(work.times.find_pairs);
  work.contacts.start(work.bodies, work.finder.parts().groups());
  const bool flown = work.flights.fly(work.candidates, state, work.bodies, work.workers);
  clock.lap(work.times.collide);
  return flown;
}

/// Who may touch whom; who sleeps and may be touched is awake then.
void find_pairs(const Scene& scene, const Plan& plan, State& state, Workspace& work, StageClock& clock) {
  work.candidates.place(state, scene.time.dt, work.sleepers.colliders(work.candidates));
  clock.lap(work.times.find_pairs);
  if (plan.sleep) {
    work.sleepers.wake(state, work.candidates);
    clock.lap(work.times.sleep);
  }
  work.candidates.pair_up(state, work.sleepers.colliders(work.candidates));
  clock.lap(work.times.find_pairs);
}

/// Bodies fall, meet and push each other.
void push(const Scene& scene, const Plan& plan, State& state, Workspace& work, bool guarded,
          StageClock& clock) {
  if (plan.contacts()) find_pairs(scene, plan, state, work, clock);
  const Rows awake = work.sleepers.bodies();
  if (plan.contacts() && work.finder.divide(state, awake)) work.bodies.arrange(work.finder.parts());
  by_parts(work, [&](Rows rows) { load(plan, state, rows, work.bodies); });
  if (plan.contacts()) {
    work.finder.find({work.candidates, state, work.bodies}, work.contacts, work.workers);
    work.bounces.start_step(work.contacts, work.finder.parts());
    work.ahead = 2.0 * work.candidates.chain() > work.finder.least_way() ? work.solver.h : 0.0;
    clock.lap(work.times.find_contacts);
  }
  if (guarded) work.guard->start_step();
  if (plan.sums_impulses) work.impulses.start(work.contacts);
  const bool learns = plan.gravity && plan.contacts();
  if (learns) prepare_to_learn(scene, plan, state, work);
  for (int i = 0; i < scene.time.substeps; ++i) {
    const bool backward = (state.step * scene.time.substeps + i) % 2 == 1;
    substep(scene, plan, state, work, {backward, guarded});
    if (plan.sums_impulses) work.impulses.add(work.contacts, work.bodies, work.solver.h);
  }
  if (plan.sums_impulses) {
    work.impulses.add_bounces(work.contacts);
    if (guarded) work.impulses.set_strikes(work.guard->strikes());
  }
  if (learns) learn_loads(work);
  clock.lap(work.times.solve);
}

/// Whether bodies got farther than they were looked for, and may have met somebody there; then the next
/// attempt looks as far.
bool widen(const State& state, Workspace& work, bool flown, bool all) {
  if (flown) return work.candidates.widen(work.flights.reached(), all);
  std::span<const Reached> strays = work.candidates.strays(work.bodies);
  if (!strays.empty() && !work.unseen.met(strays, state, work.bodies, work.contacts)) strays = {};
  return work.candidates.widen(strays, all);
}

/// How a step of bodies is taken.
struct Attempt {
  int number = 1;
  bool flown = false;    ///< from collision to collision
  bool guarded = false;  ///< in the substeps nobody gets into another's heart
};

/// Whether the step must be taken again: as bodies got where nobody was looked for, or, under guard, as
/// hearts may have met.
bool again(const State& state, Workspace& work, Attempt& attempt) {
  if (widen(state, work, attempt.flown, attempt.number >= kLocalAttempts)) return true;
  if (attempt.flown || attempt.guarded) return false;
  return attempt.guarded = work.guard->saw_meeting(state, work.bodies, work.workers);
}

/// Takes the bodies, not yet `state`, to the step's end. Returns whether they flew there.
bool advance(const Scene& scene, const Plan& plan, State& state, Workspace& work, StageClock& clock) {
  for (Attempt attempt;; ++attempt.number) {
    attempt.flown = plan.flights && fly(scene, state, work, clock);
    if (!attempt.flown) push(scene, plan, state, work, attempt.guarded, clock);
    if (!plan.contacts()) return false;
    const bool done = !again(state, work, attempt);
    clock.lap(attempt.flown ? work.times.collide : work.times.solve);
    if (done) return attempt.flown;
    if (attempt.number == kAttempts) fail_at_chain(state);
  }
}

void step_bodies(const Scene& scene, const Plan& plan, State& state, Workspace& work, StageClock& clock) {
  const bool flown = advance(scene, plan, state, work, clock);
  ++state.step;
  if (flown) {
    state.collisions += work.flights.collisions();
    if (plan.sums_impulses) {
      work.impulses.start(work.contacts);
      work.impulses.set_strikes(work.flights.strikes());
    }
    land(state, work);
  } else {
    if (plan.flights) ++state.collisions.pushed;
    store_all(scene, plan, state, work);
  }
  if (plan.contacts()) work.contacts.save(state, work.workers);
  clock.lap(work.times.store);
  if (!plan.sleep) return;
  work.sleepers.settle(state, work.candidates, work.contacts, work.bodies);
  clock.lap(work.times.sleep);
}

/// Discs that give way where they touch.
void step_soft(const Scene& scene, const Plan& plan, State& state, Workspace& work, StageClock& clock) {
  const Rows all = work.sleepers.bodies();
  for (int attempt = 1;; ++attempt) {
    work.candidates.find(state, scene.time.dt);
    clock.lap(work.times.find_pairs);
    load(plan, state, all, work.bodies);
    work.soft.run(work.candidates, state, work.bodies.in_order());
    clock.lap(work.times.solve);
    const std::span<const Reached> strays = work.candidates.strays(work.bodies, work.soft.farthest());
    if (!work.candidates.widen(strays, attempt >= kLocalAttempts)) break;
    if (attempt == kAttempts) fail_at_chain(state);
  }
  work.soft.check(state);
  ++state.step;
  store_all(scene, plan, state, work);
  work.soft.save(state);
  clock.lap(work.times.store);
}

/// Takes the bodies on, and the time that this takes.
void step_measured(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  StepSampling& sampling = work.times.sampling;
  StageClock clock(scene.bodies.size() > kFew ? 1 : sampling.next());
  if (plan.soft)
    step_soft(scene, plan, state, work, clock);
  else
    step_bodies(scene, plan, state, work, clock);
  sampling.took(clock.measured());
}

}  // namespace

void step(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  if (plan.crowd)
    step_crowd(plan, state, work);
  else
    step_measured(scene, plan, state, work);
  if (!plan.sensors) return;
  StageClock clock;
  work.sensing.sense(state);
  clock.lap(work.times.sense);
}

}  // namespace throng
