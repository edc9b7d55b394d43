// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "sim/recording/h5_read.h"
#include "sim/recording/layout.h"
#include "sim/recording/observables.h"
#include "sim/recording/quantized_reader.h"
#include "sim/recording/recording.h"
#include "sim/recording/schedule.h"

namespace throng::recording {

/// Reads what the frames of a file hold, whatever of layout.h that is. All functions throw h5::Error.
class FrameReader {
 public:
  FrameReader() = default;

  /// Opens and checks all but the values. `steps`: of the frames; `minor`: of the layout. Completes `record`,
  /// whose `every` and `single` are known. Expects the scene's bodies to be the recorded ones, `bodies` to be
  /// all of the run.
  FrameReader(const h5::File& file, const Scene& scene, std::span<const std::int64_t> steps, int minor,
              std::size_t bodies, Record& record);

  /// Ids of the recorded bodies, ascending.
  const std::vector<std::uint32_t>& ids() const { return ids_; }

  /// Which frames hold the field.
  const Schedule& schedule(RecordField field) const { return fields_[index(field)].when; }

  /// What is observed, where anything is.
  const std::vector<Observable>& observables() const { return observables_.observables; }

  /// Which frames hold what the k-th recorded sensor found.
  const Schedule& sensor_schedule(std::size_t sensor) const { return sensed_[sensor].when; }

  /// Which frames say who is in them; never where that is the same in all.
  const Schedule& id_schedule() const { return present_when_; }

  /// Fills all but ids of a frame whose step, time and hashes are there, and holds it against its hash.
  void read(std::size_t i, Frame& frame) const;

  /// The angles of a frame, of which no more than the checksums is checked; 0 for a body that is away, none
  /// where the frame has none.
  void read_angles(std::size_t i, std::vector<double>& angles) const;

 private:
  struct Stored {
    Schedule when;
    h5::Dataset set;
  };
  struct StoredContacts {
    std::vector<std::uint64_t> offset;
    h5::Dataset a, b, impulse, point;
  };
  /// Rows of steps and times, as objects of the file, that are those of a rate.
  struct CheckedTimes {
    std::uint64_t step, time;
    int every;
    friend bool operator==(const CheckedTimes&, const CheckedTimes&) = default;
  };
  struct StoredSensed {
    Schedule when;
    std::vector<std::uint64_t> offset, whom_offset;
    h5::Dataset who, count, whom;
  };
  struct StoredObservables {
    Schedule when;
    std::vector<Observable> observables;
    bool crowd = false;
    std::vector<std::vector<double>> values;  // of all frames, by observable
  };

  Schedule open_schedule(hid_t element, std::span<const std::int64_t> steps);
  void expect_times(std::span<const std::int64_t> found_steps, std::span<const double> found_times,
                    const Schedule& when, std::span<const std::int64_t> steps) const;
  void expect_times(hid_t element, const Schedule& when, std::span<const std::int64_t> steps);
  void open_ids(hid_t throng, hid_t trajectory, std::span<const std::int64_t> steps, Record& record);
  void open_region(hid_t element, Record& record) const;
  void open_field(hid_t trajectory, RecordField field, std::span<const std::int64_t> steps);
  void open_quantized(hid_t throng, std::span<const std::int64_t> steps, Record& record);
  void open_contacts(hid_t throng, std::span<const std::int64_t> steps);
  std::vector<std::uint64_t> read_ends(hid_t group, const char* name, std::size_t samples) const;
  void open_sensed(hid_t sensors, std::span<const std::int64_t> steps);
  void open_observables(const Scene& scene, std::span<const std::int64_t> steps);
  void expect_ids(std::span<const std::int64_t> steps) const;
  void complete(Record& record) const;

  std::size_t read_present(std::size_t i, Frame& frame, FrameHash& hash) const;
  template <class T>
  void read_numbers(RecordField field, std::size_t sample, std::size_t present, FrameHash& hash) const;
  void read_quantized(std::size_t sample, FrameHash& hash) const;
  void read_field(RecordField field, std::size_t i, std::size_t present, Frame& frame, FrameHash& hash) const;
  void hand_out(RecordField field, Frame& frame) const;
  void read_contacts(std::size_t i, Frame& frame, FrameHash& hash) const;
  void expect_names(std::span<const std::uint32_t> ids) const;
  std::optional<Sensed> read_sensed(const StoredSensed& stored, std::size_t i, FrameHash& hash) const;
  void read_observables(std::size_t i, Frame& frame, FrameHash& hash) const;

  const h5::File* file_ = nullptr;
  std::size_t bodies_ = 0;  // of the run
  double dt_ = 0.0;         // s
  int minor_ = 0, every_ = 1;
  bool single_ = false, changes_ = false;
  std::vector<CheckedTimes> checked_;
  std::vector<std::uint32_t> ids_;
  Schedule present_when_;  // where frames hold some bodies only
  h5::Dataset present_;    // u32 [sample, body]
  std::array<Stored, kRecordFields.size()> fields_;
  mutable QuantizedReader quantized_;  // remembers where it is
  StoredContacts contacts_;
  std::vector<StoredSensed> sensed_;
  StoredObservables observables_;
  mutable std::vector<std::uint32_t> rows_;  // of the bodies in a frame, where these change
  mutable std::vector<double> numbers_;      // of a field, of the bodies in a frame
  mutable std::vector<float> singles_;
};

}  // namespace throng::recording
