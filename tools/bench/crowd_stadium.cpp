// SPDX-License-Identifier: MIT
// throng bench crowd: steps of the gallery's largest crowd, stage by stage.
#include "sim/simulation.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

constexpr int kSetOut = 200;  // steps, 10 s: a third of them walk

}  // namespace

std::vector<Row> bench_stadium(const Options& options) {
  const std::string name = "stadium";
  if (!chosen(name, options)) return {};
  std::vector<std::string> overrides;
  if (options.quick) overrides.push_back("agents.0.count=10000");
  const Scene scene = gallery_scene(options.scenarios, name, overrides);
  const auto run = simulation(scene);
  for (int i = 0; i < (options.quick ? 1 : kSetOut); ++i) run->step();
  const auto before = run->stage_times();
  std::vector<Contestant> contestants{{"throng", [&] { run->step(); }}};
  interleave(contestants, options.blocks, 1.0);
  Row row{"crowd", name, "throng", 1, contestants[0].ms, 1.0, ""};
  const auto after = run->stage_times();
  for (std::size_t i = 0; i < after.size(); ++i)
    row.error[after[i].first + "_ms"] =
        1e3 * (after[i].second - before[i].second) / static_cast<double>(options.blocks + 1);
  return {row};
}

}  // namespace throng::bench
