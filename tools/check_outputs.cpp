// SPDX-License-Identifier: MIT
#include "tools/check_outputs.h"

#include <algorithm>
#include <filesystem>

#include "sim/input_error.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

/// A name may end in nothing or in what is written there.
void check_name(const Output& output) {
  namespace fs = std::filesystem;
  std::error_code neither;
  if (fs::exists(output.name, neither) && fs::is_other(output.name, neither)) return;
  if (fs::is_directory(output.name, neither))
    throw InputError("cannot write " + output.name + ": it is a folder");
  const std::string ending = fs::path(output.name).extension();
  if (ending.empty() ||
      std::find(output.endings.begin(), output.endings.end(), ending) != output.endings.end())
    return;
  throw InputError("cannot write " + output.name + ": what is written ends in " +
                   std::string(output.endings.front()));
}

}  // namespace

void check_outputs(std::span<const Output> outputs, const std::string& input, const std::string& what) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const Output& output = outputs[i];
    if (output.name.empty()) continue;
    if (are_one_file(output.name, input)) throw InputError("cannot write " + output.name + ": it is " + what);
    for (const Output& other : outputs.first(i))
      if (!other.name.empty() && are_one_file(output.name, other.name))
        throw InputError(std::string(other.option) + " and " + std::string(output.option) +
                         " name the same file: " + output.name);
    if (!output.endings.empty()) check_name(output);
  }
}

}  // namespace throng::tools
