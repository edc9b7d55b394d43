// SPDX-License-Identifier: MIT
#include "tools/verify.h"

#include <bit>
#include <cinttypes>
#include <cstdio>
#include <optional>

#include "scenarios/load.h"
#include "sim/input_error.h"
#include "sim/recording/build_info.h"
#include "sim/simulation.h"

namespace throng::tools {

namespace {

/// Where a frame first differs from the state of the same step.
struct Difference {
  std::uint32_t id;
  const char* field;
  double recorded, computed;
};

/// A number as the file can hold it.
double stored(double x, bool single) {
  return single ? static_cast<double>(static_cast<float>(x)) : x;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a + 0.0) == std::bit_cast<std::uint64_t>(b + 0.0);
}

std::optional<Difference> first_difference(const Frame& frame, const State& state, bool single) {
  for (std::size_t row = 0; row < state.id.size(); ++row) {
    const std::uint32_t id = state.id[row];
    std::optional<Difference> found;
    const auto compare = [&](const char* field, double recorded, double computed) {
      if (!found && !same_bits(recorded, stored(computed, single)))
        found = Difference{id, field, recorded, computed};
    };
    const std::size_t at = id - 1;
    for (int axis = 0; axis < 2; ++axis) {
      constexpr const char* positions[] = {"position x", "position y"};
      constexpr const char* velocities[] = {"velocity x", "velocity y"};
      if (!frame.position.empty())
        compare(positions[axis], frame.position[at][axis], state.position[row][axis]);
      if (!frame.velocity.empty())
        compare(velocities[axis], frame.velocity[at][axis], state.velocity[row][axis]);
    }
    if (!frame.angle.empty()) compare("angle", frame.angle[at], state.angle[row]);
    if (!frame.spin.empty()) compare("spin", frame.spin[at], state.spin[row]);
    if (found) return found;
  }
  return std::nullopt;
}

Loaded load_embedded(const Recording& recording, const std::string& file) {
  const std::string name = file + ":scenario";
  Loaded loaded = load_scenario_text(recording.origin().provenance.resolved, name);
  if (loaded.errors() > 0)
    throw InputError(file + " holds a scenario that this throng cannot run:\n" +
                     to_string(loaded.diagnostics, name));
  if (loaded.scene.bodies.size() != recording.bodies())
    throw InputError(file + " is inconsistent: its scenario makes " +
                     std::to_string(loaded.scene.bodies.size()) + " bodies, its frames hold " +
                     std::to_string(recording.bodies()));
  if (!same_bits(loaded.scene.time.dt, recording.geometry().time.dt))
    throw InputError(file + " is inconsistent: its scenario has other steps than its frames");
  const std::int64_t steps = loaded.scene.time.steps();
  if (recording.frames() > 0 && recording.steps().back() > steps)
    throw InputError(file + " is inconsistent: its scenario ends with step " + std::to_string(steps) +
                     ", its frames with step " + std::to_string(recording.steps().back()));
  return loaded;
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

}  // namespace

int verify(const Recording& recording, const std::string& file, int threads) {
  warn_of_other_version(recording.origin());
  const Loaded loaded = load_embedded(recording, file);
  const bool hashes = compares_hashes(recording.origin());
  const auto run = simulation(loaded.scene, threads);
  Frame frame;
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    recording.read(i, frame);
    while (run->state().step < frame.step) run->step();
    const std::optional<Difference> difference =
        first_difference(frame, run->state(), recording.geometry().record.single);
    if (difference || (hashes && hash(run->state()) != frame.state_hash)) {
      report(frame, run->state(), difference);
      return 1;
    }
  }
  std::printf("verified: %zu frames%s\n", recording.frames(),
              recording.complete() ? "" : " of a run that did not end");
  return 0;
}

}  // namespace throng::tools
