// SPDX-License-Identifier: MIT
#include "tools/bench/motion_timing.h"

#include <map>

#include "tools/bench/interleave.h"

namespace throng::bench {

namespace {

Contestant on_the_first(const std::string& name, const AskOne& ask, double queries) {
  return {name, [&ask, queries] {
            double sum = 0.0;
            for (std::size_t i = 0; i < static_cast<std::size_t>(queries); ++i) sum += ask(i);
            answer_sink = sum;
          }};
}

}  // namespace

void time_rows(std::vector<Row>& rows, const std::vector<AskOne>& engines, int blocks) {
  std::vector<Contestant> contestants;
  for (std::size_t i = 0; i < rows.size(); ++i)
    contestants.push_back(on_the_first(rows[i].engine, engines[i], rows[i].work));
  std::map<double, std::size_t> first_on{{rows[0].work, 0}};  // which contestant, by the number of queries
  for (const Row& row : rows)
    if (first_on.try_emplace(row.work, contestants.size()).second)
      contestants.push_back(on_the_first(rows[0].engine, engines[0], row.work));
  interleave(contestants, blocks, 1.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Row& row = rows[i];
    for (const double ms : contestants[i].ms) row.ms.push_back(ms / row.work);
    row.error["ns"] = 1e6 * median(row.ms);
    if (row.work == rows[0].work) continue;
    row.reference_ms = median(contestants[first_on[row.work]].ms) / row.work;
    row.error["asked"] = row.work / rows[0].work;
    row.error["first_ns"] = 1e6 * row.reference_ms;
  }
}

}  // namespace throng::bench
