// SPDX-License-Identifier: MIT
#include "sim/contact/soft_discs.h"

#include <algorithm>
#include <numeric>

#include "sim/contact/contact_key.h"
#include "sim/contact/kept_impulses.h"
#include "sim/contact/roll.h"
#include "sim/periodic.h"

namespace throng {

namespace {

constexpr std::size_t kWidth = BlockOrder::kWidth;

void fill(SoftBlock& block, std::size_t lane, const SoftPair& law) {
  block.stiffness[lane] = law.stiffness, block.damping[lane] = law.damping;
  block.friction[lane] = law.friction, block.rolling[lane] = law.rolling;
  block.roll_radius[lane] = law.roll_radius;
}

}  // namespace

SoftDiscs::SoftDiscs(const Scene& scene, const Plan& plan)
    : scene_(scene),
      plan_(plan),
      law_{scene.contact == ContactModel::hertz, plan.rolling, soft_ratios(scene)},
      ratios_(damping_ratios(plan)) {}

void SoftDiscs::find(const Candidates& candidates, const State& state, const SoftPlaces& places,
                     std::span<const SolverBody> bodies) {
  list_candidates(candidates, state, places);
  seat_candidates(bodies.size());
  fill_blocks(candidates, places, bodies);
  find_reaches(bodies.size());
  squeeze_ = {};
}

void SoftDiscs::list_candidates(const Candidates& candidates, const State& state, const SoftPlaces& places) {
  const Colliders& colliders = candidates.colliders();
  candidates_.clear();
  KeptImpulses memory(state.disc_contacts);
  for (const broadphase::Pair& pair : candidates.pairs()) {
    if (!is_disc(colliders, pair.a) || !is_disc(colliders, pair.b)) continue;
    const std::uint64_t key = key_of(pair, false);
    candidates_.push_back({key, pair, places.place(colliders.body[pair.a]),
                           places.place(colliders.body[pair.b]), memory.find(key), 0});
  }
}

/// Counts how many begin at each place.
void SoftDiscs::seat_candidates(std::size_t bodies) {
  next_.assign(bodies + 1, 0);
  for (const Candidate& pair : candidates_) ++next_[std::min(pair.a, pair.b) + 1];
  std::partial_sum(next_.begin(), next_.end(), next_.begin());
  for (Candidate& pair : candidates_) pair.seat = next_[std::min(pair.a, pair.b)]++;
}

void SoftDiscs::fill_blocks(const Candidates& candidates, const SoftPlaces& places,
                            std::span<const SolverBody> bodies) {
  blocks_.resize((candidates_.size() + kWidth - 1) / kWidth);
  if (!blocks_.empty()) blocks_.back() = {};
  if (plan_.periodic) shifts_.assign(blocks_.size(), {});
  for (const Candidate& pair : candidates_) {
    SoftBlock& block = blocks_[pair.seat / kWidth];
    const std::size_t lane = pair.seat % kWidth;
    block.a[lane] = pair.a, block.b[lane] = pair.b;
    block.radius_a[lane] = scene_.bodies.radius[places.row(pair.a)];
    block.radius_b[lane] = scene_.bodies.radius[places.row(pair.b)];
    fill(block, lane, law_of(pair.a, pair.b, places, bodies));
    block.touching[lane] = pair.kept ? 1.0 : 0.0;
    block.slip[lane] = pair.kept ? pair.kept->tangent : 0.0;
    block.roll[lane] = pair.kept ? pair.kept->rolling : 0.0;
    if (!plan_.periodic) continue;
    const Vec shift = candidates.shift(pair.colliders);
    shifts_[pair.seat / kWidth].x[lane] = shift.x(), shifts_[pair.seat / kWidth].y[lane] = shift.y();
  }
}

SoftPair SoftDiscs::law_of(std::uint32_t a, std::uint32_t b, const SoftPlaces& places,
                           std::span<const SolverBody> bodies) const {
  const std::uint32_t row_a = places.row(a), row_b = places.row(b);
  const std::size_t surface = plan_.surface_row(scene_.bodies.material[row_a], scene_.bodies.material[row_b]);
  const double mass = 1.0 / (bodies[a].inverse_mass + bodies[b].inverse_mass);
  const double radius = effective_radius(scene_.bodies.radius[row_a], scene_.bodies.radius[row_b]);
  SoftPair law = soft_pair(scene_, mass, radius, ratios_[surface]);
  law.friction = plan_.surfaces[surface].friction;
  law.rolling = plan_.surfaces[surface].rolling, law.roll_radius = radius;
  return law;
}

/// Pairs are seated by their lower place.
void SoftDiscs::find_reaches(std::size_t bodies) {
  lowest_.assign(blocks_.size() + 1, static_cast<std::uint32_t>(bodies));
  highest_.assign(blocks_.size(), 0);
  for (const Candidate& pair : candidates_) {
    const std::size_t block = pair.seat / kWidth;
    lowest_[block] = std::min({lowest_[block], pair.a, pair.b});
    highest_[block] = std::max({highest_[block], pair.a, pair.b});
  }
  std::partial_sum(highest_.begin(), highest_.end(), highest_.begin(),
                   [](std::uint32_t one, std::uint32_t other) { return std::max(one, other); });
}

std::size_t SoftDiscs::block_of(std::size_t block, std::uint32_t place) const {
  while (block < blocks_.size() && highest_[block] < place) ++block;
  return block;
}

void SoftDiscs::press(const SoftSubstep& now, std::size_t begin, std::size_t end) {
  const auto some = [&](auto& all) { return std::span(all).subspan(begin, end - begin); };
  press_soft(some(blocks_), shifts_.empty() ? std::span<const SoftShifts>() : some(shifts_), law_, now,
             squeeze_);
}

void SoftDiscs::press_again(const SoftSubstep& now, std::size_t begin, std::size_t end) {
  press_soft_again(std::span(blocks_).subspan(begin, end - begin), law_, now);
}

void SoftDiscs::finish(const SoftSubstep& now) {
  stretch_soft(blocks_, law_, now);
}

void SoftDiscs::save(double h, State& state) const {
  state.disc_contacts.clear();
  for (const Candidate& pair : candidates_) {
    const SoftBlock& block = blocks_[pair.seat / kWidth];
    const std::size_t lane = pair.seat % kWidth;
    if (block.touching[lane] != 0.0)
      state.disc_contacts.push_back({pair.key, 0, h * block.force[lane], block.slip[lane], block.roll[lane]});
  }
}

void SoftDiscs::list(const State& state, double h, const SoftPlaces& places,
                     std::span<const SolverBody> bodies, std::vector<ContactRow>& rows) const {
  for (const Candidate& pair : candidates_) {
    const SoftBlock& block = blocks_[pair.seat / kWidth];
    const std::size_t lane = pair.seat % kWidth;
    if (block.touching[lane] == 0.0 || !(block.force[lane] > 0.0)) continue;
    const std::uint32_t a = places.row(pair.a), b = places.row(pair.b);
    const double arm = block.radius_a[lane] - 0.5 * std::max(block.depth[lane], 0.0);
    const Vec point = bodies[a].position + arm * Vec(block.normal_x[lane], block.normal_y[lane]);
    rows.push_back({state.id[a], state.id[b], h * block.force[lane],
                    plan_.periodic ? wrapped(point, scene_.domain) : point});
  }
}

}  // namespace throng
