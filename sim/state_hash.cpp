// SPDX-License-Identifier: MIT
// The hash of a state: one body after the other as it is defined, and where vectors multiply 64 bits, as many
// at once as these hold. Both give the same.
#include <bit>

#include "sim/state.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/state_hash.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef THRONG_STATE_HASH_ONCE
#define THRONG_STATE_HASH_ONCE
namespace throng::state_hash {

constexpr std::uint64_t kStart = 0x7468726f6e673032ULL;
constexpr std::uint64_t kOfWord = 0xc2b2ae3d27d4eb4fULL, kOfHash = 0x9e3779b185ebca87ULL;
constexpr std::uint64_t kFinish1 = 0xff51afd7ed558ccdULL, kFinish2 = 0xc4ceb9fe1a85ec53ULL;

/// One word more in a running hash, as a lane of XXH64 takes it (Collet 2012).
inline std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  return std::rotl(hash + word * kOfWord, 31) * kOfHash;
}

/// Every bit of the result depends on every bit of the hash: MurmurHash3's finaliser (Appleby 2011).
inline std::uint64_t finished(std::uint64_t hash) {
  hash = (hash ^ (hash >> 33)) * kFinish1;
  hash = (hash ^ (hash >> 33)) * kFinish2;
  return hash ^ (hash >> 33);
}

/// Of one body. Numbers have one zero.
inline std::uint64_t of_body(const State& state, std::size_t row) {
  std::uint64_t hash = mix(kStart, state.id[row]);
  for (double x : {state.position[row].x(), state.position[row].y(), state.angle[row],
                   state.velocity[row].x(), state.velocity[row].y(), state.spin[row]})
    hash = mix(hash, std::bit_cast<std::uint64_t>(x + 0.0));
  return finished(hash);
}

}  // namespace throng::state_hash
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

#if HWY_TARGET <= HWY_AVX3

namespace hn = hwy::HWY_NAMESPACE;
using HashWords = hn::ScalableTag<std::uint64_t>;
using HashReals = hn::Rebind<double, HashWords>;
using HashWord = hn::Vec<HashWords>;
using HashReal = hn::Vec<HashReals>;

/// Of two vectors of bodies: one waits for its products while the other is multiplied.
struct HashPair {
  HashWord low, high;
};

HWY_INLINE HashWord mixed(HashWord hash, HashWord word) {
  const HashWords d;
  return hn::RotateRight<33>(hash + word * hn::Set(d, state_hash::kOfWord)) * hn::Set(d, state_hash::kOfHash);
}

HWY_INLINE HashPair mixed(HashPair hash, HashWord low, HashWord high) {
  return {mixed(hash.low, low), mixed(hash.high, high)};
}

HWY_INLINE HashPair mixed(HashPair hash, HashReal low, HashReal high) {
  const HashWords d;
  const HashReal zero = hn::Zero(HashReals());
  return mixed(hash, hn::BitCast(d, low + zero), hn::BitCast(d, high + zero));
}

HWY_INLINE HashPair mixed(HashPair hash, const double* numbers) {
  const HashReals d;
  return mixed(hash, hn::LoadU(d, numbers), hn::LoadU(d, numbers + hn::Lanes(d)));
}

HWY_INLINE HashPair mixed(HashPair hash, const Vec* vectors) {
  const HashReals d;
  HashReal x, y, more_x, more_y;
  hn::LoadInterleaved2(d, vectors->data(), x, y);
  hn::LoadInterleaved2(d, vectors[hn::Lanes(d)].data(), more_x, more_y);
  return mixed(mixed(hash, x, more_x), y, more_y);
}

HWY_INLINE HashWord finished(HashWord hash) {
  const HashWords d;
  hash = (hash ^ hn::ShiftRight<33>(hash)) * hn::Set(d, state_hash::kFinish1);
  hash = (hash ^ hn::ShiftRight<33>(hash)) * hn::Set(d, state_hash::kFinish2);
  return hash ^ hn::ShiftRight<33>(hash);
}

/// Of the bodies in the rows from this one on, one in each lane of two vectors.
HWY_INLINE HashPair of_bodies(const State& state, std::size_t row) {
  const HashWords d;
  const hn::Rebind<std::uint32_t, HashWords> ids;
  const std::uint32_t* const id = state.id.data() + row;
  const HashWord start = hn::Set(d, state_hash::kStart);
  HashPair hash = mixed({start, start}, hn::PromoteTo(d, hn::LoadU(ids, id)),
                        hn::PromoteTo(d, hn::LoadU(ids, id + hn::Lanes(d))));
  hash = mixed(mixed(hash, &state.position[row]), &state.angle[row]);
  hash = mixed(mixed(hash, &state.velocity[row]), &state.spin[row]);
  return {finished(hash.low), finished(hash.high)};
}

std::uint64_t sum_of_bodies(const State& state) {
  const HashWords d;
  const std::size_t n = state.id.size(), each = 2 * hn::Lanes(d), whole = n - n % each;
  HashPair sums{hn::Zero(d), hn::Zero(d)};
  for (std::size_t row = 0; row < whole; row += each) {
    const HashPair bodies = of_bodies(state, row);
    sums = {sums.low + bodies.low, sums.high + bodies.high};
  }
  std::uint64_t sum = hn::GetLane(hn::SumOfLanes(d, sums.low + sums.high));
  for (std::size_t row = whole; row < n; ++row) sum += state_hash::of_body(state, row);
  return sum;
}

#else

std::uint64_t sum_of_bodies(const State& state) {
  std::uint64_t sum = 0;
  for (std::size_t row = 0; row < state.id.size(); ++row) sum += state_hash::of_body(state, row);
  return sum;
}

#endif

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng {

HWY_EXPORT(sum_of_bodies);

std::uint64_t hash(const State& state) {
  using namespace state_hash;
  const std::uint64_t sum = HWY_DYNAMIC_DISPATCH(sum_of_bodies)(state);
  return finished(mix(mix(sum, state.id.size()), static_cast<std::uint64_t>(state.step)));
}

}  // namespace throng
#endif
