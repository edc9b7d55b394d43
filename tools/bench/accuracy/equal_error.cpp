// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/equal_error.h"

#include <algorithm>
#include <limits>

namespace throng::bench {

namespace {

bool is_peer(const Row& row) {
  return row.error.contains("peer");
}

constexpr double kUseless = 1.0;      // a body's size, or all of a quantity
constexpr double kLeastError = 1e-9;  // smaller errors aren't told apart

bool plays(const Row& row) {
  return !row.error["error"].is_null();
}

/// The error, no better than rounding.
double off(const Row& row) {
  return std::max(row.error["error"].get<double>(), kLeastError);
}

/// ms, of the fastest peer whose error is at most that.
double best_peer_ms(const std::vector<Row>& rows, double error) {
  double best = std::numeric_limits<double>::infinity();
  for (const Row& row : rows)
    if (is_peer(row) && plays(row) && off(row) <= error) best = std::min(best, minimum(row.ms));
  return best;
}

}  // namespace

std::optional<double> least_ms(const std::vector<Row>& rows, const std::string& engine, double error) {
  std::optional<double> least;
  for (const Row& row : rows)
    if (row.engine == engine && plays(row) && off(row) <= std::max(error, kLeastError))
      least = std::min(least.value_or(minimum(row.ms)), minimum(row.ms));
  return least;
}

void add_native_ms(std::vector<Row>& rows) {
  for (Row& row : rows) {
    if (row.engine == "native" || !plays(row)) continue;
    const std::optional<double> ms = least_ms(rows, "native", row.error["error"]);
    row.error["native_ms"] = ms ? nlohmann::ordered_json(*ms) : nlohmann::ordered_json(nullptr);
  }
}

std::optional<Advantage> advantage(const std::vector<Row>& rows) {
  std::optional<Advantage> found;
  for (const Row& row : rows) {
    if (!is_peer(row) || !plays(row) || row.error["error"] >= kUseless) continue;
    const double error = off(row), peer = best_peer_ms(rows, error);
    if (minimum(row.ms) > peer) continue;
    if (!found) found = Advantage{std::numeric_limits<double>::infinity(), 0.0, {}};
    const std::optional<double> own = least_ms(rows, "native", error);
    if (!own) {
      found->beyond.push_back(error);
      continue;
    }
    found->least = std::min(found->least, peer / *own);
    found->most = std::max(found->most, peer / *own);
  }
  return found;
}

}  // namespace throng::bench
