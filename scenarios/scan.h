// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace throng::scenarios {

/// What is too much for the parser, found before it starts.
struct Excess {
  int line = 0, column = 0;  ///< from 1, in bytes; 0: none found
  std::string message;
};

/// Looks through a text in TOML, without recursion, for what would cost the parser its stack or our memory:
/// brackets or dotted keys deeper than kDeepest, more than kMostItems values, and for the zero bytes of a
/// binary file. Comments and strings are skipped. O(n), allocates nothing. A text that is no TOML gets
/// through: the parser says why.
Excess find_excess(std::string_view text);

}  // namespace throng::scenarios
