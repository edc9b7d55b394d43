// SPDX-License-Identifier: MIT
#include "scenarios/report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>
#include <vector>

namespace throng::scenarios {

namespace {

/// The fewest letters to insert, remove, change, or swap with the next one. O(|a| |b|).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

void Report::add(Diagnostic::Severity severity, const toml::source_region& place, std::string path,
                 std::string message) {
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.path = std::move(path);
  diagnostic.message = std::move(message);
  if (place.path && place.path != file_) {
    diagnostic.source = *place.path;
  } else {
    diagnostic.line = static_cast<int>(place.begin.line);
    diagnostic.column = static_cast<int>(place.begin.column);
  }
  diagnostics_.push_back(std::move(diagnostic));
}

void Report::error(const toml::source_region& place, std::string path, std::string message) {
  if (full()) return;
  ++errors_;
  add(Diagnostic::Severity::error, place, std::move(path), std::move(message));
}

void Report::error(const toml::node& node, std::string path, std::string message) {
  mark_bad(node);
  error(node.source(), std::move(path), std::move(message));
}

void Report::error_of_override(const std::string& override_, std::string path, std::string message) {
  if (full()) return;
  ++errors_;
  diagnostics_.push_back(
      {Diagnostic::Severity::error, 0, 0, std::move(path), std::move(message), "--set " + override_});
}

void Report::warning(const toml::source_region& place, std::string path, std::string message) {
  if (++warnings_ > kMostWarnings) return;
  add(Diagnostic::Severity::warning, place, std::move(path), std::move(message));
}

std::vector<Diagnostic> Report::take() {
  std::stable_sort(diagnostics_.begin(), diagnostics_.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  if (const int more = warnings_ - kMostWarnings; more > 0)
    add(Diagnostic::Severity::warning, {}, "",
        more == 1 ? "there is 1 more warning" : "there are " + std::to_string(more) + " more warnings");
  return std::move(diagnostics_);
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string result = "\"";
  for (char c : text.substr(0, kMost)) {
    const auto byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  while (text.size() > kMost && !result.empty() && (static_cast<unsigned char>(result.back()) & 0x80) != 0)
    result.pop_back();  // no half of a character
  return result + (text.size() > kMost ? "...\"" : "\"");
}

std::string to_text(double x) {
  if (std::isnan(x)) return "nan";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x);
  return std::string(buffer, end.ptr);
}

std::string three_digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  if (word.size() > 64) return "";
  std::size_t best = (std::max<std::size_t>(3, word.size()) - 1) / 2 + 1;
  const std::string* nearest = nullptr;
  for (const std::string& candidate : known) {
    if (candidate.size() > 64) continue;
    const std::size_t d = edit_distance(word, candidate);
    if (d < best) best = d, nearest = &candidate;
  }
  return nearest ? ", did you mean " + in_quotes(*nearest) + "?" : "";
}

std::string nearest_or_all(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kMost = 300;
  if (std::string nearest = suggestion(word, known); !nearest.empty() || known.empty()) return nearest;
  std::string result = ", must be one of";
  for (const std::string& name : known) {
    if (result.size() > kMost) return result + ", ...";
    result += (&name == &known.front() ? " " : ", ") + in_quotes(name);
  }
  return result;
}

}  // namespace throng::scenarios
