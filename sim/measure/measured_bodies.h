// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/contact_row.h"
#include "sim/measure/asked.h"
#include "sim/state.h"

/// What a scene asks to be observed of its bodies, measured: names and numbers in one order.
namespace throng {

struct AskedColumn {
  const char* name;
  std::size_t numbers = 1;
  Bins bins = {};  ///< of a histogram
};

/// All names there may be, and whether theirs are histograms.
std::span<const AskedColumn> known_columns();

/// Those that the scene asks for, in the order of known_columns().
std::vector<AskedColumn> asked_columns(const Scene& scene);

/// Their numbers end to end; NaN where one isn't known. `contacts`: those of the state. Expects
/// asked_refusal() to be "". Allocates. O(bodies + contacts log contacts), and the pairs that a pair
/// correlation counts.
std::vector<double> measure_bodies(const Scene& scene, const State& state,
                                   std::span<const ContactRow> contacts);

/// What the scene can't be asked: the key of it and why; "" where it can be asked all of it.
std::pair<std::string, std::string> asked_refusal(const Scene& scene);

}  // namespace throng
