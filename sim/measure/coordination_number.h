// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "sim/contact_row.h"
#include "sim/state.h"

namespace throng {

/// How many others a dynamic body presses on, by the mean; walls and static bodies count for the body alone
/// that touches them. Points of one face are one contact; so are all walls that a body touches which isn't a
/// disc. NaN where nobody is dynamic. O(contacts log contacts).
double coordination_number(const Scene& scene, std::span<const ContactRow> contacts);

}  // namespace throng
