// SPDX-License-Identifier: MIT
#pragma once

#include "scenarios/report.h"
#include "sim/random.h"

namespace throng::scenarios {

/// A number of each agent's own.
struct Distribution {
  enum class Kind { fixed, uniform, normal, lognormal } kind = Kind::fixed;
  double a = 0.0, b = 0.0;       ///< value; low and high; mean and standard deviation
  double low = 0.0, high = 0.0;  ///< what is drawn beyond these is drawn again
};

/// Of a node that the check found good: a number, or a table of uniform, normal or lognormal, and `within`.
/// Draws lie between `least` and `most`. Reports bounds in the wrong order, and cut-offs that leave next to
/// nothing; warns where `least` cuts off so much of a normal distribution that its mean is another.
Distribution read_distribution(const toml::node& node, double least, double most, const std::string& path,
                               Report& report);

/// What some of it come to: the highest, or one standard deviation above the mean.
double usual_most(const Distribution& distribution);

/// Likewise: the lowest, or one standard deviation below the mean.
double usual_least(const Distribution& distribution);

/// A number of it. What a thousand draws don't bring within the cut-offs is moved to the nearer one.
double draw(const Distribution& distribution, Random& random);

}  // namespace throng::scenarios
