// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace CLI {
class App;
class Validator;
}  // namespace CLI
namespace throng {
class Recording;
}

/// The commands of the program, a file each. `add_x` declares the command's options on `app`; when the user
/// chose it, its callback runs and leaves the exit code of design.md in `exit_code`. Errors are thrown:
/// InputError ends with 2.
namespace throng::tools {

void add_validate(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code,
             const std::string& command_line);  ///< as typed, for the recording
void add_resume(CLI::App& app, int& exit_code, const std::string& command_line);  ///< likewise
void add_replay(CLI::App& app, int& exit_code);
void add_query(CLI::App& app, int& exit_code);
void add_pairs(CLI::App& app, int& exit_code);
void add_motion(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);

/// Says on the standard error where the recording, that of `file`, isn't complete, and why.
void say_where_incomplete(const Recording& recording, const std::string& file);

/// Leaves a whole number in decimals as CLI11 reads it, which alone takes 010 for 8 and what is out of range
/// for the largest there is. With limits refuses what is beyond them, and says what is allowed.
CLI::Validator whole_number();
CLI::Validator whole_number(std::int64_t low, std::int64_t high);

/// Refuses what isn't a number from end to end, in decimals; CLI11 alone takes 0x10 for 16, 1e400 for inf
/// and nan for within any range. Limits as above.
CLI::Validator real_number();
CLI::Validator real_number(double low, double high);

}  // namespace throng::tools
