// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

/// The place in the file system that a recording takes: OUT.part while it is written, OUT once it is
/// complete.
namespace throng::recording {

class OutputFile {
 public:
  /// Claims `path`: makes and locks `path`.part. Throws InputError, leaving nothing behind, where the folder
  /// is missing or not writable, where `path` or the part of an earlier run exists without `force`, or where
  /// another run is writing there.
  OutputFile(std::string path, bool force);

  /// Lets go of the part, and removes it where nothing worth keeping was said to be in it.
  ~OutputFile();

  const std::string& path() const { return path_; }  ///< the final name
  const std::string& part() const { return part_; }  ///< where to write

  /// From now on the part stays, whatever happens.
  void keep() { keep_ = true; }

  /// Something stood in the part when it was claimed.
  bool was_there() const { return was_there_; }

  /// Hands the data to the disk. Throws std::runtime_error.
  void sync() const;

  /// Lets the disk begin to write what came so far, without waiting: the last sync then has little left to
  /// do.
  void start_sync() const;

  /// Puts the file at `fresh`, complete so far and perhaps still open, in the place of the part, of which a
  /// copy is in it. Its data is on the disk before. Throws std::runtime_error; the part is then as it was.
  void adopt(const std::string& fresh);

  /// Syncs, gives the part its final name and syncs the folder. Expects the part to be complete and closed.
  /// Throws std::runtime_error; the part then stays.
  void publish();

 private:
  void open_part();
  void lock_part();

  std::string path_, part_;
  bool force_, keep_ = false, was_there_ = false;
  int fd_ = -1;
};

/// Throws the InputError that an OutputFile would throw, as far as that can be told without making a file.
void expect_writable(const std::string& path, bool force);

/// Why `bytes` and a reserve are more than the file system of `path` has left; "" where they are not.
std::string lacking_room(const std::string& path, double bytes);

/// Throws InputError where there is a reason.
void expect_room(const std::string& path, double bytes);

/// Hands the names in the folder of `path` to the disk. Throws std::runtime_error.
void sync_folder(const std::string& path);

/// Bytes that the file system of `path` has left for this user; the largest number where it doesn't tell.
double free_bytes(const std::string& path);

/// True while a run holds the lock of this part.
bool is_being_written(const std::string& part);

}  // namespace throng::recording
