// SPDX-License-Identifier: MIT
#include "sim/recording/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include "sim/input_error.h"

namespace throng::recording {

namespace {

constexpr double kReserve = 16e6;  // bytes that a recording never plans to use

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& why) {
  throw InputError("cannot write " + path + ": " + why);
}

void check_target(const std::string& path, bool force) {
  struct stat found;
  if (path.empty()) throw InputError("the output has no name");
  if (stat(folder_of(path).c_str(), &found) != 0)
    cannot_write(
        path, errno == ENOENT ? "the folder " + folder_of(path) + " does not exist" : std::strerror(errno));
  if (!S_ISDIR(found.st_mode)) cannot_write(path, folder_of(path) + " is no folder");
  if (lstat(path.c_str(), &found) != 0) return;
  if (!S_ISREG(found.st_mode)) cannot_write(path, "it exists and is no regular file");
  if (!force) cannot_write(path, "it exists already; --force overwrites it");
}

/// What stands at `part` may be written over.
void check_part(const std::string& path, const std::string& part, const struct stat& found, bool force) {
  if (!S_ISREG(found.st_mode)) cannot_write(path, part + " is no regular file");
  if (found.st_size > 0 && !force)
    cannot_write(path, part + " is left from a run that did not end, and may hold frames: 'throng resume " +
                           path + "' goes on with it, --force overwrites it");
}

[[noreturn]] void refuse_locked(const std::string& path, const std::string& part) {
  cannot_write(path, "another run is writing it (" + part + " is locked)");
}

/// A lock on the whole file that belongs to the open file, not to the process: HDF5 opens and closes the same
/// file.
struct flock whole_file() {
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

bool same_file(int fd, const std::string& path) {
  struct stat open, named;
  return fstat(fd, &open) == 0 && lstat(path.c_str(), &named) == 0 && open.st_ino == named.st_ino &&
         open.st_dev == named.st_dev;
}

[[noreturn]] void fail(const std::string& path) {
  throw std::runtime_error("cannot complete " + path + ": " + std::strerror(errno));
}

}  // namespace

void sync_folder(const std::string& path) {
  const int fd = open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;  // a folder that may be written but not read: the name reaches the disk in its own time
  const bool failed = fsync(fd) != 0 && errno != EINVAL;
  close(fd);
  if (failed) fail(path);
}

OutputFile::OutputFile(std::string path, bool force)
    : path_(std::move(path)), part_(path_ + ".part"), force_(force) {
  check_target(path_, force_);
  open_part();
  try {
    lock_part();
  } catch (...) {
    close(fd_);
    throw;
  }
}

OutputFile::~OutputFile() {
  if (fd_ < 0) return;
  if (!keep_ && same_file(fd_, part_)) unlink(part_.c_str());
  close(fd_);
}

void OutputFile::open_part() {
  const int flags = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;
  fd_ = open(part_.c_str(), flags, 0666);
  if (fd_ < 0) cannot_write(path_, part_ + ": " + std::strerror(errno));
}

void OutputFile::lock_part() {
  struct flock lock = whole_file();
  if (fcntl(fd_, F_OFD_SETLK, &lock) != 0 && (errno == EAGAIN || errno == EACCES))
    refuse_locked(path_, part_);
  struct stat found;
  if (fstat(fd_, &found) != 0) cannot_write(path_, part_ + ": " + std::strerror(errno));
  if (!same_file(fd_, part_)) cannot_write(path_, "another run has just finished it");
  was_there_ = found.st_size > 0;
  check_part(path_, part_, found, force_);
}

double free_bytes(const std::string& path) {
  struct statvfs system;
  if (statvfs(folder_of(path).c_str(), &system) != 0) return std::numeric_limits<double>::max();
  return static_cast<double>(system.f_bavail) * static_cast<double>(system.f_frsize);
}

std::string lacking_room(const std::string& path, double bytes) {
  const double have = free_bytes(path);
  if (bytes + kReserve <= have) return "";
  char needed[80], left[40];
  std::snprintf(needed, sizeof needed, "about %.3g MB and ", (bytes + kReserve) / 1e6);
  std::snprintf(left, sizeof left, " has %.3g MB left", have / 1e6);
  return needed + folder_of(path) + left;
}

void expect_room(const std::string& path, double bytes) {
  if (const std::string why = lacking_room(path, bytes); !why.empty())
    cannot_write(path, "the recording needs " + why + "; record fewer frames");
}

void OutputFile::start_sync() const {
  sync_file_range(fd_, 0, 0, SYNC_FILE_RANGE_WRITE);
}

void OutputFile::sync() const {
  if (fdatasync(fd_) != 0) fail(part_);
}

void OutputFile::adopt(const std::string& fresh) {
  const int fd = open(fresh.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) fail(fresh);
  struct flock lock = whole_file();
  if (fcntl(fd, F_OFD_SETLK, &lock) != 0 || fsync(fd) != 0 || rename(fresh.c_str(), part_.c_str()) != 0) {
    const int reason = errno;
    close(fd);
    errno = reason;
    fail(fresh);
  }
  close(std::exchange(fd_, fd));
  keep();
  sync_folder(path_);
}

void OutputFile::publish() {
  keep();
  if (fsync(fd_) != 0) fail(part_);
  int status = renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, path_.c_str(), force_ ? 0 : RENAME_NOREPLACE);
  if (status != 0 && errno == EINVAL) status = rename(part_.c_str(), path_.c_str());
  if (status != 0) fail(path_);
  sync_folder(path_);
}

void expect_writable(const std::string& path, bool force) {
  check_target(path, force);
  const std::string part = path + ".part";
  struct stat found;
  if (lstat(part.c_str(), &found) == 0) {
    if (is_being_written(part)) refuse_locked(path, part);
    check_part(path, part, found, force);
    if (access(part.c_str(), R_OK | W_OK) != 0) cannot_write(path, part + ": " + std::strerror(errno));
  } else if (access(folder_of(path).c_str(), W_OK | X_OK) != 0) {
    cannot_write(path, part + ": " + std::strerror(errno));
  }
}

bool is_being_written(const std::string& part) {
  const int fd = open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return false;
  struct flock lock = whole_file();
  const bool locked = fcntl(fd, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(fd);
  return locked;
}

}  // namespace throng::recording
