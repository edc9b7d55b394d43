// SPDX-License-Identifier: MIT
#include "sim/workers.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "sim/crew.h"

namespace throng {

struct Workers::Team {
  explicit Team(int n)
      : threads(static_cast<std::size_t>(n)),
        control(tbb::global_control::max_allowed_parallelism, threads),
        arena(n),
        crew(threads) {}

  const std::size_t threads;
  tbb::global_control control;
  tbb::task_arena arena;
  tbb::task_group helpers;
  Crew crew;
  bool stands_by = false;
};

Workers::Workers(int threads) : team_(threads > 1 ? std::make_unique<Team>(threads) : nullptr) {}
Workers::~Workers() = default;

Workers::Shift::Shift(Workers& workers, std::size_t rounds)
    : team_(rounds > kGrain ? workers.team_.get() : nullptr) {
  if (!team_) return;
  team_->crew.open(), team_->stands_by = true;
  team_->arena.execute([team = team_] {
    for (std::size_t i = 1; i < team->threads; ++i) team->helpers.run([team, i] { team->crew.stand_by(i); });
  });
}

Workers::Shift::~Shift() {
  if (!team_) return;
  team_->crew.close(), team_->stands_by = false;
  team_->arena.execute([this] { team_->helpers.wait(); });
}

void Workers::run(std::size_t n, std::size_t grain, Call call, void* context) {
  if (!team_ || n <= grain) {
    if (n > 0) call(context, 0, n);
    return;
  }
  if (team_->stands_by) return team_->crew.run(n, grain, call, context);
  team_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                      [&](const auto& range) { call(context, range.begin(), range.end()); });
  });
}

}  // namespace throng
