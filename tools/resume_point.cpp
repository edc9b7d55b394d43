// SPDX-License-Identifier: MIT
#include "tools/resume_point.h"

#include <cstdio>
#include <filesystem>

#include "scenarios/difference.h"
#include "sim/input_error.h"
#include "sim/recording/build_info.h"
#include "sim/recording/frame_hash.h"
#include "tools/printable.h"

namespace throng::tools {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPart = ".part";
constexpr const char* kRemedy =
    "; remove it to go on from the start, or put the recording's own in its place";

bool has_bytes(const std::string& path) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(path, none);
  return !none && size > 0;
}

/// A part that died before its first byte of use leaves the recording that it was to go on with.
Recording open_either(const std::string& output, std::string& source) {
  source = output + std::string(kPart);
  if (!has_bytes(source)) {
    source = output;
    return Recording(output);
  }
  try {
    return Recording(source);
  } catch (const InputError& error) {
    if (!has_bytes(output)) throw;
    std::fprintf(stderr, "throng: warning: %s; going on from %s\n", error.what(), output.c_str());
    source = output;
    return Recording(output);
  }
}

std::size_t sound_frames(const Recording& recording) {
  Frame frame;
  for (std::size_t i = 0; i < recording.frames(); ++i) try {
      recording.read(i, frame);
    } catch (const InputError& error) {
      std::fprintf(stderr, "throng: warning: %s; it and what follows will be computed again\n", error.what());
      return i;
    }
  return recording.frames();
}

void expect_same_version(const std::string& file, const std::string& version) {
  if (version == recording::version_text()) return;
  throw InputError(file + " was written by throng " + version + ", this is " + recording::version_text() +
                   ": going on could give other bits; go on with that version, or run the scenario again");
}

bool are_agents(const Scene& scene) {
  return !scene.bodies.kind.empty() && scene.bodies.kind.back() == BodyKind::agent;
}

/// Whether the checkpoint can be used; throws where it is another run's.
bool belongs(const Checkpoint& checkpoint, const std::string& file, const Kept& kept) {
  const CheckpointOrigin& origin = checkpoint.origin;
  expect_same_version(file, origin.version);
  const std::string& scenario = kept.recording.origin().provenance.resolved;
  if (const auto differ = scenario_difference(origin.scenario, scenario))
    throw InputError(file + " is of another scenario than " + kept.source + ": " + printable(differ->field) +
                     " is " + printable(differ->one) + " in the checkpoint, " + printable(differ->other) +
                     " in the recording" + kRemedy);
  const std::size_t bodies = checkpoint.state.id.size() +
                             static_cast<std::size_t>(checkpoint.state.crowd.arrived) +
                             waiting(checkpoint.state.crowd);
  if (checkpoint.state.crowd.arrived > 0 && !are_agents(kept.recording.geometry()))
    throw InputError(file + " remembers " + std::to_string(checkpoint.state.crowd.arrived) +
                     " arrived, but no agents are recorded in " + kept.source + kRemedy);
  if (bodies != kept.recording.bodies_of_run())
    throw InputError(file + " has " + std::to_string(bodies) + " bodies, " + kept.source + " has " +
                     std::to_string(kept.recording.bodies_of_run()) + kRemedy);
  if (origin.frames > kept.frames) {
    std::fprintf(stderr, "throng: warning: %s follows %llu frames, %s has %zu: it can't be used\n",
                 file.c_str(), static_cast<unsigned long long>(origin.frames), kept.source.c_str(),
                 kept.frames);
    return false;
  }
  if (recording::chain_hash(kept.recording.frame_hashes().first(origin.frames)) != origin.frames_hash)
    throw InputError(file + " belongs to another recording than " + kept.source + ": their first " +
                     std::to_string(origin.frames) + " frames differ" + kRemedy);
  return true;
}

}  // namespace

Kept find_recording(const std::string& name) {
  std::string source, output = name;
  if (output.ends_with(kPart)) output.resize(output.size() - kPart.size());
  Recording recording = open_either(output, source);
  if (recording.running()) throw InputError(source + " is still being written by another run");
  expect_same_version(source, recording.origin().version);
  const std::size_t frames = sound_frames(recording);
  return {output, source, std::move(recording), frames};
}

std::optional<Checkpoint> find_checkpoint(const Kept& kept) {
  for (const std::string& file :
       {recording::checkpoint_path(kept.output), recording::previous_checkpoint_path(kept.output)}) {
    if (!fs::exists(fs::symlink_status(file))) continue;
    std::optional<Checkpoint> checkpoint;
    try {
      checkpoint = recording::read_checkpoint(file);
    } catch (const InputError& error) {
      std::fprintf(stderr, "throng: warning: %s; it can't be used\n", error.what());
      continue;
    }
    if (belongs(*checkpoint, file, kept)) return checkpoint;
  }
  return std::nullopt;
}

}  // namespace throng::tools
