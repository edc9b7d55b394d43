// SPDX-License-Identifier: MIT
#include "sim/recording/expected_bytes.h"

#include <algorithm>

#include "sim/recording/layout.h"

namespace throng::recording {

namespace {

constexpr double kRowBytes = 4 * 8 + 64;  // of a frame, and the index entry of a chunk
constexpr double kObservableBytes = 7 * 8;

/// What nobody knows before the run.
struct Guess {
  double share;      // of the bodies, where they come and go
  double contacts;   // bytes a body
  double quantized;  // bytes a body
  double sensed;     // bytes a body that has a sensor
};

constexpr Guess kAbout{1.0, 3.0 * 32.0, 3.0, 8.0 + 10.0 * 4.0}, kLeast{0.0, 0.0, 0.0, 0.0};

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
  double bytes = static_cast<double>(count_frames(record, scene.time.steps())) * kRowBytes +
                 samples(record.observables) * (kRowBytes + kObservableBytes);
  double most = 0.0;  // frames of a field
  for (RecordField field : kRecordFields) {
    const double frames = samples(every(record, field));
    bytes += frames * (body_bytes(record, field, guess) * bodies + kRowBytes);
    most = std::max(most, frames);
  }
  for (const Sensor& sensor : scene.sensors) {
    const double having = static_cast<double>(sensor.ids.empty() ? scene.bodies.size() : sensor.ids.size());
    if (sensor.record) bytes += samples(sensor.every) * (guess.sensed * having + kRowBytes);
  }
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
