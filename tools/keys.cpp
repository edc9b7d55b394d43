// SPDX-License-Identifier: MIT
#include "tools/keys.h"

#include <string_view>

namespace throng::tools {

namespace {

/// Bytes of the first key; 0 where its end is missing. Arrows and their like are ESC, [ or O, and what ends
/// in a letter or ~ (ECMA-48, 5.4).
std::size_t length_of_first(std::string_view typed) {
  if (typed[0] != '\033') return 1;
  if (typed.size() == 1) return 0;
  if (typed[1] != '[' && typed[1] != 'O') return 1;
  for (std::size_t i = 2; i < typed.size(); ++i)
    if (typed[i] >= '@' && typed[i] <= '~') return i + 1;
  return 0;
}

Key meaning(std::string_view one) {
  if (one == " ") return Key::pause;
  if (one == "q" || one == "Q") return Key::quit;
  if (one == "+" || one == "=") return Key::faster;
  if (one == "-" || one == "_") return Key::slower;
  if (one == "\033[C" || one == "\033OC") return Key::forward;
  if (one == "\033[D" || one == "\033OD") return Key::back;
  return Key::none;
}

}  // namespace

Key next_key(std::string& typed) {
  while (!typed.empty()) {
    const std::size_t length = length_of_first(typed);
    if (length == 0) return Key::none;
    const Key key = meaning(std::string_view(typed).substr(0, length));
    typed.erase(0, length);
    if (key != Key::none) return key;
  }
  return Key::none;
}

}  // namespace throng::tools
