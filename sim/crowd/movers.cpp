// SPDX-License-Identifier: MIT
#include "sim/crowd/movers.h"

#include <algorithm>
#include <cmath>

#include "sim/crowd/slide.h"

namespace throng {

namespace {

constexpr int kRounds = 4;  // of all movers, where one pushes against another

bool is_in(const std::vector<Region>& solids, const Vec& p) {
  return std::ranges::any_of(solids, [&](const Region& piece) { return contains(piece, p); });
}

Vec local(const narrowphase::Pose& pose, const Vec& p) {
  return pose.unrotate(p - pose.position);
}

narrowphase::Pose pose_of(const State& state, std::size_t row, double dt) {
  return narrowphase::pose(state.position[row] + dt * state.velocity[row],
                           state.angle[row] + dt * state.spin[row]);
}

}  // namespace

Movers::Movers(const Scene& scene) : scene_(scene) {
  if (scene.crowd.size() == 0) return;
  for (std::size_t row = 0; row < scene.crowd.first; ++row) {
    if (scene.bodies.kind[row] != BodyKind::kinematic) continue;
    std::vector<Region> its = solids(scene, row);
    double reach = 0.0;
    for (const BarrierLine& ring : rings(its))
      for (const Vec& p : ring.points) reach = std::max(reach, p.norm());
    movers_.push_back({row, its, Barriers(rings(its), reach), reach});
  }
}

void Movers::look(const State& state) {
  for (Mover& mover : movers_) {
    mover.before = pose_of(state, mover.row, 0.0);
    mover.after = pose_of(state, mover.row, scene_.time.dt);
    mover.shift = (mover.after.position - mover.before.position).norm();
    mover.turn = std::abs(scene_.time.dt * state.spin[mover.row]);
  }
}

void Movers::show(const State& state, Barriers& barriers) {
  look(state);
  std::vector<BarrierLine> lines;
  for (const Mover& mover : movers_)
    for (BarrierLine& ring : rings(placed(mover.solids, mover.before))) lines.push_back(std::move(ring));
  barriers.set_moving(lines);
}

double Movers::depth(const Vec& p) const {
  double deepest = 0.0;
  for (const Mover& mover : movers_) {
    const Vec q = local(mover.before, p);
    for (const Region& piece : mover.solids)
      if (contains(piece, q)) deepest = std::max(deepest, (nearest_on_border(piece, q) - q).norm());
  }
  return deepest;
}

/// Whether the disc's way may touch the disc round the mover, in its frame, in which the way's length is at
/// most what they move and turn.
bool Movers::may_meet(const Mover& mover, const Vec& from, const Vec& to, double radius) {
  const double away = (from - mover.before.position).norm();
  return away * (1.0 - mover.turn) <= mover.reach + radius + (to - from).norm() + mover.shift;
}

Pushed Movers::push(const Vec& from, const Vec& to, double radius) const {
  Pushed pushed{to};
  for (int round = 0; round < kRounds; ++round) {
    pushed.settled = true;
    for (const Mover& mover : movers_) {
      if (!may_meet(mover, from, pushed.to, radius)) continue;
      const double far = mover.reach + radius;
      const Vec q0 = local(mover.before, from), q1 = local(mover.after, pushed.to);
      if (nearest_on_segment(q0, q1, {0.0, 0.0}).norm() > far || is_in(mover.solids, q0)) continue;
      const Moved its = slide(mover.edges, q0, q1 - q0, radius);
      if (!its.corrected) continue;
      pushed = {mover.after * its.to, true, movers_.size() == 1};
    }
    if (pushed.settled) break;
  }
  return pushed;
}

void Movers::move(State& state) const {
  const double dt = scene_.time.dt;
  for (const Mover& mover : movers_) {
    state.position[mover.row] += dt * state.velocity[mover.row];
    state.angle[mover.row] += dt * state.spin[mover.row];
  }
}

}  // namespace throng
