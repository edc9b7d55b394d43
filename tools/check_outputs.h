// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::tools {

/// A file to be written.
struct Output {
  std::string_view option;                ///< that names it: "--png"
  std::string name;                       ///< empty: not asked for
  std::vector<std::string_view> endings;  ///< that fit what is written there; none: its writer checks it
};

/// Outputs replace what had their name; what is read is not to be had again. Throws InputError where one of
/// them is the file `input`, which is `what`; where two are one file; where one is a folder, or its name ends
/// in what isn't written there. Devices and pipes are called anything.
void check_outputs(std::span<const Output> outputs, const std::string& input, const std::string& what);

}  // namespace throng::tools
