// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "tools/motion_system.h"

namespace throng::tools {

/// Of two things that touch.
struct MotionContact {
  Vec point, normal;  ///< m, and unit, from the first to the second
};

/// About one segment of the paths: from one waypoint of all movers to the next.
struct SegmentAnswer {
  std::optional<narrowphase::Verdict> verdict;  ///< none: it was not asked to its end
  double from = 0.0,
         to = 0.0;     ///< fractions: of the first contact, of a contact (both equal), or what is in doubt
  std::string a, b;    ///< who touches, or is in doubt
  double clear = 0.0;  ///< fraction up to which the first contact's search has proven all free
  std::optional<MotionContact> contact;
  std::optional<std::size_t> evaluations;  ///< computations of a pair's distance, where counted apart
  std::vector<narrowphase::Neighbourhood> covering;  ///< fractions; `pair` is a row of the scene's pairs
};

struct MotionAnswer {
  narrowphase::Verdict verdict = narrowphase::Verdict::free;
  std::vector<SegmentAnswer> segments;  ///< all
  std::size_t evaluations = 0;
};

struct MotionQuestion {
  bool any = false;      ///< stop at the first contact found, in whichever segment
  double epsilon = 0.0;  ///< m, clearance that need not be told from contact; 0: as fine as rounding lets it
  bool covering = false;
  std::size_t evaluations = narrowphase::BisectOptions().evaluations;  ///< most of a pair by bisection
};

MotionAnswer answer_motion(const MotionSystem& system, const MotionQuestion& question);

/// Seconds since the start of the path, where the task has durations.
std::optional<double> seconds(const MotionTask& task, std::size_t segment, double fraction);

nlohmann::ordered_json to_json(const MotionSystem& system, const MotionAnswer& answer);

}  // namespace throng::tools
