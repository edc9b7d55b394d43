// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>

namespace throng {

/// Threads that stand by for short loops: one begins on all of them within a microsecond. Whoever is late, or
/// not there at all, is not waited for: the others do its share. While they stand by they spin.
class Crew {
 public:
  using Call = void (*)(void* context, std::size_t begin, std::size_t end);

  /// Expects threads >= 1, the caller of run() among them.
  explicit Crew(std::size_t threads);

  /// Between these two helpers may come, and run() may call on them. All must have left before the next
  /// open().
  void open() { open_.store(true, std::memory_order_release); }
  void close() { open_.store(false, std::memory_order_release); }

  /// A helper's life: returns once the crew is closed. Expects 1 <= helper < threads, each once.
  void stand_by(std::size_t helper);

  /// Calls call(context, begin, end) for ranges of `grain` rounds, more where there are millions, that cover
  /// 0 to n, and returns once all are done. A thread begins with the same part of them each time. Rethrows
  /// what the lowest range threw, of those that threw.
  void run(std::size_t n, std::size_t grain, Call call, void* context);

 private:
  struct alignas(64) Share {
    std::atomic<std::uint64_t> word{0};  // round << 32 | end << 16 | next, of ranges
  };
  struct Loop {
    std::size_t n, grain;
    Call call;
    void* context;
  };

  void take(std::uint32_t round, std::size_t helper);
  bool claim(Share& share, std::uint32_t round, std::size_t& range);
  void do_range(std::size_t range);

  const std::size_t threads_;
  std::unique_ptr<Share[]> shares_;  // of each thread
  Loop loop_{};                      // of the present round
  alignas(64) std::atomic<std::uint32_t> round_{0};
  std::atomic<bool> open_{false};
  alignas(64) std::atomic<std::size_t> done_{0};  // ranges
  std::mutex mutex_;                              // of what follows
  std::exception_ptr thrown_;
  std::size_t thrown_at_ = 0;  // range
};

}  // namespace throng
