// SPDX-License-Identifier: MIT
#include "tools/pair_query.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "narrowphase/decompose.h"
#include "narrowphase/holes.h"
#include "sim/input_error.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;
using narrowphase::Convex;
using narrowphase::Vec;

constexpr int kDeepest = 8;                   // levels of nesting that any line needs, and some
constexpr std::size_t kMostVertices = 20000;  // of a polygon: seconds, not minutes
constexpr std::size_t kMostDiscs = 20000;     // of a composite, likewise
constexpr double kLargest = 1e100;            // m
constexpr double kLeast = 1e-140;             // m; squares of smaller lengths lose their digits

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw InputError(path + ": " + what);
}

/// Refuses what a DOM would hide: keys that are there twice, and towers of brackets.
class Guard {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& value) {
    using Event = Json::parse_event_t;
    if (depth > kDeepest) throw InputError("nested more than " + std::to_string(kDeepest) + " levels deep");
    if (event == Event::object_start) keys_.emplace_back();
    if (event == Event::object_end) keys_.pop_back();
    if (event == Event::key && !keys_.back().insert(value.get<std::string>()).second)
      throw InputError("the key \"" + value.get<std::string>() + "\" is there twice");
    return true;
  }

 private:
  std::vector<std::set<std::string>> keys_;
};

/// The parser counts lines from the one that it was given.
std::string without_line(std::string message) {
  const std::string prefix = "at line 1, column";
  const std::size_t at = message.find(prefix);
  return at == std::string::npos ? message : message.replace(at, prefix.size(), "at column");
}

void check_keys(const Json& object, const std::string& path, std::initializer_list<const char*> allowed) {
  if (!object.is_object()) fail(path, "an object is expected");
  for (const auto& item : object.items()) {
    if (std::find(allowed.begin(), allowed.end(), item.key()) != allowed.end()) continue;
    std::string list;
    for (const char* key : allowed) list += (list.empty() ? "" : ", ") + std::string(key);
    fail(path, "unknown key \"" + item.key() + "\"; allowed: " + list);
  }
}

double read_number(const Json& value, const std::string& path) {
  if (!value.is_number()) fail(path, "a number is expected");
  const double x = value.get<double>();
  if (!(std::abs(x) <= kLargest)) fail(path, "a number up to 1e100 in size is expected");
  return x;
}

double length(const Json& value, const std::string& path) {
  const double x = read_number(value, path);
  if (x < 0.0) fail(path, "must not be negative");
  return x;
}

const Json& array(const Json& value, const std::string& path, std::size_t size) {
  if (!value.is_array() || value.size() != size)
    fail(path, "a list of " + std::to_string(size) + " is expected");
  return value;
}

std::string at(const std::string& path, std::size_t i) {
  return path + "[" + std::to_string(i) + "]";
}

double coordinate(const Json& value, const std::string& path) {
  const double x = read_number(value, path);
  if (x != 0.0 && std::abs(x) < kLeast) fail(path, "0 or a number of at least 1e-140 in size is expected");
  return x;
}

Vec point(const Json& value, const std::string& path) {
  array(value, path, 2);
  return {coordinate(value[0], at(path, 0)), coordinate(value[1], at(path, 1))};
}

double optional_number(const Json& object, const std::string& path, const char* key) {
  return object.contains(key) ? read_number(object[key], path + "." + key) : 0.0;
}

Vec optional_point(const Json& object, const std::string& path, const char* key) {
  return object.contains(key) ? point(object[key], path + "." + key) : Vec{0.0, 0.0};
}

/// Unlike a point it may be as small as it likes.
Vec velocity(const Json& solid, const std::string& path) {
  if (!solid.contains("velocity")) return {0.0, 0.0};
  const std::string here = path + ".velocity";
  const Json& value = array(solid["velocity"], here, 2);
  return {read_number(value[0], at(here, 0)), read_number(value[1], at(here, 1))};
}

double rounding(const Json& solid, const std::string& path) {
  return solid.contains("radius") ? length(solid["radius"], path + ".radius") : 0.0;
}

std::vector<Vec> read_ring(const Json& value, const std::string& path) {
  if (!value.is_array()) fail(path, "a list of points is expected");
  if (value.size() > kMostVertices)
    fail(path, "at most " + std::to_string(kMostVertices) + " vertices are supported");
  std::vector<Vec> vertices;
  for (std::size_t i = 0; i < value.size(); ++i) vertices.push_back(point(value[i], at(path, i)));
  return vertices;
}

/// The outline, then the holes.
std::vector<std::vector<Vec>> read_rings(const Json& solid, const std::string& path) {
  std::vector<std::vector<Vec>> rings{read_ring(solid["polygon"], path + ".polygon")};
  if (!solid.contains("holes")) return rings;
  const Json& holes = solid["holes"];
  if (!holes.is_array()) fail(path + ".holes", "a list of lists of points is expected");
  std::size_t vertices = rings[0].size();
  for (std::size_t i = 0; i < holes.size(); ++i) {
    rings.push_back(read_ring(holes[i], at(path + ".holes", i)));
    vertices += rings.back().size();
    if (vertices > kMostVertices)
      fail(path + ".holes",
           "at most " + std::to_string(kMostVertices) + " vertices with the polygon's are supported");
  }
  return rings;
}

