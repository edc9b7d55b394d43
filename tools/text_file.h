// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

#include "sim/recording/export.h"

namespace throng::tools {

/// The path of a target that is the standard output.
inline constexpr std::string_view kStandardOutput = "-";

/// A text file under construction. Numbers are written with the fewest digits that read back as they were.
/// Everything throws InputError where it can't be written.
class TextFile {
 public:
  explicit TextFile(const ExportTarget& target);

  TextFile& operator<<(std::string_view text);
  TextFile& operator<<(double number);
  TextFile& operator<<(std::int64_t number);

  /// Ends it; until then some of it may not have been written.
  void close();

 private:
  void expect_written() const;

  std::string name_;
  std::ofstream file_;  // closed where it is the standard output
  std::ostream& out_;
};

}  // namespace throng::tools
