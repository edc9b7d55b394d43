// SPDX-License-Identifier: MIT
#include "sim/state.h"

#include <bit>
#include <numeric>

namespace throng {

namespace {

/// A 64-bit mix of one word into a running hash, after MurmurHash3's finaliser (Appleby 2011).
std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  hash ^= word;
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
  return state;
}

std::uint64_t hash(const State& state) {
  std::uint64_t result = mix(0x7468726f6e673031ULL, static_cast<std::uint64_t>(state.step));
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    result = mix(result, state.id[row]);
    for (double x : {state.position[row].x(), state.position[row].y(), state.angle[row],
                     state.velocity[row].x(), state.velocity[row].y(), state.spin[row]})
      result = mix(result, bits(x));
  }
  return result;
}

}  // namespace throng
