// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenarios/load.h"
#include "scenarios/toml.h"

/// From a file to a tree, whatever it describes.
namespace throng::scenarios {

/// All of the file into `text`; false, and the reason in `diagnostics`, where it can't be had.
bool read_source(const std::string& file, std::string& text, std::vector<Diagnostic>& diagnostics);

/// The text's tree, or nothing and the reason in `diagnostics`. `name` stands for the file. O(n).
std::optional<toml::table> parse(const std::string& text, const std::string& name,
                                 std::vector<Diagnostic>& diagnostics);

}  // namespace throng::scenarios
