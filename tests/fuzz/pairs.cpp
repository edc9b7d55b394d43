// SPDX-License-Identifier: MIT
// A line of `throng pairs`: refused by InputError, or answered in finite numbers that fit together.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/input_error.h"
#include "tests/fuzz/fuzz.h"
#include "tools/pair_answer.h"

namespace throng::fuzz {

namespace {

using Json = nlohmann::ordered_json;
using narrowphase::Convex;
using narrowphase::Vec;
using tools::PairQuery;
using tools::Solid;

double scale(const Solid& solid) {
  double size = solid.pose.position.cwiseAbs().maxCoeff();
  for (const Convex& part : solid.parts)
    for (const Vec& v : part.vertices) size = std::max(size, v.cwiseAbs().maxCoeff() + part.radius);
  return size;
}

Vec vec(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>()};
}

bool is_finite(const Json& value) {
  if (value.is_structured()) return std::all_of(value.begin(), value.end(), is_finite);
  return !value.is_number_float() || std::isfinite(value.get<double>());
}

/// b, moved by its way out, at most touches a.
void check_way_out(PairQuery query, const Vec& way_out, double size) {
  query.b.pose.position += way_out;
  expect(answer(query)["distance"].get<double>() >= -1e-14 * size, "the way out parts the two");
}

/// Hits and doubts have a time on the way; what collides at the start hits there.
void check_motion(const PairQuery& query, const Json& answer) {
  expect(answer.contains("motion") == query.until.has_value(), "a path is answered");
  if (!query.until) return;
  const bool free = answer["motion"] == "free", hit = answer["motion"] == "hit";
  expect(answer.contains("time_bracket") == !free && answer.contains("time_of_impact") == hit,
         "with its time");
  if (answer["collide"].get<bool>()) expect(hit && answer["time_of_impact"] == 0.0, "collides at once");
  if (free) return;
  const double from = answer["time_bracket"][0], to = answer["time_bracket"][1];
  expect(0.0 <= from && from <= to && to <= *query.until, "the bracket lies on the way");
}

/// Returns the answer.
Json checked_answer(const PairQuery& query, double size) {
  const Json answer = tools::answer(query);
  expect(is_finite(answer), "all figures are finite");
  const double distance = answer["distance"], lower = answer["lower"], upper = answer["upper"];
  expect(lower <= upper && upper == distance, "lower <= upper == distance");
  if (distance > 0.0)
    expect(upper <= (1.0 + query.epsilon) * lower * (1.0 + 1e-15),
           "apart, epsilon bounds how far they are off");
  expect(answer["collide"] == (distance <= 0.0), "what is not apart collides");
  const Vec normal = vec(answer["normal"]);
  expect(std::abs(normal.norm() - 1.0) <= 1e-15, "the normal has length 1");
  if (answer.contains("way_out")) {
    const Vec way_out = vec(answer["way_out"]);
    expect(std::abs(way_out.norm() + lower) <= 1e-14 * size, "the way out is as long as it says");
    check_way_out(query, way_out, size);
  }
  check_motion(query, answer);
  const Vec off = vec(answer["point_a"]) + distance * normal - vec(answer["point_b"]);
  expect(off.cwiseAbs().maxCoeff() <= 1e-14 * size, "the points are the distance apart");
  return answer;
}

}  // namespace

}  // namespace throng::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng;
  try {
    const fuzz::Json line = tools::parse_line({reinterpret_cast<const char*>(data), size});
    tools::read_id(line);
    tools::PairQuery query = tools::read_pair(line);
    const double length = fuzz::scale(query.a) + fuzz::scale(query.b);
    const fuzz::Json one = fuzz::checked_answer(query, length);
    std::swap(query.a, query.b);
    const fuzz::Json other = fuzz::checked_answer(query, length);
    fuzz::expect(one["collide"] == other["collide"], "swapped solids collide as much");
    if (query.epsilon == 0.0)
      fuzz::expect(one["distance"] == other["distance"], "swapped solids are as far apart");
  } catch (const InputError&) {
  }
  return 0;
}
