// SPDX-License-Identifier: MIT
#include "sim/contact/soft_contacts.h"

#include <string>

#include "sim/simulation_error.h"

namespace throng {

SoftContacts::SoftContacts(const Scene& scene, const Plan& plan)
    : scene_(scene),
      h_(plan.substep),
      gravity_(plan.gravity),
      discs_(scene, plan),
      solids_(scene, plan),
      bodies_(plan.soft ? scene.bodies.size() + 1 : 0),
      pushes_(bodies_.size()),
      speeds_(bodies_.size()),
      ways_(bodies_.size()),
      farthest_(bodies_.size()) {}

void SoftContacts::run(const Candidates& candidates, const State& state, std::span<SolverBody> bodies) {
  take(state, bodies);
  discs_.find(candidates, state, places_, bodies_);
  solids_.find(candidates, state, places_, bodies_);
  start();
  const int last = scene_.time.substeps - 1;
  for (int i = 0; i <= last; ++i) {
    const double past = i == 0 && state.step == 0 ? 0.5 * h_ : h_;
    const SoftSubstep now{i == 0, i == last, h_, past, h_ * fastest_, bodies_, speeds_, pushes_};
    discs_.press(now);
    solids_.press(now);
    foretell();
    discs_.press_again(now);
    solids_.press_again(now);
    kick_and_drift(i == last ? 0.5 * h_ : h_);
    if (i < last) continue;
    discs_.finish(now);
    solids_.finish(now);
  }
  give_back(bodies);
}

void SoftContacts::take(const State& state, std::span<const SolverBody> bodies) {
  places_.sort(state.position);
  for (std::uint32_t place = 0; place < places_.size(); ++place) {
    bodies_[place] = bodies[places_.row(place)];
    ways_[place] = {bodies_[place].position, 0.0};
  }
}

void SoftContacts::give_back(std::span<SolverBody> bodies) {
  for (std::uint32_t place = 0; place < places_.size(); ++place) {
    const std::uint32_t row = places_.row(place);
    bodies[row] = bodies_[place];
    farthest_[row] = std::sqrt(ways_[place].farthest2);
  }
}

/// To the middle of the first substep.
void SoftContacts::start() {
  double fastest2 = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Vec way = 0.5 * h_ * bodies_[i].velocity;
    bodies_[i].position += way;
    bodies_[i].turn += 0.5 * h_ * bodies_[i].spin;
    ways_[i].farthest2 = way.squaredNorm();
    fastest2 = std::max(fastest2, bodies_[i].velocity.squaredNorm());
  }
  fastest_ = std::sqrt(fastest2);
  std::ranges::fill(pushes_, SoftPush{});
}

/// The velocities of the substep's middle.
void SoftContacts::foretell() {
  const Vec fall = gravity_ ? Vec(0.5 * h_ * scene_.gravity) : Vec(0.0, 0.0);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const SolverBody& body = bodies_[i];
    speeds_[i] = {body.velocity + 0.5 * h_ * body.inverse_mass * pushes_[i].force,
                  body.spin + 0.5 * h_ * body.inverse_inertia * pushes_[i].torque};
    if (body.inverse_mass > 0.0) speeds_[i].velocity += fall;
    pushes_[i] = {};
  }
}

/// To the end of a substep, and on for `time` (s).
void SoftContacts::kick_and_drift(double time) {
  const Vec fall = gravity_ ? Vec(h_ * scene_.gravity) : Vec(0.0, 0.0);
  double fastest2 = 0.0;
  for (std::size_t i = 0; i + 1 < bodies_.size(); ++i) {  // obstacles stay
    SolverBody& body = bodies_[i];
    body.velocity += h_ * body.inverse_mass * pushes_[i].force;
    body.spin += h_ * body.inverse_inertia * pushes_[i].torque;
    if (body.inverse_mass > 0.0) body.velocity += fall;
    pushes_[i] = {};
    fastest2 = std::max(fastest2, body.velocity.squaredNorm());
    body.position += time * body.velocity;
    body.turn += time * body.spin;
    SoftWay& way = ways_[i];
    way.farthest2 = std::max(way.farthest2, (body.position - way.from).squaredNorm());
  }
  fastest_ = std::sqrt(fastest2);
}

void SoftContacts::check_depth(const State& state) const {
  const SoftSqueeze& worst =
      discs_.squeeze().depth > solids_.squeeze().depth ? discs_.squeeze() : solids_.squeeze();
  if (!(worst.depth > 0.0)) return;
  const auto name = [&](std::uint32_t place) {
    const std::uint32_t row = places_.row(place);
    return row < state.id.size() ? "body " + std::to_string(state.id[row]) : std::string("a wall");
  };
  char depth[32];
  std::snprintf(depth, sizeof depth, "%.3g", worst.depth);
  throw SimulationError("step " + std::to_string(state.step + 1) + ": " + name(worst.a) + " and " +
                        name(worst.b) + " are pressed " + depth +
                        " m into each other, more than half a radius: take stiffer contacts");
}

void SoftContacts::save(State& state) const {
  discs_.save(h_, state);
  solids_.save(h_, state);
}

void SoftContacts::list(const State& state, std::span<const SolverBody> bodies,
                        std::vector<ContactRow>& rows) const {
  rows.clear();
  discs_.list(state, h_, places_, bodies, rows);
  solids_.list(state, h_, places_, bodies, rows);
}

}  // namespace throng
