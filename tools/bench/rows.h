// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// What a benchmark prints: the rows of design.md.
namespace throng::bench {

struct Row {
  std::string bench, name, engine;  ///< `name` is the case
  int threads = 1;
  std::vector<double> ms;  ///< one figure a block, each a mean over the block
  double work = 0.0;       ///< pairs, queries or steps behind one figure
  std::string check;       ///< what all engines of a case must agree on
  nlohmann::ordered_json error = nlohmann::ordered_json::object();
  double reference_ms = 0.0;  ///< what the ratio is to; 0: the median of the case's first row
};

double median(std::vector<double> values);
double minimum(const std::vector<double>& values);

/// Throws std::runtime_error naming the case where two engines' checks differ.
void expect_agreement(const std::vector<Row>& rows);

/// The table, on stdout; ratios are of medians, to the row's reference.
void print_table(const std::vector<Row>& rows);

/// Writes the rows as a JSON list, to stdout where the file is "-". Throws InputError where the file can't be
/// written.
void write_json(const std::vector<Row>& rows, const std::string& file);

}  // namespace throng::bench
