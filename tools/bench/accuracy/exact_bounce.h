// SPDX-License-Identifier: MIT
#pragma once

namespace throng::bench {

/// How high above the floor something is, and how fast it rises.
struct Height {
  double height;  ///< m
  double speed;   ///< m/s, upwards
};

/// What falls from rest at `height` (m) and bounces with restitution e, after t (s): between its bounces a
/// throw, the nth of which rises to e^2n height. For e < 1 these are infinitely many in the finite time of
/// `exact_rest`; then it lies still. O(bounces). Source: any textbook of mechanics; the sum is geometric.
Height exact_bounce(double height, double gravity, double restitution, double t);

/// s, when it has come to rest: sqrt(2 height / gravity) (1 + e) / (1 - e).
double exact_rest(double height, double gravity, double restitution);

}  // namespace throng::bench
