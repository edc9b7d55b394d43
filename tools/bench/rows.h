// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
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

double mean(const std::vector<double>& values);
double median(std::vector<double> values);
double minimum(const std::vector<double>& values);

/// Throws std::runtime_error naming the case where two engines' checks differ.
void expect_agreement(const std::vector<Row>& rows);

/// The table from row `begin` on, on stdout, with its head before the first; ratios are of medians, to the
/// row's reference.
void print_table(const std::vector<Row>& rows, std::size_t begin);

/// Rows as a JSON list that grows, one a line: to stdout where the file is "-", nowhere where it is "". What
/// there was of a run that didn't end lacks the last bracket alone.
class JsonRows {
 public:
  /// What was in the file goes with the first row. Throws InputError where it can't be written.
  explicit JsonRows(const std::string& file);
  ~JsonRows();
  JsonRows(const JsonRows&) = delete;
  JsonRows& operator=(const JsonRows&) = delete;

  void add(std::span<const Row> rows);

  /// Ends the list. Throws InputError where some of it couldn't be written.
  void end();

 private:
  const std::string name_;
  std::FILE* file_ = nullptr;
  bool empty_ = true;
};

}  // namespace throng::bench
