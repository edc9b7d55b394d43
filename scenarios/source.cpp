// SPDX-License-Identifier: MIT
#include "scenarios/source.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "scenarios/limits.h"
#include "scenarios/scan.h"

namespace throng::scenarios {

namespace {

constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";  // as its files begin

/// The diagnosis of a file that is no TOML.
Diagnostic fault(int line, int column, std::string message) {
  return {Diagnostic::Severity::error, line, column, "", std::move(message), ""};
}

}  // namespace

bool read_source(const std::string& file, std::string& text, std::vector<Diagnostic>& diagnostics) {
  std::error_code code;
  const auto fail = [&](std::string message) {
    diagnostics = {fault(0, 0, std::move(message))};
    return false;
  };
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) return fail("there is no such file");
  if (std::filesystem::is_directory(status)) return fail("is a folder; must be a file in TOML");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fail("can't be read: " + std::string(std::strerror(errno)));
  std::vector<char> block(1 << 16);
  while (text.size() <= kMostBytes &&
         (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0))
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return fail("can't be read to its end");
  if (text.starts_with(kHdf5)) {
    text.clear();
    return fail(
        "is HDF5, as recordings are, and no TOML; throng replay shows one, throng resume goes on with it");
  }
  if (text.size() <= kMostBytes) return true;
  text.clear();
  return fail("is larger than " + std::to_string(kMostBytes >> 20) + " MB; must be at most that");
}

std::optional<toml::table> parse(const std::string& text, const std::string& name,
                                 std::vector<Diagnostic>& diagnostics) {
  if (const Excess excess = find_excess(text); excess.line > 0) {
    diagnostics = {fault(excess.line, excess.column, excess.message)};
    return std::nullopt;
  }
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    diagnostics = {fault(static_cast<int>(place.line), static_cast<int>(place.column),
                         "this is no TOML: " + std::string(error.description()))};
    return std::nullopt;
  }
}

}  // namespace throng::scenarios
