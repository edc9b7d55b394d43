// SPDX-License-Identifier: MIT
// throng replay: plays, checks or draws a recording.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <memory>
#include <optional>

#include "sim/input_error.h"
#include "sim/recording/recording.h"
#include "tools/check_outputs.h"
#include "tools/commands.h"
#include "tools/film.h"
#include "tools/frame_at.h"
#include "tools/picture.h"
#include "tools/play.h"
#include "tools/replay_page.h"
#include "tools/verify.h"
#include "tools/view.h"

namespace throng::tools {

namespace {

constexpr std::size_t kLines = 20;  // of the table

struct ReplayOptions {
  std::string file, png, html, video;
  std::optional<double> at, speed;
  std::optional<int> width, fps, threads;
  bool verify = false;
};

/// An option that would do nothing is a mistake.
void refuse_what_does_nothing(const ReplayOptions& options) {
  if (options.speed && options.verify && options.video.empty())
    throw InputError("--speed plays and --verify checks: give one of them");
  if (options.at && options.png.empty()) throw InputError("--at says which frame --png draws: give both");
  if (options.width && options.png.empty() && options.video.empty())
    throw InputError("--width is that of --png's or --video's pictures: give both");
  if (options.fps && options.video.empty()) throw InputError("--fps is that of --video: give both");
  if (options.threads && !options.verify) throw InputError("--threads are for --verify: give both");
}

double mean_speed(const Frame& frame) {
  double sum = 0;
  for (std::size_t row = 0; row < frame.velocity.size(); ++row)
    if (frame.has(row)) sum += frame.velocity[row].norm();
  return frame.bodies() == 0 ? 0.0 : sum / static_cast<double>(frame.bodies());
}

/// Up to kLines frames, evenly spread, the first and the last among them; each is checked as it is read.
void print_table(const Recording& recording) {
  std::printf("%10s %12s %14s %12s  %s\n", "frame", "step", "time (s)", "mean (m/s)", "state hash");
  const std::size_t n = recording.frames(), lines = std::min(n, kLines);
  Frame frame;
  for (std::size_t line = 0; line < lines; ++line) {
    const std::size_t i = lines == 1 ? 0 : line * (n - 1) / (lines - 1);
    recording.read(i, frame);
    char speed[32] = "-";
    if (!frame.velocity.empty()) std::snprintf(speed, sizeof speed, "%.4g", mean_speed(frame));
    std::printf("%10zu %12" PRId64 " %14.6g %12s  %016" PRIx64 "\n", i, frame.step, frame.time, speed,
                frame.state_hash);
  }
  if (n > lines) std::printf("%zu of %zu frames; --verify checks all of them\n", lines, n);
}

void draw(const Recording& recording, const ReplayOptions& options) {
  expect_drawable(recording, options.file);
  const std::size_t i = frame_at_or_throw(recording, options.file, options.at);
  Frame frame = recording.frame(i);
  recording.carry_angles(i, frame);
  Picture picture(recording.geometry(), view_of(recording.geometry(), frame), options.width.value_or(1600));
  picture.draw(frame);
  picture.write_png(options.png);
}

void make_film(const Recording& recording, const ReplayOptions& options) {
  expect_drawable(recording, options.file);
  FilmOptions film;
  film.speed = options.speed.value_or(film.speed);
  film.rate = options.fps.value_or(film.rate);
  film.width = options.width.value_or(film.width);
  write_film(recording, options.video, film);
}

int play_frames(const Recording& recording, const ReplayOptions& options) {
  expect_drawable(recording, options.file);
  return play(recording, *options.speed);
}

int replay(const ReplayOptions& options) {
  refuse_what_does_nothing(options);
  check_outputs(std::vector<Output>{{"--png", options.png, {".png", ".PNG"}},
                                    {"--html", options.html, {".html", ".htm"}},
                                    {"--video", options.video, {}}},
                options.file, "the recording");
  const bool draws = !options.png.empty() || !options.html.empty() || !options.video.empty() || options.speed;
  const Recording recording(options.file, draws ? FrameChoice::with_position : FrameChoice::all);
  say_where_incomplete(recording, options.file);
  if (!options.png.empty()) draw(recording, options);
  if (!options.html.empty() && !write_replay_page(recording, options.file, options.html))
    std::fprintf(stderr, "throng: %s is not inside %s: the page asks for it when it opens\n",
                 options.file.c_str(), options.html.c_str());
  if (!options.video.empty()) make_film(recording, options);
  if (options.speed && options.video.empty()) return play_frames(recording, options);
  if (options.verify) return verify(Recording(options.file), options.file, options.threads.value_or(1));
  if (options.png.empty() && options.html.empty() && options.video.empty()) print_table(recording);
  return 0;
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay", "Plays, checks or draws a recording; without options, lists 20 of its frames");
  command->add_option("FILE", options->file, "recording (.h5, or the .h5.part of a run)")->required();
  command->add_flag("--verify", options->verify,
                    "runs the scenario again and compares every frame, bit for bit");
  command->add_option("--threads", options->threads, "threads for --verify; 1 without it")
      ->transform(whole_number(1, 256));
  command->add_option("--png", options->png,
                      "picture to write or replace, a PNG file, of the frame nearest to --at");
  command->add_option("--at", options->at, "time of the picture (s); the last frame without it")
      ->check(real_number());
  command
      ->add_option("--width", options->width,
                   "of the picture's or the film's longer side, in pixels; 1600 without it")
      ->transform(whole_number(200, 8000));
  command->add_option("--html", options->html,
                      "replay page to write or replace: one file that any browser opens, without network");
  command->add_option(
      "--video", options->video,
      "film to write or replace, .mp4, .mov, .mkv or .webm: made by ffmpeg, which must be installed");
  command->add_option("--fps", options->fps, "pictures of the film a second; 25 without it")
      ->transform(whole_number(1, 240));
  command
      ->add_option(
          "--speed", options->speed,
          "plays it in the terminal, so many times as fast as it happened, until its end, q or Ctrl-C;\n"
          "space pauses, arrows seek, or step where it is paused, + and - change the speed;\n"
          "with --video, how fast the film goes, 1 without it")
      ->check(real_number(1e-9, 1e9));
  command->footer(
      "Examples: throng replay pile.h5 --speed 0.5\n"
      "          throng replay pile.h5 --verify\n"
      "          throng replay pile.h5 --png pile.png --at 2.5 --html pile.html\n"
      "          throng replay pile.h5 --video pile.mp4 --speed 2 --width 1280\n"
      "--verify holds every frame, and names, seed, engine, steps, shapes, masses, walls, areas and what is\n"
      "measured, against the scenario in the file. Author, command line, compiler, threads, the text of the\n"
      "scenario as it was given and who has a sensor are what the file says of itself: held against\n"
      "nothing.\n"
      "Exit codes: 0 done or verified, 1 the run diverges from the recording, 2 the file is unusable,\n"
      "130 stopped by a signal.");
  command->callback([options, &exit_code] { exit_code = replay(*options); });
}

}  // namespace throng::tools
