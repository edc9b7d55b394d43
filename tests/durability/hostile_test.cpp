// SPDX-License-Identifier: MIT
// X1, X2: damaged files. Each must be refused with a reason, or hold exactly what was written.
#include <chrono>
#include <random>

#include "tests/durability/hostile.h"

namespace throng {
namespace {

struct Damaged : Hostile {
  void expect_mutations_seen(const Sample& sample, int files) {
    constexpr unsigned seed = 20240611;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    int refusals = 0;
    for (int i = 0; i < files && !HasFailure(); ++i) {
      std::string bytes = sample.bytes;
      const std::size_t reach = i % 2 == 0 ? std::min<std::size_t>(4096, bytes.size()) : bytes.size();
      for (std::uint64_t changes = 1 + random() % 4; changes > 0; --changes)
        bytes[random() % reach] ^= static_cast<char>(1 + random() % 255);
      const auto begin = std::chrono::steady_clock::now();
      refusals += refused(bytes, sample);
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10))
          << "file " << i << " hangs";
    }
    EXPECT_GT(refusals, files * 3 / 10);  // the sample hits what matters,
    EXPECT_LT(refusals, files);           // and what does not
  }
};

const int kMutations = cases(10'000 / 7 + 1, 300);

TEST_F(Damaged, X1MutatedFilesAreRefusedOrUnharmed) {
  expect_mutations_seen(good, kMutations);
}

TEST_F(Damaged, X1MutatedFilesOfSinglePrecisionAreRefusedOrUnharmed) {
  expect_mutations_seen(single(), kMutations);
}

TEST_F(Damaged, X1MutatedFilesOfPackedPositionsAreRefusedOrUnharmed) {
  expect_mutations_seen(full(false), kMutations);
}

TEST_F(Damaged, X1MutatedFilesOfRegionsAreRefusedOrUnharmed) {
  expect_mutations_seen(full(true), kMutations);
}

TEST_F(Damaged, X1MutatedFilesOfPackedRegionsAreRefusedOrUnharmed) {
  Record record = full_record(true);
  record.quantum = 1e-3;
  expect_mutations_seen(full(record), kMutations);
}

TEST_F(Damaged, X1MutatedFilesOfCrowdsAreRefusedOrUnharmed) {
  expect_mutations_seen(crowd(), kMutations);
}

TEST_F(Damaged, X2TruncatedFilesOfEveryKindAreRefused) {
  for (const int kind : {0, 1, 2}) {
    const Sample sample = kind == 2 ? crowd() : full(kind == 1);
    for (std::size_t size = 0; size < sample.bytes.size() && !HasFailure(); size += 512)
      EXPECT_TRUE(refused(sample.bytes.substr(0, size), sample)) << "truncated to " << size;
  }
}

/// HDF5 looks a hundred times at a checksum that is wrong in a file that is open for writing, and doubles its
/// pause each time: a killed run's damaged file once took for ever to be refused.
TEST_F(Damaged, X1MutatedFilesOfKilledRunsAreRefusedOrTellFewerFrames) {
  expect_mutations_seen(unfinished(), kMutations);
}

TEST_F(Damaged, X2TruncatedFilesAreRefused) {
  for (std::size_t size = 0; size < good.bytes.size() && !HasFailure(); size += 512)
    EXPECT_TRUE(refused(good.bytes.substr(0, size), good)) << "truncated to " << size;
}

TEST_F(Damaged, X2TruncatedFilesOfKilledRunsAreRefusedOrTellFewerFrames) {
  const Sample sample = unfinished();
  int refusals = 0;
  for (std::size_t size = 0; size < sample.bytes.size() && !HasFailure(); size += 512)
    refusals += refused(sample.bytes.substr(0, size), sample);
  EXPECT_GT(refusals, 3);
}

/// The mark of completeness is written before the file is closed: where the disk failed in between, it may
/// stand there in part. The frames are still those of a run that did not end.
TEST_F(Damaged, AMarkInAFileThatWasNeverClosedIsNoEnd) {
  const std::string mark =
      "/usr/bin/python3 -c \"import h5py, os; f = h5py.File('" + (folder / "good.h5") +
      "', 'r+', libver='latest'); f.swmr_mode = True; d = f['throng/finished']; d[()] = 5; "
      "d.flush(); os._exit(0)\"";
  ASSERT_EQ(std::system(mark.c_str()), 0);
  const Recording recording(folder / "good.h5");
  EXPECT_FALSE(recording.complete());
  ASSERT_EQ(recording.frames(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(text(recording.frame(kFrames - 1)), good.told.frames.back());
}

TEST_F(Damaged, RowsOfFramesAreCoveredThoughTheyCarryNoChecksum) {
  const Recording recording(folder / "good.h5");
  const std::string& before = good.bytes;
  for (const std::uint64_t hash : recording.state_hashes()) {
    const std::size_t at = before.find(std::string_view(reinterpret_cast<const char*>(&hash), 8));
    ASSERT_NE(at, std::string::npos);
    std::string bytes = before;
    bytes[at + 3] ^= 16;
    EXPECT_TRUE(refused(bytes, good));
  }
}

TEST_F(Damaged, SensedAndMeasuredAreCoveredThoughTheyCarryNoChecksum) {
  const Sample sample = crowd();
  const Recording recording(folder / "crowd.h5");
  std::vector<std::uint32_t> whom;
  std::vector<double> densities;
  for (std::size_t i = 0; i < recording.frames(); ++i) {
    const Frame frame = recording.frame(i);
    const Sensed sensed = frame.sensed.at(0).value_or(Sensed{});
    whom.insert(whom.end(), sensed.whom.begin(), sensed.whom.end());
    if (frame.observables) densities.push_back(frame.observables->crowd->measures.at(6));
  }
  ASSERT_GT(whom.size(), 8u);
  const auto expect_covered = [&](const auto& rows) {
    const std::string_view column(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof rows[0]);
    const std::size_t at = sample.bytes.find(column);
    ASSERT_NE(at, std::string::npos);
    for (std::size_t k = 0; k < column.size(); k += 7) {
      std::string bytes = sample.bytes;
      bytes[at + k] ^= 1;
      EXPECT_TRUE(refused(bytes, sample)) << k;
    }
  };
  expect_covered(whom);
  densities.erase(densities.begin());  // nobody knows the first one's bits: it is no number
  expect_covered(densities);
}

}  // namespace
}  // namespace throng
