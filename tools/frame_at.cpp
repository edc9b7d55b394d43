// SPDX-License-Identifier: MIT
#include "tools/frame_at.h"

#include <cmath>

#include "sim/input_error.h"
#include "tools/printable.h"

namespace throng::tools {

std::size_t frame_at_or_throw(const Recording& recording, const std::string& file, std::optional<double> at) {
  if (!at) return recording.frames() - 1;
  const double first = recording.times().front(), last = recording.times().back(),
               slack = 1e-9 * std::abs(last);
  if (*at >= first - slack && *at <= last + slack) return recording.index_at(*at);
  throw InputError(file + ": --at " + text_of(*at) + " is outside the recording, which goes from " +
                   text_of(rounded(first)) + " s to " + text_of(rounded(last)) + " s");
}

}  // namespace throng::tools
