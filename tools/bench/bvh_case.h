// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"

namespace throng::bench {

/// Nine digits: what two orders of a sum agree on.
std::string text(double value);

/// The rows of one case of throng bench bvh: each engine answers `work` questions in `ask`, whose sum all
/// must agree on. Quick ones are asked several times a block.
class Case {
 public:
  Case(std::string name, double work) : name_(std::move(name)), work_(work) {}

  void add(std::string engine, std::function<double()> ask, nlohmann::ordered_json error = {});
  void finish(const Options& options, std::vector<Row>& rows);

 private:
  const std::string name_;
  const double work_;
  std::vector<Contestant> contestants_;
  std::vector<int> repeats_;
  std::vector<double> sums_;
  std::vector<nlohmann::ordered_json> errors_;
};

}  // namespace throng::bench
