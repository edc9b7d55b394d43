// SPDX-License-Identifier: MIT
#pragma once

/// The colours of pictures and replay pages.
namespace throng::tools {

struct Colour {
  double red, green, blue;  ///< 0 to 1, sRGB
};

/// The colour of a value from 0 to 1 (clamped): dark blue-violet over green to yellow, even steps looking
/// even, in daylight, in grey and to colour-blind eyes, after viridis (Smith and van der Walt 2015, CC0).
Colour palette(double value);

/// The same colour, darker: for outlines.
Colour shade(const Colour& colour);

/// A round number, 1, 2 or 5 times a power of ten: the largest that is at most `limit`. Expects limit > 0.
double round_below(double limit);

/// `speed` (m/s) at the top of the scale, so that nearly all of the speeds given have a colour of their own:
/// the 99th percentile, rounded up to two digits. 0 where nothing moves. Reorders `speeds`.
double top_speed(double* speeds, long count);

}  // namespace throng::tools
