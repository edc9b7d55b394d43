// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/holes.h"
#include "scenarios/path.h"
#include "scenarios/read.h"

namespace throng::scenarios {

/// The polygon of a shape's table, and its holes.
class PolygonReader {
 public:
  /// Expects a table whose "polygon" and "holes" the check found good, and all three to outlive it.
  PolygonReader(const toml::table& table, const Path& path, Report& report)
      : table_(table), path_(path), report_(report) {}

  /// The outline, counter-clockwise, then the holes, clockwise, in the file's coordinates; none, and
  /// reported, where there is no such polygon. What was mended is a warning. Cost as `clean` of holes.h.
  std::vector<std::vector<Vec>> read();

  /// Reports what is wrong with a ring that `read` gave.
  void fail(const narrowphase::RingNote& refusal);

 private:
  void add_ring(const toml::node& node, const Path& path);
  void add_holes(const toml::node& node, const Path& path);
  void fail(const toml::node& node, const Path& path, std::string message);

  struct Place {
    const toml::node* node;
    std::string path;
  };
  const toml::table& table_;
  const Path& path_;
  Report& report_;
  std::vector<std::vector<Vec>> rings_;  // as given, the outline first
  std::vector<Place> places_;            // of these
  bool failed_ = false;
};

/// Counted before any geometry is done, whose cost grows faster: false, and reported, where the vertices and
/// discs of all shapes are too many.
bool check_total(const toml::table& shapes, const Path& path, Report& report);

}  // namespace throng::scenarios
