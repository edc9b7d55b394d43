// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "tools/bench/validation_walk.h"

/// What crowds are held against: a row per case, with where it stands, what is measured, and its bounds.
namespace throng::bench {

/// What a case measured of one model.
struct Finding {
  std::optional<double> value;  ///< none: it could not be measured, as `note` says
  std::string note = {};
  nlohmann::ordered_json series = nlohmann::ordered_json::object();  ///< the numbers behind it, for plots
  double doubt = 0.0;  ///< twice the standard error of `value`, where it is a mean over draws of the crowd
  std::optional<double> worst = {};  ///< of one of the draws
};

/// Twice the standard error of the mean of these. Expects two or more.
double doubt(const std::vector<double>& draws);

struct ValidationCase {
  const char* name;  ///< its numbers in the catalogues, and a word or two
  const char* what;  ///< is measured
  const char* unit;
  double low, high;  ///< of the value, up to its doubt; both are allowed; none: it is only documented
  Finding (*measure)(const Trials& trials);
  bool quick = false;  ///< done in less than a second
};

std::span<const ValidationCase> lone_cases();    ///< who walks by himself, or nearly so
std::span<const ValidationCase> exit_cases();    ///< who leaves through narrow exits
std::span<const ValidationCase> stream_cases();  ///< who walks in streams
std::span<const ValidationCase> choice_cases();  ///< who chooses, or keeps company

/// What a model can't do by its nature, however it is tuned; nothing where nothing is known of it.
const char* by_nature(const std::string& model, const std::string& name);

}  // namespace throng::bench
