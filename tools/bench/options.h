// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace throng::bench {

struct Row;

struct Options {
  std::string scenarios;             ///< folder of the gallery
  std::vector<std::string> only;     ///< regular expressions, one of which a case's name holds; empty: all
  std::vector<std::string> engines;  ///< broadphase, validation, accuracy: these alone; empty: all
  std::vector<std::string> set;      ///< validation: "KEY=VALUE" for all agents
  int blocks = 7;                    ///< figures a row, engines in turn
  bool quick = false;                ///< a tenth of the work, to see that it runs
  bool large = false;                ///< broadphase: ten million points too; recording: a file of 10 GB
  /// Shows what there is so far, when the rows of a case are complete: called with all of the benchmark's.
  std::function<void(const std::vector<Row>&)> show = [](const std::vector<Row>&) {};
  /// Names of cases, for who asks for one that isn't there, and whether there was one.
  std::shared_ptr<std::vector<std::string>> passed_over = std::make_shared<std::vector<std::string>>();
  std::shared_ptr<bool> any_chosen = std::make_shared<bool>(false);
};

/// That folder of the clone in which the program lies, as in its build folder; of the one from which it was
/// built where it lies in none.
std::string of_clone(const std::string& folder);

/// Whether the options ask for a case of this name; who is not asked for joins `passed_over`.
/// Throws InputError where one of `only` isn't a regular expression (POSIX extended).
bool chosen(const std::string& name, const Options& options);

}  // namespace throng::bench
