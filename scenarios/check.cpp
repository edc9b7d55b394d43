// SPDX-License-Identifier: MIT
#include "scenarios/check.h"

#include <algorithm>
#include <cmath>

#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

namespace {

using Kind = Type::Kind;

class Checker {
 public:
  Checker(const toml::table& root, Report& report) : root_(root), report_(report) {}

  /// True where the node and all in it is fine; else it is reported and marked.
  bool check(const toml::node& node, const Type& type, const Path& path) {
    if (report_.full()) return false;
    if (check_kind(node, type, path)) return true;
    report_.mark_bad(node);
    return false;
  }

  bool check_fields(const toml::table& node, const Table& table, const Path& path);

 private:
  bool check_kind(const toml::node& node, const Type& type, const Path& path);
  bool check_number(const toml::node& node, const Type& type, const Path& path);
  bool check_text(const toml::node& node, const Type& type, const Path& path);
  bool check_choice(const toml::node& node, const Type& choice, const Type& all, const Path& path);
  bool check_name(const toml::node& node, const Type& type, const Path& path);
  bool check_tuple(const toml::node& node, const Type& type, const Path& path);
  bool check_list(const toml::node& node, const Type& type, const Path& path);
  bool check_named(const toml::node& node, const Type& type, const Path& path);
  bool check_either(const toml::node& node, const Type& type, const Path& path);
  bool check_present(const toml::table& node, const Table& table, const Path& path);
  bool check_one_of(const toml::table& node, const Table& table, const Path& path);
  bool check_field(const toml::key& key, const toml::node& node, const Table& table, const Path& path);
  bool wrong(const toml::node& node, const Type& type, const Path& path);

  bool fail(const toml::node& node, const Path& path, std::string message) {
    report_.error(node, path.text(), std::move(message));
    return false;
  }

