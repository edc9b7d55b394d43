// SPDX-License-Identifier: MIT
#include "sim/recording/expected_bytes.h"

#include "sim/recording/layout.h"

namespace throng::recording {

namespace {

constexpr double kRowBytes = 4 * 8 + 64;      // of a frame, and the index entry of a chunk
constexpr double kContactBytes = 3.0 * 32.0;  // a body
constexpr double kQuantizedBytes = 3.0;       // a body
constexpr double kObservableBytes = 7 * 8;

/// A body's numbers in one frame.
double body_bytes(const Record& record, RecordField field) {
  if (field == RecordField::contacts) return kContactBytes;
  const int f = static_cast<int>(field);
  if (is_quantized(record, static_cast<FieldIndex>(f))) return kQuantizedBytes;
  return kComponents[static_cast<std::size_t>(f)] * (record.single ? 4.0 : 8.0);
}

}  // namespace

double expected_bytes(const Scene& scene) {
  const Record& record = scene.record;
  const double bodies = static_cast<double>(record.ids.empty() ? scene.bodies.size() : record.ids.size());
  const auto samples = [&](int every) {
    return every == 0 ? 0.0 : static_cast<double>(scene.time.steps()) / every + 1;
  };
  double bytes = static_cast<double>(count_frames(record, scene.time.steps())) * kRowBytes +
                 samples(record.observables) * (kRowBytes + kObservableBytes);
  for (int f = 0; f < kRecordFields; ++f) {
    const auto field = static_cast<RecordField>(f);
    bytes += samples(every(record, field)) * (body_bytes(record, field) * bodies + kRowBytes);
  }
  return bytes + (record.within ? samples(record.every) * 4.0 * bodies : 0.0);
}

}  // namespace throng::recording
