// SPDX-License-Identifier: MIT
#include "sim/record.h"

#include <algorithm>
#include <numeric>

namespace throng {

bool& flag(Record& record, RecordField field) {
  bool* const flags[] = {&record.position, &record.angle, &record.velocity, &record.spin, &record.contacts};
  return *flags[index(field)];
}

bool is_recorded(const Record& record, RecordField field) {
  return flag(const_cast<Record&>(record), field);
}

int every(const Record& record, RecordField field) {
  if (!is_recorded(record, field)) return 0;
  const int own = record.own_every[index(field)];
  return own > 0 ? own : record.every;
}

std::vector<int> rates(const Record& record) {
  std::vector<int> result{record.observables};
  for (RecordField field : kRecordFields) result.push_back(every(record, field));
  result.insert(result.end(), record.sensors.begin(), record.sensors.end());
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  if (result.front() == 0) result.erase(result.begin());
  if (result.empty()) result.push_back(record.every);
  return result;
}

namespace {

/// The least; most + 1 where that is beyond `most`.
std::int64_t common_multiple(std::int64_t a, std::int64_t b, std::int64_t most) {
  const std::int64_t factor = b / std::gcd(a, b);
  return a > most / factor ? most + 1 : a * factor;
}

}  // namespace

/// Each set of rates counts the steps at which all of them are due, added and taken away in turn.
std::int64_t count_frames(const Record& record, std::int64_t steps) {
  const std::vector<int> all = rates(record);
  std::int64_t count = 0;
  for (unsigned set = 1; set < 1u << all.size(); ++set) {
    std::int64_t common = 1, sign = -1;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (set >> i & 1) {
        sign = -sign;
        common = common_multiple(common, all[i], steps);
      }
    count += sign * (steps / common + 1);
  }
  return count;
}

bool has_bodies(const Record& record, std::int64_t step) {
  return std::ranges::any_of(kRecordFields,
                             [&](RecordField field) { return is_due(every(record, field), step); });
}

bool is_frame(const Record& record, std::int64_t step) {
  const auto any_else = [&](std::int64_t at) {
    return is_due(record.observables, at) ||
           std::ranges::any_of(record.sensors, [at](int rate) { return is_due(rate, at); });
  };
  if (has_bodies(record, step) || any_else(step)) return true;
  const bool nothing = !has_bodies(record, 0) && !any_else(0);  // all rates begin at step 0
  return nothing && is_due(record.every, step);
}

}  // namespace throng
