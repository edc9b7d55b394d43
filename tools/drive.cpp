// SPDX-License-Identifier: MIT
#include "tools/drive.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <csignal>
#include <cstdio>

#include "sim/auto_time.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "tools/summary.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;

volatile std::sig_atomic_t stop_signal = 0;

/// Says when the next checkpoint is due.
class CheckpointClock {
 public:
  explicit CheckpointClock(std::optional<double> every) : every_(every) {}

  bool is_due() {
    if (!every_) return false;
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - last_).count() < *every_) return false;
    last_ = now;
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::optional<double> every_;
  Clock::time_point last_ = Clock::now();
};

/// Adds frames to the recording, or holds them against those that it has.
class FrameSink {
 public:
  FrameSink(Recorder* recorder, const Record& record, const RecordedFrames& recorded, std::int64_t first)
      : recorder_(recorder), record_(record), recorded_(recorded) {
    next_ = std::lower_bound(recorded.steps.begin(), recorded.steps.end(), first) - recorded.steps.begin();
  }

  /// Takes the state that the simulation has, where a frame is due.
  void take(const Simulation& simulation) {
    const State& state = simulation.state();
    if (!recorder_ || !is_frame(record_, state.step)) return;
    if (next_ < recorded_.steps.size()) return compare(state);
    contacts_.clear();
    if (wants_contacts(state.step)) simulation.list_contacts(contacts_);
    recorder_->record(state, contacts_, simulation.sensed());
  }

 private:
  bool wants_contacts(std::int64_t step) const {
    return is_due(every(record_, RecordField::contacts), step) || is_due(record_.observables, step);
  }

  void compare(const State& state) {
    const std::uint64_t now = hash(state), then = recorded_.state_hashes[next_];
    if (state.step != recorded_.steps[next_] || now != then) fail(state, now, then);
    ++next_;
  }

  [[noreturn]] static void fail(const State& state, std::uint64_t now, std::uint64_t then) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "step %" PRId64 " gives another state (hash %016" PRIx64
                  ") than the recording has (%016" PRIx64
                  "): this throng computes otherwise than the one that "
                  "recorded; nothing was added",
                  state.step, now, then);
    throw SimulationError(text);
  }

  Recorder* recorder_;
  const Record& record_;
  std::vector<ContactRow> contacts_;
  const RecordedFrames& recorded_;
  std::size_t next_ = 0;
};

/// Steps until the end or a signal. Returns the timings.
RunTimes advance(Simulation& simulation, const Scene& scene, const DriveOptions& options, Recorder* recorder,
                 FrameSink& frames, Progress& progress) {
  RunTimes times;
  CheckpointClock clock(options.checkpoint);
  const std::int64_t steps = scene.time.steps();
  const State& state = simulation.state();
  frames.take(simulation);
  simulation.heed(stop_requested);
  try {
    while (state.step < steps && !stop_signal) {
      times.begin_step();
      simulation.step();
      times.end_step();
      frames.take(simulation);
      if (recorder && clock.is_due()) recorder->checkpoint(state);
      progress.update(state.step);
    }
  } catch (const Interrupted&) {  // by a signal, within a step
  }
  return times;
}

void report_stop(const Recorder* recorder, const Scene& scene, const State& state) {
  std::fprintf(stderr, "throng: stopped by a signal after step %" PRId64 " of %" PRId64, state.step,
               scene.time.steps());
  if (recorder)
    std::fprintf(stderr, "; %s holds the frames so far, closed and readable; 'throng resume %s' goes on",
                 recorder->part().c_str(), recorder->path().c_str());
  std::fputc('\n', stderr);
}

}  // namespace

void add_drive_options(CLI::App& command, DriveOptions& options) {
  command.add_option("--threads", options.threads, "threads; the result doesn't depend on it")
      ->transform(whole_number(1, 256));
  command
      .add_option("--checkpoint", options.checkpoint,
                  "a checkpoint in OUT.h5.ckpt each so many seconds of wall time, and at the end")
      ->check(real_number(kShortestCheckpoint, kLongestCheckpoint));
  command.add_option("--progress", options.progress, "auto, plain, json or none")
      ->check(CLI::IsMember({"auto", "plain", "json", "none"}));
}

void stop_on_signals() {
  struct sigaction action = {};
  action.sa_handler = [](int) { stop_signal = 1; };
  action.sa_flags = SA_RESTART;
  for (int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

bool stop_requested() {
  return stop_signal != 0;
}

void warn_of_room(const std::string& output, const Scene& scene, const Provenance& provenance) {
  if (const std::string doubt = Recorder::doubt(output, scene, provenance); !doubt.empty())
    std::fprintf(stderr, "throng: warning: %s; where the disk is full the run stops\n", doubt.c_str());
}

void warn_of_checkpoints(const DriveOptions& options, const Scene& scene) {
  if (!options.checkpoint || scene.engine == Engine::native) return;
  std::fprintf(
      stderr,
      "throng: warning: nothing goes on from checkpoints of engine %s: 'throng resume' computes again "
      "from the start, and only checks by them\n",
      engine_name(scene.engine));
}

void warn_of_last_state(const Scene& scene) {
  const std::int64_t steps = scene.time.steps();
  std::int64_t last = 0;
  for (const int rate : rates(scene.record)) last = std::max(last, steps / rate * rate);
  if (last == steps) return;
  std::fprintf(stderr,
               "throng: warning: the last frame is of step %" PRId64 " of %" PRId64
               ": no rate of the recording divides the run\n",
               last, steps);
}

void warn_of_threads(const DriveOptions& options, const Scene& scene) {
  if (options.threads == 1) return;
  if (scene.engine != Engine::native)
    std::fprintf(stderr, "throng: warning: --threads has no meaning: engine %s computes on one thread\n",
                 engine_name(scene.engine));
  else if (is_soft(scene.contact))
    std::fputs("throng: warning: --threads has no meaning: soft contacts are computed on one thread\n",
               stderr);
}

void say_promise(const Scene& scene) {
  if (!(scene.time.error > 0.0)) return;
  const AutoTime chosen = auto_time(scene);
  std::fprintf(stderr, "throng: steps of %g s chosen for an error of %g: %s; %s\n", scene.time.dt,
               scene.time.error, chosen.promise.c_str(), chosen.why.c_str());
}

int drive(Simulation& simulation, const Scene& scene, const DriveOptions& options, Recorder* recorder,
          const RecordedFrames& recorded) {
  const State& state = simulation.state();
  FrameSink frames(recorder, scene.record, recorded, state.step);
  Progress progress(Progress::style(options.progress), scene.time.steps(), scene.time.dt, state.step);
  RunTimes times;
  try {
    times = advance(simulation, scene, options, recorder, frames, progress);
  } catch (const SimulationError&) {
    progress.finish(state.step);
    throw;
  }
  progress.finish(state.step);
  const bool stopped = state.step < scene.time.steps();
  if (recorder && (stopped || options.checkpoint || options.checkpoint_at_end)) recorder->checkpoint(state);
  if (recorder) stopped ? recorder->stop() : recorder->finish(state.crowd);
  if (stopped) report_stop(recorder, scene, state);
  const std::string output = !recorder ? "" : stopped ? recorder->part() : recorder->path();
  print(summary(scene, simulation, times, output));
  return stopped ? 130 : 0;
}

}  // namespace throng::tools
