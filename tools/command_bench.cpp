// SPDX-License-Identifier: MIT
// throng bench: starts the program throng-bench that stands beside this one.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "sim/input_error.h"
#include "tools/commands.h"

namespace throng::tools {

namespace {

[[noreturn]] void start_beside(const std::string& program, const std::vector<std::string>& arguments) {
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(path.c_str(), argv.data());
  const int reason = errno;
  throw InputError(
      path.string() + ": can't be started: " + std::strerror(reason) +
      (reason == ENOENT ? "; 'cmake --build --preset release --target throng-bench' builds it" : ""));
}

}  // namespace

void add_bench(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("bench", "Runs a benchmark: time and error, engines in turn");
  command->prefix_command();
  command->set_help_flag();
  command->footer("Example: throng bench step --only pile");
  command->callback([command] { start_beside("throng-bench", command->remaining()); });
}

}  // namespace throng::tools
