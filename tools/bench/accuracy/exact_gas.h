// SPDX-License-Identifier: MIT
#pragma once

namespace throng::bench {

/// P V / (N k T) of hard discs that fill the share `fraction` of the area, up to 0.65, within 0.1 %: a fit to
/// virial series and simulations, (1 + x²/8 + x³/18 - 4 x⁴/21) / (1 - x)². Source: Liu, arXiv 2010.14357
/// (2020), after Henderson, Mol. Phys. 30, 971 (1975).
double exact_compressibility(double fraction);

/// Collisions of each disc, 1/s, in a gas of discs of that diameter (m) and mean square speed (m²/s², of both
/// coordinates together, the momentum being 0): 4 (Z - 1) sqrt(k T / m) / (sqrt(pi) diameter). Source:
/// Enskog's theory with the pressure's contact value; Chapman and Cowling (1970), chapter 16.
double exact_collision_rate(double fraction, double diameter, double mean_square_speed);

}  // namespace throng::bench
