// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/bench/rows.h"

/// What the same error costs, by the least of the times: on a busy machine they say more than medians. Errors
/// below 1e-9 are one: rounding.
namespace throng::bench {

/// ms, the least time at which an engine reaches an error of at most that among one case's rows; none where
/// it doesn't.
std::optional<double> least_ms(const std::vector<Row>& rows, const std::string& engine, double error);

/// Puts "native_ms" beside each error of another engine: native's least time for at most this error; null
/// where it has no setting that good.
void add_native_ms(std::vector<Row>& rows);

/// How many times as fast as the best peer native is at the errors that peers reach, as far as these are of
/// use (below 1): the least and the most.
struct Advantage {
  double least, most;
  std::vector<double> beyond;  ///< errors that peers reach and native, at any setting seen, doesn't
};

/// Of one case's rows; none where no peer plays.
std::optional<Advantage> advantage(const std::vector<Row>& rows);

}  // namespace throng::bench
