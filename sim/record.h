// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace throng {

/// What may be recorded of bodies and between them.
enum class RecordField { position, angle, velocity, spin, contacts };
inline constexpr std::array kRecordFields{RecordField::position, RecordField::angle, RecordField::velocity,
                                          RecordField::spin, RecordField::contacts};
inline constexpr std::array kRecordFieldName{"position", "angle", "velocity", "spin", "contacts"};

constexpr std::size_t index(RecordField field) {
  return static_cast<std::size_t>(field);
}
constexpr const char* name(RecordField field) {
  return kRecordFieldName[index(field)];
}

/// What a recording holds, and how often. A frame is made at every step at which anything is due; where
/// nothing is recorded at all, frames are made at the rate of all that has none of its own.
struct Record {
  int every = 1;  ///< steps from frame to frame, of all that has no rate of its own
  bool position = true, angle = true, velocity = true, spin = false, contacts = false;
  std::array<int, kRecordFields.size()> own_every{};  ///< steps, by RecordField; 0: `every`
  int observables = 0;                                ///< steps from one measurement to the next; 0: none
  std::vector<int> sensors;                           ///< steps from look to look, of each recorded sensor
  bool single = false;                                ///< recorded fields as float32
  double quantum = 0.0;                               ///< m, the grid that positions are rounded to; 0: exact
  std::vector<std::uint32_t> ids;                     ///< of the recorded bodies, ascending; empty: all
  std::optional<Eigen::AlignedBox2d> within;          ///< m, bodies are recorded while their centre is in it
};

/// Whether the field is recorded.
bool& flag(Record& record, RecordField field);
bool is_recorded(const Record& record, RecordField field);

/// Steps from one frame that holds the field to the next; 0 where none does. All begin at step 0.
int every(const Record& record, RecordField field);

/// Whether a frame is made at this step.
bool is_frame(const Record& record, std::int64_t step);

/// Whether fields of bodies or contacts are due.
bool has_bodies(const Record& record, std::int64_t step);

/// The rates at which anything is recorded, each once, ascending.
std::vector<int> rates(const Record& record);

/// Frames of the steps 0 to `steps`.
std::int64_t count_frames(const Record& record, std::int64_t steps);

/// Whether what is recorded each so many steps, 0 for never, is due.
inline bool is_due(int every, std::int64_t step) {
  return every > 0 && step % every == 0;
}

}  // namespace throng
