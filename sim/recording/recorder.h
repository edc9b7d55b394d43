// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "sim/recording/provenance.h"
#include "sim/state.h"

namespace throng {

/// What one frame of the scene takes in the file, in bytes.
double frame_bytes(const Scene& scene);

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
  /// missing, no permission, exists without `force`, another run at work, too little room for all frames),
  /// std::runtime_error where making the file fails all the same.
  Recorder(const std::string& path, const Scene& scene, const Provenance& provenance, bool force = false);

  /// Throws the InputError that a Recorder of these arguments would throw, as far as that can be told without
  /// making anything.
  static void expect_writable(const std::string& path, const Scene& scene, const Provenance& provenance,
                              bool force = false);

  /// Without `finish`: does what `stop` does, but can't tell of errors.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Adds a frame. Returns once it is copied; waits where the queue is full, so a slow disk slows the loop
  /// rather than filling the memory. O(n); allocates nothing. Expects the scene's bodies, ids 1 to n in any
  /// order, and steps that ascend. Throws std::runtime_error with path and reason where writing has failed.
  void record(const State& state);

  /// Writes what is queued, closes, syncs and renames. Call it once, after the last frame, also when the run
  /// was interrupted but is worth keeping. Throws std::runtime_error as `record` does.
  void finish();

  /// Writes what is queued and closes OUT.part, which stays readable as that of a run that did not end, or is
  /// removed where no frame was committed. Call it instead of `finish`. Throws std::runtime_error as `record`
  /// does.
  void stop();

  const std::string& path() const;  ///< of the complete file
  const std::string& part() const;  ///< of the file until then
  std::size_t frames() const;       ///< recorded so far

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace throng
