// SPDX-License-Identifier: MIT
#include "scenarios/difference.h"

#include <algorithm>
#include <set>
#include <vector>

#include "scenarios/path.h"
#include "scenarios/print.h"
#include "scenarios/source.h"

namespace throng {

using namespace scenarios;

namespace {

using Found = std::optional<ScenarioDifference>;

bool is_plain(const toml::node* node) {
  return !node || !(node->is_table() || node->is_array_of_tables());
}

std::string value(const toml::node* node) {
  constexpr std::size_t kMost = 60;
  if (!node) return "absent";
  if (!is_plain(node)) return "given";
  const std::string text = print(*node);
  return text.size() > kMost ? "given" : text;
}

Found compare(const toml::node* one, const toml::node* other, const Path& path);

Found compare(const toml::array& one, const toml::array& other, const Path& path) {
  for (std::size_t i = 0; i < std::max(one.size(), other.size()); ++i)
    if (Found found = compare(one.get(i), other.get(i), Path(path, i))) return found;
  return std::nullopt;
}

Found compare(const toml::table& one, const toml::table& other, const Path& path) {
  std::set<std::string> keys;
  for (const toml::table* table : {&one, &other})
    for (const auto& [key, node] : *table) keys.insert(std::string(key.str()));
  for (const bool plain : {true, false})
    for (const std::string& key : keys) {
      const toml::node *a = one.get(key), *b = other.get(key);
      if ((is_plain(a) && is_plain(b)) != plain) continue;
      if (Found found = compare(a, b, Path(path, key))) return found;
    }
  return std::nullopt;
}

Found compare(const toml::node* one, const toml::node* other, const Path& path) {
  if (one && other && one->is_table() && other->is_table())
    return compare(*one->as_table(), *other->as_table(), path);
  if (!is_plain(one) && !is_plain(other) && one->is_array() && other->is_array())
    return compare(*one->as_array(), *other->as_array(), path);
  if (one && other && print(*one) == print(*other)) return std::nullopt;
  return ScenarioDifference{path.text(), value(one), value(other)};
}

std::optional<toml::table> without_end(const std::string& text) {
  std::vector<Diagnostic> diagnostics;
  std::optional<toml::table> root = parse(text, "", diagnostics);
  if (!root) return root;
  if (toml::table* time = (*root)["time"].as_table()) {
    time->erase("until");
    if (time->empty()) root->erase("time");
  }
  return root;
}

}  // namespace

std::optional<ScenarioDifference> scenario_difference(const std::string& one, const std::string& other) {
  if (one == other) return std::nullopt;
  const std::optional<toml::table> a = without_end(one), b = without_end(other);
  if (!a || !b) return ScenarioDifference{"the text", a ? "TOML" : "none", b ? "TOML" : "none"};
  return compare(*a, *b, Path());
}

}  // namespace throng
