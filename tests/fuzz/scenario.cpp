// SPDX-License-Identifier: MIT
// The text of a scenario: refused with the reasons, or a scene that its resolved form gives again.
#include <cctype>
#include <string_view>

#include "scenarios/load.h"
#include "sim/state.h"
#include "tests/fuzz/fuzz.h"

namespace throng::fuzz {

namespace {

/// Millions of bodies are legal and slow: whether a line counts or measures out lattices in more than three
/// characters a number.
bool asks_for_many(std::string_view line) {
  if (line.find("count") == line.npos && line.find("size") == line.npos) return false;
  int longest = 0, length = 0;
  for (const char c : line.substr(line.find_first_of("=.") + 1)) {
    length = std::isdigit(static_cast<unsigned char>(c)) || c == '_' || c == 'x' || c == 'b' ? length + 1 : 0;
    longest = std::max(longest, length);
  }
  return longest > 3;
}

bool is_quick(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    if (asks_for_many(text.substr(0, end + 1))) return false;
    text.remove_prefix(end + 1);
  }
  return true;
}

}  // namespace

}  // namespace throng::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (!fuzz::is_quick(text)) return 0;
  const Loaded loaded = load_scenario_text(text, "/nowhere/fuzz.toml");
  fuzz::expect(to_string(loaded.diagnostics, "fuzz.toml").empty() == loaded.diagnostics.empty(),
               "each fault is a line");
  if (loaded.errors() > 0) return 0;
  const Loaded again = load_scenario_text(loaded.resolved, "/nowhere/fuzz.toml");
  fuzz::expect(again.errors() == 0, "the resolved form loads");
  fuzz::expect(again.resolved == loaded.resolved, "the resolved form resolves to itself");
  fuzz::expect(hash(initial_state(again.scene)) == hash(initial_state(loaded.scene)),
               "the resolved form gives the same bodies in the same places");
  return 0;
}
