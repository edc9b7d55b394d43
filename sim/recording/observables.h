// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/measure/measured_bodies.h"
#include "sim/observe.h"

namespace throng::recording {

/// What a scene or a file may have: each is five datasets, flushed at each commit.
inline constexpr std::size_t kMostMeasures = 1'000;

/// One of the measurements below /observables.
struct Observable {
  std::string name;            ///< its path there
  std::size_t components = 1;  ///< numbers
  bool may_be_nan = false;     ///< unknown at times
  double up_to = 0.0;          ///< where the last of a histogram's bins ends; 0 of what is none
};

/// A name as one part of a path, from which it can be told again as from an address of the web: %2F for '/',
/// %2E for a lone '.', %25 for a '%' that would be taken for the begin of such a code.
std::string path_part(std::string_view name);

/// What is observed of a run, in the order in which frame_hash covers it; of a crowd also who is there, and
/// what is measured; behind all else what is asked for.
std::vector<Observable> observables_of(bool crowd, std::span<const Measure> measures,
                                       std::span<const AskedColumn> asked);

/// Their numbers end to end, and back. Expects as many as the observables of the run have; of a crowd nothing
/// is asked.
std::vector<double> numbers_of(const Observables& observables);
Observables observables_from(std::span<const double> numbers, bool crowd);

}  // namespace throng::recording
