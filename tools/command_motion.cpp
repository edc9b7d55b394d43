// SPDX-License-Identifier: MIT
// throng motion: is a path free, and if not, when is the first contact?
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "scenarios/motion_grammar.h"
#include "scenarios/read_motion.h"
#include "scenarios/reference.h"
#include "sim/input_error.h"
#include "sim/recording/utf8.h"
#include "tools/answer_json.h"
#include "tools/check_outputs.h"
#include "tools/commands.h"
#include "tools/motion_clearance.h"
#include "tools/motion_page.h"
#include "tools/motion_picture.h"
#include "tools/scenario.h"
#include "tools/summary.h"

namespace throng::tools {

namespace {

struct MotionOptions {
  std::string file, png, html;
  double epsilon = 0.0;
  std::optional<double> margin;
  std::optional<std::int64_t> waypoint;
  int width = 1600;
  bool any = false, clearance = false, summary = false, schema = false, fields = false;
};

constexpr const char* kMotionFooter =
    R"(FILE is TOML; --fields lists all that may stand in it, scenarios/motions/ has examples:
  motion = 1
  [shapes]
  post = { disc = { radius = 0.1 } }
  bar  = { segment = [[-1, 0], [1, 0]], radius = 0.05 }
  [[obstacles]]
  shape = "post"
  at = [2, 1.2]
  [[bodies]]
  name = "bar"
  shape = "bar"
  waypoints = [[0, 0, 0], [4, 0, 6.28]]     # x, y and angle of the shape's own origin; angles are not wrapped
All bodies and robots move at once, straight and evenly from waypoint to waypoint: a segment.

The answer is one JSON object:
  "verdict"      of all segments together, the worst: free, undecided, hit
  "evaluations"  how often a distance was computed
  "segments"     of each of them; with --any of a hit only that in which it was found
    "segment"    its number, from 0
    "verdict"    free: nothing touches, which is proven; hit: something does; undecided: something comes so near
                 that rounding decides, or that --epsilon leaves open
    "bracket"    of a hit, fractions of the segment: nothing touches before the first, the pair touches at the
                 second, which is also "fraction"; with --any both are that of some contact
    "in_doubt"   of what is undecided: nothing touches before the first fraction
    "time", "time_bracket", "time_in_doubt"
                 the same in seconds since the start, where the file has durations
    "pair"       who, by their names; of what is undecided the second may be "obstacles", whichever of them
    "point", "normal"
                 of the contact, the normal from the first to the second
    "evaluations" how many of them this segment took; not with --any, which asks all segments at once
  "margin"       m, where there is one: to hit is then to come as near as that; "point" is half way
  "clearance"    with --clearance, of a free path; null where nothing is compared
    "bracket"    m: nothing comes nearer than the first, which is proven, and "pair" comes as near as the second,
                 at "fraction" of "segment" with these nearest "points"; the first is 0.999 of the second or more,
                 but where --epsilon or rounding leaves a doubt: then of the least margin that was undecided
    "evaluations" what that took: at most some 1,000 configurations looked at, fewer of many pairs, then mostly one
                 to ten times the question
With --waypoint N it is of that configuration alone: "verdict", free or hit, "distance" of the "pair" that is nearest
to each other (m; below 0 minus the depth; null where nothing is compared), their "points" and the "normal".
Two links of one robot are compared where two joints or more that move lie between them; limits may rule that out.
What is fixed on a link is one with it: neither is compared with what hangs on the other by one joint. A revolute
joint that keeps its value moves, in this sense.
An answer is an answer: the exit code is 0 for each verdict, and 2 where the file or the command line is faulty.
Examples: throng motion scenarios/motions/sofa.toml --html sofa.html
          throng motion scenarios/motions/arm.toml --any
          throng motion scenarios/motions/post.toml --margin 5e-5 --clearance
          throng motion - --summary < scenarios/motions/crossing.toml)";

MotionTask load_motion_or_throw(const std::string& file) {
  LoadedMotion loaded = load_motion(file);
  const std::string name = file == "-" ? kStandardInput : file;
  expect_sound(loaded.diagnostics, name);
  if (loaded.task.name.empty())
    loaded.task.name = recording::as_utf8(std::filesystem::path(name).stem().string());
  return std::move(loaded.task);
}

using Json = nlohmann::ordered_json;

/// In m; of a bound that is proven, no more than it.
std::string in_metres(double length, bool is_bound) {
  char text[32];
  double shown = length;
  do {
    std::snprintf(text, sizeof text, "%.6g", shown);
    shown -= 1e-6 * length;
  } while (is_bound && std::strtod(text, nullptr) > length);
  return std::string(text) + " m";
}

std::string at_margin(double margin) {
  return margin > 0.0 ? " at a margin of " + in_metres(margin, false) : "";
}

std::string how_far(const MotionDistance& nearest) {
  const double distance = nearest.separation.distance;
  return nearest.a + " – " + nearest.b + " " + in_metres(std::abs(distance), false) +
         (distance < 0.0 ? " deep" : " apart");
}

/// One configuration.
void answer_waypoint(const MotionTask& task, const MotionOptions& options) {
  if (*options.waypoint < 0 || static_cast<std::uint64_t>(*options.waypoint) >= task.waypoints())
    throw InputError("--waypoint " + std::to_string(*options.waypoint) + ": they are 0 to " +
                     std::to_string(task.waypoints() - 1));
  const auto waypoint = static_cast<std::size_t>(*options.waypoint);
  const std::optional<MotionDistance> nearest = nearest_at(task, waypoint);
  const bool hit = nearest && nearest->separation.distance <= task.margin;
  const char* verdict = word(hit ? narrowphase::Verdict::hit : narrowphase::Verdict::free);
  if (options.summary) {
    std::puts((verdict + at_margin(task.margin) + (nearest ? ": " + how_far(*nearest) : "")).c_str());
    return;
  }
  Json answer{{"motion", task.name}, {"waypoint", waypoint}, {"verdict", verdict}};
  if (task.margin > 0.0) answer["margin"] = task.margin;
  answer.update(nearest ? to_json(*nearest) : Json{{"distance", nullptr}});
  print(answer);
}

void answer_path(const MotionTask& task, const MotionOptions& options) {
  const MotionSystem system(task);
  const bool drawn = !options.png.empty() || !options.html.empty();
  const MotionAnswer answer = answer_motion(system, {options.any, options.epsilon, drawn});
  if (!options.png.empty()) write_motion_png(system, answer, options.png, options.width);
  if (!options.html.empty()) write_motion_page(system, answer, options.html);
  const bool asked = options.clearance && answer.verdict == narrowphase::Verdict::free;
  const auto clearance = asked ? least_clearance(task, task.margin, options.epsilon) : std::nullopt;
  if (options.summary) {
    const std::string least = clearance ? ", clearance " + in_metres(clearance->low, true) : "";
    std::puts((summary(system, answer, view_of(system, answer)) + least).c_str());
    return;
  }
  Json all = to_json(system, answer);
  if (asked) all["clearance"] = clearance ? to_json(*clearance) : Json();
  print(all);
}

void answer_file(const MotionOptions& options) {
  if (options.file.empty()) throw InputError("motion needs a file; see throng motion --help");
  check_outputs(std::vector<Output>{{"--png", options.png, {".png", ".PNG"}},
                                    {"--html", options.html, {".html", ".htm"}}},
                options.file, "the motion file");
  MotionTask task = load_motion_or_throw(options.file);
  if (options.margin) task.margin = *options.margin;
  if (options.waypoint)
    answer_waypoint(task, options);
  else
    answer_path(task, options);
}

void run(const MotionOptions& options) {
  if (options.schema)
    std::fputs(scenarios::motion_schema().c_str(), stdout);
  else if (options.fields)
    std::fputs(scenarios::reference(scenarios::motion_grammar(), scenarios::kAboutMotions).c_str(), stdout);
  else
    answer_file(options);
}

}  // namespace

