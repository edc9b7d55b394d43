// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

/// Random numbers that depend on what they are for and on nothing else: not on threads, not on what was drawn
/// before.
namespace throng {

/// What a number is drawn for; purposes never share numbers. The values are part of what a seed means: never
/// reuse one.
enum class Purpose : std::uint8_t {
  radius = 1,
  angle,
  velocity,
  place,
  desired_speed,
  doubt,
  journey,
  premovement,
  stay,
  spot,
  hesitation,
  parameter
};

/// The block cipher Philox4x32-10 of Salmon et al., "Parallel random numbers: as easy as 1, 2, 3" (SC 2011).
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// The numbers of one (seed, step, id, purpose), one after the other. Up to 2^33 of them. Cheap to make;
/// allocates nothing.
class Random {
 public:
  /// Expects step < 2^56.
  Random(std::uint64_t seed, std::uint64_t step, std::uint32_t id, Purpose purpose);

  /// Uniform on [0, 1): a multiple of 2^-53.
  double uniform();

  /// Uniform on [low, high]. Expects low <= high.
  double uniform(double low, double high);

  /// Standard normal, by the polar method of Marsaglia & Bray, "A convenient method for generating normal
  /// variables" (SIAM Review 1964), with our own logarithm: the same bits on every machine.
  double normal();

 private:
  std::uint64_t next();  ///< 64 random bits

  std::array<std::uint32_t, 4> counter_;  ///< number of the block, id, step, step and purpose
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> block_{};
  bool half_left_ = false;
};

/// The natural logarithm of a normal x > 0 by + - * / alone: the same bits on every machine, right to 3e-16
/// relative (absolute next to 1).
double logarithm(double x);

}  // namespace throng
