// SPDX-License-Identifier: MIT
#include "tools/motion_answer.h"

#include <numeric>

#include "tools/answer_json.h"

namespace throng::tools {

namespace {

using narrowphase::LinkageAnswer;
using narrowphase::LinkageChecker;
using narrowphase::Neighbourhood;
using narrowphase::Verdict;
using Json = nlohmann::ordered_json;

SegmentAnswer named(const MotionSystem& system, const LinkageAnswer& answer) {
  SegmentAnswer segment;
  segment.verdict = answer.verdict;
  if (answer.verdict == Verdict::free) return segment;
  segment.from = answer.from, segment.to = answer.to;
  const bool hit = answer.verdict == Verdict::hit;
  std::tie(segment.a, segment.b) = system.names(answer.pair, hit ? answer.part_b : MotionSystem::kNoPart);
  if (!hit) return segment;
  const narrowphase::Separation touch =
      system.separation(answer.pair, answer.part_a, answer.part_b, answer.segment, answer.to);
  segment.contact = MotionContact{(touch.point_a + touch.point_b) / 2, touch.normal};
  return segment;
}

/// Gives each segment its own neighbourhoods.
void hand_out(const std::vector<Neighbourhood>& covering, std::size_t pairs, MotionAnswer& answer) {
  for (Neighbourhood one : covering) {
    const std::size_t segment = one.pair / pairs;
    one.pair = static_cast<std::uint32_t>(one.pair % pairs);
    answer.segments[segment].covering.push_back(one);
  }
}

/// The first contact on the segment of one that was found; that one, where rounding decides whether another
/// comes before it.
LinkageAnswer first_contact(const MotionSystem& system, LinkageChecker& checker, const LinkageAnswer& found) {
  LinkageAnswer first =
      checker.first_contact(system.waypoint(found.segment), system.waypoint(found.segment + 1));
  const double from = first.from;
  const std::size_t evaluations = found.evaluations + first.evaluations;
  if (first.verdict != Verdict::hit) first = found;
  first.segment = found.segment, first.from = from, first.evaluations = evaluations;
  return first;
}

MotionAnswer answer_all(const MotionSystem& system, LinkageChecker& checker,
                        const narrowphase::BisectOptions& options) {
  std::vector<LinkageAnswer> found(system.segments());
  MotionAnswer answer{checker.check_path(system.path(), options, found).verdict, {}, 0};
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].segment = static_cast<std::uint32_t>(i);
    const bool hit = found[i].verdict == Verdict::hit;
    if (hit) found[i] = first_contact(system, checker, found[i]);
    answer.segments.push_back(named(system, found[i]));
    if (hit) answer.segments.back().clear = found[i].from;
    answer.segments.back().evaluations = found[i].evaluations;
    answer.evaluations += found[i].evaluations;
  }
  return answer;
}

/// All segments where they are asked to their ends, as they are without a hit.
MotionAnswer answer_any(const MotionSystem& system, LinkageChecker& checker,
                        const narrowphase::BisectOptions& options) {
  const LinkageAnswer found = checker.check_path(system.path(), options);
  if (found.verdict == Verdict::undecided) {
    if (options.covering) options.covering->clear();
    MotionAnswer answer = answer_all(system, checker, options);
    answer.evaluations += found.evaluations;
    return answer;
  }
  MotionAnswer answer{found.verdict, std::vector<SegmentAnswer>(system.segments()), found.evaluations};
  if (found.verdict == Verdict::free)
    for (SegmentAnswer& segment : answer.segments) segment.verdict = Verdict::free;
  else
    answer.segments[found.segment] = named(system, found);
  return answer;
}

/// A time, or both ends of an interval.
void add_times(const MotionTask& task, std::size_t segment, const SegmentAnswer& answer, Json& result) {
  const auto seconds_of = [&](double fraction) { return seconds(task, segment, fraction); };
  if (answer.verdict == Verdict::hit) result["fraction"] = answer.to;
  result[answer.verdict == Verdict::hit ? "bracket" : "in_doubt"] = {answer.from, answer.to};
  if (task.durations.empty()) return;
  if (answer.verdict == Verdict::hit) result["time"] = *seconds_of(answer.to);
  result[answer.verdict == Verdict::hit ? "time_bracket" : "time_in_doubt"] = {*seconds_of(answer.from),
                                                                               *seconds_of(answer.to)};
}

Json to_json(const MotionTask& task, std::size_t segment, const SegmentAnswer& answer) {
  Json result{{"segment", segment}, {"verdict", word(*answer.verdict)}};
  if (answer.verdict != Verdict::free) {
    add_times(task, segment, answer, result);
    result["pair"] = {answer.a, answer.b};
  }
  if (answer.contact) {
    result["point"] = json(answer.contact->point);
    result["normal"] = json(answer.contact->normal);
  }
  if (answer.evaluations) result["evaluations"] = *answer.evaluations;
  return result;
}

}  // namespace

std::optional<double> seconds(const MotionTask& task, std::size_t segment, double fraction) {
  if (task.durations.empty()) return std::nullopt;
  const auto begin = task.durations.begin();
  return std::accumulate(begin, begin + static_cast<std::ptrdiff_t>(segment), 0.0) +
         fraction * task.durations[segment];
}

MotionAnswer answer_motion(const MotionSystem& system, const MotionQuestion& question) {
  LinkageChecker checker(system.scene());
  std::vector<Neighbourhood> covering;
  const narrowphase::BisectOptions options{question.epsilon, question.covering ? &covering : nullptr,
                                           question.evaluations};
  MotionAnswer answer =
      question.any ? answer_any(system, checker, options) : answer_all(system, checker, options);
  hand_out(covering, system.scene().pairs.size(), answer);
  return answer;
}

Json to_json(const MotionSystem& system, const MotionAnswer& answer) {
  Json segments = Json::array();
  for (std::size_t i = 0; i < answer.segments.size(); ++i)
    if (answer.segments[i].verdict) segments.push_back(to_json(system.task(), i, answer.segments[i]));
  Json all{{"motion", system.task().name}, {"verdict", word(answer.verdict)}};
  if (system.margin() > 0.0) all["margin"] = system.margin();
  all["evaluations"] = answer.evaluations;
  all["segments"] = std::move(segments);
  return all;
}

}  // namespace throng::tools
