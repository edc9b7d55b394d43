// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "broadphase/pairs.h"
#include "tools/bench/interleave.h"
#include "tools/bench/options.h"
#include "tools/bench/rows.h"

/// The cases of `throng bench broadphase` that find all pairs.
namespace throng::bench {

/// How many pairs, and the sum of a hash of each: the same in any order.
struct Digest {
  std::size_t count = 0;
  std::uint64_t sum = 0;

  void add(std::span<const broadphase::Pair> pairs);
  std::string text() const;
};

Digest digest(std::span<const broadphase::Pair> pairs);
Digest digest(const broadphase::PairList& pairs);

/// The engines of a case, or of several that are compared, and how each one's pairs are read once it has run.
class PairRace {
 public:
  explicit PairRace(std::string name) : name_(std::move(name)) {}

  /// The case of the engines that are added from here on.
  void begin_case(std::string name) { name_ = std::move(name); }

  void add(const std::string& engine, std::function<void()> block, std::function<Digest()> found,
           int threads = 1);

  /// Appends a row for each engine that the options ask for. `work`: searches in a block.
  void run(const Options& options, double work, std::vector<Row>& rows);

 private:
  void keep(const std::vector<std::string>& engines);

  std::string name_;
  std::vector<Contestant> contestants_;
  std::vector<std::string> cases_;
  std::vector<int> threads_;
  std::vector<std::function<Digest()>> found_;
};

}  // namespace throng::bench
