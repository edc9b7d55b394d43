// SPDX-License-Identifier: MIT
#include "tools/play.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

#include "sim/observe.h"
#include "tools/dots.h"
#include "tools/drive.h"
#include "tools/keys.h"
#include "tools/playhead.h"
#include "tools/screen.h"
#include "tools/terminal.h"
#include "tools/view.h"

namespace throng::tools {

namespace {

constexpr double kRest = 0.04;  // s at least, from one picture to the next
constexpr double kNap = 0.1;    // s at most, without a look at the clock and the terminal
constexpr std::uint8_t kBarColour = 245;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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
  std::string line = who_is_there(scene.bodies, frame);
  if (!frame.is_present.empty()) return line;
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

/// What is played, and how it looks. Times are from the first frame on.
class Show {
 public:
  explicit Show(const Recording& recording)
      : recording_(recording), view_(view_of(recording)), first_(recording.times().front()) {}

  std::size_t last() const { return recording_.frames() - 1; }
  double time(std::size_t i) const { return recording_.times()[i] - first_; }  ///< s

  /// The last frame that is not after `time` (s).
  std::size_t frame_at(double time) const {
    const auto times = recording_.times();
    const auto next = std::upper_bound(times.begin(), times.end(), first_ + time);
    return next == times.begin() ? 0 : static_cast<std::size_t>(next - times.begin()) - 1;
  }

  Screen picture(std::size_t i, const Playhead& head, const Terminal::Size& size) {
    recording_.read(i, frame_);
    const Scene& scene = recording_.geometry();
    Screen screen(size.columns, size.rows);
    const double last = recording_.times().back();
    const std::string time = text("%st = %.3f s of %.3f s  x%g", head.paused() ? "paused   " : "",
                                  frame_.time, last, head.speed());
    screen.put(0, 0, scene.name);
    screen.put(std::max(0, size.columns - width(time)), 0, time);
    const int end = screen.put(0, size.rows - 1, measures(scene, frame_)) + 3;
    recording_.carry_angles(i, frame_);  // to be seen, not to be measured
    draw_dots(screen, {0, 1, size.columns, size.rows - 2}, scene, view_, frame_);
    const double fraction = last > first_ ? (frame_.time - first_) / (last - first_) : 1.0;
    screen.put(end, size.rows - 1, bar(fraction, std::min(30, size.columns - end)), kBarColour);
    return screen;
  }

 private:
  const Recording& recording_;
  View view_;
  double first_;
  Frame frame_;
};

/// A twentieth of the recording that way, or a frame of one that is paused.
void seek(int direction, const Show& show, Playhead& head, double now) {
  const double here = head.time(now);
  const auto frame = static_cast<std::ptrdiff_t>(show.frame_at(here)) + direction;
  const auto next = std::clamp<std::ptrdiff_t>(frame, 0, static_cast<std::ptrdiff_t>(show.last()));
  head.go_to(head.paused() ? show.time(next) : here + direction * show.time(show.last()) / 20.0, now);
}

/// Returns false where the key ends it.
bool obey(Key key, const Show& show, Playhead& head, double now) {
  if (key == Key::pause) head.pause_or_go_on(now);
  if (key == Key::faster) head.speed_up(2.0, now);
  if (key == Key::slower) head.speed_up(0.5, now);
  if (key == Key::forward) seek(1, show, head, now);
  if (key == Key::back) seek(-1, show, head, now);
  return key != Key::quit;
}

/// Waits until the next picture is due, or somebody types. Returns false where that ends it.
bool wait(const Show& show, Playhead& head, std::size_t shown, double now, Terminal& terminal,
          std::string& typed) {
  double rest = kNap;
  if (!head.paused() && shown < show.last())
    rest = std::max(head.when(show.time(shown + 1)) - now, kRest - (seconds_now() - now));
  typed += terminal.typed(std::min(rest, kNap));
  for (Key key; (key = next_key(typed)) != Key::none;)
    if (!obey(key, show, head, seconds_now())) return false;
  return true;
}

/// Shows frame after frame until the last, q, or a signal. Returns what is shown then.
Screen run(Show& show, double speed, Terminal& terminal) {
  Playhead head(show.time(show.last()), speed, seconds_now());
  Screen shown;
  std::string typed;
  std::optional<std::pair<std::size_t, std::string>> state;  // that is shown
  Terminal::Size size{};
  while (!stop_requested()) {
    const double now = seconds_now();
    const std::size_t i = show.frame_at(head.time(now));
    const std::pair next_state(i, text("%d %g", head.paused(), head.speed()));
    const bool afresh = terminal.was_cleared() || terminal.size() != size;
    if (next_state != state || afresh) {
      size = terminal.size();
      const Screen next = show.picture(i, head, size);
      terminal.write(next.update(afresh ? Screen() : shown));
      shown = next;
      state = next_state;
    }
    if (i == show.last() && !head.paused()) break;
    if (!wait(show, head, i, now, terminal, typed)) break;
  }
  return shown;
}

}  // namespace

int play(const Recording& recording, double speed) {
  stop_on_signals();
  Screen last;
  {
    Terminal terminal("--speed");
    Show show(recording);
    last = run(show, speed, terminal);
  }
  std::fputs(last.lines().c_str(), stdout);
  return stop_requested() ? 130 : 0;
}

}  // namespace throng::tools
