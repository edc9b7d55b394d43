// SPDX-License-Identifier: MIT
// throng pairs: the narrowphase as a calculator, JSON Lines in and out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "sim/input_error.h"
#include "tools/commands.h"
#include "tools/pair_answer.h"

namespace throng::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestLine = std::size_t{16} << 20;  // bytes

constexpr const char* kPairsFooter = R"(A line is {"a": SHAPE, "b": SHAPE}, and may have
  "id"        a string or a number, which the answer has too
  "epsilon"   accepted relative error of the distance, 0 unless given: of many-cornered shapes that are apart,
              a rough distance takes less time
  "until"     the time, 0 or later, up to which the two move: then the answer says whether and when they touch first.
              Needed where one of them moves
SHAPE is one of
  {"disc": {"at": [x, y], "radius": r}}   {"discs": [[x, y, r], ...]}
  {"polygon": [[x, y], ...]}              {"segment": [[x, y], [x, y]]}
A polygon is solid, convex or not, "holes": [[[x, y], ...], ...] taken out; what stands free in a hole is as
far away as the hole's rim.
A polygon or a segment may be rounded by a "radius": it grows, and its holes shrink. Every shape may have a pose: "angle" (rad) turns it about
(0, 0), then "at": [x, y] moves it. Lengths are in any one unit. From there, at time 0, it may move on: its (0, 0)
straight at "velocity": [vx, vy], turning about it at "spin" (rad per unit of time), both the same all the way.

An answer is one line of
  "distance"  of the two shapes; where they overlap it is below 0: minus their depth, where not both are convex
              minus that of the deepest two of the convex parts that they were cut into
  "lower", "upper"
              what the distance lies between, to rounding; "upper" is "distance". Where shapes overlap that are not
              both convex, "lower" is minus the length of "way_out"
  "way_out"   of shapes that overlap and are not both convex: a translation of b after which the two
              at most touch, but for rounding
  "collide"   whether they touch or overlap: exact for any epsilon
  "normal"    unit vector from a to b, of the same two parts as the distance
  "point_a", "point_b"
              the points that are nearest, or deepest: point_b = point_a + distance * normal; with an "epsilon"
              they are as far apart as "upper" says
  "manifold"  of convex shapes that touch or overlap: one or two contact points, each with its "separation"
  "motion"    with "until": "hit" where the two touch at the start or on the way, "free" where they surely don't,
              "undecided" where their gap is 0 within rounding, or stays so small that the computations run out.
              What stands above is of the start
  "time_of_impact"
              of a hit: the first contact, 0 where they touch at the start
  "time_bracket"
              [t, u], of a hit: nothing touches before t, that is certain, the two overlap at u, the time of impact;
              what moves goes 1e-12 of its size between them, or what rounding takes where that is more.
              Undecided: nothing touches before t, what comes then is not known; the gap is 0 within rounding until u,
              or the computations ran out there
  "impact_point", "impact_normal"
              of a hit: where the two touch, midway between them, and the unit normal from a to b
  "repairs"   what was mended in a polygon; only where something was
  "work"      with --work, what the distance took: pairs of bounding volumes ("nodes") and of leaves ("leaves")
              compared, microseconds ("us"); with "until" how many distances the motion took ("looks")
A faulty line is answered by its "id", "line" (counted from 1) and "error"; the exit code is then 2.
Example:
  echo '{"a": {"disc": {"radius": 1}}, "b": {"polygon": [[2,-1],[3,0],[2,1]]}}' | throng pairs -
  echo '{"until": 9, "a": {"disc": {"radius": 1}, "velocity": [1, 0]}, "b": {"segment": [[4,-1],[4,1]]}}' | throng pairs -)";

void print_line(const Json& line) {
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

Json with_id(const Json& id, const Json& rest) {
  Json line;
  if (!id.is_null()) line["id"] = id;
  line.update(rest);
  return line;
}

/// Answers all lines; true if none was faulty.
bool answer_all(std::istream& in, bool work) {
  bool good = true;
  std::string line;
  for (std::size_t number = 1; read_line(in, line); ++number) {
    Json id;
    try {
      if (line.size() > kLongestLine) throw InputError("longer than 16 MB");
      const Json asked = parse_line(line);
      id = read_id(asked);
      print_line(with_id(id, answer(read_pair(asked), work)));
    } catch (const InputError& error) {
      print_line(with_id(id, {{"line", number}, {"error", error.what()}}));
      good = false;
    }
  }
  return good;
}

bool answer_file(const std::string& file, bool work) {
  if (file == "-") return answer_all(std::cin, work);
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) throw InputError(file + ": can't be read");
  return answer_all(in, work);
}

}  // namespace

void add_pairs(CLI::App& app, int& exit_code) {
  auto file = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("pairs", "Answers exact narrowphase questions: JSON Lines in, JSON Lines out");
  command->add_option("FILE", *file, "a JSON object a line with shapes a and b; - reads standard input")
      ->required();
  auto work = std::make_shared<bool>(false);
  command->add_flag("--work", *work,
                    "adds to each answer what its distance took: pairs of volumes and of leaves compared, "
                    "microseconds");
  command->footer(kPairsFooter);
  command->callback([file, work, &exit_code] { exit_code = answer_file(*file, *work) ? 0 : 2; });
}

}  // namespace throng::tools
