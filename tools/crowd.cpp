// SPDX-License-Identifier: MIT
#include "tools/crowd.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "sim/input_error.h"
#include "sim/periodic.h"
#include "sim/recording/recording.h"
#include "tools/frame_at.h"
#include "tools/printable.h"
#include "tools/scenario.h"

namespace throng::tools {

namespace {

constexpr double kFarthestBody = 1e150;  // m; squared distances stay finite

bool is_recording(const std::string& file) {
  char signature[8] = {};
  std::ifstream(file, std::ios::binary).read(signature, sizeof signature);
  return std::string(signature, sizeof signature) == "\x89HDF\r\n\x1a\n" || file.ends_with(".h5") ||
         file.ends_with(".h5.part");
}

/// A scenario as it starts.
CrowdSnapshot crowd_of_scenario(const std::string& source, std::optional<double> at, Scene& scene) {
  if (at.value_or(0.0) != 0.0)
    throw InputError(
        source +
        ": a scenario is asked at its start, --at 0; for later times record a run with 'throng run " +
        source + " -o FILE.h5' and ask the recording");
  scene = load_or_throw(source).scene;
  CrowdSnapshot crowd;
  State state = initial_state(scene);
  crowd.id = std::move(state.id);
  crowd.position = std::move(state.position), crowd.velocity = std::move(state.velocity);
  crowd.angle = std::move(state.angle);
  crowd.body = crowd.id;
  crowd.bodies_of_run = crowd.id.size();
  return crowd;
}

/// Those whom the frame does not hold go, of `rows` as of the frame.
void leave_present(Frame& frame, std::vector<std::uint32_t>& rows) {
  const auto keep = [&](auto& all) {
    std::size_t row = 0;
    std::erase_if(all, [&](const auto&) { return !frame.has(row++); });
  };
  keep(frame.position), keep(frame.velocity), keep(frame.angle), keep(frame.id), keep(rows);
}

/// Why a frame lacks a field, and when the next one has it that has positions too; "" where it doesn't.
std::string absence(const Recording& recording, RecordField field, std::size_t frame) {
  const int rate = every(recording.geometry().record, field);
  if (rate == 0) return "were not recorded (record.fields)";
  if (recording.sample(field, frame)) return "";
  const std::string when = "are not in this frame; recorded each " + std::to_string(rate) + " steps, ";
  const auto at = [&](const char* word, std::size_t i) {
    return when + word + " at " + text_of(rounded(recording.times()[i])) + " s";
  };
  for (std::size_t i = frame + 1; i < recording.frames(); ++i)
    if (recording.sample(field, i)) return at("next", i);
  for (std::size_t i = frame; i-- > 0;)
    if (recording.sample(field, i)) return at("last", i);
  return when + "never with positions";
}

/// The frame nearest to the time that is asked for, else the last one; says on stderr which.
CrowdSnapshot crowd_of_recording(const std::string& source, std::optional<double> wanted, Scene& scene) {
  const Recording recording(source, FrameChoice::with_position);
  if (recording.frames() == 0) throw InputError(source + ": holds no frame yet");
  const std::size_t index = frame_at_or_throw(recording, source, wanted);
  Frame frame = recording.frame(index);
  if (frame.position.size() != frame.id.size())
    throw InputError(source + ": positions were not recorded (record.fields)");
  std::vector<std::uint32_t> body(frame.id.size()), recorded = frame.id;
  std::iota(body.begin(), body.end(), 1u);
  leave_present(frame, body);
  scene = recording.geometry();
  std::fprintf(stderr, "throng: %s: frame %zu (of 0 to %zu), at %s s\n", source.c_str(),
               recording.frame_of_file(index), recording.frames_of_file() - 1,
               text_of(rounded(recording.times()[index])).c_str());
  return {.id = std::move(frame.id),
          .position = std::move(frame.position),
          .velocity = std::move(frame.velocity),
          .angle = std::move(frame.angle),
          .no_velocity = absence(recording, RecordField::velocity, index),
          .no_angle = absence(recording, RecordField::angle, index),
          .time = frame.time,
          .period = {},
          .scene = {},
          .body = std::move(body),
          .recorded = std::move(recorded),
          .bodies_of_run = recording.bodies_of_run()};
}

}  // namespace

CrowdSnapshot read_crowd(const std::string& source, std::optional<double> at) {
  Scene scene;
  CrowdSnapshot crowd =
      is_recording(source) ? crowd_of_recording(source, at, scene) : crowd_of_scenario(source, at, scene);
  if (scene.domain.kind == DomainKind::periodic)
    crowd.period = {scene.domain.min, scene.domain.max - scene.domain.min};
  crowd.scene = std::move(scene);
  for (std::size_t row = 0; row < crowd.id.size(); ++row) {
    if (!crowd.position[row].allFinite() || crowd.position[row].cwiseAbs().maxCoeff() > kFarthestBody)
      throw InputError(source + ": body " + std::to_string(crowd.id[row]) +
                       " has no position within 1e150 m of the origin");
    if (crowd.period) crowd.position[row] = wrapped(crowd.position[row], crowd.scene.domain);
  }
  return crowd;
}

namespace {

/// Why nobody in a crowd has the id.
std::string why_absent(const CrowdSnapshot& crowd, std::int64_t id) {
  const std::string it = "no body has the id " + std::to_string(id);
  if (crowd.bodies_of_run == 0) return it + ": there are none";
  if (id < 1 || id > static_cast<std::int64_t>(crowd.bodies_of_run))
    return it + "; ids go from 1 to " + std::to_string(crowd.bodies_of_run);
  const std::string body = "body " + std::to_string(id) + " is ";
  if (!std::ranges::binary_search(crowd.recorded, id)) return body + "not recorded (record.of)";
  return body + "not there at " + text_of(rounded(crowd.time)) + " s";
}

}  // namespace

std::uint32_t row_of(const CrowdSnapshot& crowd, std::int64_t id, const std::string& source) {
  const auto found = std::ranges::find_if(crowd.id, [id](std::uint32_t other) { return other == id; });
  if (found == crowd.id.end()) throw InputError(source + ": " + why_absent(crowd, id));
  return static_cast<std::uint32_t>(found - crowd.id.begin());
}

}  // namespace throng::tools
