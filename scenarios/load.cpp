// SPDX-License-Identifier: MIT
#include "scenarios/load.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scenarios/check.h"
#include "scenarios/limits.h"
#include "scenarios/override.h"
#include "scenarios/place.h"
#include "scenarios/print.h"
#include "scenarios/scan.h"
#include "sim/engine_box2d.h"

namespace throng {

using namespace scenarios;

namespace {

/// The diagnosis of a file that is no TOML.
Diagnostic fault(int line, int column, std::string message) {
  return {Diagnostic::Severity::error, line, column, "", std::move(message), ""};
}

/// The text's tree, or nothing and the reason in `loaded`.
std::optional<toml::table> parse(const std::string& name, Loaded& loaded) {
  const Excess excess = find_excess(loaded.text);
  if (excess.line > 0) {
    loaded.diagnostics = {fault(excess.line, excess.column, excess.message)};
    return std::nullopt;
  }
  try {
    return toml::parse(loaded.text, name);
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    loaded.diagnostics = {fault(static_cast<int>(place.line), static_cast<int>(place.column),
                                "this is no TOML: " + std::string(error.description()))};
    return std::nullopt;
  }
}

/// Where bodies pass through all, nothing keeps them in.
void warn_of_idle_borders(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.contact != ContactModel::none) return;
  if (scene.domain.kind == DomainKind::box)
    report.warning(root["domain"]["box"].node()->source(), "domain.box",
                   "holds nobody: contact.model is \"none\", and the box is only drawn");
  if (!scene.walls.empty())
    report.warning(root["walls"][0].node()->source(), "walls",
                   "hold nobody: contact.model is \"none\", and they are only drawn");
}

/// What only the engine knows, said before anything runs.
void check_engine(const toml::table& root, const Scene& scene, Report& report) {
  if (scene.engine != Engine::box2d) return;
  if (const std::string refusal = box2d_refusal(scene); !refusal.empty())
    report.error(*root.get("engine"), "engine", "box2d: " + refusal);
}

void read_scene(const toml::table& root, Scene& scene, Report& report) {
  check(root, report);
  if (report.full()) return;  // the rest of the tree was not looked at
  read_settings(root, scene, report);
  read_materials(root, scene, report);
  const std::vector<ShapeDraw> draws = read_shapes(root, scene, report);
  read_walls(root, scene, report);
  const std::vector<Entry> entries = read_entries(root, scene, report);
  if (report.errors() > 0) return;
  warn_of_idle_borders(root, scene, report);
  place_bodies(entries, draws, scene, report);
  if (report.errors() == 0) check_engine(root, scene, report);
}

/// All of the file, or nothing and the reason in `loaded`.
bool read_file(const std::string& file, Loaded& loaded) {
  std::error_code code;
  const auto fail = [&](std::string message) {
    loaded.diagnostics = {fault(0, 0, std::move(message))};
    return false;
  };
  const auto status = std::filesystem::status(file, code);
  if (!std::filesystem::exists(status)) return fail("there is no such file");
  if (std::filesystem::is_directory(status)) return fail("is a folder; must be a scenario file in TOML");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fail("can't be read: " + std::string(std::strerror(errno)));
  std::string& text = loaded.text;
  std::vector<char> block(1 << 16);
  while (text.size() <= kMostBytes &&
         (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0))
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return fail("can't be read to its end");
  if (text.size() <= kMostBytes) return true;
  text.clear();
  return fail("is larger than " + std::to_string(kMostBytes >> 20) + " MB; must be at most that");
}

void load(Loaded& loaded, const std::string& name, std::span<const std::string> overrides) {
  std::optional<toml::table> root = parse(name, loaded);
  if (!root) return;
  Report report(root->source().path);
  for (const std::string& override_ : overrides) apply_override(*root, override_, report);
  read_scene(*root, loaded.scene, report);
  loaded.resolved = print(*root);
  loaded.diagnostics = report.take();
}

}  // namespace

int Loaded::errors() const {
  return static_cast<int>(std::count_if(
      diagnostics.begin(), diagnostics.end(),
      [](const Diagnostic& diagnostic) { return diagnostic.severity == Diagnostic::Severity::error; }));
}

Loaded load_scenario(const std::string& file, std::span<const std::string> overrides) {
  Loaded loaded;
  if (read_file(file, loaded)) load(loaded, file, overrides);
  return loaded;
}

Loaded load_scenario_text(std::string_view text, const std::string& name,
                          std::span<const std::string> overrides) {
  Loaded loaded;
  loaded.text = text;
  load(loaded, name, overrides);
  return loaded;
}

std::string to_string(std::span<const Diagnostic> diagnostics, const std::string& file) {
  std::ostringstream out;
  for (const Diagnostic& diagnostic : diagnostics) {
    out << (diagnostic.source.empty() ? file : diagnostic.source);
    if (diagnostic.line > 0) out << ':' << diagnostic.line << ':' << diagnostic.column;
    out << (diagnostic.severity == Diagnostic::Severity::error ? ": error: " : ": warning: ");
    if (!diagnostic.path.empty()) out << diagnostic.path << ": ";
    out << diagnostic.message << '\n';
  }
  return out.str();
}

}  // namespace throng
