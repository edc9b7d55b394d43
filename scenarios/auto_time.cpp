// SPDX-License-Identifier: MIT
#include "sim/auto_time.h"

#include "scenarios/read.h"
#include "sim/soft_timing.h"

namespace throng::scenarios {

void settle_auto_time(const toml::table& root, Scene& scene, Report& report) {
  if (!(scene.time.error > 0.0)) return;
  if (is_soft(scene.contact) && scene.engine == Engine::native && !soft_refusal(scene).empty()) return;
  const AutoTime chosen = auto_time(scene);
  if (!chosen.refusal.empty())
    return report.error(*root["time"]["dt"].node(), "time.dt",
                        "\"auto\" can promise nothing: " + chosen.refusal);
  scene.time.dt = chosen.dt;
  scene.time.substeps = chosen.substeps;
}

}  // namespace throng::scenarios
