// SPDX-License-Identifier: MIT
// throng pairs: the narrowphase as a calculator, JSON Lines in and out.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <memory>

#include "narrowphase/bvh_parts.h"
#include "narrowphase/manifold.h"
#include "sim/input_error.h"
#include "tools/commands.h"
#include "tools/pair_query.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;
using narrowphase::Convex;
using narrowphase::Pose;
using narrowphase::Separation;
using narrowphase::Vec;

constexpr std::size_t kLongestLine = std::size_t{16} << 20;  // bytes

/// How far the solid reaches along a unit vector, from `origin`.
double support(const Solid& solid, const Vec& along, const Vec& origin) {
  double farthest = -std::numeric_limits<double>::infinity();
  const Vec local = solid.pose.unrotate(along);
  for (const Convex& part : solid.parts)
    for (const Vec& v : part.vertices) farthest = std::max(farthest, local.dot(v) + part.radius);
  return farthest + along.dot(solid.pose.position - origin);
}

/// What is surely enough to part two overlapping solids: the shortest of the ways out along their faces'
/// normals.
double sure_depth(const PairQuery& q, const Vec& normal) {
  double least = std::numeric_limits<double>::infinity();
  const auto try_along = [&](const Vec& n) {
    least = std::min(least, support(q.a, n, q.a.pose.position) + support(q.b, -n, q.a.pose.position));
  };
  try_along(normal);
  for (const Convex& part : q.a.parts)
    for (const Vec& n : part.normals) try_along(q.a.pose.rotate(n));
  for (const Convex& part : q.b.parts)
    for (const Vec& n : part.normals) try_along(-q.b.pose.rotate(n));
  return least;
}

Json json(const Vec& v) {
  return {v.x(), v.y()};
}

Json json(const narrowphase::Manifold& m) {
  Json points = Json::array();
  for (int i = 0; i < m.count; ++i) {
    const narrowphase::ManifoldPoint& p = m.points[static_cast<std::size_t>(i)];
    points.push_back({{"point", json(p.point)}, {"separation", p.separation}});
  }
  return points;
}

Json answer(const PairQuery& q) {
  const Separation s = separation(parts_bvh(q.a.parts), q.a.pose, parts_bvh(q.b.parts), q.b.pose);
  const bool convex = q.a.parts.size() == 1 && q.b.parts.size() == 1;
  Json result;
  if (!q.id.is_null()) result["id"] = q.id;
  result["distance"] = s.distance;
  result["lower"] = convex || s.distance >= 0.0 ? s.distance : std::min(s.distance, -sure_depth(q, s.normal));
  result["upper"] = s.distance;
  result["collide"] = s.distance <= 0.0;
  result["normal"] = json(s.normal);
  result["point_a"] = json(s.point_a);
  result["point_b"] = json(s.point_b);
  if (convex && s.distance <= 0.0)
    result["manifold"] = json(manifold(q.a.parts[0], q.a.pose, q.b.parts[0], q.b.pose, 0.0));
  if (!q.repairs.empty()) result["repairs"] = q.repairs;
  return result;
}

bool is_finite(const Json& value) {
  if (value.is_structured()) return std::all_of(value.begin(), value.end(), is_finite);
  return !value.is_number_float() || std::isfinite(value.get<double>());
}

/// JSON has no word for infinity or NaN, and an answer has no use for them.
Json checked(Json result) {
  if (!is_finite(result)) throw InputError("the answer is too large or too small for a double");
  return result;
}

void print(const Json& line) {
  std::puts(line.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

/// Reads a line, of which no more is kept than proves it too long. False at the end.
bool read_line(std::istream& in, std::string& line) {
  constexpr auto kEnd = std::istream::traits_type::eof();
  line.clear();
  auto c = in.rdbuf()->sbumpc();
  if (c == kEnd) return false;
  for (; c != kEnd && c != '\n'; c = in.rdbuf()->sbumpc())
    if (line.size() <= kLongestLine) line += static_cast<char>(c);
  return true;
}

/// Answers all lines; true if none was faulty.
bool answer_all(std::istream& in) {
  bool good = true;
  std::string line;
  for (std::size_t number = 1; read_line(in, line); ++number) try {
      if (line.size() > kLongestLine) throw InputError("longer than 16 MB");
      print(checked(answer(read_pair(line))));
    } catch (const InputError& error) {
      print({{"line", number}, {"error", error.what()}});
      good = false;
    }
  return good;
}

bool answer_file(const std::string& file) {
  if (file == "-") return answer_all(std::cin);
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) throw InputError(file + ": can't be read");
  return answer_all(in);
}

}  // namespace

void add_pairs(CLI::App& app, int& exit_code) {
  auto file = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("pairs", "Answers exact narrowphase questions: JSON Lines in, JSON Lines out");
  command->add_option("FILE", *file, "a JSON object a line with shapes a and b; - reads standard input")
      ->required();
  command->footer(
      "Shapes, each with an optional pose \"at\": [x, y], \"angle\": rad:\n"
      "  {\"disc\": {\"at\": [x, y], \"radius\": r}}   {\"discs\": [[x, y, r], ...]}\n"
      "  {\"polygon\": [[x, y], ...], \"radius\": r}   {\"segment\": [[x, y], [x, y]], \"radius\": r}\n"
      "Polygons are solids, convex or not. The distance is below 0 where the shapes overlap: minus the "
      "depth.\n"
      "Where one of the two isn't convex, that is the depth of its deepest convex part, a lower bound of "
      "what\n"
      "parts the two; \"lower\" is then minus a translation that surely does.\n"
      "A faulty line is answered by {\"line\": N, \"error\": ...}; the exit code is then 2.\n"
      "Example:\n"
      "  echo '{\"a\": {\"disc\": {\"radius\": 1}}, \"b\": {\"polygon\": [[2,-1],[3,0],[2,1]]}}' | throng "
      "pairs -");
  command->callback([file, &exit_code] { exit_code = answer_file(*file) ? 0 : 2; });
}

}  // namespace throng::tools
