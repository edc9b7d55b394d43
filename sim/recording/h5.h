// SPDX-License-Identifier: MIT
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

/// HDF5's C library behind values: handles that close themselves, and errors that are thrown. Included by
/// this folder's sources only, never by a header that others see.
namespace throng::recording::h5 {

/// What the library reported, as the operating system or HDF5 says it; the caller adds the path.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Readies the library for the calling thread; every entry point into HDF5 calls it first. Cheap.
/// No clean-up at exit (after a failed write it ends in a segmentation fault), no plugins, no error stack on
/// stderr.
void prepare();

/// Throws Error with the innermost reason where `status` is negative, returns it otherwise.
template <class Status>
Status check(Status status, const char* what);
[[noreturn]] void fail(const std::string& what);

/// An open object of the library. Expects `closer` to fit the kind of `id`.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*closer)(hid_t), const char* what) : id_(check(id, what)), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.abandon()), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator hid_t() const { return id_; }

  /// Closes and reports; the destructor cannot.
  void close(const char* what) {
    if (id_ >= 0) check(close_(abandon()), what);
  }

  /// Leaves the object open for ever: after a failed write, closing it may crash the program.
  hid_t abandon() { return std::exchange(id_, -1); }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// The type of numbers, in the file and in memory alike: throng runs on little-endian machines only.
template <class T>
hid_t type();
template <>
hid_t type<double>();
template <>
hid_t type<float>();
template <>
hid_t type<std::uint8_t>();
template <>
hid_t type<std::int32_t>();
template <>
hid_t type<std::uint32_t>();
template <>
hid_t type<std::int64_t>();
template <>
hid_t type<std::uint64_t>();

template <class Status>
Status check(Status status, const char* what) {
  if (status < 0) fail(what);
  return status;
}

}  // namespace throng::recording::h5
