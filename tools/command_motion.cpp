// SPDX-License-Identifier: MIT
// throng motion: is a path free, and if not, when is the first contact?
#include <cstdio>
#include <filesystem>
#include <memory>

#include "scenarios/motion_grammar.h"
#include "scenarios/read_motion.h"
#include "scenarios/reference.h"
#include "sim/input_error.h"
#include "sim/recording/utf8.h"
#include "tools/check_outputs.h"
#include "tools/commands.h"
#include "tools/motion_page.h"
#include "tools/motion_picture.h"
#include "tools/scenario.h"

namespace throng::tools {

namespace {

struct Options {
  std::string file, png, html;
  double epsilon = 0.0;
  int width = 1600;
  bool any = false, schema = false, fields = false;
};

constexpr const char* kFooter =
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
An answer is an answer: the exit code is 0 for each verdict, and 2 where the file or the command line is faulty.
Examples: throng motion scenarios/motions/sofa.toml --html sofa.html
          throng motion scenarios/motions/arm.toml --any)";

MotionTask load_or_throw(const std::string& file) {
  LoadedMotion loaded = load_motion(file);
  expect_sound(loaded.diagnostics, file);
  if (loaded.task.name.empty())
    loaded.task.name = recording::as_utf8(std::filesystem::path(file).stem().string());
  return std::move(loaded.task);
}

void answer_file(const Options& options) {
  if (options.file.empty()) throw InputError("motion needs a file; see throng motion --help");
  check_outputs(std::vector<Output>{{"--png", options.png, {".png", ".PNG"}},
                                    {"--html", options.html, {".html", ".htm"}}},
                options.file, "the motion file");
  const MotionTask task = load_or_throw(options.file);
  const MotionSystem system(task);
  const bool drawn = !options.png.empty() || !options.html.empty();
  const MotionAnswer answer = answer_motion(system, {options.any, options.epsilon, drawn});
  if (!options.png.empty()) write_motion_png(system, answer, options.png, options.width);
  if (!options.html.empty()) write_motion_page(system, answer, options.html);
  std::puts(to_json(system, answer).dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

void run(const Options& options) {
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
  const auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "the motion file");
  command->add_flag(
      "--any", options->any,
      "ask only whether all of it is free: stops at whichever contact is found first, which takes "
      "less time than the first on the way");
  command
      ->add_option(
          "--epsilon", options->epsilon,
          "clearance (m) that is not worth more computations: what comes nearer may be left undecided; "
          "without it, what rounding lets be told")
      ->check(real_number())
      ->check(CLI::Range(0.0, 1e9));
  command->add_option(
      "--png", options->png,
      "picture to write or replace: the way, the contact, and what each distance proves free");
  command->add_option(
      "--html", options->html,
      "page to write or replace: the same with a scrubber over time, in any browser, without network");
  command->add_option("--width", options->width, "of the picture, in pixels; 1600 without it")
      ->transform(whole_number() & CLI::Range(200, 8000));
  command->add_flag("--schema", options->schema,
                    "print the JSON Schema of motion files, for editors, and nothing else");
  command->add_flag("--fields", options->fields,
                    "print all fields of motion files, what they mean and what they are when absent");
  command->footer(kFooter);
  command->callback([options, &exit_code] {
    run(*options);
    exit_code = 0;
  });
}

}  // namespace throng::tools
