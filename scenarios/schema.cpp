// SPDX-License-Identifier: MIT
#include "scenarios/schema.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scenarios/toml.h"

namespace throng::scenarios {

namespace {

using nlohmann::ordered_json;
using Kind = Type::Kind;

ordered_json schema_of(const Type& type);

/// A bound as an integer where it is one: 1 rather than 1.0.
ordered_json bound(double x) {
  if (std::abs(x) <= 0x1p53 && x == std::floor(x)) return static_cast<std::int64_t>(x);
  return x;
}

ordered_json number_schema(const Type& type, const char* name) {
  return {{"type", name}, {"minimum", bound(type.low)}, {"maximum", bound(type.high)}};
}

ordered_json tuple_schema(const Type& type) {
  ordered_json items = ordered_json::array();
  for (const Type& part : type.parts) items.push_back(schema_of(part));
  return {{"type", "array"},
          {"prefixItems", items},
          {"minItems", type.parts.size()},
          {"maxItems", type.parts.size()}};
}

ordered_json list_schema(const Type& type) {
  return {{"type", "array"},
          {"items", schema_of(type.parts[0])},
          {"minItems", type.least},
          {"maxItems", type.most}};
}

ordered_json preset(const std::string& toml_value) {
  const toml::table parsed = toml::parse("value = " + toml_value);
  std::ostringstream json;
  json << toml::json_formatter{parsed};
  return ordered_json::parse(json.str())["value"];
}

ordered_json field(const Field& entry) {
  ordered_json result = schema_of(entry.type);
  result["description"] = entry.doc;
  if (!entry.preset.empty()) result["default"] = preset(entry.preset);
  return result;
}

ordered_json table_schema(const Table& fields) {
  ordered_json properties = ordered_json::object(), required = ordered_json::array(),
               one_of = ordered_json::array();
  for (const Field& entry : fields.fields) {
    if (entry.later) continue;
    properties[entry.key] = field(entry);
    if (entry.required) required.push_back(entry.key);
  }
  ordered_json result = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!required.empty()) result["required"] = required;
  for (const std::string& key : fields.one_of)
    if (properties.contains(key)) one_of.push_back({{"required", {key}}});
  if (!one_of.empty()) result["oneOf"] = one_of;
  return result;
}

ordered_json schema_of(const Type& type) {
  switch (type.kind) {
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::integer:
      return number_schema(type, "integer");
    case Kind::number:
      return number_schema(type, "number");
    case Kind::text:
      return {{"type", "string"}, {"maxLength", type.most}};
    case Kind::choice:
      return {{"enum", type.choices}};
    case Kind::name:
      return {{"type", "string"}};
    case Kind::tuple:
      return tuple_schema(type);
    case Kind::list:
      return list_schema(type);
    case Kind::table:
      return table_schema(*type.table);
    case Kind::tables:
      return {{"type", "array"}, {"items", table_schema(*type.table)}};
    case Kind::named:
      return {{"type", "object"}, {"additionalProperties", schema_of(type.parts[0])}};
    case Kind::either:
      break;
  }
  ordered_json any = ordered_json::array();
  for (const Type& part : type.parts) any.push_back(schema_of(part));
  return {{"anyOf", any}};
}

}  // namespace

std::string schema(const Table& grammar, const std::string& title, const std::string& about) {
  ordered_json result = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}, {"description", about}};
  result.update(table_schema(grammar));
  return result.dump(2) + "\n";
}

std::string schema() {
  return schema(grammar(), "throng scenario", "Printed by throng validate --schema; SI units and radians.");
}

}  // namespace throng::scenarios
