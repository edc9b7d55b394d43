// SPDX-License-Identifier: MIT
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>

namespace throng::bench {

/// A folder that goes when this does.
struct ScratchFolder {
  std::string path = (std::filesystem::temp_directory_path() / "throng-bench-XXXXXX").string();
  ScratchFolder() { path = mkdtemp(path.data()); }
  ~ScratchFolder() { std::filesystem::remove_all(path); }
};

}  // namespace throng::bench
