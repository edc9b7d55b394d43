// SPDX-License-Identifier: MIT
// The program: reads the command line, runs one command, turns what went wrong into a sentence and an exit
// code.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "scenarios/report.h"
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

/// What to say where the first word is no command, else nothing.
std::string unknown_command(const CLI::App& app, const std::string& word) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
  if (word.starts_with("-") || std::ranges::find(known, word) != known.end()) return "";
  return "there is no command '" + word + "'" + throng::scenarios::nearest_or_all(word, known);
}

/// What of --set isn't PATH=VALUE, else nothing: whoever types "--set a b" has given two words.
std::string unset(const CLI::App& command) {
  const CLI::Option* set = command.get_option_no_throw("--set");
  if (!set) return "";
  const auto half = std::ranges::find_if(
      set->results(), [](const std::string& given) { return given.find('=') == std::string::npos; });
  return half == set->results().end() ? "" : *half;
}

/// What to say of words that `command` has no use for.
std::string unexpected(const CLI::App& command, const std::vector<std::string>& words) {
  if (const std::string half = unset(command); !half.empty())
    return "--set takes one word, PATH=VALUE as in time.dt=0.005, not '" + half + "' and '" + words.front() +
           "'";
  const auto option =
      std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("-"); });
  if (option == words.end()) return "'" + words.front() + "' was not expected";
  std::vector<std::string> known;
  for (const CLI::Option* one : command.get_options())
    if (!one->get_lnames().empty()) known.push_back("--" + one->get_lnames().front());
  const std::string name = option->substr(0, option->find('='));
  return "there is no option '" + name + "'" + throng::scenarios::suggestion(name, known);
}

/// CLI11 says of an option without its value what type that has.
std::string plain_words(const CLI::ParseError& error) {
  const std::string words = error.what();
  const bool missing = dynamic_cast<const CLI::ArgumentMismatch*>(&error) && words.ends_with(" missing");
  return missing ? words.substr(0, words.find(": ")) + ": a value is missing" : words;
}

/// What is wrong with the command line, and whose help says more.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
  const auto given = app.get_subcommands();
  const CLI::App& command = given.empty() ? app : *given.front();
  const std::vector<std::string> words = app.remaining(true);
  const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) && !words.empty();
  return (extra ? unexpected(command, words) : plain_words(error)) + "; see throng " +
         (given.empty() ? "" : command.get_name() + " ") + "--help";
}

int fail(const std::string& message, int exit_code) {
  std::fprintf(stderr, "throng: %s\n", message.c_str());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace throng::tools;
  CLI::App app{
      "throng simulates crowds and particles in the plane: a scenario file in, an HDF5 trajectory out.\n"
      "Exit codes: 0 done, 1 the simulation failed, 2 bad input, 130 stopped by a signal."};
  app.set_version_flag("--version", THRONG_VERSION);
  app.require_subcommand(0, 1);
  int exit_code = 0;
  std::string command_line = "throng";
  for (int i = 1; i < argc; ++i) command_line += std::string(" ") + argv[i];
  add_validate(app, exit_code);
  add_plan(app, exit_code);
  add_run(app, exit_code, command_line);
  add_resume(app, exit_code, command_line);
  add_query(app, exit_code);
  add_replay(app, exit_code);
  add_export(app, exit_code);
  add_info(app, exit_code);
  add_pairs(app, exit_code);
  add_motion(app, exit_code);
  add_bench(app, exit_code);

  if (const std::string message = unknown_command(app, argc > 1 ? argv[1] : "-"); !message.empty())
    return fail(message, 2);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& answer) {  // --help, --version
    return with_answers_written(app.exit(answer));
  } catch (const CLI::ParseError& error) {
    return fail(complaint(app, error), 2);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 1);
  } catch (const throng::InputError& error) {
    return fail(error.what(), 2);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
  if (app.get_subcommands().empty()) return fail("a command is missing\n\n" + app.help(), 2);
  return with_answers_written(exit_code);
}
