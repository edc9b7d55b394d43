// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <span>
#include <string>

#include "tests/fuzz/fuzz.h"

namespace throng::fuzz {

/// The name of a file that holds `bytes` and stands in memory alone. The next call takes it away.
inline std::string memory_file(std::span<const std::uint8_t> bytes) {
  static int file = -1;
  if (file >= 0) close(file);
  file = memfd_create("fuzzed", MFD_CLOEXEC);
  expect(write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()), "memory for a file");
  return "/proc/self/fd/" + std::to_string(file);
}

}  // namespace throng::fuzz