void add_motion(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand(
      "motion", "Proves paths of bodies and robots free of contact, or finds the first: TOML in, JSON out");
  const auto options = std::make_shared<MotionOptions>();
  command->add_option("FILE", options->file, "the motion file; - reads the standard input");
  CLI::Option* any = command->add_flag(
      "--any", options->any,
      "ask only whether all of it is free: stops at whichever contact is found first, which takes "
      "less time than the first on the way");
  CLI::Option* clearance = command->add_flag("--clearance", options->clearance,
                                             "how near a free path comes to anything, as two bounds: costs "
                                             "up to some 1,000 looks at the path and a few "
                                             "times the question itself");
  command
      ->add_option("--margin", options->margin,
                   "clearance (m) that a free path has at least, instead of the file's: what comes as near "
                   "is hit")
      ->check(real_number(0.0, 1e9));
  CLI::Option* waypoint =
      command
          ->add_option(
              "--waypoint", options->waypoint,
              "answer for this waypoint alone, from 0: whether anything touches there, and by how much")
          ->transform(whole_number());
  command->add_flag("--summary", options->summary,
                    "one line instead of JSON: the verdict, then who and where of the first contact");
  CLI::Option* epsilon =
      command
          ->add_option(
              "--epsilon", options->epsilon,
              "clearance (m) that is not worth more computations: what comes nearer may be left undecided; "
              "without it, what rounding lets be told")
          ->check(real_number(0.0, 1e9));
  CLI::Option* png = command->add_option(
      "--png", options->png,
      "picture to write or replace: the way, the contact, and what each distance proves free");
  CLI::Option* html = command->add_option(
      "--html", options->html,
      "page to write or replace: the same with a scrubber over time, in any browser, without network");
  command->add_option("--width", options->width, "of the picture, in pixels; 1600 without it")
      ->transform(whole_number(200, 8000));
  for (CLI::Option* of_paths : {any, clearance, epsilon, png, html}) waypoint->excludes(of_paths);
  command->add_flag("--schema", options->schema,
                    "print the JSON Schema of motion files, for editors, and nothing else");
  command->add_flag("--fields", options->fields,
                    "print all fields of motion files, what they mean and what they are when absent");
  command->footer(kMotionFooter);
  command->callback([options, &exit_code] {
    run(*options);
    exit_code = 0;
  });
}

}  // namespace throng::tools
