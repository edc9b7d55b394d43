// SPDX-License-Identifier: MIT
// The text of a motion file: refused with the reasons, or answered in finite numbers that fit together, and
// that samples do not contradict.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "scenarios/read_motion.h"
#include "sim/input_error.h"
#include "tests/fuzz/fuzz.h"
#include "tools/motion_clearance.h"
#include "tools/motion_page.h"

const char* const throng::tools::kMotionHtml = "@GIVEN@";  // the page around the data takes no part

namespace throng::fuzz {

namespace {

using Json = nlohmann::ordered_json;
using narrowphase::Verdict;
using tools::MotionAnswer;
using tools::MotionSystem;
using tools::SegmentAnswer;

constexpr std::size_t kMostPairs = 64;       // times segments: each may take all of
constexpr std::size_t kEvaluations = 2'000;  // computations

bool is_finite(const Json& value) {
  if (value.is_structured()) return std::all_of(value.begin(), value.end(), is_finite);
  return !value.is_number_float() || std::isfinite(value.get<double>());
}

void expect_sound(const SegmentAnswer& answer) {
  if (!answer.verdict) return;
  expect(answer.contact.has_value() == (answer.verdict == Verdict::hit), "a hit has a contact");
  if (*answer.verdict == Verdict::free) return;
  expect(0.0 <= answer.from && answer.from <= answer.to && answer.to <= 1.0, "the bracket is on the segment");
  expect(!answer.a.empty() && !answer.b.empty(), "both have names");
  if (answer.contact) expect(std::abs(answer.contact->normal.norm() - 1.0) <= 1e-15, "normals have length 1");
}

/// What is free, and what comes before a bracket, has no contact at samples.
void expect_free(const MotionSystem& system, std::size_t segment, double until) {
  narrowphase::LinkageChecker checker(system.scene());
  for (int k = 0; k < 16; ++k)
    expect(!checker.contact(system.values(segment, until * k / 16)), "samples do not touch on what is free");
}

/// Of a path that is free.
void expect_clearance(const MotionTask& task) {
  const auto clearance = tools::least_clearance(task, task.margin, 1e-6);
  if (!clearance) return;
  expect(task.margin <= clearance->low, "what was asked is proven");
  expect(clearance->low <= clearance->nearest.separation.distance, "the bracket is one");
  const MotionSystem system(task, 0.0, MotionSystem::Pairs::all);
  narrowphase::LinkageChecker checker(system.scene());
  for (std::size_t segment = 0; segment < system.segments(); ++segment)
    for (int k = 0; k <= 16; ++k)
      expect(checker.nearest(system.values(segment, k / 16.0))->separation.distance >=
                 clearance->low - system.rounding(),
             "samples come no nearer than what is proven");
  expect(is_finite(to_json(*clearance)), "all figures of it are finite");
}

int badness(Verdict verdict) {
  return verdict == Verdict::hit ? 2 : verdict == Verdict::undecided ? 1 : 0;
}

MotionAnswer checked_answer(const MotionSystem& system, bool any) {
  const MotionAnswer answer = answer_motion(system, {any, 0.0, true, kEvaluations});
  Verdict worst = Verdict::free;
  for (std::size_t i = 0; i < answer.segments.size(); ++i) {
    const SegmentAnswer& one = answer.segments[i];
    expect_sound(one);
    if (one.verdict && badness(*one.verdict) > badness(worst)) worst = *one.verdict;
    if (one.verdict == Verdict::free) expect_free(system, i, 1.0);
    if (one.verdict == Verdict::hit && !any && one.from > 0.0) expect_free(system, i, one.from);
  }
  expect(worst == answer.verdict, "the verdict is the worst of the segments");
  expect(is_finite(to_json(system, answer)), "all figures are finite");
  expect(is_finite(Json::parse(motion_page_data(system, answer))), "those of the page too");
  return answer;
}

}  // namespace

}  // namespace throng::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng;
  const LoadedMotion loaded =
      load_motion_text({reinterpret_cast<const char*>(data), size}, "/nowhere/fuzz.toml");
  fuzz::expect(to_string(loaded.diagnostics, "fuzz.toml").empty() == loaded.diagnostics.empty(),
               "each fault is a line");
  if (loaded.errors() > 0) return 0;
  try {
    const tools::MotionSystem system(loaded.task);
    if (system.scene().pairs.size() * system.segments() > fuzz::kMostPairs) return 0;
    const tools::MotionAnswer all = fuzz::checked_answer(system, false);
    if (all.verdict == narrowphase::Verdict::free && system.scene().pairs.size() * system.segments() < 8)
      fuzz::expect_clearance(loaded.task);
    const tools::MotionAnswer any = fuzz::checked_answer(system, true);
    if (all.verdict != narrowphase::Verdict::undecided)
      fuzz::expect(all.verdict == any.verdict, "any contact is found where the first one is");
  } catch (const InputError&) {
  }
  return 0;
}
