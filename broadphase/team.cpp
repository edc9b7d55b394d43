// SPDX-License-Identifier: MIT
#include "broadphase/team.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace throng::broadphase {

struct Team::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

Team::Team(int threads)
    : threads_(static_cast<std::size_t>(threads)),
      arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}
Team::~Team() = default;

void Team::run(std::size_t n, Call call, void* context) {
  if (!arena_ || n < 2) {
    for (std::size_t i = 0; i < n; ++i) call(context, i);
    return;
  }
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, 1),
        [&](const auto& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) call(context, i);
        },
        tbb::simple_partitioner());
  });
}

}  // namespace throng::broadphase
