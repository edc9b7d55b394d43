// SPDX-License-Identifier: MIT
#include "sim/recording/expected_bytes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/recording/layout.h"
#include "sim/recording/observables.h"
#include "sim/recording/selection.h"

namespace throng::recording {

namespace {

constexpr double kHeadBytes = 4e4, kTableBytes = 30.0;  // of a file; of a body in the scene's tables
constexpr double kChunkBytes = 20.0;                    // of a chunk: its entry in the index, its checksum
constexpr double kSparseChunkBytes = 84.0;              // where bodies come and go: the index is a tree

/// What nobody knows before the run.
struct Guess {
  double share;      // of the bodies, where they come and go
  double contacts;   // a body
  double quantized;  // bytes a body
  bool sensed;       // whether anyone who has a sensor is there and finds others
};

constexpr Guess kAbout{1.0, 3.0, 3.0, true}, kLeast{0.0, 0.0, 0.0, false};

/// Of rows that are added a few at a time: their chunks are whole.
double rows_bytes(double rows, double row_bytes, std::size_t rows_per_chunk = kRowChunk) {
  const auto chunk = static_cast<double>(rows_per_chunk);
  return std::ceil(rows / chunk) * (chunk * row_bytes + kChunkBytes);
}

class Estimate {
 public:
  Estimate(const Scene& scene, const Guess& guess)
      : scene_(scene),
        guess_(guess),
        changes_(bodies_come_and_go(scene)),
        chosen_(
            static_cast<double>(scene.record.ids.empty() ? scene.bodies.size() : scene.record.ids.size())),
        bodies_(changes_ ? guess.share * chosen_ : chosen_) {}

  double bytes() const {
    const Record& record = scene_.record;
    double sum = kHeadBytes + kTableBytes * chosen_ +
                 4.0 * rows_bytes(static_cast<double>(count_frames(record, scene_.time.steps())), 8.0) +
                 observables() + contacts();
    double most = 0.0;  // frames of a field, in which the bodies are listed
    for (RecordField field : kRecordFields) {
      const double frames = samples(every(record, field));
      if (field != RecordField::contacts) sum += frames * field_bytes(field);
      most = std::max(most, frames);
    }
    for (const Sensor& sensor : recorded(scene_.sensors)) sum += sensed(sensor);
    const double arrivals = guess_.share * static_cast<double>(scene_.crowd.size());
    sum += rows_bytes(arrivals, 4.0) + rows_bytes(arrivals, 8.0);
    if (changes_) sum += most * frame_bytes(4.0, kRegionChunk) + 2.0 * rows_bytes(most, 8.0);
    return sum + own_rates();
  }

 private:
  /// Of what is recorded each so many steps.
  double samples(int every) const {
    return every == 0 ? 0.0 : static_cast<double>(scene_.time.steps() / every + 1);
  }

  /// Of one frame: its chunks are whole, too, each of at most so many bodies.
  double frame_bytes(double body_bytes, double most) const {
    const double chunk = std::clamp(most, 1.0, std::max(1.0, chosen_)), chunks = std::ceil(bodies_ / chunk);
    return chunks * (chunk * body_bytes + (changes_ ? kSparseChunkBytes : kChunkBytes));
  }

  double field_bytes(RecordField field) const {
    if (is_quantized(scene_.record, field)) return kChunkBytes + bodies_ * guess_.quantized;
    const double body = static_cast<double>(components(field)) * (scene_.record.single ? 4.0 : 8.0);
    return frame_bytes(body, changes_ ? kRegionChunk : kMaxChunk / body);
  }

  double observables() const {
    double sum = 0.0;
    for (const Observable& one :
         observables_of(scene_.crowd.size() > 0, scene_.crowd.measures, asked_columns(scene_)))
      sum += rows_bytes(samples(scene_.record.observables), 8.0 * static_cast<double>(one.components));
    return sum;
  }

  double contacts() const {
    const double count = samples(every(scene_.record, RecordField::contacts));
    if (count == 0.0) return 0.0;
    const double rows = count * bodies_ * guess_.contacts;
    const std::size_t chunk = contact_chunk(scene_.bodies.size());
    return rows_bytes(count + 1.0, 8.0) + 2.0 * rows_bytes(rows, 4.0, chunk) + rows_bytes(rows, 8.0, chunk) +
           rows_bytes(rows, 16.0, chunk);
  }

  /// Where all are spread evenly.
  double sensed(const Sensor& sensor) const {
    const auto bodies = static_cast<double>(scene_.bodies.size());
    const double having = sensor.ids.empty() ? bodies : static_cast<double>(sensor.ids.size());
    const double seen = std::numbers::pi * sensor.radius * sensor.radius * sensor.fov / 360.0;
    const double area = place_of_bodies(scene_).sizes().prod();
    const double looks = samples(sensor.every), rows = guess_.sensed ? looks * having : 0.0;
    const double found = rows * bodies * (area > seen ? seen / area : 1.0);
    return 2.0 * rows_bytes(looks + 1.0, 8.0) + 2.0 * rows_bytes(rows, 4.0, kContactChunk) +
           rows_bytes(found, 4.0, kContactChunk);
  }

  /// Steps and times of the frames at rates that not all frames have.
  double own_rates() const {
    const std::vector<int> all = rates(scene_.record);
    double sum = 0.0;
    for (int every : all) sum += 2.0 * rows_bytes(samples(every), 8.0);
    return all.size() > 1 ? sum : 0.0;
  }

  const Scene& scene_;
  const Guess& guess_;
  bool changes_;
  double chosen_, bodies_;  // that may be recorded; that are, in each frame
};

}  // namespace

double expected_bytes(const Scene& scene) {
  return Estimate(scene, kAbout).bytes();
}

double least_bytes(const Scene& scene) {
  return Estimate(scene, kLeast).bytes();
}

}  // namespace throng::recording
