// SPDX-License-Identifier: MIT
#include "sim/workers.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace throng {

namespace {
constexpr std::size_t kGrain = 512;  // rounds a range: enough work to pay for handing it over
}

struct Workers::Arena {
  explicit Arena(int threads)
      : control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
        arena(threads) {}
  tbb::global_control control;
  tbb::task_arena arena;
};

Workers::Workers(int threads) : arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}
Workers::~Workers() = default;

void Workers::run(std::size_t n, Call call, void* context) {
  if (!arena_ || n <= kGrain) return call(context, 0, n);
  arena_->arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kGrain),
                      [&](const auto& range) { call(context, range.begin(), range.end()); });
  });
}

void Workers::run_few(std::size_t n, Call call, void* context) {
  const auto all = [&](std::size_t begin, std::size_t end) {
    for (; begin < end; ++begin) call(context, begin, begin + 1);
  };
  if (!arena_ || n < 2) return all(0, n);
  arena_->arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, n, 1), [&](const auto& range) { all(range.begin(), range.end()); },
        tbb::static_partitioner());
  });
}

}  // namespace throng
