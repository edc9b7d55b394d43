// SPDX-License-Identifier: MIT
#include "scenarios/override.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "scenarios/limits.h"
#include "scenarios/scan.h"

namespace throng::scenarios {

namespace {

/// The path's parts: keys and indices alike, quotes removed. Nothing where it is no path.
std::optional<std::vector<std::string>> split(std::string_view path) {
  std::vector<std::string> parts;
  while (!path.empty()) {
    std::size_t end = 0;
    if (path[0] == '"' || path[0] == '\'') {
      end = path.find(path[0], 1);
      if (end == std::string_view::npos) return std::nullopt;
      parts.emplace_back(path.substr(1, end - 1));
      path.remove_prefix(end + 1);
    } else if (path[0] == '[') {
      end = path.find(']');
      if (end == std::string_view::npos) return std::nullopt;
      parts.emplace_back(path.substr(1, end - 1));
      path.remove_prefix(end + 1);
    } else {
      end = std::min(path.find_first_of(".["), path.size());
      parts.emplace_back(path.substr(0, end));
      path.remove_prefix(end);
    }
    if (parts.back().empty()) return std::nullopt;
    if (path.empty() || path[0] == '[') continue;
    if (path[0] != '.' || path.size() == 1) return std::nullopt;
    path.remove_prefix(1);
  }
  if (parts.empty()) return std::nullopt;
  return parts;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Where `=` ends the path: the first one outside quotes.
std::size_t find_equals(std::string_view text) {
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote != '\0' ? text[i] == quote : text[i] == '"' || text[i] == '\'')
      quote = quote != '\0' ? '\0' : text[i];
    else if (quote == '\0' && text[i] == '=')
      return i;
  }
  return std::string_view::npos;
}

/// With the digits that TOML wants around a number's point: 0.1 for .1, 5.0 for 5., as C has them.
std::string with_digits(const std::string& value) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::size_t point = value.find('.');
  if (point == std::string::npos || value.find_first_not_of("+-.0123456789eE") != std::string::npos)
    return value;
  const bool before = point > 0 && is_digit(value[point - 1]);
  const bool after = point + 1 < value.size() && is_digit(value[point + 1]);
  if (before == after) return value;
  return value.substr(0, point) + (before ? ".0" : "0.") + value.substr(point + 1);
}

/// A table with the value as "value". Throws toml::parse_error where it is not even a text.
toml::table parse_value(const std::string& value, const std::string& source) {
  const std::string text = "value = " + with_digits(value);
  if (find_excess(text).line == 0) {
    try {
      toml::table parsed = toml::parse(text, source);
      if (parsed.size() == 1 && parsed.contains("value")) return parsed;
    } catch (const toml::parse_error&) {
    }
  }
  std::string literal = "value = \"";  // not TOML: the string itself
  for (char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') literal += '\\';
    literal += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  return toml::parse(literal + "\"", source);
}

class Applier {
 public:
  Applier(const std::string& text, Report& report) : text_(text), report_(report) {}

  void apply(toml::table& root) {
    const std::size_t equals = find_equals(text_);
    if (equals == std::string::npos) return fail("", "must be PATH=VALUE, as in time.dt=0.005");
    path_ = trimmed(text_.substr(0, equals));
    value_ = trimmed(text_.substr(equals + 1));
    const auto parts = split(path_);
    if (!parts) return fail("", in_quotes(path_) + " is no path of keys, as time.dt or bodies[0].spin are");
    if (parts->size() > static_cast<std::size_t>(kDeepest)) return fail("", "the path is too deep");
    toml::node* node = &root;
    for (std::size_t i = 0; i + 1 < parts->size() && node; ++i) node = child((*parts)[i], *node);
    if (node) set(*node, parts->back());
  }

 private:
  /// The node's own entry of this name or number; made where a table lacks it.
  toml::node* child(const std::string& part, toml::node& node) {
    if (toml::table* table = node.as_table()) {
      if (!table->contains(part)) put(parse_value("{}", source()), part, *table);
      return table->get(part);
    }
    if (toml::array* list = node.as_array()) return entry(part, *list);
    fail(path_, in_quotes(part) + " is asked of something that is neither a table nor a list");
    return nullptr;
  }

  toml::node* entry(const std::string& part, toml::array& list) {
    std::size_t index = 0;
    const auto end = std::from_chars(part.data(), part.data() + part.size(), index);
    if (end.ec == std::errc() && end.ptr == part.data() + part.size() && index < list.size())
      return list.get(index);
    fail(path_, "there is no entry " + in_quotes(part) + " in a list of " + std::to_string(list.size()) +
                    "; the first is 0");
    return nullptr;
  }

  void set(toml::node& node, const std::string& part) {
    std::optional<toml::table> parsed = value_or_nothing();
    if (!parsed) return fail(path_, "the value is no UTF-8");
    toml::node& value = *parsed->get("value");
    if (toml::table* table = node.as_table()) {
      put(std::move(*parsed), part, *table);
    } else if (toml::array* list = node.as_array()) {
      toml::node* old = entry(part, *list);
      if (!old) return;
      const auto index = static_cast<std::size_t>(
          std::find_if(list->begin(), list->end(), [&](const toml::node& n) { return &n == old; }) -
          list->begin());
      value.visit([&](auto&& concrete) {
        list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(index), std::move(concrete));
      });
    } else {
      fail(path_, in_quotes(part) + " is asked of something that is neither a table nor a list");
    }
  }

  std::string source() const { return "--set " + text_; }

  std::optional<toml::table> value_or_nothing() const {
    try {
      return parse_value(value_, source());
    } catch (const toml::parse_error&) {
      return std::nullopt;
    }
  }

  /// Moves `parsed`.value to the table's entry of this name.
  static void put(toml::table parsed, const std::string& part, toml::table& table) {
    parsed.get("value")->visit([&](auto&& concrete) { table.insert_or_assign(part, std::move(concrete)); });
  }

  void fail(std::string path, std::string message) {
    report_.error_of_override(text_, std::move(path), std::move(message));
  }

  const std::string& text_;
  std::string path_, value_;
  Report& report_;
};

}  // namespace

void apply_override(toml::table& root, const std::string& override_, Report& report) {
  Applier(override_, report).apply(root);
}

}  // namespace throng::scenarios
