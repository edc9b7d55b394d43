// SPDX-License-Identifier: MIT
#include "sim/recording/expected_bytes.h"

#include <algorithm>
#include <numbers>

#include "sim/recording/layout.h"
#include "sim/recording/observables.h"

namespace throng::recording {

namespace {

constexpr double kHeadBytes = 6e4, kTableBytes = 30.0;  // of a file; of a body in the scene's tables
constexpr double kRowBytes = 4 * 8 + 8;                 // of a frame: step, time, hashes
constexpr double kSampleBytes = 20.0;                   // of a field in it: the index entry of a chunk

/// What nobody knows before the run.
struct Guess {
  double share;      // of the bodies, where they come and go
  double contacts;   // bytes a body
  double quantized;  // bytes a body
  bool sensed;       // whether anyone who has a sensor is there and finds others
};

constexpr Guess kAbout{1.0, 3.0 * 32.0, 3.0, true}, kLeast{0.0, 0.0, 0.0, false};

double observable_bytes(const Scene& scene) {
  double numbers = 0.0;
  for (const Observable& one :
       observables_of(scene.crowd.size() > 0, scene.crowd.measures, asked_columns(scene)))
    numbers += static_cast<double>(one.components);
  return 8.0 * numbers;
}

/// Where bodies are, by and large.
Eigen::AlignedBox2d place(const Scene& scene) {
  if (scene.domain.kind != DomainKind::unbounded) return {scene.domain.min, scene.domain.max};
  if (!scene.crowd.walkable.empty()) return bounds(scene.crowd.walkable);
  Eigen::AlignedBox2d box;
  for (const Vec& p : scene.bodies.position) box.extend(p);
  return box;
}

/// In one look, where all are spread evenly.
double sensed_bytes(const Scene& scene, const Sensor& sensor) {
  const double bodies = static_cast<double>(scene.bodies.size());
  const double having = sensor.ids.empty() ? bodies : static_cast<double>(sensor.ids.size());
  const double seen = std::numbers::pi * sensor.radius * sensor.radius * sensor.fov / 360.0;
  const double area = place(scene).sizes().prod();
  const double share = area > seen ? seen / area : 1.0;
  return having * (8.0 + 4.0 * bodies * share);
}

/// A body's numbers in one frame.
double body_bytes(const Record& record, RecordField field, const Guess& guess) {
  if (field == RecordField::contacts) return guess.contacts;
  if (is_quantized(record, field)) return guess.quantized;
  return static_cast<double>(components(field)) * (record.single ? 4.0 : 8.0);
}

double bytes_by(const Guess& guess, const Scene& scene) {
  const Record& record = scene.record;
  const double chosen = static_cast<double>(record.ids.empty() ? scene.bodies.size() : record.ids.size());
  const bool changes = bodies_come_and_go(scene);
  const double bodies = changes ? guess.share * chosen : chosen;
  const auto samples = [&](int every) {
    return every == 0 ? 0.0 : static_cast<double>(scene.time.steps()) / every + 1;
  };
  double bytes = kHeadBytes + kTableBytes * chosen +
                 static_cast<double>(count_frames(record, scene.time.steps())) * kRowBytes +
                 samples(record.observables) * (kSampleBytes + observable_bytes(scene));
  double most = 0.0;  // frames of a field
  for (RecordField field : kRecordFields) {
    const double frames = samples(every(record, field));
    bytes += frames * (body_bytes(record, field, guess) * bodies + kSampleBytes);
    most = std::max(most, frames);
  }
  for (const Sensor& sensor : recorded(scene.sensors))
    bytes += samples(sensor.every) * (kSampleBytes + (guess.sensed ? sensed_bytes(scene, sensor) : 0.0));
  return bytes + (changes ? most * 4.0 * bodies : 0.0);
}

}  // namespace

double expected_bytes(const Scene& scene) {
  return bytes_by(kAbout, scene);
}

double least_bytes(const Scene& scene) {
  return bytes_by(kLeast, scene);
}

}  // namespace throng::recording
