// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/bench/rows.h"

namespace throng::bench {

/// The exponent p of error = c h^p, fitted to the logarithms of points (h, error); of those points alone that
/// are neither rounding (single precision reaches 1e-5) nor so large that powers of h say nothing. None where
/// fewer than three are left.
std::optional<double> observed_order(std::span<const std::pair<double, double>> points);

/// Puts "order" beside each error of one case: that of its engine and knob over dt, null where there is none.
/// Where not even the largest of these errors is more than rounding in double precision, "exact" is true.
void add_orders(std::vector<Row>& rows);

/// A table on stdout: smooth scenes down, engines across.
void print_convergence(const std::vector<Row>& rows);

}  // namespace throng::bench
