// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/load.h"
#include "scenarios/toml.h"

namespace throng::scenarios {

/// What is wrong with a scenario, as it comes to light. Every fault has a node of the tree, from which its
/// place follows: line and column of the file, or the override that the node came from.
class Report {
 public:
  static constexpr int kMostErrors = 20, kMostWarnings = 20;

  /// `file` is the tree's own source; a node from any other source came from an override.
  explicit Report(toml::source_path_ptr file = nullptr) : file_(std::move(file)) {}

  void error(const toml::source_region& place, std::string path, std::string message);
  void warning(const toml::source_region& place, std::string path, std::string message);

  /// An error of a node: what needs it is left out from now on.
  void error(const toml::node& node, std::string path, std::string message);

  /// A fault that has no place in the text, only in the command line.
  void error_of_override(const std::string& override_, std::string path, std::string message);

  void mark_bad(const toml::node& node) { bad_.insert(&node); }
  bool bad(const toml::node& node) const { return bad_.contains(&node); }

  int errors() const { return errors_; }
  bool full() const { return errors_ >= kMostErrors; }

  /// All of it in the order of the text; what has no place in it, as overrides have none, comes first, and
  /// last how many warnings more there are than `kMostWarnings`.
  std::vector<Diagnostic> take();

 private:
  void add(Diagnostic::Severity severity, const toml::source_region& place, std::string path,
           std::string message);

  toml::source_path_ptr file_;
  std::vector<Diagnostic> diagnostics_;
  std::set<const toml::node*> bad_;
  int errors_ = 0, warnings_ = 0;  // said or not
};

/// A stranger's text fit for a message: in double quotes, shortened, without control characters.
std::string in_quotes(std::string_view text);

/// The number as TOML writes it, with no more digits than needed to read it back.
std::string to_text(double x);

/// The number rounded to three significant digits.
std::string three_digits(double x);

/// ", did you mean NAME?" for the nearest of `known` by edit distance (Levenshtein 1966; letters that are
/// swapped count once, Damerau 1964); "" where half of the word or more is another.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

/// The suggestion; where none is near ", must be one of ..." with as many of `known` as a line bears.
std::string nearest_or_all(std::string_view word, const std::vector<std::string>& known);

}  // namespace throng::scenarios
