// SPDX-License-Identifier: MIT
#include "tools/bench/rows.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numeric>
#include <stdexcept>
#include <system_error>

#include "sim/input_error.h"

namespace throng::bench {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double minimum(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

void expect_agreement(const std::vector<Row>& rows) {
  std::map<std::string, const Row*> first;
  for (const Row& row : rows) {
    const Row& other = *first.try_emplace(row.name, &row).first->second;
    if (other.check != row.check)
      throw std::runtime_error("case " + row.name + ": " + other.engine + " says " + other.check + ", " +
                               row.engine + " says " + row.check);
  }
}

/// "mean_overlap 3.7e-03  max_overlap 0.031"; texts as they are.
std::string short_text(const nlohmann::ordered_json& error) {
  std::string text;
  for (const auto& [key, value] : error.items()) {
    char number[32];
    std::snprintf(number, sizeof number, "%.3g", value.is_number() ? value.get<double>() : 0.0);
    text += (text.empty() ? "" : "  ") + key + " " + (value.is_number() ? number : value.dump());
  }
  return text;
}

void print_table(const std::vector<Row>& rows, std::size_t begin) {
  if (begin == 0)
    std::printf("%-34s %-12s %10s %10s %8s  %s\n", "case", "engine", "ms", "ms_min", "ratio", "error");
  std::map<std::string, double> first;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    const double ms = median(row.ms);
    const double of_first = first.try_emplace(row.name, ms).first->second;
    const double reference = row.reference_ms > 0.0 ? row.reference_ms : of_first;
    if (i < begin) continue;
    std::printf("%-34s %-12s %10.5g %10.5g %8.2f  %s\n", row.name.c_str(), row.engine.c_str(), ms,
                minimum(row.ms), ms / reference, short_text(row.error).c_str());
  }
}

JsonRows::JsonRows(const std::string& file) : name_(file) {
  if (file.empty()) return;
  file_ = file == "-" ? stdout : std::fopen(file.c_str(), "a");
  if (!file_) throw InputError(file + ": can't be written");
}

JsonRows::~JsonRows() {
  if (!file_ || file_ == stdout) return;
  std::fclose(file_);
  std::error_code none;
  if (empty_ && std::filesystem::file_size(name_, none) == 0) std::filesystem::remove(name_, none);
}

void JsonRows::add(std::span<const Row> rows) {
  if (!file_) return;
  if (empty_ && !rows.empty() && file_ != stdout && ftruncate(fileno(file_), 0) != 0) errno = 0;  // a pipe
  for (const Row& row : rows) {
    const nlohmann::ordered_json line{
        {"bench", row.bench},     {"case", row.name},     {"engine", row.engine},
        {"threads", row.threads}, {"ms", median(row.ms)}, {"ms_min", minimum(row.ms)},
        {"work", row.work},       {"check", row.check},   {"error", row.error}};
    std::fprintf(file_, "%s%s", empty_ ? "[\n" : ",\n", line.dump().c_str());
    empty_ = false;
  }
  std::fflush(file_);
}

void JsonRows::end() {
  if (!file_) return;
  std::fputs(empty_ ? "[]\n" : "\n]\n", file_);
  if (std::fflush(file_) != 0 || std::ferror(file_)) throw InputError(name_ + ": can't be written");
}

}  // namespace throng::bench
