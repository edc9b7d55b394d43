// SPDX-License-Identifier: MIT
#include "sim/state.h"

#include <bit>
#include <numeric>

namespace throng {

namespace {

/// One word more in a running hash, as a lane of XXH64 takes it (Collet 2012).
std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  return std::rotl(hash + word * 0xc2b2ae3d27d4eb4fULL, 31) * 0x9e3779b185ebca87ULL;
}

/// Every bit of the result depends on every bit of the hash: MurmurHash3's finaliser (Appleby 2011).
std::uint64_t finished(std::uint64_t hash) {
  hash ^= hash >> 33;
  hash *= 0xff51afd7ed558ccdULL;
  hash ^= hash >> 33;
  hash *= 0xc4ceb9fe1a85ec53ULL;
  return hash ^ (hash >> 33);
}

/// The bits of a number, with one zero.
std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x + 0.0);
}

}  // namespace

State initial_state(const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  State state;
  state.id.resize(bodies.size());
  std::iota(state.id.begin(), state.id.end(), 1u);
  state.position = bodies.position;
  state.angle = bodies.angle;
  state.velocity = bodies.velocity;
  state.spin = bodies.spin;
  if (scene.crowd.size() > 0) {
    state.crowd.stand = state.position;
    state.crowd.stand_step.assign(bodies.size(), 0);
    state.crowd.measured.resize(scene.crowd.measures.size());
  }
  return state;
}

bool fits(const State& state, const Scene& scene) {
  const bool crowd = scene.crowd.size() > 0;
  const std::size_t rows = state.id.size(), arrived = static_cast<std::size_t>(state.crowd.arrived);
  return rows + arrived == scene.bodies.size() && (crowd || arrived == 0) &&
         state.crowd.stand.size() == (crowd ? rows : 0) &&
         state.crowd.measured.size() == (crowd ? scene.crowd.measures.size() : 0);
}

std::uint64_t hash(const State& state) {
  std::uint64_t sum = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    std::uint64_t one = mix(0x7468726f6e673032ULL, state.id[row]);
    for (double x : {state.position[row].x(), state.position[row].y(), state.angle[row],
                     state.velocity[row].x(), state.velocity[row].y(), state.spin[row]})
      one = mix(one, bits(x));
    sum += finished(one);
  }
  return finished(mix(mix(sum, state.id.size()), static_cast<std::uint64_t>(state.step)));
}

}  // namespace throng
