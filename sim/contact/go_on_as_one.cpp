// SPDX-License-Identifier: MIT
#include "sim/contact/go_on_as_one.h"

namespace throng {

void go_on_as_one(SolverBody& a, SolverBody& b, const Vec& between) {
  const double inverse = a.inverse_mass + b.inverse_mass;
  const double of_a = b.inverse_mass / inverse, of_b = a.inverse_mass / inverse;  // of the mass
  double spin = 0.0;
  if (a.inverse_inertia > 0.0) {
    const double inertia_a = 1.0 / a.inverse_inertia, inertia_b = 1.0 / b.inverse_inertia;
    const double momentum =
        inertia_a * a.spin + inertia_b * b.spin + cross(between, Vec(b.velocity - a.velocity)) / inverse;
    spin = momentum / (inertia_a + inertia_b + between.squaredNorm() / inverse);
  }
  const Vec velocity = of_a * a.velocity + of_b * b.velocity, about = spin * tangent(between);
  a.velocity = velocity - of_b * about, b.velocity = velocity + of_a * about;
  a.spin = b.spin = spin;
}

}  // namespace throng
