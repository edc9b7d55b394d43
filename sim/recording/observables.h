// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "sim/observe.h"

namespace throng::recording {

/// One of the measurements below /observables.
struct Observable {
  const char* name;
  std::size_t components;
  double* (*at)(Observables&);  ///< its first number

  const double* numbers(const Observables& all) const { return at(const_cast<Observables&>(all)); }
};

/// In the order in which frame_hash covers them.
inline constexpr std::array<Observable, 6> kObservables{
    {{"kinetic_energy", 1, [](Observables& o) { return &o.kinetic_energy; }},
     {"potential_energy", 1, [](Observables& o) { return &o.potential_energy; }},
     {"momentum", 2, [](Observables& o) { return o.momentum.data(); }},
     {"contacts", 1, [](Observables& o) { return &o.contacts; }},
     {"max_overlap", 1, [](Observables& o) { return &o.max_overlap; }},
     {"mean_overlap", 1, [](Observables& o) { return &o.mean_overlap; }}}};

}  // namespace throng::recording