  const toml::table& root_;
  Report& report_;
};

std::string what_it_is(const toml::node& node) {
  if (const auto* text = node.as_string()) return "the string " + in_quotes(text->get());
  if (const auto* integer = node.as_integer()) return "the integer " + std::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) return "the number " + to_text(number->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (const auto* list = node.as_array())
    return list->empty() ? "an empty list" : "a list of " + std::to_string(list->size());
  return "a date or time";
}

bool Checker::wrong(const toml::node& node, const Type& type, const Path& path) {
  return fail(node, path, "must be " + describe(type) + ", and is " + what_it_is(node));
}

bool is_kind(const toml::node& node, Kind kind) {
  switch (kind) {
    case Kind::boolean:
      return node.is_boolean();
    case Kind::integer:
      return node.is_integer();
    case Kind::number:
      return node.is_number();
    case Kind::text:
    case Kind::choice:
    case Kind::name:
      return node.is_string();
    case Kind::table:
    case Kind::named:
      return node.is_table();
    case Kind::tuple:
    case Kind::list:
    case Kind::tables:
      return node.is_array();
    case Kind::either:
      break;
  }
  return true;
}

bool Checker::check_kind(const toml::node& node, const Type& type, const Path& path) {
  if (!is_kind(node, type.kind)) return wrong(node, type, path);
  switch (type.kind) {
    case Kind::boolean:
      return true;
    case Kind::integer:
    case Kind::number:
      return check_number(node, type, path);
    case Kind::text:
      return check_text(node, type, path);
    case Kind::choice:
      return check_choice(node, type, type, path);
    case Kind::name:
      return check_name(node, type, path);
    case Kind::tuple:
      return check_tuple(node, type, path);
    case Kind::list:
    case Kind::tables:
      return check_list(node, type, path);
    case Kind::table:
      return check_fields(*node.as_table(), *type.table, path);
    case Kind::named:
      return check_named(node, type, path);
    case Kind::either:
      break;
  }
  return check_either(node, type, path);
}

bool Checker::check_number(const toml::node& node, const Type& type, const Path& path) {
  const double x = number(node);
  return (x >= type.low && x <= type.high) || wrong(node, type, path);
}

bool Checker::check_text(const toml::node& node, const Type& type, const Path& path) {
  const std::string& text = node.as_string()->get();
  if (text.find('\0') != std::string::npos) return fail(node, path, "holds U+0000, which no text here may");
  return text.size() <= type.most || wrong(node, type, path);
}

/// `all`: what else the value might be, besides one of the choices.
bool Checker::check_choice(const toml::node& node, const Type& choice, const Type& all, const Path& path) {
  const std::string& word = node.as_string()->get();
  if (std::find(choice.choices.begin(), choice.choices.end(), word) != choice.choices.end()) return true;
  return fail(node, path,
              "must be " + describe(all) + ", and is " + in_quotes(word) + suggestion(word, choice.choices));
}

bool Checker::check_name(const toml::node& node, const Type& type, const Path& path) {
  const std::string& word = node.as_string()->get();
  const toml::table* entries = root_[type.of].as_table();
  if (entries && entries->contains(word)) return true;
  if (type.of == "materials" && word == "default") return true;  // it needs no entry
  std::vector<std::string> known;
  if (entries)
    for (const auto& [name, entry] : *entries) known.emplace_back(name.str());
  if (type.of == "materials" && !(entries && entries->contains("default"))) known.emplace_back("default");
  return fail(node, path,
              "there is no " + in_quotes(word) + " in [" + type.of + "]" +
                  (known.empty() ? ", which is empty" : nearest_or_all(word, known)));
}

bool Checker::check_tuple(const toml::node& node, const Type& type, const Path& path) {
  const toml::array& list = *node.as_array();
  if (list.size() != type.parts.size()) return wrong(node, type, path);
  bool good = true;
  for (std::size_t i = 0; i < list.size(); ++i)
    good = check(*list.get(i), type.parts[i], Path(path, i)) && good;
  return good;
}

bool Checker::check_list(const toml::node& node, const Type& type, const Path& path) {
  const toml::array& list = *node.as_array();
  if (type.kind == Kind::list && (list.size() < type.least || list.size() > type.most))
    return wrong(node, type, path);
  bool good = true;
  Type entry = type;
  entry.kind = Kind::table;
  const Type& part = type.kind == Kind::tables ? entry : type.parts[0];
  for (std::size_t i = 0; i < list.size(); ++i) good = check(*list.get(i), part, Path(path, i)) && good;
  return good;
}

bool Checker::check_named(const toml::node& node, const Type& type, const Path& path) {
  bool good = true;
  for (const auto& [name, entry] : *node.as_table()) {
    if (name.str().find('\0') != std::string_view::npos)
      good = fail(entry, Path(path, name.str()), "has U+0000 in its name, which no name here may");
    good = check(entry, type.parts[0], Path(path, name.str())) && good;
  }
  return good;
}

bool Checker::check_either(const toml::node& node, const Type& type, const Path& path) {
  for (const Type& part : type.parts)
    if (is_kind(node, part.kind))
      return part.kind == Kind::choice ? check_choice(node, part, type, path) : check_kind(node, part, path);
  return wrong(node, type, path);
}

/// Where the key stands; one that an override brought has its value's place.
const toml::source_region& place_of(const toml::key& key, const toml::node& node) {
  return key.source().begin.line > 0 && key.source().path ? key.source() : node.source();
}

bool Checker::check_field(const toml::key& key, const toml::node& node, const Table& table,
                          const Path& path) {
  for (const Field& field : table.fields) {
    if (field.key != key.str()) continue;
    if (!field.later) return check(node, field.type, path);
    report_.error(place_of(key, node), path.text(), "not supported yet: " + path.text());
    return false;
  }
  std::vector<std::string> known;
  for (const Field& field : table.fields)
    if (!field.later) known.push_back(field.key);
  report_.error(place_of(key, node), path.text(), "unknown key" + nearest_or_all(key.str(), known));
  return false;
}

bool Checker::check_present(const toml::table& node, const Table& table, const Path& path) {
  bool good = true;
  for (const Field& field : table.fields) {
    if (!field.required || node.contains(field.key)) continue;
    report_.error(node.source(), Path(path, field.key).text(), "is missing: " + describe(field.type));
    good = false;
  }
  return good;
}

bool Checker::check_one_of(const toml::table& node, const Table& table, const Path& path) {
  if (table.one_of.empty()) return true;
  std::string present, allowed;
  int count = 0;
  for (const std::string& key : table.one_of) {
    allowed += (allowed.empty() ? "" : ", ") + key;
    if (node.contains(key)) present += (count++ == 0 ? "" : ", ") + key;
  }
  if (count == 1) return true;
  return fail(node, path, "needs exactly one of " + allowed + ", and has " + (count == 0 ? "none" : present));
}

bool Checker::check_fields(const toml::table& node, const Table& table, const Path& path) {
  bool good = true;
  for (const auto& [key, value] : node) good = check_field(key, value, table, Path(path, key.str())) && good;
  good = check_present(node, table, path) && good;
  return check_one_of(node, table, path) && good;
}

}  // namespace

void check(const toml::table& root, const Table& grammar, Report& report) {
  Checker checker(root, report);
  if (!checker.check_fields(root, grammar, Path())) report.mark_bad(root);
}

}  // namespace throng::scenarios
