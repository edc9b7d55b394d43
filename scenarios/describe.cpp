// SPDX-License-Identifier: MIT
#include "scenarios/grammar.h"
#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

using Kind = Type::Kind;

std::string range(const Type& type) {
  if (type.kind == Kind::integer)
    return " from " + std::to_string(static_cast<std::int64_t>(type.low)) + " to " +
           std::to_string(static_cast<std::int64_t>(type.high));
  return " from " + to_text(type.low) + " to " + to_text(type.high) +
         (type.unit.empty() ? "" : " " + type.unit);
}

std::string one_of(const std::vector<std::string>& words) {
  if (words.size() == 1) return in_quotes(words[0]);
  std::string result = "one of";
  for (const std::string& word : words) result += (&word == &words.front() ? " " : ", ") + in_quotes(word);
  return result;
}

std::string keys(const Table& table) {
  std::string result = "a table { ";
  for (const Field& field : table.fields)
    if (!field.later) result += (&field == &table.fields.front() ? "" : ", ") + field.key;
  return result + " }";
}

std::string alternatives(const std::vector<Type>& types) {
  std::string result;
  for (const Type& type : types) result += (result.empty() ? "" : ", or ") + describe(type);
  return result;
}

}  // namespace

std::string describe(const Type& type) {
  if (!type.called.empty()) return type.called;
  switch (type.kind) {
    case Kind::boolean:
      return "true or false";
    case Kind::integer:
      return "an integer" + range(type);
    case Kind::number:
      return "a number" + range(type);
    case Kind::text:
      return "a string of at most " + std::to_string(type.most) + " bytes";
    case Kind::choice:
      return one_of(type.choices);
    case Kind::name:
      return "the name of an entry of [" + type.of + "]";
    case Kind::table:
      return keys(*type.table);
    case Kind::tables:
      return "a list of tables [[...]]";
    case Kind::named:
      return "a table of names";
    case Kind::either:
      return alternatives(type.parts);
    case Kind::tuple:
    case Kind::list:
      break;
  }
  return "a list";
}

}  // namespace throng::scenarios
