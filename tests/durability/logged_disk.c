// SPDX-License-Identifier: MIT
// Preloaded into the program: what it writes to a file named *.part goes to the log named THRONG_WRITE_LOG too,
// each write as offset and length (8 bytes each), then its bytes; a change of the file's size as size and ~0.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static ssize_t (*real_pwrite)(int, const void*, size_t, off64_t);
static int (*real_ftruncate)(int, off64_t);
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static int log_fd = -1;

__attribute__((constructor)) static void begin(void) {
  *(void**)&real_pwrite = dlsym(RTLD_NEXT, "pwrite64");
  *(void**)&real_ftruncate = dlsym(RTLD_NEXT, "ftruncate64");
  const char* name = getenv("THRONG_WRITE_LOG");
  if (name) log_fd = open(name, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
}

static int is_part(int fd) {
  char link[64], name[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
  const ssize_t length = readlink(link, name, sizeof name - 1);
  return log_fd >= 0 && length > 5 && !strncmp(name + length - 5, ".part", 5);
}

static void put(uint64_t at, uint64_t count, const void* bytes) {
  const uint64_t head[2] = {at, count};
  if (write(log_fd, head, sizeof head) != sizeof head) abort();
  if (bytes && write(log_fd, bytes, count) != (ssize_t)count) abort();
}

ssize_t pwrite64(int fd, const void* bytes, size_t count, off64_t at) {
  if (!is_part(fd)) return real_pwrite(fd, bytes, count, at);
  pthread_mutex_lock(&mutex);
  put((uint64_t)at, count, bytes);
  const ssize_t done = real_pwrite(fd, bytes, count, at);
  pthread_mutex_unlock(&mutex);
  if (done != (ssize_t)count) abort();
  return done;
}

ssize_t pwrite(int fd, const void* bytes, size_t count, off_t at) { return pwrite64(fd, bytes, count, at); }

int ftruncate64(int fd, off64_t size) {
  if (is_part(fd)) put((uint64_t)size, ~(uint64_t)0, NULL);
  return real_ftruncate(fd, size);
}

int ftruncate(int fd, off_t size) { return ftruncate64(fd, size); }
