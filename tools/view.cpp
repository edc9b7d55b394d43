// SPDX-License-Identifier: MIT
#include "tools/view.h"

#include <algorithm>

#include "sim/input_error.h"
#include "tools/palette.h"
#include "tools/printable.h"

namespace throng::tools {

namespace {

/// What creeps by less than a millionth of a radius a second stands still: its colours would be those of
/// rounding. `velocities` are those of one frame after the other.
SpeedScale speed_scale(const Scene& scene, std::span<const Vec> velocities) {
  constexpr double kCreeping = 1e-6, kFewFastest = 100.0;
  std::vector<double> speeds;
  double fastest = 0.0, radius = 0.0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const std::size_t row = i % scene.bodies.size();
    const bool moves =
        scene.bodies.kind[row] == BodyKind::dynamic || scene.bodies.kind[row] == BodyKind::agent;
    if (!moves || velocities[i].hasNaN()) continue;
    speeds.push_back(velocities[i].norm());
    fastest = std::max(fastest, speeds.back());
    radius = std::max(radius, scene.bodies.radius[row]);
  }
  if (fastest < kCreeping * radius) return {};
  const double most = top_speed(speeds.data(), static_cast<long>(speeds.size()));
  const double top = std::max(most, fastest / kFewFastest);  // where few move and the others only creep
  return {top, fastest > top};
}

}  // namespace

std::string who_is_there(const Bodies& bodies, const Frame& frame) {
  std::int64_t agents = 0;
  for (std::size_t row = 0; row < bodies.size(); ++row)
    agents += bodies.kind[row] == BodyKind::agent && frame.has(row);
  const std::size_t others = frame.bodies() - static_cast<std::size_t>(agents);
  const bool walked = std::ranges::find(bodies.kind, BodyKind::agent) != bodies.kind.end();
  if (!walked) return counted_bodies(others);
  return (others > 0 ? counted_bodies(others) + ", " : "") + counted(agents, "agent");
}

void expect_drawable(const Recording& recording, const std::string& file) {
  if (recording.frames() == 0) throw InputError(file + " holds no frames: there is nothing to draw");
  if (!recording.geometry().record.position)
    throw InputError(file + " holds no positions: there is nothing to draw");
}

View view_of(const Scene& scene, const Frame& frame) {
  return {framing(scene, frame.position), speed_scale(scene, frame.velocity)};
}

View view_of(const Recording& recording) {
  constexpr std::size_t kFrames = 24, kEnough = 2'000'000;  // frames, bodies in all of them
  const std::size_t last = recording.frames() - 1,
                    fit = kEnough / std::max<std::size_t>(1, recording.bodies());
  const std::size_t intervals = std::min(last, std::clamp<std::size_t>(fit, 2, kFrames) - 1);
  std::vector<Vec> positions, velocities;
  Frame frame;
  for (std::size_t k = 0; k <= intervals; ++k) {
    recording.read(intervals == 0 ? 0 : k * last / intervals, frame);
    positions.insert(positions.end(), frame.position.begin(), frame.position.end());
    velocities.insert(velocities.end(), frame.velocity.begin(), frame.velocity.end());
  }
  return {framing(recording.geometry(), positions), speed_scale(recording.geometry(), velocities)};
}

}  // namespace throng::tools
