// SPDX-License-Identifier: MIT
#include "tools/bench/pair_race.h"

#include <algorithm>
#include <cstdio>

#include "tools/bench/clouds.h"

namespace throng::bench {

using broadphase::Pair;
using broadphase::PairList;

void Digest::add(std::span<const Pair> pairs) {
  count += pairs.size();
  for (const Pair& pair : pairs) sum += random_bits(pair.a & 0xff, (std::uint64_t{pair.a} << 32) + pair.b);
}

std::string Digest::text() const {
  char text[64];
  std::snprintf(text, sizeof text, "%zu pairs %016llx", count, static_cast<unsigned long long>(sum));
  return text;
}

Digest digest(std::span<const Pair> pairs) {
  Digest digest;
  digest.add(pairs);
  return digest;
}

Digest digest(const PairList& pairs) {
  Digest digest;
  for (std::size_t i = 0; i < pairs.buffers(); ++i) digest.add(pairs.pairs(i));
  return digest;
}

void PairRace::add(const std::string& engine, std::function<void()> block, std::function<Digest()> found,
                   int threads) {
  contestants_.push_back({engine, std::move(block)});
  cases_.push_back(name_);
  threads_.push_back(threads);
  found_.push_back(std::move(found));
}

void PairRace::keep(const std::vector<std::string>& engines) {
  for (std::size_t i = contestants_.size(); i-- > 0;) {
    if (std::ranges::find(engines, contestants_[i].engine) != engines.end()) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    contestants_.erase(contestants_.begin() + at);
    cases_.erase(cases_.begin() + at);
    threads_.erase(threads_.begin() + at);
    found_.erase(found_.begin() + at);
  }
}

void PairRace::run(const Options& options, double work, std::vector<Row>& rows) {
  if (!options.engines.empty()) keep(options.engines);
  interleave(contestants_, options.blocks, work);
  for (std::size_t i = 0; i < contestants_.size(); ++i) {
    const Digest digest = found_[i]();
    const double pairs = static_cast<double>(digest.count);
    rows.push_back({"broadphase",
                    cases_[i],
                    contestants_[i].engine,
                    threads_[i],
                    contestants_[i].ms,
                    pairs,
                    digest.text(),
                    {{"ns_per_pair", 1e6 * median(contestants_[i].ms) / pairs}}});
  }
}

}  // namespace throng::bench
