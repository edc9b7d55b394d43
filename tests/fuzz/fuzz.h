// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>

/// What every target of the fuzzer offers: libFuzzer calls it with its inventions, `replay.cpp` with files.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace throng::fuzz {

/// Ends the program where a promise is broken: the fuzzer keeps the input that did it.
inline void expect(bool kept, const char* promise) {
  if (kept) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

}  // namespace throng::fuzz
