// SPDX-License-Identifier: MIT
#include "tools/verify.h"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cstdio>
#include <optional>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/observe.h"
#include "sim/recording/build_info.h"
#include "sim/recording/packed.h"
#include "sim/recording/selection.h"
#include "sim/simulation.h"
#include "tools/printable.h"
#include "tools/recorded_scenario.h"

namespace throng::tools {

namespace {

/// Where a frame first differs from the state of the same step.
struct Difference {
  std::uint32_t id;
  const char* field;
  double recorded, computed;
};

bool same_value(double a, double b) {
  return std::bit_cast<std::uint64_t>(a + 0.0) == std::bit_cast<std::uint64_t>(b + 0.0);
}

/// Holds frames against states: numbers as the file can hold them.
class Comparison {
 public:
  explicit Comparison(const Scene& scene) : record_(scene.record), selection_(scene) {}

  std::optional<Difference> first_difference(const Frame& frame, const State& state) const {
    if (!has_bodies(record_, frame.step)) return std::nullopt;
    for (std::size_t body = 0; body < state.id.size(); ++body) {
      const std::uint32_t row = selection_.row_of(state.id[body]);
      if (row == recording::Selection::kNone) continue;
      const bool present = selection_.is_within(state.position[body]);
      if (present != frame.has(row))
        return Difference{state.id[body], "presence", double(frame.has(row)), double(present)};
      if (!present) continue;
      if (const auto found = difference(frame, row, state, body)) return found;
    }
    return first_gone(frame, state);
  }

  /// The same contacts in the same order.
  bool same_contacts(const Frame& frame, std::vector<ContactRow>& computed) const {
    if (!frame.contacts) return true;
    std::erase_if(computed, [&](const ContactRow& row) { return !selection_.keeps(row, frame.is_present); });
    return computed == *frame.contacts;
  }

 private:
  /// Of those in the frame whom the state has no more.
  std::optional<Difference> first_gone(const Frame& frame, const State& state) const {
    if (frame.is_present.empty()) return std::nullopt;
    std::vector<std::uint8_t> is_gone = frame.is_present;
    for (const std::uint32_t id : state.id)
      if (const std::uint32_t row = selection_.row_of(id); row != recording::Selection::kNone)
        is_gone[row] = 0;
    const auto first = std::find(is_gone.begin(), is_gone.end(), 1);
    if (first == is_gone.end()) return std::nullopt;
    return Difference{frame.id[static_cast<std::size_t>(first - is_gone.begin())], "presence", 1.0, 0.0};
  }

  std::optional<Difference> difference(const Frame& frame, std::size_t row, const State& state,
                                       std::size_t body) const {
    std::optional<Difference> found;
    const auto compare = [&](const char* field, double recorded, double computed) {
      if (!found && !same_value(recorded, computed))
        found = Difference{state.id[body], field, recorded, computed};
    };
    constexpr const char* positions[] = {"position x", "position y"};
    constexpr const char* velocities[] = {"velocity x", "velocity y"};
    for (int axis = 0; axis < 2; ++axis) {
      if (!frame.position.empty())
        compare(positions[axis], frame.position[row][axis], place(state.position[body][axis]));
      if (!frame.velocity.empty())
        compare(velocities[axis], frame.velocity[row][axis], stored(state.velocity[body][axis]));
    }
    if (!frame.angle.empty()) compare("angle", frame.angle[row], stored(state.angle[body]));
    if (!frame.spin.empty()) compare("spin", frame.spin[row], stored(state.spin[body]));
    return found;
  }

  double stored(double x) const { return record_.single ? static_cast<double>(static_cast<float>(x)) : x; }
  double place(double x) const {
    return record_.quantum > 0.0 ? recording::quantized(x, record_.quantum) * record_.quantum : stored(x);
  }

