// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "sim/contact_row.h"
#include "sim/recording/provenance.h"
#include "sim/recording/recording.h"
#include "sim/state.h"

namespace throng {

/// Writes a run's trajectory to HDF5 (recording/layout.h) without holding up the loop: `record` copies the
/// state into a queue, and one thread of the recorder's own does the rest, all of HDF5 included.
///
/// The file grows as OUT.part and takes its final name in `finish`: a file with the final name is complete. A
/// frame counts, for readers that follow the run and after a crash, once it is committed: each second or 16
/// MB.
///
/// A failed write (disk full, a limit, a broken disk) ends the recording with an exception and never with a
/// signal; frames committed before stay readable in OUT.part. HDF5 can then not be made to clean up safely:
/// its objects stay open until the program ends, and nothing of it runs at exit.
class Recorder {
 public:
  /// Makes OUT.part. Throws InputError, leaving nothing behind, where `path` can't be written (folder
  /// missing, no permission, exists without `force`, another run at work, too little room for what all frames
  /// take at least), std::runtime_error where making the file fails all the same.
  Recorder(const std::string& path, const Scene& scene, const Provenance& provenance, bool force = false);

  /// Goes on with the recording of `path`: its first `frames` frames, read from `kept` and checked, stand in
  /// OUT.part as if this had recorded them. They are copied, and the file that `kept` reads is replaced or
  /// left only when the copy is on the disk: a crash at any moment loses none of them. Expects `kept` to be
  /// OUT or OUT.part and a recording of the same scene, of which only the end may differ. Throws as above.
  Recorder(const std::string& path, const Scene& scene, const Provenance& provenance, const Recording& kept,
           std::size_t frames);

  /// Throws the InputError that a Recorder of these arguments would throw, as far as that can be told without
  /// making anything.
  static void expect_writable(const std::string& path, const Scene& scene, const Provenance& provenance,
                              bool force = false);

  /// What to say before a run whose frames may take more room than there is, of which nobody can know: how
  /// much they would take if all bodies stayed in record.within, with three contacts a body. "" where there
  /// is room.
  static std::string doubt(const std::string& path, const Scene& scene, const Provenance& provenance);

  /// Without `finish`: does what `stop` does, but can't tell of errors.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Adds a frame: what is due at the state's step. `sensed` is of each sensor that is recorded, in the
  /// scene's order, and is looked at where one is due. Returns once it is copied; waits where the queue is
  /// full, so a slow disk slows the loop rather than filling the memory. O(n); allocates only where there are
  /// more contacts, or more are sensed, than ever before. Expects the scene's bodies, ids 1 to n in any
  /// order, all but agents in every frame, steps that ascend, and the state's contacts where they or
  /// observables are due. Throws std::runtime_error with path and reason where writing has failed.
  void record(const State& state, std::span<const ContactRow> contacts = {},
              std::span<const Sensed> sensed = {});

  /// Makes a checkpoint beside the recording (recording/checkpoint.h): once it is written, which this doesn't
  /// wait for, a run can go on from `state`, and every frame recorded before is on the disk. The one before
  /// is kept. O(bodies + contacts). Waits and throws as `record` does.
  void checkpoint(const State& state);

  /// Writes what is queued and who arrived, of the crowd as it is at the end, closes, syncs and renames. Call
  /// it once, after the last frame, also when the run was interrupted but is worth keeping. Throws
  /// std::runtime_error as `record` does.
  void finish(const CrowdState& crowd);

  /// Writes what is queued and closes OUT.part, which stays readable as that of a run that did not end, or is
  /// removed where no frame was committed. Call it instead of `finish`. Throws std::runtime_error as `record`
  /// does.
  void stop();

  const std::string& path() const;  ///< of the complete file
  const std::string& part() const;  ///< of the file until then
  std::size_t frames() const;       ///< in the file and on their way there

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace throng
