// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "sim/recording/field_writer.h"
#include "sim/recording/h5.h"
#include "sim/recording/layout.h"
#include "sim/recording/provenance.h"
#include "sim/recording/recording.h"
#include "sim/recording/sampled_writer.h"
#include "sim/state.h"

namespace throng::recording {

/// Writes one trajectory file, from one thread. All functions throw h5::Error; after that, `abandon` is the
/// only call allowed, and the frames committed before stay readable.
class TrajectoryWriter {
 public:
  /// Makes the file at `path` with everything that doesn't change, ready for frames and for readers that
  /// follow.
  TrajectoryWriter(const std::string& path, const Scene& scene, const Provenance& provenance);

  /// Adds what is due of a state, its bodies in order of id. It is there for readers after the next `commit`.
  /// `contacts`: of the state; `observables`: likewise, where they are due; `sensed`: of each recorded
  /// sensor, where any is due. Throws std::runtime_error for a number that is not finite; the frame then
  /// never counts, nothing may be added any more, and the file stays sound.
  void append(const State& state, std::uint64_t state_hash, std::span<const ContactRow> contacts = {},
              const std::optional<Observables>& observables = std::nullopt,
              std::span<const Sensed> sensed = {});

  /// Adds a frame that was read from a recording of the same scene. Throws h5::Error where it wouldn't be
  /// stored as it was.
  void append(Frame&& frame);

  /// Makes every frame so far count, in an order that no crash can turn round: first the values, then their
  /// hashes.
  void commit();

  /// Commits, says who of the crowd arrived, marks the file as complete and closes it.
  void finish(const CrowdState& crowd);

  /// Commits and closes; the file stays marked as incomplete. May be called twice.
  void close();

  /// Leaves every object open: once a write has failed, HDF5's own clean-up ends in a segmentation fault.
  void abandon();

  std::size_t committed() const { return committed_; }  ///< frames
  std::uint64_t digest() const { return digest_; }      ///< chain_hash of their hashes
  bool has_uncommitted() const { return frames_ > committed_; }
  double uncommitted_bytes() const { return uncommitted_bytes_; }

 private:
  enum Row { kStep, kTime, kStateHash, kFrameHash, kRows };
  struct Rate {
    int every;
    RateRows rows;
  };

  void create_all(const Scene& scene, const Provenance& provenance);
  void create_throng(const Scene& scene);
  void create_finished(hid_t throng);
  void create_arrivals(hid_t throng);
  void write_arrivals(const CrowdState& crowd);
  void create_rates(hid_t throng);
  void create_trajectory(const Scene& scene);
  void create_ids(hid_t group);
  void create_field(hid_t group, RecordField field);
  void create_sampled(const Scene& scene);
  void create_sensed(std::span<const Sensor> sensors);
  void link_times(hid_t element, int every);
  bool holds(RecordField field, std::int64_t step) const;
  void gather(const State& state);
  std::span<const double> in_rows(RecordField field, const State& state, bool stand_so);
  void gather(const Frame& frame);
  void keep_present(std::int64_t step);
  std::uint64_t append_gathered(std::int64_t step, std::uint64_t state_hash,
                                std::span<const ContactRow> contacts,
                                const std::optional<Observables>& observables,
                                std::span<const Sensed> sensed);
  std::size_t write_fields(std::int64_t step, FrameHash& hash);
  std::size_t write_sensed(std::int64_t step, std::span<const Sensed> sensed, FrameHash& hash);
  std::span<const ContactRow> chosen(std::span<const ContactRow> contacts);
  template <class F>
  void for_each_log(F f);

  double dt_;
  Record record_;
  Selection selection_;
  std::size_t frames_ = 0, committed_ = 0;
  std::uint64_t digest_;
  double uncommitted_bytes_ = 0.0;
  h5::Handle file_, finished_;
  std::array<RowLog, kRows> rows_;
  std::vector<Rate> rates_;  ///< that are not those of all frames
  FrameBlocks ids_;          ///< where the recorded bodies change
  RateRows id_times_;
  std::array<FieldWriter, kBodyFields.size()> fields_;
  std::array<std::span<const double>, kBodyFields.size()> due_;  ///< of the frame in the making
  ContactWriter contacts_;
  std::vector<SensedWriter> sensed_;
  ObservableWriter observables_;
  std::vector<std::uint8_t> is_present_;  ///< by row of the selection, where that changes
  std::vector<std::uint32_t> present_;    ///< the ids of those that are, ascending
  std::vector<ContactRow> chosen_;
  h5::Handle arrived_id_, arrived_step_;
};

}  // namespace throng::recording
