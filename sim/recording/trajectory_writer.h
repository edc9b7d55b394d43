// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/recording/h5.h"
#include "sim/recording/layout.h"
#include "sim/recording/provenance.h"
#include "sim/recording/recording.h"
#include "sim/state.h"

namespace throng::recording {

/// Which fields the scene records, in the order of layout.h.
std::array<bool, kFields> recorded_fields(const Record& record);

/// Writes one trajectory file, from one thread. All functions throw h5::Error; after that, `abandon` is the
/// only call allowed, and the frames committed before stay readable.
class TrajectoryWriter {
 public:
  /// Makes the file at `path` with everything that doesn't change, ready for frames and for readers that
  /// follow.
  TrajectoryWriter(const std::string& path, const Scene& scene, const Provenance& provenance);

  /// Adds a frame, its bodies in order of id. It is there for readers after the next `commit`. Throws
  /// std::runtime_error for a number that is not finite; the frame is then not written and the file stays
  /// sound.
  void append(const State& state);

  /// Adds a frame that was read from a recording of the same scene. Throws h5::Error where it wouldn't be
  /// stored as it was.
  void append(const Frame& frame);

  /// Makes every frame so far count, in an order that no crash can turn round: first the values, then their
  /// hashes.
  void commit();

  /// Commits, marks the file as complete and closes it.
  void finish();

  /// Commits and closes; the file stays marked as incomplete. May be called twice.
  void close();

  /// Leaves every object open: once a write has failed, HDF5's own clean-up ends in a segmentation fault.
  void abandon();

  std::size_t committed() const { return committed_; }  ///< frames
  std::uint64_t digest() const { return digest_; }      ///< chain_hash of their hashes

 private:
  struct Field {
    h5::Handle set;
    int components;
    std::size_t chunk_bytes;
    std::vector<double> values;  ///< by row of the file
    std::vector<float> singles;  ///< the same as stored, with record.precision = "single"
  };
  enum Row { kStep, kTime, kStateHash, kFrameHash, kRows };
  struct Rows {
    h5::Handle set;
    std::vector<std::uint64_t> pending;  ///< the bits of 8-byte numbers
  };

  void create_all(const Scene& scene, const Provenance& provenance);
  void create_parameters(const Scene& scene, const Provenance& provenance);
  void create_trajectory(const Scene& scene);
  void create_throng(const Scene& scene);
  void create_field(hid_t group, int index);
  void gather(const State& state);
  void gather(const Frame& frame);
  std::uint64_t append_gathered(std::int64_t step, std::uint64_t state_hash);
  std::uint64_t write_fields(std::int64_t step, std::uint64_t state_hash);
  void write_field(Field& field, std::span<const std::byte> bytes);
  void write_rows(Rows& rows);

  double dt_;
  std::size_t bodies_;
  bool single_;
  std::size_t frames_ = 0, committed_ = 0;
  std::uint64_t digest_;
  h5::Handle file_, finished_;
  std::array<Rows, kRows> rows_;
  std::array<Field, kFields> fields_;
  std::vector<std::byte> chunk_;  ///< the one being written, with its checksum
};

}  // namespace throng::recording
