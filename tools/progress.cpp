// SPDX-License-Identifier: MIT
#include "tools/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/seconds.h"

namespace throng::tools {

namespace {

constexpr std::chrono::milliseconds kBarPeriod{100}, kLinePeriod{3000};

std::string bar(double fraction) {
  constexpr int kWidth = 30;
  const int full = static_cast<int>(fraction * kWidth);
  std::string text;
  for (int i = 0; i < kWidth; ++i) text += i < full ? "█" : "░";
  return text;
}

}  // namespace

Progress::Style Progress::style(const std::string& name) {
  if (name == "plain") return Style::plain;
  if (name == "json") return Style::json;
  if (name == "none") return Style::none;
  return isatty(STDERR_FILENO) ? Style::bar : Style::plain;
}

Progress::Progress(Style style, std::int64_t steps, double dt, std::int64_t first, const char* step)
    : style_(style), steps_(steps), first_(first), dt_(dt), name_(step) {
  next_ = begin_ + (style == Style::bar ? kBarPeriod : kLinePeriod);
}

void Progress::clear() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
  shown_ = false;
}

void Progress::update(std::int64_t step) {
  if (style_ == Style::none) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + (style_ == Style::bar ? kBarPeriod : kLinePeriod);
  print(step, seconds(now - begin_));
}

void Progress::finish(std::int64_t step) {
  clear();
  if (style_ != Style::none && style_ != Style::bar) print(step, seconds(Clock::now() - begin_));
}

void Progress::print(std::int64_t step, double elapsed) {
  const double rate = static_cast<double>(step - first_) / std::max(elapsed, 1e-9);
  const double left = rate > 0.0 ? static_cast<double>(steps_ - step) / rate : 0.0;
  const double fraction = steps_ > 0 ? static_cast<double>(step) / static_cast<double>(steps_) : 1.0;
  const double time = static_cast<double>(step) * dt_;
  const auto at = static_cast<long long>(step), all = static_cast<long long>(steps_);
  shown_ = style_ == Style::bar;
  if (style_ == Style::bar)
    std::fprintf(stderr, "\r\033[K%s %3.0f %%  t = %.2f s  %.0f %ss/s  %.0f s left", bar(fraction).c_str(),
                 100.0 * fraction, time, rate, name_, left);
  else if (style_ == Style::json)
    std::fprintf(
        stderr,
        "{\"step\": %lld, \"steps\": %lld, \"time\": %.9g, \"steps_per_s\": %.1f, \"left_s\": %.1f}\n", at,
        all, time, rate, left);
  else
    std::fprintf(stderr, "%s %lld of %lld  t = %.2f s  %.0f %ss/s  %.0f s left\n", name_, at, all, time, rate,
                 name_, left);
}

}  // namespace throng::tools
