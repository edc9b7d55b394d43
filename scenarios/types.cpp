// SPDX-License-Identifier: MIT
#include "scenarios/types.h"

namespace throng::scenarios::types {

namespace {

using Kind = Type::Kind;

Type of_kind(Kind kind, std::string called = "") {
  Type type;
  type.kind = kind;
  type.called = std::move(called);
  return type;
}

Type table_of(Table fields, Kind kind) {
  Type type = of_kind(kind);
  type.table = std::make_shared<const Table>(std::move(fields));
  return type;
}

}  // namespace

Type boolean() {
  return of_kind(Kind::boolean);
}

Type number(double low, double high, std::string unit) {
  Type type = of_kind(Kind::number);
  type.low = low, type.high = high, type.unit = std::move(unit);
  return type;
}

Type integer(double low, double high) {
  Type type = number(low, high);
  type.kind = Kind::integer;
  return type;
}

Type text(std::size_t most, std::string called) {
  Type type = of_kind(Kind::text, std::move(called));
  type.most = most;
  return type;
}

Type choice(std::vector<std::string> choices) {
  Type type = of_kind(Kind::choice);
  type.choices = std::move(choices);
  return type;
}

Type name_in(std::string of) {
  Type type = of_kind(Kind::name);
  type.of = std::move(of);
  return type;
}

Type tuple(std::vector<Type> parts, std::string called) {
  Type type = of_kind(Kind::tuple, std::move(called));
  type.parts = std::move(parts);
  return type;
}

Type list(Type part, std::size_t least, std::string called, std::size_t most) {
  Type type = of_kind(Kind::list, std::move(called));
  type.parts = {std::move(part)}, type.least = least, type.most = most;
  return type;
}

Type either(std::vector<Type> parts) {
  Type type = of_kind(Kind::either);
  type.parts = std::move(parts);
  return type;
}

Type table(Table fields) {
  return table_of(std::move(fields), Kind::table);
}

Type tables(Table fields) {
  return table_of(std::move(fields), Kind::tables);
}

Type named(Type part) {
  Type type = of_kind(Kind::named);
  type.parts = {std::move(part)};
  return type;
}

/// A field that the grammar knows and this version refuses.
Field later(std::string key, std::string doc) {
  Field field{std::move(key), boolean(), std::move(doc)};
  field.later = true;
  return field;
}

Field required(Field field) {
  field.required = true;
  return field;
}

Type version() {
  Type type = integer(1, 1);
  type.called = "1, the version of this grammar";
  return type;
}

Type coordinate() {
  return number(-kFarthest, kFarthest, "m");
}
Type length() {
  return number(kShortest, kFarthest, "m");
}
Type angle() {
  return number(-kFarthest, kFarthest, "rad");
}
Type point() {
  return tuple({coordinate(), coordinate()}, "a point [x, y]");
}
Type points(std::size_t least, std::string called, std::size_t most) {
  return list(point(), least, std::move(called), most);
}
Type box() {
  return tuple({point(), point()}, "a box [[min x, min y], [max x, max y]]");
}

Field polygon_field() {
  return {"polygon", points(3, "a list of 3 to 10000 points [x, y]", kMostVertices),
          "A simple polygon, convex or not, counter-clockwise, m."};
}

Field discs_field() {
  return {"discs",
          list(tuple({coordinate(), coordinate(), length()}, "a disc [x, y, radius]"), 1,
               "a list of 1 to 1000 discs [x, y, radius]", kMostParts),
          "One rigid body of several discs: x, y, radius, m."};
}

Field holes_field() {
  return {"holes",
          list(points(3, "a list of 3 to 10000 points [x, y]", kMostVertices), 0,
               "a list of at most 1000 holes, each a list of points [x, y]", kMostHoles),
          "What is cut out of the polygon: simple polygons in it that don't touch it or each other, m.",
          "[]"};
}

Table wall_lines() {
  return {
      {{"segment", tuple({point(), point()}, "two points [[x, y], [x, y]]"), "A straight wall, m."},
       {"polyline", points(2, "a list of at least 2 points [x, y]"), "A wall through these points, m."},
       {"polygon", points(3, "a list of at least 3 points [x, y]"), "A closed wall through these points, m."},
       {"wkt", text(kMostBytes, "a well-known text such as \"LINESTRING (0 0, 1 0)\""),
        "LINESTRING, POLYGON (each ring a closed wall) and their MULTI forms, m."}},
      {"segment", "polyline", "polygon", "wkt"}};
}

}  // namespace throng::scenarios::types
