// SPDX-License-Identifier: MIT
// Preloaded into the program: a disk of THRONG_DISK_BYTES bytes under the folder THRONG_DISK, which stands for a
// real one where nobody may mount.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

enum { kBlock = 4096 };

static long long disk_bytes(void) { return atoll(getenv("THRONG_DISK_BYTES")); }

static int is_on_disk(const char* path) {
  const char* disk = getenv("THRONG_DISK");
  return disk && !strncmp(path, disk, strlen(disk));
}

/// Of all files on the disk.
static long long used_bytes(void) {
  long long used = 0;
  DIR* folder = opendir(getenv("THRONG_DISK"));
  if (!folder) return 0;
  struct stat found;
  for (struct dirent* file; (file = readdir(folder));)
    if (!fstatat(dirfd(folder), file->d_name, &found, 0) && S_ISREG(found.st_mode)) used += 512 * found.st_blocks;
  closedir(folder);
  return used;
}

static long long free_bytes(void) {
  const long long left = disk_bytes() - used_bytes();
  return left > 0 ? left : 0;
}

int statvfs64(const char* path, struct statvfs64* found) {
  int (*const real)(const char*, struct statvfs64*) =
      (int (*)(const char*, struct statvfs64*))dlsym(RTLD_NEXT, "statvfs64");
  const int status = real(path, found);
  if (status || !is_on_disk(path)) return status;
  found->f_bsize = found->f_frsize = kBlock;
  found->f_bavail = found->f_bfree = (fsblkcnt64_t)(free_bytes() / kBlock);
  return 0;
}

int statvfs(const char* path, struct statvfs* found) { return statvfs64(path, (struct statvfs64*)found); }

/// Whether a write from `at` on has to fail: it would make a file of the disk longer than there is room.
static int has_no_room(int fd, size_t count, off64_t at) {
  char link[64], path[PATH_MAX];
  struct stat found;
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0 || fstat(fd, &found) != 0) return 0;
  path[length] = 0;
  if (!is_on_disk(path)) return 0;
  const long long grows = at + (off64_t)count - found.st_size;
  if (grows <= 0 || grows <= free_bytes()) return 0;
  errno = ENOSPC;
  return 1;
}

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  ssize_t (*const real)(int, const void*, size_t, off64_t) =
      (ssize_t(*)(int, const void*, size_t, off64_t))dlsym(RTLD_NEXT, "pwrite64");
  return has_no_room(fd, count, at) ? -1 : real(fd, bytes, count, at);
}

ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) { return pwrite64(fd, bytes, count, at); }

ssize_t write(int fd, const void* bytes, size_t count) {
  ssize_t (*const real)(int, const void*, size_t) = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
  if (fd > STDERR_FILENO && has_no_room(fd, count, lseek(fd, 0, SEEK_CUR))) return -1;
  return real(fd, bytes, count);
}
