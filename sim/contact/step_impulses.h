// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "sim/contact/body_rows.h"
#include "sim/contact/contacts.h"
#include "sim/contact_row.h"

namespace throng {

/// What contacts press in the course of a step, along their normals: in all its substeps, and what strikes
/// there. Kept where contacts are recorded (Plan::sums_impulses).
class StepImpulses {
 public:
  /// Of a contact.
  struct Sum {
    double impulse = 0.0;  ///< N s
    Vec at{0.0, 0.0};      ///< m, where it presses by the end, or else where it was struck last, or pressed
  };

  /// Before the first substep, or where there is none. O(contacts).
  void start(const Contacts& contacts);
  /// What the i-th of `faces` has pressed in this substep (of h, s), if it is forgotten then.
  void add_face(std::size_t i, const Contacts& contacts, BodyRows<const SolverBody> bodies, double h);
  /// What they press in the substep (of h, s) that ends. O(contacts).
  void add(const Contacts& contacts, BodyRows<const SolverBody> bodies, double h);
  /// What struck in all substeps. O(bounces).
  void add_bounces(const Contacts& contacts);
  /// Between whom nothing was listed, or not as a contact.
  void set_strikes(std::span<const ContactRow> strikes) { strikes_.assign(strikes.begin(), strikes.end()); }

  std::span<const Sum> discs() const { return discs_; }  ///< of each of `Contacts::discs`
  std::span<const Sum> faces() const { return faces_; }  ///< of each of `Contacts::faces`
  std::span<const ContactRow> strikes() const { return strikes_; }

 private:
  std::vector<Sum> discs_, faces_;
  std::vector<ContactRow> strikes_;
};

}  // namespace throng
