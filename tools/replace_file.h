// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace throng::tools {

/// Calls `write` with the name of a new, empty file beside `output`, and gives that file the name `output`
/// once it is written. Whatever goes wrong, what stood at `output` stays as it was and nothing else is left.
/// This holds too where SIGINT, SIGTERM or SIGHUP ends the program meanwhile, with exit code 130.
/// A device or a pipe is written as it is. One at a time. Throws InputError where `output` is a folder or
/// can't be written, and what `write` throws.
void replace_file(const std::string& output, const std::function<void(const std::string& name)>& write);

/// Whether two names lead to the same file, also where there is none yet.
bool are_one_file(const std::string& a, const std::string& b);

}  // namespace throng::tools
