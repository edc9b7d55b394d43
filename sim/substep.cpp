// SPDX-License-Identifier: MIT
#include "sim/substep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "sim/contact/contact_key.h"
#include "sim/contact/fast.h"

namespace throng {

namespace {

/// Of bounces in a substep: what still meets then is left to the contacts. Of impacts that keep some energy
/// each takes some, sooner than it would be, as dense clusters do anyway.
constexpr int kElasticSweeps = 64, kBounceSweeps = 8;

/// Of those that stop what hits: more where so much work does for it, counted in contacts. Then who is struck
/// in their course is stopped at less than hit_speed(), too.
constexpr int kHitSweeps = 16, kMostHitSweeps = 128;
constexpr std::size_t kHitWork = 6'000;
constexpr double kFollows = 0.05;

constexpr double kNever = std::numeric_limits<double>::infinity();

constexpr double kAtOnce = 0.01;  // of a substep: who meets so soon has arrived

constexpr double kElsewhere = 0.5;  // radii, half lengths of walls, or rad, in a substep

int bounce_sweeps(const Plan& plan) {
  return plan.elastic ? kElasticSweeps : plan.restitution ? kBounceSweeps : 0;
}

int hit_sweeps(const Contacts& contacts) {
  if (contacts.hits == 0) return 0;
  return std::clamp(static_cast<int>(kHitWork / contacts.hits), kHitSweeps, kMostHitSweeps);
}

void move(BodyRows<SolverBody> bodies, Rows awake, double h, bool rotation) {
  awake.for_each([&](std::uint32_t i) {
    bodies[i].position += h * bodies[i].velocity;
    if (rotation) bodies[i].turn += h * bodies[i].spin;
  });
}

/// Lets all bounce that meets by the rule, and what that sets in motion, until nothing meets any more.
void bounce(Workspace& work, BounceRule rule, int bounces) {
  const int hits = hit_sweeps(work.contacts);
  rule.follow_speed = hits > kHitSweeps ? kFollows * rule.hit_speed : rule.hit_speed;
  for (int sweep = 0; sweep < std::max(bounces, hits); ++sweep) {
    if (sweep == hits) rule.hit_speed = rule.follow_speed = kNever;
    if (sweep == bounces) rule.threshold = kNever;
    if (!work.bounces.sweep(work.contacts, work.bodies, rule, work.workers)) return;
  }
}

/// Of a substep in which gravity adds `kick` (m/s) to velocities.
BounceRule bounce_rule(const Workspace& work, const Vec& kick, const Vec* period) {
  const double h = work.solver.h, hit_speed = work.finder.hit_speed();
  return {h, h, kRestSpeed * kick.norm(), hit_speed, hit_speed, kick, period, work.ahead, h};
}

void bounce(const Plan& plan, Workspace& work, const BounceRule& rule) {
  if (work.contacts.disc_bounces.empty() && work.contacts.point_bounces.empty()) return;
  work.bounces.start(work.bodies, rule, work.workers);
  bounce(work, rule, bounce_sweeps(plan));
}

void fall(Workspace& work, const Vec& kick) {
  by_parts(work, [&](Rows rows) { work.free_fall.fall(work.bodies, rows, kick); });
  work.bounces.for_each_stopped(work.bodies,
                                [&](std::uint32_t row) { work.free_fall.stop(work.bodies, row); });
}

/// Who fell or flew freely in the substep gets to where he would be.
void land(const Plan& plan, Workspace& work, const BounceRule& rule) {
  if (plan.gravity)
    by_parts(work, [&](Rows rows) { work.free_fall.land(work.bodies, rows, rule.kick, rule.h); });
  if (plan.restitution) work.bounces.land(work.contacts, work.bodies, work.free_fall, rule);
}

/// What hit has arrived at the other's surface and is stopped there, and who stands on it with it. Left to
/// the contacts, the impulses of that would act again in the next substep, and throw up who stands there.
/// What bounces doesn't here.
void stop(Workspace& work, const Vec* period) {
  if (work.contacts.hits == 0) return;
  const double h = work.solver.h, hit_speed = work.finder.hit_speed();
  const BounceRule rule{h, kAtOnce * h, kNever, hit_speed, hit_speed, Vec(0.0, 0.0), period, work.ahead, -h};
  work.bounces.go_on();
  bounce(work, rule, 0);
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

/// m: who gets so far in a substep against the other touches elsewhere then. Along a wall it is the wall's
/// length that counts.
double length_of_touch(const Scene& scene, const Obstacles& obstacles, const BlockContact& at,
                       std::uint64_t key) {
  const double radius = scene.bodies.radius[at.a];
  if (!is_of_obstacle(key)) return kElsewhere * std::min(radius, scene.bodies.radius[at.b]);
  const std::uint32_t row = pair_of(key).b;
  if (obstacles.is_side(row)) return std::numeric_limits<double>::infinity();
  return kElsewhere * std::max(radius, 0.5 * bounds(obstacles.part_at(row)).diagonal().norm());
}

/// Whether the two get elsewhere against each other in a substep: other contacts are theirs then.
bool get_elsewhere(const Scene& scene, const Workspace& work, const BlockContact& at, std::uint64_t key) {
  const auto spin = [&](std::uint32_t row) {  // of a disc it takes nobody elsewhere
    const bool turns =
        row < scene.bodies.size() && scene.shapes[scene.bodies.shape[row]].kind != ShapeKind::disc;
    return turns ? std::abs(work.bodies[row].spin) : 0.0;
  };
  const double h = work.solver.h;
  const double way = h * (work.bodies[at.a].velocity - work.bodies[at.b].velocity).norm();
  return way > length_of_touch(scene, work.candidates.obstacles(), at, key) ||
         h * std::max(spin(at.a), spin(at.b)) > kElsewhere;
}

/// Contacts at points don't relax between who gets elsewhere in this substep, nor are they warm-started in
/// the next: with other arms, what they did would be taken back or done again at random, and give energy to
/// who bounces there. Others are soon stopped.
void forget_elsewhere(const Scene& scene, const Plan& plan, Workspace& work) {
  const double substeps = scene.time.substeps, least_radius = work.finder.least_way() / kAheadWay;
  const bool any = work.candidates.chain() > 0.5 * kElsewhere * substeps * least_radius ||
                   work.candidates.farthest_turn() > 0.5 * kElsewhere * substeps;
  FaceBlocks& faces = work.contacts.faces;
  for (std::size_t i = 0; any && i < faces.size(); ++i) {
    const BlockContact at = faces.contact(i);
    if (!get_elsewhere(scene, work, at, work.contacts.point_key[i])) continue;
    if (plan.sums_impulses) work.impulses.add_face(i, work.contacts, work.bodies, work.solver.h);
    *at.normal_impulse = *at.tangent_impulse = *at.preload = 0.0;
  }
}

/// Parts side by side; what joins them begins before and is pushed apart after.
void start_and_push_apart(Workspace& work, const Vec* period) {
  const std::size_t parts = work.finder.parts().count();
  const bool joined = parts > 1;
  work.contacts.turning.turn(work.contacts.faces, work.bodies, work.solver.h, work.workers);
  warm_start(work.contacts.disc_rolls, work.bodies);
  warm_start(work.contacts.point_rolls, work.bodies);
  if (joined) start(work, parts, period);
  work.workers.for_few(parts, [&](std::size_t part) { start(work, part, period), push_apart(work, part); });
  if (joined) push_apart(work, parts);
  resist_rolling(work);
}

/// Of parts whose bodies have moved, or move now; what joins parts after.
void relax(Workspace& work, const Plan& plan, bool moving) {
  const std::size_t parts = work.finder.parts().count();
  work.workers.for_few(parts, [&](std::size_t part) {
    if (moving) move(work.bodies, rows_of(work, part), work.solver.h, plan.rotation);
    relax(work, part, plan.periodic);
  });
  if (parts > 1) relax(work, parts, plan.periodic);
  resist_rolling(work);
}

}  // namespace

void substep(const Scene& scene, const Plan& plan, const State& state, Workspace& work, SubstepWay way) {
  const Vec kick = work.solver.h * scene.gravity;
  const Vec size = scene.domain.max - scene.domain.min, *period = plan.periodic ? &size : nullptr;
  const BounceRule rule = bounce_rule(work, plan.gravity ? kick : Vec(0.0, 0.0), period);
  bounce(plan, work, rule);
  if (plan.gravity || plan.restitution) fall(work, rule.kick);
  work.solver.backward = way.backward;
  if (plan.contacts()) start_and_push_apart(work, period);
  if (plan.restitution) forget_elsewhere(scene, plan, work);
  const bool at_once = plan.contacts() && !way.guarded && work.contacts.hits == 0;
  if (way.guarded)
    work.guard->move(state, work.bodies, work.sleepers.bodies(), work.solver.h);
  else if (!at_once)
    by_parts(work, [&](Rows rows) { move(work.bodies, rows, work.solver.h, plan.rotation); });
  stop(work, period);
  work.solver.backward = !way.backward;
  if (plan.contacts()) relax(work, plan, at_once);
  if (!way.guarded) land(plan, work, rule);
}

}  // namespace throng
