// SPDX-License-Identifier: MIT
// Preloaded into the program: the disk fails at the write with the number THRONG_FAILING_WRITE, in the way that
// THRONG_FAILURE names: "eio" and "enospc" at all writes from there on; "once" with EIO at that write alone;
// "full" as a full disk does it: half of a write that makes a file longer, then none of those, while what is
// there may be written over.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static ssize_t (*real_pwrite)(int, const void*, size_t, off64_t);
static ssize_t (*real_write)(int, const void*, size_t);

__attribute__((constructor)) static void find_real(void) {
  *(void**)&real_pwrite = dlsym(RTLD_NEXT, "pwrite64");
  *(void**)&real_write = dlsym(RTLD_NEXT, "write");
}

/// How much of a write of `count` bytes the disk takes; -1, with errno, where it fails.
static ssize_t taken(size_t count, int longer) {
  static atomic_long writes;
  const char *number = getenv("THRONG_FAILING_WRITE"), *how = getenv("THRONG_FAILURE");
  if (!number || !how) return (ssize_t)count;
  const long first = atol(number), now = atomic_fetch_add(&writes, 1) + 1;
  if (now < first || (now > first && !strcmp(how, "once"))) return (ssize_t)count;
  if (!strcmp(how, "full") && !longer) return (ssize_t)count;
  if (now == first && !strcmp(how, "full") && count > 1) return (ssize_t)(count / 2);
  errno = !strcmp(how, "eio") || !strcmp(how, "once") ? EIO : ENOSPC;
  return -1;
}

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  struct stat found;
  const int longer = fstat(fd, &found) != 0 || at + (off64_t)count > found.st_size;
  const ssize_t size = taken(count, longer);
  return size < 0 ? -1 : real_pwrite(fd, bytes, (size_t)size, at);
}

ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) { return pwrite64(fd, bytes, count, at); }

ssize_t write(int fd, const void* bytes, size_t count) {
  if (fd <= STDERR_FILENO) return real_write(fd, bytes, count);
  const ssize_t size = taken(count, 1);
  return size < 0 ? -1 : real_write(fd, bytes, (size_t)size);
}
