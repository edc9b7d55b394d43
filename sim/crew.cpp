// SPDX-License-Identifier: MIT
#include "sim/crew.h"

#include <algorithm>
#include <thread>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace throng {

namespace {

constexpr int kPatience = 20'000;  // looks, some hundred microseconds: then others may have the core
constexpr std::size_t kMostRanges = 0xffff;

/// Waits for a moment, longer once it has often been called for one thing.
class Pause {
 public:
  void operator()() {
    if (++looks_ > kPatience) return std::this_thread::yield();
#if defined(__x86_64__)
    _mm_pause();
#endif
  }

 private:
  int looks_ = 0;
};

}  // namespace

Crew::Crew(std::size_t threads) : threads_(threads), shares_(std::make_unique<Share[]>(threads)) {}

void Crew::stand_by(std::size_t helper) {
  std::uint32_t seen = round_.load(std::memory_order_acquire);
  take(seen, helper);
  for (Pause pause; open_.load(std::memory_order_acquire); pause()) {
    const std::uint32_t round = round_.load(std::memory_order_acquire);
    if (round == seen) continue;
    seen = round, pause = Pause();
    take(round, helper);
  }
}

void Crew::run(std::size_t n, std::size_t grain, Call call, void* context) {
  if (n == 0) return;
  grain = std::max(grain, n / kMostRanges + 1);
  const std::size_t ranges = (n + grain - 1) / grain;
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  loop_ = {n, grain, call, context};
  done_.store(0, std::memory_order_relaxed);
  for (std::size_t i = 0; i < threads_; ++i)
    shares_[i].word.store(
        std::uint64_t{round} << 32 | (ranges * (i + 1) / threads_) << 16 | ranges * i / threads_,
        std::memory_order_release);
  round_.store(round, std::memory_order_release);
  take(round, 0);
  for (Pause pause; done_.load(std::memory_order_acquire) != ranges;) pause();
  if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
}

/// Its own share, then what is left of the others'.
void Crew::take(std::uint32_t round, std::size_t helper) {
  std::size_t range = 0;
  for (std::size_t i = 0; i < threads_; ++i)
    while (claim(shares_[(helper + i) % threads_], round, range)) do_range(range);
}

/// Who has claimed a range may read the loop: it isn't over before the range is done. Whoever comes late
/// finds another round and claims nothing.
bool Crew::claim(Share& share, std::uint32_t round, std::size_t& range) {
  std::uint64_t word = share.word.load(std::memory_order_acquire);
  while (word >> 32 == round && (word & 0xffff) < (word >> 16 & 0xffff)) {
    range = word & 0xffff;
    if (share.word.compare_exchange_weak(word, word + 1, std::memory_order_acq_rel)) return true;
  }
  return false;
}

void Crew::do_range(std::size_t range) {
  const std::size_t begin = range * loop_.grain;
  try {
    loop_.call(loop_.context, begin, std::min(begin + loop_.grain, loop_.n));
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!thrown_ || range < thrown_at_) thrown_ = std::current_exception(), thrown_at_ = range;
  }
  done_.fetch_add(1, std::memory_order_release);
}

}  // namespace throng
