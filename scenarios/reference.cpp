// SPDX-License-Identifier: MIT
#include "scenarios/reference.h"

#include <algorithm>

namespace throng::scenarios {

namespace {

using Kind = Type::Kind;

constexpr std::size_t kColumn = 34;  // where the meaning begins

void list_fields(const Table& table, const std::string& prefix, std::string& text);

/// The fields within a value of that type, if it has any. `path`: the value's own.
void list_within(const Type& type, const std::string& path, std::string& text) {
  if (type.kind == Kind::table) list_fields(*type.table, path + ".", text);
  if (type.kind == Kind::tables) list_fields(*type.table, path + "[].", text);
  if (type.kind == Kind::named) list_within(type.parts[0], path + ".NAME", text);
  if (type.kind == Kind::either)
    for (const Type& part : type.parts) list_within(part, path, text);
}

bool has_fields(const Type& type) {
  return type.kind == Kind::table || type.kind == Kind::tables || type.kind == Kind::named;
}

/// " Just one of box, periodic.", of what there is so far.
std::string alternatives(const Table& table) {
  std::string text = " Just one of";
  for (const Field& field : table.fields) {
    if (field.later || std::ranges::find(table.one_of, field.key) == table.one_of.end()) continue;
    text += (text.ends_with("of") ? " " : ", ") + field.key;
  }
  return text + ".";
}

void list_fields(const Table& table, const std::string& prefix, std::string& text) {
  for (const Field& field : table.fields) {
    if (field.later) continue;
    const std::string path = prefix + field.key;
    text += path + std::string(path.size() < kColumn ? kColumn - path.size() : 1, ' ') + field.doc;
    if (field.required) text += " Required.";
    if (std::ranges::find(table.one_of, field.key) != table.one_of.end()) text += alternatives(table);
    if (!has_fields(field.type)) text += "\n" + std::string(kColumn + 2, ' ') + describe(field.type);
    if (!field.preset.empty()) text += "; " + field.preset + " when absent";
    text += "\n";
    list_within(field.type, path, text);
  }
}

}  // namespace

std::string reference(const Table& grammar, const std::string& about) {
  std::string text = about + "\n\n";
  list_fields(grammar, "", text);
  return text;
}

std::string reference() {
  return reference(grammar(), "Scenario files are TOML. SI units, radians, counter-clockwise polygons.");
}

}  // namespace throng::scenarios
