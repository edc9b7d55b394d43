// SPDX-License-Identifier: MIT
// Preloaded into the program: the disk fails from the write with the number THRONG_FAILING_WRITE on.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  static atomic_long writes;
  static ssize_t (*next)(int, const void*, size_t, off64_t);
  if (!next) *(void**)&next = dlsym(RTLD_NEXT, "pwrite64");
  const char* from = getenv("THRONG_FAILING_WRITE");
  if (from && atomic_fetch_add(&writes, 1) + 1 >= atol(from)) {
    errno = EIO;
    return -1;
  }
  return next(fd, bytes, count, at);
}

ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) { return pwrite64(fd, bytes, count, at); }