  const Record& record_;
  recording::Selection selection_;
};

Loaded load_embedded(const Recording& recording, const std::string& file) {
  const std::string name = file + ":scenario";
  Loaded loaded = load_scenario_text(recording.origin().provenance.resolved, name, fields_of_run(recording));
  if (loaded.errors() > 0)
    throw InputError(file + " holds a scenario that this throng cannot run:\n" +
                     to_string(loaded.diagnostics, name));
  expect_scenario(recording, loaded.scene, file);
  const std::int64_t steps = loaded.scene.time.steps();
  if (recording.frames() > 0 && recording.steps().back() > steps)
    throw InputError(file + " is inconsistent: its scenario ends with step " + std::to_string(steps) +
                     ", its frames with step " + std::to_string(recording.steps().back()));
  return loaded;
}

/// What isn't recorded isn't observed: before 1.9 that was no density by Voronoi cells, before 1.11 no more
/// of contacts than the last substep's.
void observe_as_then(int minor, Scene& scene) {
  if (minor < 11) scene.record.contacts = false;
  for (Measure& measure : scene.crowd.measures)
    if (minor < 9) measure.cutoff = 0.0;
}

void warn_of_other_version(const RecordingOrigin& origin) {
  if (origin.version != recording::version_text())
    std::fprintf(stderr, "throng: warning: recorded by throng %s, verified by %s\n", origin.version.c_str(),
                 recording::version_text());
}

/// Whether the file's state hashes are of the kind that this throng computes.
bool compares_hashes(const RecordingOrigin& origin) {
  if (origin.minor >= 1) return true;
  std::fprintf(stderr,
               "throng: warning: recorded with state hashes of an older kind: the recorded fields alone are "
               "compared\n");
  return false;
}

void report(const Frame& frame, const State& state, const std::optional<Difference>& difference) {
  std::printf("diverged: at step %" PRId64 " (t = %.9g s)", frame.step, frame.time);
  if (difference)
    std::printf(": %s of body %" PRIu32 " was recorded as %.17g, runs to %.17g", difference->field,
                difference->id, difference->recorded, difference->computed);
  else
    std::printf(": in a field that the file does not hold");
  std::printf("; state hash %016" PRIx64 ", now %016" PRIx64 "\n", frame.state_hash, hash(state));
}

/// The name of the first recorded sensor that found others; "" where none did.
std::string first_other_sensor(const Frame& frame, const Scene& scene, const Simulation& run) {
  for (std::size_t i = 0; i < frame.sensed.size(); ++i)
    if (frame.sensed[i] && *frame.sensed[i] != run.sensed()[i]) return recorded(scene.sensors)[i].name;
  return "";
}

/// What the run has now; of a crowd only where that was recorded, as it wasn't before 1.5.
Observables observed_as(const Observables& recorded, Observer& observer, const Simulation& run,
                        std::span<const ContactRow> contacts) {
  Observables now = observer.observe(run.state(), contacts);
  if (!recorded.crowd) now.crowd.reset();
  return now;
}

/// What beside the bodies' own fields differs: "" where nothing does.
std::string other_difference(const Comparison& comparison, Observer& observer, const Frame& frame,
                             const Scene& scene, const Simulation& run) {
  if (const std::string sensor = first_other_sensor(frame, scene, run); !sensor.empty())
    return "those whom " + printable(sensor) + " senses";
  if (!frame.contacts && !frame.observables) return "";
  std::vector<ContactRow> contacts;
  run.list_contacts(contacts);
  if (frame.observables && *frame.observables != observed_as(*frame.observables, observer, run, contacts))
    return "the observables";
  return comparison.same_contacts(frame, contacts) ? "" : "the contacts";
}

/// Of a run to its end.
bool same_arrivals(const Recording& recording, const Scene& scene, Simulation& run) {
  const std::optional<Arrivals> recorded = recording.arrivals();
  if (!recorded) return true;
  while (run.state().step < scene.time.steps()) run.step();
  const CrowdState& crowd = run.state().crowd;
  return *recorded == Arrivals{crowd.arrivals, crowd.arrived_id};
}

}  // namespace

int verify(const Recording& recording, const std::string& file, int threads) {
  warn_of_other_version(recording.origin());
  Loaded loaded = load_embedded(recording, file);
  observe_as_then(recording.origin().minor, loaded.scene);
  recording.expect_tables(loaded.scene);
  const bool hashes = compares_hashes(recording.origin());
  const Comparison comparison(loaded.scene);
  Observer observer(loaded.scene);
  const auto run = simulation(loaded.scene, threads);
  Frame frame;
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    recording.read(i, frame);
    while (run->state().step < frame.step) run->step();
    const std::optional<Difference> difference = comparison.first_difference(frame, run->state());
    if (difference || (hashes && hash(run->state()) != frame.state_hash)) {
      report(frame, run->state(), difference);
      return 1;
    }
    if (const std::string what = other_difference(comparison, observer, frame, loaded.scene, *run);
        !what.empty()) {
      std::printf("diverged: at step %" PRId64 " (t = %.9g s): %s were recorded otherwise than they run to\n",
                  frame.step, frame.time, what.c_str());
      return 1;
    }
  }
  if (!same_arrivals(recording, loaded.scene, *run)) {
    std::printf("diverged: who arrived, or when, was recorded otherwise than it runs to\n");
    return 1;
  }
  std::printf("verified: %zu frames%s\n", recording.frames(),
              recording.complete() ? "" : " of a run that did not end");
  return 0;
}

}  // namespace throng::tools
