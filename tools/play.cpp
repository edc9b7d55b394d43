// SPDX-License-Identifier: MIT
#include "tools/play.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>

#include "sim/observe.h"
#include "tools/dots.h"
#include "tools/drive.h"
#include "tools/printable.h"
#include "tools/screen.h"
#include "tools/terminal.h"
#include "tools/view.h"

namespace throng::tools {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr Seconds kRest{0.04};  // at least, from one picture to the next
constexpr Seconds kNap{0.1};    // at most, without a look at the clock and the terminal
constexpr std::uint8_t kFaint = 245;

template <class... Arguments>
std::string text(const char* format, Arguments... arguments) {
  char line[256];
  std::snprintf(line, sizeof line, format, arguments...);
  return line;
}

bool are_all_discs(const Scene& scene) {
  return std::ranges::all_of(scene.shapes, [](const Shape& shape) { return shape.kind == ShapeKind::disc; });
}

/// Energy and overlap, as far as what was recorded tells them.
std::string measures(const Scene& scene, const Frame& frame) {
  State state = initial_state(scene);
  state.position = frame.position;
  if (!frame.angle.empty()) state.angle = frame.angle;
  if (!frame.velocity.empty()) state.velocity = frame.velocity;
  if (!frame.spin.empty()) state.spin = frame.spin;
  std::string line = counted_bodies(frame.position.size());
  if (!frame.velocity.empty())
    line +=
        text("   kinetic %.4g J%s", kinetic_energy(scene, state), frame.spin.empty() ? " without spin" : "");
  if (frame.angle.empty() && !are_all_discs(scene)) return line;
  return line + text("   deepest overlap %.3g m", overlap(scene, state).max);
}

std::string bar(double fraction, int cells) {
  std::string line;
  for (int i = 0; i < cells; ++i) line += i < fraction * cells ? "=" : "-";
  return line;
}

/// What is played, and how it looks.
class Show {
 public:
  Show(const Recording& recording, double speed)
      : recording_(recording), view_(view_of(recording)), speed_(speed), first_(recording.times().front()) {}

  /// The last frame whose time has come `elapsed` s after the beginning.
  std::size_t frame_at(double elapsed) const {
    const auto times = recording_.times();
    const auto next = std::upper_bound(times.begin(), times.end(), first_ + speed_ * elapsed);
    return next == times.begin() ? 0 : static_cast<std::size_t>(next - times.begin()) - 1;
  }

  /// s after the beginning.
  double due(std::size_t i) const { return (recording_.times()[i] - first_) / speed_; }

  Screen picture(std::size_t i, const Terminal::Size& size) {
    recording_.read(i, frame_);
    const Scene& scene = recording_.geometry();
    Screen screen(size.columns, size.rows);
    const double last = recording_.times().back();
    const std::string time = text("t = %.3f s of %.3f s  x%g", frame_.time, last, speed_);
    screen.put(0, 0, scene.name);
    screen.put(std::max(0, size.columns - width(time)), 0, time);
    draw_dots(screen, {0, 1, size.columns, size.rows - 2}, scene, view_, frame_);
    const int end = screen.put(0, size.rows - 1, measures(scene, frame_)) + 3;
    const double fraction = last > first_ ? (frame_.time - first_) / (last - first_) : 1.0;
    screen.put(end, size.rows - 1, bar(fraction, std::min(30, size.columns - end)), kFaint);
    return screen;
  }

 private:
  const Recording& recording_;
  View view_;
  double speed_, first_;
  Frame frame_;
};

/// Shows frame after frame until the last, or a signal. Returns what is shown then.
Screen run(Show& show, std::size_t last, Terminal& terminal) {
  const Clock::time_point begin = Clock::now();
  const auto elapsed = [&] { return Seconds(Clock::now() - begin).count(); };
  Screen shown;
  std::optional<std::size_t> frame;
  Terminal::Size size{};
  while (!stop_requested()) {
    const double now = elapsed();
    const std::size_t i = show.frame_at(now);
    const bool afresh = terminal.was_cleared() || terminal.size() != size;
    if (i != frame || afresh) {
      size = terminal.size();
      const Screen next = show.picture(i, size);
      terminal.write(next.update(afresh ? Screen() : shown));
      shown = next;
      frame = i;
    }
    if (i == last) break;
    const double rest = std::max(show.due(i + 1), now + kRest.count()) - elapsed();
    std::this_thread::sleep_for(std::min(Seconds(std::max(0.0, rest)), kNap));
  }
  return shown;
}

}  // namespace

int play(const Recording& recording, double speed) {
  stop_on_signals();
  Screen last;
  {
    Terminal terminal("--speed");
    Show show(recording, speed);
    last = run(show, recording.frames() - 1, terminal);
  }
  std::fputs(last.lines().c_str(), stdout);
  return stop_requested() ? 130 : 0;
}

}  // namespace throng::tools
