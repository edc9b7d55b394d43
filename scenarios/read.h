// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenarios/report.h"
#include "sim/scene.h"

/// From a checked tree to a scene, a part each. Nodes that the check marked bad are left out, so that
/// whatever else is wrong comes to light in the same go; what a table can't say (bounds in the wrong order,
/// impossible polygons) is reported here.
namespace throng::scenarios {

/// A number drawn uniformly, or the one number that both bounds are.
struct Uniform {
  double low = 0.0, high = 0.0;
};

/// What the bodies of a shape still need, by row of Scene::shapes.
struct ShapeDraw {
  Uniform radius;  ///< m, discs only
};

/// One [[bodies]] entry.
struct Entry {
  enum class Place { at, lattice, random };

  std::uint32_t first = 0, count = 0;  ///< rows of Scene::bodies
  std::uint32_t shape = 0, material = 0;
  BodyKind kind = BodyKind::dynamic;
  Uniform angle;  ///< rad
  Vec velocity{0.0, 0.0};
  std::optional<double> maxwell;  ///< m/s, standard deviation of each component
  double spin = 0.0;
  Place place = Place::at;
  Vec origin{0.0, 0.0}, spacing{0.0, 0.0};  ///< m; `at` is the origin
  std::uint32_t columns = 1;
  Eigen::AlignedBox2d within;
  double gap = 0.0;                  ///< m
  std::size_t index = 0;             ///< in the file
  const toml::node* node = nullptr;  ///< where it stands
};

/// Name, description, seed, engine, gravity, sleep, time, domain, contact, record.
void read_settings(const toml::table& root, Scene& scene, Report& report);

/// How bodies push each other; part of read_settings.
void read_contact(const toml::table& root, Scene& scene, Report& report);

/// Of soft contacts: chooses the substeps where the file doesn't, so that the shortest impact takes 50; warns
/// where it takes fewer than 20, and refuses steps that are unstable. Of rigid ones: more substeps than
/// read_settings() chose, where the smallest bodies need them; warns where they are pressed deep into others
/// within one. Expects all bodies in the scene.
void settle_contacts(const toml::table& root, Scene& scene, Report& report);

/// Where dt is "auto": chooses it and the substeps, or reports why nothing can be promised. Expects all
/// bodies in the scene.
void settle_auto_time(const toml::table& root, Scene& scene, Report& report);

/// Rates, fields and form of the recording; part of read_settings.
void read_record(const toml::table& root, Scene& scene, Report& report);

/// Warns of a recorded region that is outside of where bodies are held. Expects domain and floor in the
/// scene.
void check_region(const toml::table& root, const Scene& scene, Report& report);

/// Refuses a quantum that is too fine for where recorded bodies may be. Expects all of them in the scene.
void check_quantum(const toml::table& root, const Scene& scene, Report& report);

/// Warns where a recording would hold nothing. Expects the sensors read.
void warn_of_empty_record(const toml::table& root, const Scene& scene, Report& report);

/// What is observed of all bodies, beside energies and overlaps.
void read_observe(const toml::table& root, Scene& scene, Report& report);

/// Whether it can be of this scene. Expects all bodies in it.
void check_observe(const toml::table& root, const Scene& scene, Report& report);

/// Which bodies are recorded. Expects all of them in the scene.
void read_recorded_bodies(const toml::table& root, Scene& scene, Report& report);

/// Expects all bodies in the scene, and the record read.
void read_sensors(const toml::table& root, Scene& scene, Report& report);

/// Ids, ascending, of those that `of` fits: a table as record.of has it, at that path. Reports it where it
/// fits none or names ids that there are not.
std::vector<std::uint32_t> fitting_ids(const toml::table& of, const std::string& path, const Scene& scene,
                                       Report& report);

/// Row 0 is "default", which needs no entry; the others follow by name.
void read_materials(const toml::table& root, Scene& scene, const Report& report);

/// All shapes by name, about their centres of mass. A shape with a fault in it keeps its row, empty.
std::vector<ShapeDraw> read_shapes(const toml::table& root, Scene& scene, Report& report);

void read_walls(const toml::table& root, Scene& scene, Report& report);

/// The entries that are free of faults, in the order of the file.
std::vector<Entry> read_entries(const toml::table& root, const Scene& scene, Report& report);

// The small readers that these share. All expect nodes that the check found good.

double number(const toml::node& node);
double number(const toml::table& table, std::string_view key, double fallback);
std::string text(const toml::table& table, std::string_view key, std::string_view fallback);
Vec point(const toml::node& node);
std::vector<Vec> points(const toml::node& node);
std::string to_text(const Vec& place);  ///< as people write it, [x, y]
Eigen::AlignedBox2d box(const toml::node& node);

/// What is said of bounds, [low, high], and of a box that are the wrong way round.
std::string lower_first(const Vec& bounds);
std::string least_first(const Eigen::AlignedBox2d& box);

/// What is wrong with the line where two neighbours are nearer than kShortestEdge without being equal: a
/// sentence, "" where none are. O(n).
std::string too_short(std::span<const Vec> line, bool closed);

/// The table's entry of this key, unless it is absent or bad.
const toml::node* good(const toml::table& table, std::string_view key, const Report& report);

/// The material of this name in `table`.material; row 0 without one. O(log n).
std::uint32_t material_row(const toml::table& table, const Scene& scene);

}  // namespace throng::scenarios
