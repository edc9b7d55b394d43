// SPDX-License-Identifier: MIT
// The step is the story. Of bodies: wake, find pairs, then fly from collision to collision, or find contacts
// (and, as a run begins, what they bear) and solve in substeps, or be pushed by soft contacts in substeps;
// store, fall asleep. Of agents: look, steer, walk (kinematic bodies among them, which push them), leave,
// appear. Of both: sense.
#include "sim/step.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/contact/bounce.h"
#include "sim/contact/fast.h"
#include "sim/contact/first_loads.h"
#include "sim/contact/pressed.h"
#include "sim/periodic.h"
#include "sim/simulation_error.h"
#include "sim/stage_clock.h"

namespace throng {

namespace {

constexpr double kContactHertz = 0.18;  // of the substep's rate: stiffer, tall pyramids tremble
constexpr double kContactDamping = 20.0;
constexpr double kAjar = 2.0;       // of the way that gravity gives in a substep, g h²
constexpr double kPushOut = 2.0;    // radii a second: the fastest that overlap is undone
constexpr int kElasticSweeps = 64;  // of bounces in a substep: what still meets then ends without bounce,
constexpr int kBounceSweeps = 8;    // where each takes energy sooner, as dense clusters do anyway

/// At a step in which a body is hit so hard that it gets where nobody was looked for: after some of them all
/// are looked at as far as the farthest one got.
constexpr int kAttempts = 20, kLocalAttempts = 4;

/// Where so few move, to read the clock takes as long as a stage: of so many steps one is measured.
constexpr std::size_t kFew = 64;
constexpr int kStepsPerMeasure = 32;

/// For how many steps' times those of the next one stand: the first one's, which prepares all, for its own.
int steps_measured(const Scene& scene, StageTimes& times) {
  const std::int64_t step = times.steps++;
  if (scene.bodies.size() > kFew || step == 0) return 1;
  if (step == 1) return kStepsPerMeasure - 1;
  return step % kStepsPerMeasure == 0 ? kStepsPerMeasure : 0;
}

/// Calls f(rows) with those of each part, by the thread that solves the contacts of the part: it has the
/// bodies at hand.
template <class F>
void by_parts(Workspace& work, F f) {
  const Parts& parts = work.finder.parts();
  if (parts.count() == 1) return f(work.sleepers.bodies());
  work.workers.for_each(parts.count(), [&](std::size_t part) { f(parts.rows(part)); });
}

/// No velocity is -0: FaceBlocks' lanes without a face would make it 0.
void load(const State& state, Rows awake, std::span<SolverBody> bodies) {
  awake.for_each([&](std::uint32_t i) {
    bodies[i].position = state.position[i];
    bodies[i].velocity = state.velocity[i].array() + 0.0;
    bodies[i].spin = state.spin[i] + 0.0;
    bodies[i].turn = 0.0;
  });
}

void fall(std::span<SolverBody> bodies, Rows awake, const Vec& kick) {
  awake.for_each([&](std::uint32_t i) {
    if (bodies[i].inverse_mass > 0.0) bodies[i].velocity += kick;
  });
}

void move(std::span<SolverBody> bodies, Rows awake, double h) {
  awake.for_each([&](std::uint32_t i) {
    bodies[i].position += h * bodies[i].velocity;
    bodies[i].turn += h * bodies[i].spin;
  });
}

/// Bounces all that meets in this substep, and what that sets in motion, until nothing meets any more.
void bounce(Workspace& work, const Vec& kick, int sweeps) {
  const BounceRule rule{work.solver.h, kRestSpeed * kick.norm(), work.finder.hit_speed(), kick};
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const bool discs = bounce(work.contacts.disc_bounces, work.bodies, rule);
    const bool points = bounce(work.contacts.point_bounces, work.bodies, rule);
    if (!discs && !points) return;
  }
}

/// What bounces is looked at contact after contact. The discs' normals, each on its own.
void prepare_bounce(Workspace& work, const Vec* period) {
  const std::span<DiscContact> discs = work.contacts.disc_bounces;
  work.workers.for_ranges(discs.size(), [&](std::size_t begin, std::size_t end) {
    prepare(discs.subspan(begin, end - begin), work.bodies, period, work.ahead);
  });
  prepare(work.contacts.point_bounces, work.bodies);
}

void resist_rolling(Workspace& work) {
  Contacts& contacts = work.contacts;
  resist(std::span<RollContact>(contacts.disc_rolls), contacts.discs, work.bodies);
  resist(std::span<RollContact>(contacts.point_rolls), contacts.faces, work.bodies);
}

/// What the contacts of a group did before, and then what push_apart asks of them.
void start(Workspace& work, std::size_t group, const Vec* period) {
  prepare_and_start(work.contacts.discs.blocks(group), work.bodies, period, work.ahead);
  prepare_and_start(work.contacts.faces.blocks(group), work.bodies);
}
void push_apart(Workspace& work, std::size_t group) {
  const bool backward = work.solver.backward;
  if (!backward) push_apart(work.contacts.discs.blocks(group), work.bodies, work.solver);
  push_apart(work.contacts.faces.blocks(group), work.bodies, work.solver);
  if (backward) push_apart(work.contacts.discs.blocks(group), work.bodies, work.solver);
}
void relax(Workspace& work, std::size_t group, bool periodic) {
  const bool backward = work.solver.backward;
  if (!backward) relax(work.contacts.discs.blocks(group), work.bodies, work.solver, periodic);
  relax(work.contacts.faces.blocks(group), work.bodies, work.solver);
  if (backward) relax(work.contacts.discs.blocks(group), work.bodies, work.solver, periodic);
}

/// Parts side by side; what joins them begins before and is pushed apart after.
void start_and_push_apart(Workspace& work, const Vec* period) {
  const std::size_t parts = work.finder.parts().count();
  const bool joined = parts > 1;
  warm_start(work.contacts.disc_rolls, work.bodies);
  warm_start(work.contacts.point_rolls, work.bodies);
  if (joined) start(work, parts, period);
  work.workers.for_each(parts, [&](std::size_t part) { start(work, part, period), push_apart(work, part); });
  if (joined) push_apart(work, parts);
  resist_rolling(work);
}

void relax(Workspace& work, bool periodic) {
  const std::size_t parts = work.finder.parts().count();
  work.workers.for_each(parts, [&](std::size_t part) { relax(work, part, periodic); });
  if (parts > 1) relax(work, parts, periodic);
  resist_rolling(work);
}

/// How high the highest of those stands above the lowest (m), of dynamic bodies.
template <class F>
double height(const Scene& scene, const Workspace& work, F counts) {
  const Vec up = -scene.gravity.normalized();
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  work.sleepers.bodies().for_each([&](std::uint32_t i) {
    if (work.bodies[i].inverse_mass == 0.0 || !counts(i)) return;
    const double at = up.dot(work.bodies[i].position);
    lowest = std::min(lowest, at), highest = std::max(highest, at);
  });
  return std::max(highest - lowest, 0.0);
}

/// How contacts learn whose bodies stand as high as now. Where that seems so high that it matters, those
/// count alone that something presses: who falls far from a tower changes nothing in it.
Learning learning(const Scene& scene, const State& state, Workspace& work) {
  const auto layers = [&](double height) { return 1.0 + height / (2.0 * work.mean_radius); };
  double most = layers(height(scene, work, [](std::uint32_t) { return true; }));
  if (most > kFewLayers && state.step > 0) {
    find_pressed(state, work.candidates.colliders(), work.pressed);
    most = layers(height(scene, work, [&](std::uint32_t i) { return work.pressed[i] != 0; }));
  }
  const double weight = scene.gravity.norm() * work.solver.h;
  return learning_in(most, weight, work.solver.h, scene.time.substeps, work.mean_radius);
}

void learn(Workspace& work) {
  work.workers.for_each(work.finder.parts().groups(), [&](std::size_t group) {
    learn(work.contacts.discs.blocks(group), work.bodies, work.solver.learning);
    learn(work.contacts.faces.blocks(group), work.bodies, work.solver.learning);
  });
}

void find_first_loads(const Scene& scene, const Plan& plan, Workspace& work) {
  const Vec kick = work.solver.h * scene.gravity;
  const Vec size = scene.domain.max - scene.domain.min, *period = plan.periodic ? &size : nullptr;
  find_first_loads(work.contacts, work.finder.parts(), work.bodies, work.solver, kick, period, work.workers);
}

/// `backward`: pushes apart from each part's last contact on, and relaxes from its first; else the other way.
/// `guarded`: nobody gets through another or a wall, however fast.
void substep(const Scene& scene, const Plan& plan, const State& state, Workspace& work, bool backward,
             bool guarded) {
  const Vec kick = work.solver.h * scene.gravity;
  const Vec size = scene.domain.max - scene.domain.min, *period = plan.periodic ? &size : nullptr;
  if (plan.restitution || !work.contacts.point_bounces.empty()) {
    prepare_bounce(work, period);
    bounce(work, plan.gravity ? kick : Vec(0.0, 0.0), plan.elastic ? kElasticSweeps : kBounceSweeps);
  }
  if (plan.gravity) by_parts(work, [&](Rows rows) { fall(work.bodies, rows, kick); });
  work.solver.backward = backward;
  if (plan.contacts()) start_and_push_apart(work, period);
  if (guarded)
    work.guard.move(state, work.bodies, work.sleepers.bodies(), work.solver.h);
  else
    by_parts(work, [&](Rows rows) { move(work.bodies, rows, work.solver.h); });
  work.solver.backward = !backward;
  if (plan.contacts()) relax(work, plan.periodic);
}

/// False where a body can't go on; that one is left where it got.
bool store(const Scene& scene, const Plan& plan, std::span<const SolverBody> bodies, Rows awake,
           State& state) {
  bool all_go_on = true;
  awake.for_each([&](std::uint32_t i) {
    state.position[i] = bodies[i].position;
    state.velocity[i] = bodies[i].velocity;
    state.spin[i] = bodies[i].spin;
    state.angle[i] += bodies[i].turn;
    const bool goes_on = can_go_on(state, i);
    all_go_on &= goes_on;
    if (plan.periodic && goes_on) state.position[i] = wrapped(state.position[i], scene.domain);
  });
  return all_go_on;
}

void check_all(const State& state, const Workspace& work) {
  work.sleepers.bodies().for_each([&](std::uint32_t i) { check_body(state, i); });
}

/// Throws of the first body that can't go on, whoever stored it.
void store_all(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  std::atomic<bool> all_go_on = true;
  by_parts(work, [&](Rows rows) {
    if (!store(scene, plan, work.bodies, rows, state)) all_go_on = false;
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

double mean_radius(const Colliders& colliders) {
  const double sum = std::accumulate(colliders.radius.begin(), colliders.radius.end(), 0.0);
  return colliders.radius.empty() ? 0.0 : sum / static_cast<double>(colliders.size());
}

}  // namespace

Workspace::Workspace(const Scene& scene, const Plan& plan, int threads)
    : workers(threads),
      candidates(scene, plan),
      guard(scene, plan, candidates),
      sleepers(scene, plan),
      flights(scene, plan),
      soft(scene, plan),
      finder(scene, plan, candidates.colliders()),
      bodies(scene.bodies.size() + finder.parts().groups()),
      crowd(scene),
      sensing(scene, threads) {
  for (SolverBody& body : bodies) body = {Vec(0.0, 0.0), 0.0, 0.0, Vec(0.0, 0.0), 0.0, 0.0};
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies.kind[i] != BodyKind::dynamic) continue;
    bodies[i].inverse_mass = 1.0 / mass(scene, i);
    bodies[i].inverse_inertia = 1.0 / inertia(scene, i);
  }
  const double h = plan.substep;
  mean_radius = throng::mean_radius(candidates.colliders());
  const Softness spring = softness(kContactHertz / h, kContactDamping, h);
  const double ajar = plan.gravity ? kAjar * scene.gravity.norm() * h * h : 0.0;
  solver = {h, spring, {}, kPushOut * mean_radius, plan.friction, ajar};
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
  work.contacts.start(work.bodies.size(), work.finder.parts().groups());
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
  if (plan.contacts()) work.finder.divide(state, awake);
  by_parts(work, [&](Rows rows) { load(state, rows, work.bodies); });
  if (plan.contacts()) {
    work.finder.find(work.candidates, state, work.bodies, work.contacts, work.workers);
    work.ahead = 2.0 * work.candidates.chain() > work.finder.slow_way() ? work.solver.h : 0.0;
    clock.lap(work.times.find_contacts);
  }
  if (plan.gravity && plan.contacts()) work.solver.learning = learning(scene, state, work);
  if (state.step == 0 && plan.gravity && plan.contacts()) find_first_loads(scene, plan, work);
  for (int i = 0; i < scene.time.substeps; ++i) {
    const bool backward = (state.step * scene.time.substeps + i) % 2 == 1;
    substep(scene, plan, state, work, backward, guarded);
  }
  if (plan.gravity && plan.contacts()) learn(work);
  clock.lap(work.times.solve);
}

/// Whether the step must be taken again as bodies got where nobody was looked for.
bool widen(Workspace& work, bool flown, bool all) {
  if (flown) return work.candidates.widen(work.flights.reached(), all);
  return work.candidates.widen(work.bodies, {}, all);
}

void step_bodies(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  StageClock clock(steps_measured(scene, work.times));
  bool flown = false, guarded = false;
  for (int attempt = 1;; ++attempt) {
    flown = plan.flights && fly(scene, state, work, clock);
    if (!flown) push(scene, plan, state, work, guarded, clock);
    if (!plan.contacts()) break;
    if (!widen(work, flown, attempt >= kLocalAttempts)) {
      if (flown || guarded || !work.guard.saw_meeting(state, work.bodies, work.workers)) break;
      guarded = true;
    }
    if (attempt == kAttempts) fail_at_chain(state);
  }
  ++state.step;
  if (flown)
    state.collisions += work.flights.collisions();
  else if (plan.flights)
    ++state.collisions.pushed;
  if (flown)
    land(state, work);
  else
    store_all(scene, plan, state, work);
  if (plan.contacts()) work.contacts.save(state);
  clock.lap(work.times.store);
  if (!plan.sleep) return;
  work.sleepers.settle(state, work.candidates, work.contacts, work.bodies);
  clock.lap(work.times.sleep);
}

/// Discs that give way where they touch.
void step_soft(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  StageClock clock(steps_measured(scene, work.times));
  const Rows all = work.sleepers.bodies();
  for (int attempt = 1;; ++attempt) {
    work.candidates.find(state, scene.time.dt);
    clock.lap(work.times.find_pairs);
    load(state, all, work.bodies);
    work.soft.run(work.candidates, state, work.bodies);
    clock.lap(work.times.solve);
    if (!work.candidates.widen(work.bodies, work.soft.farthest(), attempt >= kLocalAttempts)) break;
    if (attempt == kAttempts) fail_at_chain(state);
  }
  work.soft.check_depth(state);
  ++state.step;
  store_all(scene, plan, state, work);
  work.soft.save(state);
  clock.lap(work.times.store);
}

void step(const Scene& scene, const Plan& plan, State& state, Workspace& work) {
  if (plan.crowd)
    step_crowd(plan, state, work);
  else if (plan.soft)
    step_soft(scene, plan, state, work);
  else
    step_bodies(scene, plan, state, work);
  if (!plan.sensors) return;
  StageClock clock;
  work.sensing.sense(state);
  clock.lap(work.times.sense);
}

}  // namespace throng
