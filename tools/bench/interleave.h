// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace throng::bench {

/// One engine of a case: what it does in a block, and what its figures are.
struct Contestant {
  std::string engine;
  std::function<void()> block;
  std::vector<double> ms = {};      ///< per unit of work, a figure a block
  std::function<void()> look = {};  ///< at where a block has got, untimed; may be absent
};

/// Takes what blocks have answered, so that no answer is left out.
inline volatile double answer_sink = 0.0;

/// Runs the contestants' blocks in turn, A B A B ..., after one uncounted round, so that their ratio means
/// something on a noisy machine. `work`: units (steps, queries) in a block.
inline void interleave(std::vector<Contestant>& contestants, int blocks, double work) {
  for (Contestant& one : contestants) one.block();
  for (int i = 0; i < blocks; ++i)
    for (Contestant& one : contestants) {
      const auto begin = std::chrono::steady_clock::now();
      one.block();
      const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
      one.ms.push_back(spent.count() / work);
      if (one.look) one.look();
    }
}

}  // namespace throng::bench
