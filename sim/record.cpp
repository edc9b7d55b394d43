// SPDX-License-Identifier: MIT
#include "sim/record.h"

#include <algorithm>
#include <numeric>

namespace throng {

bool is_recorded(const Record& record, RecordField field) {
  const bool recorded[] = {record.position, record.angle, record.velocity, record.spin, record.contacts};
  return recorded[static_cast<int>(field)];
}

int every(const Record& record, RecordField field) {
  if (!is_recorded(record, field)) return 0;
  const int own = record.own_every[static_cast<std::size_t>(field)];
  return own > 0 ? own : record.every;
}

std::vector<int> rates(const Record& record) {
  std::vector<int> result{record.every, record.observables};
  for (int field = 0; field < kRecordFields; ++field)
    result.push_back(every(record, static_cast<RecordField>(field)));
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  if (result.front() == 0) result.erase(result.begin());
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

bool is_frame(const Record& record, std::int64_t step) {
  if (is_due(record.every, step) || is_due(record.observables, step)) return true;
  for (int field = 0; field < kRecordFields; ++field)
    if (is_due(every(record, static_cast<RecordField>(field)), step)) return true;
  return false;
}

}  // namespace throng
