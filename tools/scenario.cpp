// SPDX-License-Identifier: MIT
#include "tools/scenario.h"

#include <cstdio>
#include <filesystem>

#include "scenarios/report.h"
#include "sim/input_error.h"
#include "sim/recording/utf8.h"

namespace throng::tools {

Loaded load_or_throw(const std::string& file, const std::vector<std::string>& overrides) {
  Loaded loaded = load_scenario(file, overrides);
  std::fputs(to_string(loaded.diagnostics, file).c_str(), stderr);
  if (const int n = loaded.errors(); n > 0)
    throw InputError(file + ": " + (n >= scenarios::Report::kMostErrors ? "the first " : "") +
                     std::to_string(n) + (n == 1 ? " error" : " errors"));
  if (loaded.scene.name.empty())
    loaded.scene.name = recording::as_utf8(std::filesystem::path(file).stem().string());
  return loaded;
}

}  // namespace throng::tools
