// SPDX-License-Identifier: MIT
#include "broadphase/team.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>

namespace throng::broadphase {

struct Team::Arena {
  explicit Arena(std::size_t threads) : arena(static_cast<int>(threads)) {
    if (threads > static_cast<std::size_t>(tbb::info::default_concurrency()))
      more.emplace(tbb::global_control::max_allowed_parallelism, threads);
  }

  template <class Partitioner>
  void run(std::size_t n, Call call, void* context, const Partitioner& partitioner) {
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, n, 1),
          [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) call(context, i);
          },
          partitioner);
    });
  }

  std::optional<tbb::global_control> more;  // than there are cores to run on
  tbb::task_arena arena;
};

Team::Team(int threads)
    : threads_(static_cast<std::size_t>(threads)),
      arena_(threads > 1 ? std::make_unique<Arena>(threads_) : nullptr) {}
Team::~Team() = default;

void Team::run(std::size_t n, Call call, void* context) {
  if (arena_ && n > 1) return arena_->run(n, call, context, tbb::simple_partitioner());
  for (std::size_t i = 0; i < n; ++i) call(context, i);
}

void Team::run_few(std::size_t n, Call call, void* context) {
  if (arena_ && n > 1) return arena_->run(n, call, context, tbb::static_partitioner());
  for (std::size_t i = 0; i < n; ++i) call(context, i);
}

}  // namespace throng::broadphase
