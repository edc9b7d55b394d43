// SPDX-License-Identifier: MIT
#pragma once

/// Sine, cosine and their inverses out of + - * / and sqrt alone: the same bits on every machine, which the
/// system's libm doesn't promise. Whatever feeds the state takes its angles from here.
namespace throng::narrowphase {

struct SinCos {
  double sin, cos;
};

/// The sine and cosine of any finite `angle` (rad), within 1 ulp up to 1e9 rad and 2 ulp beyond; sin² + cos²
/// is 1 within 2 ulp; sin is odd and cos even to the bit. NaN for an angle that is not finite. About 10 ns.
/// Reduction after Cody and Waite (1980) in four parts, above 2^30 rad after Payne and Hanek (1983).
SinCos sin_cos(double angle);

/// The angle of (x, y) in (-pi, pi], rad, within 4 ulp; 0 for the origin. Expects finite arguments; signs of
/// zeros don't count.
double arc_tangent(double y, double x);

/// The angle in [0, pi] whose cosine is `x`, rad, within 4 ulp near 0 and pi too. Expects -1 <= x <= 1.
double arc_cosine(double x);

}  // namespace throng::narrowphase
