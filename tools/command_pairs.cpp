// SPDX-License-Identifier: MIT
// throng pairs: the narrowphase as a calculator, JSON Lines in and out.
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
bool answer_all(std::istream& in, bool work) {
  bool good = true;
  std::string line;
  for (std::size_t number = 1; read_line(in, line); ++number) try {
      if (line.size() > kLongestLine) throw InputError("longer than 16 MB");
      print(answer(read_pair(line), work));
    } catch (const InputError& error) {
      print({{"line", number}, {"error", error.what()}});
      good = false;
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
  command->callback([file, work, &exit_code] { exit_code = answer_file(*file, *work) ? 0 : 2; });
}

}  // namespace throng::tools
