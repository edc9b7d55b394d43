// SPDX-License-Identifier: MIT
#pragma once

#include "tools/motion_answer.h"

namespace throng::tools {

/// What was proven free of a pair, or of several pairs, along all segments. Where a segment hits, that is all
/// before the first contact and whatever was proven on the way to it; the rest was not asked.
struct Lane {
  struct Strip {
    double from, to,
        at;  ///< segments since the start: 1.5 is the middle of the second; `at`: when distance was taken
    bool proven;  ///< otherwise from = to = at: rounding or a contact
  };
  std::string label;
  std::vector<Strip> strips;
};

/// The pairs that took most computations, one each, the others in a last one: `most` lanes at most. Expects
/// answers with their coverings.
std::vector<Lane> lanes(const MotionSystem& system, const MotionAnswer& answer, std::size_t most);

}  // namespace throng::tools
