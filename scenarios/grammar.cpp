// SPDX-License-Identifier: MIT
#include "scenarios/grammar.h"

#include "scenarios/limits.h"
#include "scenarios/report.h"

namespace throng::scenarios {

namespace {

using Kind = Type::Kind;

Type of_kind(Kind kind, std::string called = "") {
  Type type;
  type.kind = kind;
  type.called = std::move(called);
  return type;
}

Type boolean() {
  return of_kind(Kind::boolean);
}

Type number(double low, double high, std::string unit = "") {
  Type type = of_kind(Kind::number);
  type.low = low, type.high = high, type.unit = std::move(unit);
  return type;
}

Type integer(double low, double high) {
  Type type = number(low, high);
  type.kind = Kind::integer;
  return type;
}

Type text(std::size_t most = 65536, std::string called = "") {
  Type type = of_kind(Kind::text, std::move(called));
  type.most = most;
  return type;
}

Type choice(std::vector<std::string> choices, std::vector<std::string> later = {}) {
  Type type = of_kind(Kind::choice);
  type.choices = std::move(choices), type.later = std::move(later);
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

Type list(Type part, std::size_t least, std::string called, std::size_t most = kMostItems) {
  Type type = of_kind(Kind::list, std::move(called));
  type.parts = {std::move(part)}, type.least = least, type.most = most;
  return type;
}

Type either(std::vector<Type> parts) {
  Type type = of_kind(Kind::either);
  type.parts = std::move(parts);
  return type;
}

Type table(Table fields, Kind kind = Kind::table) {
  Type type = of_kind(kind);
  type.table = std::make_shared<const Table>(std::move(fields));
  return type;
}

Type tables(Table fields) {
  return table(std::move(fields), Kind::tables);
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
Type speed() {
  return number(-kFastest, kFastest, "m/s");
}
Type point() {
  return tuple({coordinate(), coordinate()}, "a point [x, y]");
}
Type points(std::size_t least, std::string called, std::size_t most = kMostItems) {
  return list(point(), least, std::move(called), most);
}
Type box() {
  return tuple({point(), point()}, "a box [[min x, min y], [max x, max y]]");
}

Type uniform(Type bound, const std::string& doc) {
  return table({{required({"uniform", tuple({bound, bound}, "two bounds [low, high]"), doc})}});
}

Type time_table() {
  return table({{{"dt", number(kShortestStep, 1e6, "s"), "Length of a step, s.", "0.01"},
                 {"until", number(0, 1e12, "s"), "When the simulation ends, s.", "10.0"},
                 {"substeps", integer(1, 1000), "Solver substeps within a step.", "4"}}});
}

Type domain_table() {
  return table({{{"box", box(), "Four walls of the default material round this box, m."},
                 {"periodic", box(), "A box, m, whose opposite sides are one: what leaves comes in again."}},
                {"box", "periodic"}});
}

Type contact_table() {
  return table({{{"model", choice({"impulse", "none"}, {"spring", "hertz"}),
                  "How bodies push each other; none: they pass through.", "\"impulse\""}}});
}

Type record_table() {
  return table(
      {{{"every", integer(1, 1e9), "Steps from one recorded frame to the next.", "1"},
        {"fields", list(choice({"position", "angle", "velocity", "spin"}), 1, "a list of fields", 16),
         "What a frame holds.", "[\"position\", \"angle\", \"velocity\"]"},
        {"precision", choice({"double", "single"}), "Width of recorded numbers.", "\"double\""},
        later("quantize", "Store positions rounded to this many metres.")}});
}

Type material_table() {
  return table(
      {{{"density", number(1e-9, 1e12, "kg/m^2"), "Mass per area, kg/m^2.", "1.0"},
        {"restitution", number(0, 1), "Speed after over speed before an impact; a pair takes the larger.",
         "0.0"},
        {"friction", number(0, 1e6), "Coulomb's coefficient; a pair takes the geometric mean.", "0.5"}}});
}

Type disc_table() {
  return table(
      {{required({"radius", either({length(), uniform(length(), "Each body's own, m, between these.")}),
                  "Radius, m."})}});
}

Type shape_table() {
  return table(
      {{{"disc", disc_table(), "A disc."},
        {"polygon", points(3, "a list of 3 to 10000 points [x, y]", kMostVertices),
         "A simple polygon, convex or not, counter-clockwise, m."},
        {"discs",
         list(tuple({coordinate(), coordinate(), length()}, "a disc [x, y, radius]"), 1,
              "a list of 1 to 1000 discs [x, y, radius]", kMostParts),
         "One rigid body of several discs: x, y, radius, m."},
        {"holes",
         list(points(3, "a list of 3 to 10000 points [x, y]", kMostVertices), 0,
              "a list of at most 1000 holes, each a list of points [x, y]", kMostHoles),
         "What is cut out of the polygon: simple polygons in it that don't touch it or each other, m.",
         "[]"}},
       {"disc", "polygon", "discs"}});
}

Type place_table() {
  const Type random =
      table({{required({"within", box(), "Box, m, that holds all of every body."}),
              {"gap", number(0, kFarthest, "m"), "Least distance to any other body and wall, m.", "0.0"}}});
  const Type lattice =
      table({{required({"origin", point(), "Where the first body's centre of mass stands, m."}),
              required({"spacing", tuple({coordinate(), coordinate()}, "a pair [dx, dy]"),
                        "From column to column and from row to row, m."}),
              required({"size",
                        tuple({integer(1, kMostBodies), integer(1, kMostBodies)},
                              "a pair of counts [columns, rows]"),
                        "How many columns and rows; filled row by row."})}});
  return table({{{"random", random, "Anywhere that is free, uniformly at random."},
                 {"lattice", lattice, "A rectangular lattice."},
                 later("file", "Positions from a file.")},
                {"random", "lattice", "file"}});
}

Table body_table() {
  const Type maxwell = table({{required(
      {"maxwell", number(0, kFastest, "m/s"),
       "Standard deviation of each component, m/s; the total momentum of this entry is removed."})}});
  const Type angles = uniform(number(-kFarthest, kFarthest, "rad"), "Each body's own, rad, between these.");
  return {{required({"shape", name_in("shapes"), "Name of a shape."}),
           {"at", point(), "Where the centre of mass stands, m."},
           {"place", place_table(), "How to place more than one body."},
           {"count", integer(0, kMostBodies), "How many bodies; a lattice's own size when absent.", "1"},
           {"angle", either({number(-kFarthest, kFarthest, "rad"), angles}),
            "Rotation about the centre of mass, rad.", "0.0"},
           {"velocity", either({tuple({speed(), speed()}, "a velocity [vx, vy]"), maxwell}),
            "Of the centre of mass, m/s.", "[0.0, 0.0]"},
           {"spin", number(-kFastest, kFastest, "rad/s"), "Angular velocity, rad/s.", "0.0"},
           {"material", name_in("materials"), "Name of a material.", "\"default\""},
           {"kind", choice({"dynamic", "static", "kinematic"}),
            "dynamic: moved by forces; static: never moves; kinematic: moves as told, whatever it meets.",
            "\"dynamic\""}},
          {"at", "place"}};
}

Table wall_table() {
  return {
      {{"segment", tuple({point(), point()}, "two points [[x, y], [x, y]]"), "A straight wall, m."},
       {"polyline", points(2, "a list of at least 2 points [x, y]"), "A wall through these points, m."},
       {"polygon", points(3, "a list of at least 3 points [x, y]"), "A closed wall through these points, m."},
       {"wkt", text(kMostBytes, "a well-known text such as \"LINESTRING (0 0, 1 0)\""),
        "LINESTRING, POLYGON (each ring a closed wall) and their MULTI forms, m."},
       {"material", name_in("materials"), "Name of a material.", "\"default\""}},
      {"segment", "polyline", "polygon", "wkt"}};
}

Table root_table() {
  return {
      {required({"throng", version(), "Version of this grammar."}),
       {"name", text(256), "A short name.", "\"\""},
       {"description", text(1000), "One line on what is to be seen.", "\"\""},
       {"seed", integer(0, 0x1p53 - 1), "All that is random follows from it.", "1"},
       {"engine", choice({"native", "box2d"}, {"event_driven"}), "What computes the motion.", "\"native\""},
       {"gravity",
        tuple({number(-kFarthest, kFarthest, "m/s^2"), number(-kFarthest, kFarthest, "m/s^2")},
              "an acceleration [x, y]"),
        "Acceleration of everything dynamic, m/s^2.", "[0.0, 0.0]"},
       {"sleep", boolean(), "Bodies at rest may leave the loop.", "false"},
       {"time", time_table(), "Steps and their end."},
       {"domain", domain_table(), "Where bodies may be; absent: the unbounded plane."},
       {"contact", contact_table(), "What happens where bodies touch."},
       {"record", record_table(), "What a recording holds."},
       {"materials", named(material_table()), "Materials by name; one called default is always there."},
       {"shapes", named(shape_table()), "Shapes by name."},
       {"bodies", tables(body_table()), "Bodies, one or many an entry; ids count from 1 in this order."},
       {"walls", tables(wall_table()), "Thin walls with two sides, which never move."},
       later("walkable", "Where agents may be."),
       later("areas", "Named areas."),
       later("agents", "Crowds."),
       later("sensors", "Who senses whom."),
       later("measure", "Counts and densities.")}};
}

std::string range(const Type& type) {
  if (type.kind == Kind::integer)
    return " from " + std::to_string(static_cast<std::int64_t>(type.low)) + " to " +
           std::to_string(static_cast<std::int64_t>(type.high));
  return " from " + to_text(type.low) + " to " + to_text(type.high) +
         (type.unit.empty() ? "" : " " + type.unit);
}

std::string one_of(const std::vector<std::string>& words) {
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

}  // namespace

const Table& grammar() {
  static const Table root = root_table();
  return root;
}

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
      return describe(type.parts[0]) + ", or " + describe(type.parts[1]);
    case Kind::tuple:
    case Kind::list:
      break;
  }
  return "a list";
}

}  // namespace throng::scenarios
