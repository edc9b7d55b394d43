// SPDX-License-Identifier: MIT
#include "sim/recording/h5.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

#if defined(__SANITIZE_ADDRESS__) || defined(__clang__)
// What libhdf5 1.10 itself loses on damaged files and failed writes is not ours to mend, nor what fontconfig
// keeps under the pictures' letters; our own leaks still show. NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_options() {
  return "print_suppressions=0";
}
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5\nleak:libfontconfig";
}
// NOLINTEND(bugprone-reserved-identifier)
#endif

namespace throng::recording::h5 {

namespace {

/// The errno that HDF5's file driver wrote into a message such as "..., errno = 28, error message = ...",
/// else 0.
int errno_in(const char* description) {
  const char* at = std::strstr(description, "errno = ");
  return at ? std::atoi(at + std::strlen("errno = ")) : 0;
}

/// HDF5's words for a file that is shorter than it says, in ours; its own otherwise.
std::string in_plain_words(const char* description) {
  unsigned long long bytes = 0, base = 0, whole = 0;
  if (std::sscanf(description, "truncated file: eof = %llu, sblock->base_addr = %llu, stored_eof = %llu",
                  &bytes, &base, &whole) != 3)
    return description;
  return "it is cut short: " + std::to_string(bytes) + " of " + std::to_string(whole) + " bytes are there";
}

/// Keeps the first reason with an errno, else the first of all: the walk starts at the innermost call.
herr_t keep_reason(unsigned, const H5E_error2_t* error, void* out) {
  std::string& reason = *static_cast<std::string*>(out);
  if (!error->desc) return 0;
  if (const int number = errno_in(error->desc)) {
    reason = std::strerror(number);
    return 1;
  }
  if (reason.empty()) reason = in_plain_words(error->desc);
  return 0;
}

}  // namespace

void prepare() {
  static std::once_flag once;
  std::call_once(once, [] {
    H5dont_atexit();
    H5open();
    H5PLset_loading_state(0);
  });
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void fail(const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_reason, &reason);
  H5Eclear2(H5E_DEFAULT);
  throw Error(reason.empty() ? what : what + ": " + reason);
}

template <>
hid_t type<double>() {
  return H5T_IEEE_F64LE;
}
template <>
hid_t type<float>() {
  return H5T_IEEE_F32LE;
}
template <>
hid_t type<std::uint8_t>() {
  return H5T_STD_U8LE;
}
template <>
hid_t type<std::int32_t>() {
  return H5T_STD_I32LE;
}
template <>
hid_t type<std::uint32_t>() {
  return H5T_STD_U32LE;
}
template <>
hid_t type<std::int64_t>() {
  return H5T_STD_I64LE;
}
template <>
hid_t type<std::uint64_t>() {
  return H5T_STD_U64LE;
}

}  // namespace throng::recording::h5
