// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace throng::tools {

enum class Key { none, pause, back, forward, slower, faster, quit };

/// Takes the next key that a player obeys from what a terminal sent, and what comes before it. `none` where
/// nothing is left, or the beginning of an arrow whose end may come yet.
Key next_key(std::string& typed);

}  // namespace throng::tools
