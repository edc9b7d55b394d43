// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact/contacts.h"
#include "sim/contact_row.h"

namespace throng {

/// A contact at which bodies were struck, among its like.
struct StruckContact {
  std::uint32_t row;
  Vec at;  ///< m, where they were last
};

/// What contacts press in the course of a step, along their normals: in all its substeps, and what strikes
/// there. Kept where contacts are recorded (Plan::sums_impulses).
struct StepImpulses {
  std::vector<double> discs, faces;  ///< N s, of each of `Contacts::discs` and `Contacts::faces`
  std::vector<StruckContact> struck_discs, struck_faces;  ///< those of them, ascending
  std::vector<ContactRow> strikes;  ///< between whom nothing was listed, or not as a contact

  /// Before the first substep. O(contacts).
  void start(const Contacts& contacts);
  /// What they press in the substep that ends. O(contacts).
  void add(const Contacts& contacts);
  /// What struck in all substeps. O(bounces).
  void add_bounces(const Contacts& contacts);
};

}  // namespace throng
