// SPDX-License-Identifier: MIT
// The program: reads the command line, runs one command, turns what went wrong into a sentence and an exit
// code.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>

#include "sim/input_error.h"
#include "tools/commands.h"

namespace {

/// Answers that did not arrive (the disk is full) are a failure like any other.
int with_answers_written(int exit_code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return exit_code;
  std::fprintf(stderr, "throng: cannot write to the standard output: %s\n",
               errno != 0 ? std::strerror(errno) : "an earlier write failed");
  return exit_code == 0 ? 1 : exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace throng::tools;
  CLI::App app{
      "throng simulates crowds and particles in the plane: a scenario file in, an HDF5 trajectory out.\n"
      "Exit codes: 0 done, 1 the simulation failed, 2 bad input, 130 stopped by a signal."};
  app.set_version_flag("--version", THRONG_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  std::string command_line = "throng";
  for (int i = 1; i < argc; ++i) command_line += std::string(" ") + argv[i];
  add_validate(app, exit_code);
  add_plan(app, exit_code);
  add_run(app, exit_code, command_line);
  add_query(app, exit_code);
  add_replay(app, exit_code);
  add_info(app, exit_code);
  add_pairs(app, exit_code);
  add_bench(app, exit_code);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return with_answers_written(app.exit(error) == 0 ? 0 : 2);
  } catch (const throng::InputError& error) {
    std::fprintf(stderr, "throng: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "throng: %s\n", error.what());
    return 1;
  }
  return with_answers_written(exit_code);
}
