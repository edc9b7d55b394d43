// SPDX-License-Identifier: MIT
#include "sim/contact/soft_contacts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "sim/simulation_error.h"
#include "sim/soft_timing.h"

namespace throng {

namespace {

constexpr std::size_t kWave = 32;  // blocks that are pressed before others behind them go on

}  // namespace

SoftContacts::SoftContacts(const Scene& scene, const Plan& plan)
    : scene_(scene),
      h_(plan.substep),
      most_(longest_way(scene) / plan.substep),
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
  too_fast_ = 0.0;
  watch_speed();
  const int last = scene_.time.substeps - 1;
  for (int i = 0; i <= last; ++i) {
    const double past = i == 0 && state.step == 0 ? 0.5 * h_ : h_;
    const double fringe = h_ * std::sqrt(fastest2_);
    substep({i == 0, i == last, h_, past, fringe, bodies_, speeds_, pushes_});
    watch_speed();
  }
  give_back(bodies);
}

/// A wave that runs along the places: behind the front where discs are found in contact come their speeds of
/// the middle, behind these the pushes that count, and then all go on. What is at hand goes through all of it
/// before memory has to give more. Each waits for whom it needs, so the order of sums is that of the blocks.
void SoftContacts::substep(const SoftSubstep& now) {
  std::size_t pressed = 0, again = 0;    // blocks
  std::uint32_t foretold = 0, gone = 0;  // places
  const double time = now.last ? 0.5 * h_ : h_;
  fastest2_ = 0.0;
  solids_.press(now);
  do {
    const std::size_t end = std::min(pressed + kWave, discs_.blocks());
    discs_.press(now, pressed, end);
    pressed = end;
    const std::uint32_t known = discs_.lowest(pressed);
    solids_.add_pushes(now, known);
    foretell(foretold, known);
    foretold = known;
    const std::size_t ready = discs_.block_of(again, known);
    discs_.press_again(now, again, ready);
    again = ready;
    const std::uint32_t done = std::min(discs_.lowest(again), known);
    solids_.press_again(now, done);
    kick_and_drift(gone, done, time);
    gone = done;
  } while (pressed < discs_.blocks());
  if (!now.last) return;
  discs_.finish(now);
  solids_.finish(now);
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
  fastest2_ = 0.0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Vec way = 0.5 * h_ * bodies_[i].velocity;
    bodies_[i].position += way;
    bodies_[i].turn += 0.5 * h_ * bodies_[i].spin;
    ways_[i].farthest2 = way.squaredNorm();
    fastest2_ = std::max(fastest2_, bodies_[i].velocity.squaredNorm());
  }
  std::ranges::fill(pushes_, SoftPush{});
}

/// The velocities of the substep's middle.
void SoftContacts::foretell(std::uint32_t begin, std::uint32_t end) {
  const Vec fall = gravity_ ? Vec(0.5 * h_ * scene_.gravity) : Vec(0.0, 0.0);
  for (std::size_t i = begin; i < end; ++i) {
    const SolverBody& body = bodies_[i];
    speeds_[i] = {body.velocity + 0.5 * h_ * body.inverse_mass * pushes_[i].force,
                  body.spin + 0.5 * h_ * body.inverse_inertia * pushes_[i].torque};
    if (body.is_dynamic()) speeds_[i].velocity += fall;
    pushes_[i] = {};
  }
}

/// To the end of a substep, and on for `time` (s).
void SoftContacts::kick_and_drift(std::uint32_t begin, std::uint32_t end, double time) {
  const Vec fall = gravity_ ? Vec(h_ * scene_.gravity) : Vec(0.0, 0.0);
  double fastest2 = fastest2_;
  const std::size_t last = std::min<std::size_t>(end, bodies_.size() - 1);  // obstacles stay
  for (std::size_t i = begin; i < last; ++i) {
    SolverBody& body = bodies_[i];
    body.velocity += h_ * body.inverse_mass * pushes_[i].force;
    body.spin += h_ * body.inverse_inertia * pushes_[i].torque;
    if (body.is_dynamic()) body.velocity += fall;
    pushes_[i] = {};
    fastest2 = std::max(fastest2, body.velocity.squaredNorm());
    body.position += time * body.velocity;
    body.turn += time * body.spin;
    SoftWay& way = ways_[i];
    way.farthest2 = std::max(way.farthest2, (body.position - way.from).squaredNorm());
  }
  fastest2_ = fastest2;
}

/// Notes the fastest of the first substep in which somebody is too fast.
void SoftContacts::watch_speed() {
  if (too_fast_ > 0.0 || fastest2_ <= most_ * most_) return;
  const auto fastest = std::ranges::max_element(
      bodies_, {}, [](const SolverBody& body) { return body.velocity.squaredNorm(); });
  fast_ = static_cast<std::uint32_t>(fastest - bodies_.begin());
  too_fast_ = fastest->velocity.norm();
}

std::string SoftContacts::name(const State& state, std::uint32_t place) const {
  const std::uint32_t row = places_.row(place);
  return row < state.id.size() ? "body " + std::to_string(state.id[row]) : std::string("a wall");
}

void SoftContacts::check_speed(const State& state) const {
  if (too_fast_ == 0.0) return;
  char text[250];
  std::snprintf(
      text, sizeof text,
      " moves at %.3g m/s, so %.3g m in a substep, farther than the smallest disc's radius, %.3g m: "
      "it may pass others unseen; take time.dt = %.3g s at most, with time.substeps = %d",
      too_fast_, too_fast_ * h_, most_ * h_, 0.99 * most_ / too_fast_ * scene_.time.dt, scene_.time.substeps);
  throw SimulationError("step " + std::to_string(state.step + 1) + ": " + name(state, fast_) + text);
}

void SoftContacts::check(const State& state) const {
  check_speed(state);
  const SoftSqueeze& worst =
      discs_.squeeze().depth > solids_.squeeze().depth ? discs_.squeeze() : solids_.squeeze();
  if (!(worst.depth > 0.0)) return;
  char depth[32];
  std::snprintf(depth, sizeof depth, "%.3g", worst.depth);
  throw SimulationError("step " + std::to_string(state.step + 1) + ": " + name(state, worst.a) + " and " +
                        name(state, worst.b) + " are pressed " + depth +
                        " m into each other, more than half a radius: take stiffer contacts" +
                        (state.step == 0 ? ", or place them apart if they begin so" : ""));
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
  for (ContactRow& row : rows) row.impulse *= scene_.time.substeps;
}

}  // namespace throng
