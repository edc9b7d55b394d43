// SPDX-License-Identifier: MIT
// A heap that is full once, preloaded: of the pieces that THRONG_FAILING_OWNER asks for, "throng" or "hdf5" (with
// it the C library), the one with the number THRONG_FAILING_ALLOCATION is refused, counted from when the file is
// made.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef int64_t hid_t;

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);

static atomic_long left;  // until one is refused; 0: none is
static int of_throng;

hid_t H5Fcreate(const char* name, unsigned flags, hid_t create, hid_t access) {
  hid_t (*const real)(const char*, unsigned, hid_t, hid_t) =
      (hid_t(*)(const char*, unsigned, hid_t, hid_t))dlsym(RTLD_NEXT, "H5Fcreate");
  const char *n = getenv("THRONG_FAILING_ALLOCATION"), *owner = getenv("THRONG_FAILING_OWNER");
  of_throng = owner && !strcmp(owner, "throng");
  if (n) atomic_store(&left, atol(n));
  return real(name, flags, create, access);
}

static int is_throng(const void* caller) {  // who asks by `new` asks through libstdc++
  Dl_info found;
  return dladdr(caller, &found) && found.dli_fname && strstr(found.dli_fname, "libstdc++");
}

static int is_refused(const void* caller) {
  if (atomic_load(&left) == 0 || is_throng(caller) != of_throng || atomic_fetch_sub(&left, 1) != 1) return 0;
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t size) {
  return is_refused(__builtin_return_address(0)) ? NULL : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  return is_refused(__builtin_return_address(0)) ? NULL : __libc_calloc(count, size);
}
void* realloc(void* old, size_t size) {
  return is_refused(__builtin_return_address(0)) ? NULL : __libc_realloc(old, size);
}