std::vector<Convex> read_polygon(const Json& solid, const std::string& path, double radius,
                                 std::vector<std::string>& repairs) {
  const auto place = [&](std::size_t ring) {
    return ring == 0 ? path + ".polygon" : at(path + ".holes", ring - 1);
  };
  const narrowphase::CleanedRings cleaned = narrowphase::clean(read_rings(solid, path));
  if (!cleaned.refusal.text.empty()) fail(place(cleaned.refusal.ring), cleaned.refusal.text);
  for (const narrowphase::RingNote& repair : cleaned.repairs)
    repairs.push_back(place(repair.ring) + ": " + repair.text);
  return narrowphase::decompose(cleaned.rings, radius);
}

Convex read_disc(const Json& value, const std::string& path) {
  check_keys(value, path, {"at", "radius"});
  if (!value.contains("radius")) fail(path, "radius is missing");
  return narrowphase::disc(length(value["radius"], path + ".radius"), optional_point(value, path, "at"));
}

std::vector<Convex> read_discs(const Json& value, const std::string& path) {
  if (!value.is_array() || value.empty()) fail(path, "a list of [x, y, radius] is expected");
  if (value.size() > kMostDiscs) fail(path, "at most " + std::to_string(kMostDiscs) + " discs are supported");
  std::vector<Convex> parts;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string here = at(path, i);
    array(value[i], here, 3);
    parts.push_back(
        narrowphase::disc(length(value[i][2], at(here, 2)),
                          {coordinate(value[i][0], at(here, 0)), coordinate(value[i][1], at(here, 1))}));
  }
  return parts;
}

Convex read_segment(const Json& value, const std::string& path, double radius) {
  array(value, path, 2);
  const Vec p = point(value[0], at(path, 0)), q = point(value[1], at(path, 1));
  if (p == q) fail(path, "its two ends must differ");
  return narrowphase::segment(p, q, radius);
}

std::vector<Convex> read_parts(const Json& solid, const std::string& path,
                               std::vector<std::string>& repairs) {
  const int kinds = solid.contains("polygon") + solid.contains("disc") + solid.contains("segment") +
                    solid.contains("discs");
  if (kinds != 1) fail(path, "one of polygon, disc, segment, discs is expected");
  const bool can_be_rounded = solid.contains("polygon") || solid.contains("segment");
  if (solid.contains("radius") && !can_be_rounded)
    fail(path + ".radius", "only a polygon or a segment is rounded");
  if (solid.contains("holes") && !solid.contains("polygon"))
    fail(path + ".holes", "only a polygon has holes");
  if (solid.contains("polygon")) return read_polygon(solid, path, rounding(solid, path), repairs);
  if (solid.contains("segment"))
    return {read_segment(solid["segment"], path + ".segment", rounding(solid, path))};
  if (solid.contains("disc")) return {read_disc(solid["disc"], path + ".disc")};
  return read_discs(solid["discs"], path + ".discs");
}

Solid read_solid(const Json& line, const char* name, std::vector<std::string>& repairs) {
  if (!line.contains(name)) fail(name, "is missing");
  const Json& solid = line[name];
  const std::string path = name;
  check_keys(solid, path,
             {"polygon", "holes", "disc", "segment", "discs", "radius", "at", "angle", "velocity", "spin"});
  const narrowphase::Motion motion{optional_point(solid, path, "at"), optional_number(solid, path, "angle"),
                                   velocity(solid, path), optional_number(solid, path, "spin")};
  return {read_parts(solid, path, repairs), narrowphase::pose(motion.position, motion.angle), motion};
}

/// Without an end a path has no first contact, and none may be as far away as one likes.
std::optional<double> read_until(const Json& line, const PairQuery& query) {
  if (line.contains("until")) return length(line["until"], "until");
  for (const Solid* solid : {&query.a, &query.b})
    if (solid->motion.velocity != Vec{0.0, 0.0} || solid->motion.spin != 0.0)
      fail("until", std::string("is missing, but ") + (solid == &query.a ? "a" : "b") + " moves");
  return {};
}

}  // namespace

Json parse_line(std::string_view text) {
  if (text.find_first_not_of(" \t\r") == std::string_view::npos) throw InputError("the line is empty");
  Guard guard;
  try {
    return Json::parse(text.begin(), text.end(), [&guard](int depth, Json::parse_event_t event, Json& value) {
      return guard(depth, event, value);
    });
  } catch (const Json::exception& error) {
    const std::string what = error.what();
    const std::size_t bracket = what.find("] ");
    throw InputError("not JSON: " +
                     without_line(bracket == std::string::npos ? what : what.substr(bracket + 2)));
  }
}

Json read_id(const Json& line) {
  if (!line.is_object() || !line.contains("id")) return {};
  const Json& id = line["id"];
  if (!id.is_null() && !id.is_string() && !id.is_number()) fail("id", "a string or a number is expected");
  return id;
}

PairQuery read_pair(const Json& line) {
  check_keys(line, "line", {"id", "a", "b", "epsilon", "until"});
  PairQuery query;
  if (line.contains("epsilon")) query.epsilon = length(line["epsilon"], "epsilon");
  query.a = read_solid(line, "a", query.repairs);
  query.b = read_solid(line, "b", query.repairs);
  query.until = read_until(line, query);
  return query;
}

}  // namespace throng::tools
