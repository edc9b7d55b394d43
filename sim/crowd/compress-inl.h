// SPDX-License-Identifier: MIT
// The numbers of a mask, one after the other. Included once for each width.
#if defined(THRONG_CROWD_COMPRESS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef THRONG_CROWD_COMPRESS_INL
#undef THRONG_CROWD_COMPRESS_INL
#else
#define THRONG_CROWD_COMPRESS_INL
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#ifndef THRONG_HALVES_OF_MASK
#define THRONG_HALVES_OF_MASK
namespace throng {

using HalvesOfMasks = std::array<std::array<std::uint32_t, 8>, 16>;

constexpr HalvesOfMasks halves_of_masks() {
  HalvesOfMasks table{};
  for (std::uint32_t mask = 0; mask < 16; ++mask)
    for (std::uint32_t half = 0, count = 0; half < 8; ++half)
      if (mask >> half / 2 & 1) table[mask][count++] = half;
  return table;
}

/// For each mask of four numbers the halves of those in it, ascending.
inline constexpr HalvesOfMasks kHalvesOfMask = halves_of_masks();

}  // namespace throng
#endif

HWY_BEFORE_NAMESPACE();
namespace throng::HWY_NAMESPACE {

/// Stores the numbers of a mask one after the other, and rubbish up to a vector behind them. (Highway 1.0.3
/// compresses numbers of 64 bits by a table that g++ copies to the stack each time, 512 bytes or 2 kB.)
class Compressor {
  using D = hwy::HWY_NAMESPACE::ScalableTag<double>;
  using Numbers = hwy::HWY_NAMESPACE::Vec<D>;
  using Mask = hwy::HWY_NAMESPACE::Mask<D>;

 public:
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4
  HWY_INLINE explicit Compressor(Mask mask) : bits_(bits_of(mask)) {}

  HWY_INLINE std::size_t count() const {
    return static_cast<std::size_t>(std::popcount(bits_));
  }
  HWY_INLINE void store(Numbers v, double* to) const {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::Repartition<std::uint32_t, D> halves;
    const auto front = hn::IndicesFromVec(halves, hn::LoadU(halves, kHalvesOfMask[bits_].data()));
    hn::StoreU(hn::BitCast(D(), hn::TableLookupLanes(hn::BitCast(halves, v), front)), D(), to);
  }

 private:
  static HWY_INLINE std::uint8_t bits_of(Mask mask) {
    std::uint8_t bits[8] = {};
    hwy::HWY_NAMESPACE::StoreMaskBits(D(), mask, bits);
    return bits[0];
  }

  std::uint8_t bits_;
#else
  HWY_INLINE explicit Compressor(Mask mask) : mask_(mask) {}

  HWY_INLINE std::size_t count() const {
    return hwy::HWY_NAMESPACE::CountTrue(D(), mask_);
  }
  HWY_INLINE void store(Numbers v, double* to) const {
    hwy::HWY_NAMESPACE::StoreU(compressed(v), D(), to);
  }

 private:
  HWY_INLINE Numbers compressed(Numbers v) const {
#if HWY_TARGET == HWY_AVX3
    return Numbers{_mm512_maskz_compress_pd(mask_.raw, v.raw)};
#else
    return hwy::HWY_NAMESPACE::Compress(v, mask_);
#endif
  }

  Mask mask_;
#endif
};

}  // namespace throng::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
