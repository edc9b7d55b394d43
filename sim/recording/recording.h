// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/contact_row.h"
#include "sim/observe.h"
#include "sim/recording/provenance.h"
#include "sim/scene.h"

namespace throng {

/// One recorded frame; a row per recorded body in order of id. An array is empty where the frame does not
/// hold it.
struct Frame {
  std::int64_t step = 0;
  double time = 0.0;             ///< s
  std::uint64_t state_hash = 0;  ///< throng::hash of the state
  std::uint64_t frame_hash = 0;
  std::vector<std::uint32_t> id;
  std::vector<Vec> position;  ///< m
  std::vector<double> angle;  ///< rad
  std::vector<Vec> velocity;  ///< m/s
  std::vector<double> spin;   ///< rad/s
  /// 1 where the body was there; empty where all are in every frame. The others, outside record.within or
  /// gone as agents go, have NaN in all arrays.
  std::vector<std::uint8_t> is_present;
  std::optional<std::vector<ContactRow>> contacts;
  std::vector<std::optional<Sensed>> sensed;  ///< of each recorded sensor, where it was due
  std::optional<Observables> observables;

  std::size_t bodies() const {
    return is_present.empty() ? id.size()
                              : static_cast<std::size_t>(std::count(is_present.begin(), is_present.end(), 1));
  }
  bool has(std::size_t row) const { return is_present.empty() || is_present[row] != 0; }
};

/// As CrowdState has them.
struct Arrivals {
  std::vector<std::int64_t> step;
  std::vector<std::uint32_t> id;

  friend bool operator==(const Arrivals&, const Arrivals&) = default;
};

/// Which frames of a recording are looked at: fields may have rates of their own.
enum class FrameChoice { all, with_position };

/// What made the file.
struct RecordingOrigin {
  Provenance provenance;
  std::string author;
  std::string version, compiler, flags;  ///< of the throng that wrote it
  int minor = 0;                         ///< of the layout: below 1, states were hashed otherwise
};

/// Reads a trajectory file (recording/layout.h) frame by frame, that of a run still going or killed included.
///
/// The file is hostile until checked: a damaged, truncated or crafted one is refused with InputError, "FILE
/// is no HDF5 file", "is HDF5 but not throng's", "was written by a newer throng: ..." or "is damaged: ...".
/// What the checks let through is what was written: all values carry checksums. Not for two threads at a
/// time.
class Recording {
 public:
  /// Opens and checks everything but the frames' values. O(frames + bodies). Of the frames that are not
  /// chosen nothing is seen; where no positions were recorded, all are chosen.
  explicit Recording(const std::string& path, FrameChoice choice = FrameChoice::all);
  ~Recording();
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;

  bool complete() const;  ///< false: the run is still going, or did not reach its end in order
  bool running() const;   ///< a run was writing to it when it was opened
  double bytes() const;   ///< of the file when it was opened

  /// Names, domain, shapes, materials, recorded bodies (their motion is zero: ask a frame), walls, the
  /// floor that agents walk on, measures, recorded sensors, time, seed, engine and what is recorded. Gravity
  /// and whatever else drawing doesn't need has its default.
  const Scene& geometry() const;
  const RecordingOrigin& origin() const;

  std::size_t frames() const;
  std::size_t bodies() const;                           ///< that are recorded
  std::size_t bodies_of_run() const;                    ///< that the scenario makes
  std::span<const std::uint32_t> ids() const;           ///< of the recorded bodies, ascending
  std::span<const std::int64_t> steps() const;          ///< ascending
  std::span<const double> times() const;                ///< s, ascending
  std::span<const std::uint64_t> state_hashes() const;  ///< checked against the values when a frame is read
  std::span<const std::uint64_t> frame_hashes() const;  ///< likewise

  /// Frame i < frames(), checked against its hash. O(bodies). Throws InputError where it is damaged.
  Frame frame(std::size_t i) const;
  /// The same into a frame whose memory is used again.
  void read(std::size_t i, Frame& frame) const;

  /// Gives frame i, as `read` left it, what a picture shows where its angles have a rate of their own: those
  /// of the last frame before that has them, whether it is chosen or not; 0 for a body that was away then. Of
  /// that frame the checksums alone are checked. O(bodies) where there is anything to do. Throws as `read`.
  void carry_angles(std::size_t i, Frame& frame) const;

  /// Which frame of the file frame i is, of how many: others than those chosen count.
  std::size_t frame_of_file(std::size_t i) const;
  std::size_t frames_of_file() const;

  /// Holds the file's tables against the scene that its scenario makes: name, seed, engine, substeps and
  /// end of the run, materials, shapes, bodies, walls, floor, ends of histograms, also the masses and the box
  /// that pictures don't need. O(scene). Throws InputError where any is damaged or otherwise.
  void expect_tables(const Scene& scene) const;

  /// kg, of the recorded bodies. O(bodies). Throws InputError where they are damaged.
  std::vector<double> masses() const;

  /// In which sample of a field's own, where it is stored, frame i stands; nothing where it does not.
  std::optional<std::size_t> sample(RecordField field, std::size_t i) const;

  /// The same of the k-th recorded sensor.
  std::optional<std::size_t> sensor_sample(std::size_t sensor, std::size_t i) const;

  /// Who of the crowd arrived and when, where the file says so: of a run with agents that has ended, since
  /// 1.10. O(arrivals). Throws InputError where they are damaged.
  std::optional<Arrivals> arrivals() const;

  std::vector<std::string> observed() const;  ///< names of what is below /observables

  /// Samples of a field, where it is stored, in all frames of the file, chosen or not.
  std::size_t samples(RecordField field) const;

  /// The same of who is in a frame, where bodies come and go: the row of ids that is frame i's.
  std::optional<std::size_t> id_sample(std::size_t i) const;
  std::size_t id_samples() const;

  /// The frame nearest in time; the earlier of two. Expects frames() > 0. O(log frames).
  std::size_t index_at(double time) const;
  Frame frame_at(double time) const { return frame(index_at(time)); }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace throng
