// SPDX-License-Identifier: MIT
#include "scenarios/read_polygon.h"

#include "scenarios/limits.h"

namespace throng::scenarios {

std::vector<std::vector<Vec>> PolygonReader::read() {
  add_ring(*table_.get("polygon"), Path(path_, "polygon"));
  if (const toml::node* holes = table_.get("holes")) add_holes(*holes, Path(path_, "holes"));
  if (failed_) return {};
  narrowphase::CleanedRings cleaned = narrowphase::clean(rings_);
  for (const narrowphase::RingNote& repair : cleaned.repairs)
    report_.warning(places_[repair.ring].node->source(), places_[repair.ring].path, repair.text);
  if (cleaned.refusal.text.empty()) return std::move(cleaned.rings);
  fail(cleaned.refusal);
  return {};
}

void PolygonReader::add_ring(const toml::node& node, const Path& path) {
  rings_.push_back(points(node));
  places_.push_back({&node, path.text()});
  if (const std::string fault = too_short(rings_.back(), true); !fault.empty()) fail(node, path, fault);
}

void PolygonReader::add_holes(const toml::node& node, const Path& path) {
  std::size_t vertices = rings_[0].size();
  for (std::size_t i = 0; i < node.as_array()->size(); ++i) {
    add_ring(*node.as_array()->get(i), Path(path, i));
    vertices += rings_.back().size();
  }
  if (vertices > kMostVertices)
    fail(node, path, "makes more than " + std::to_string(kMostVertices) + " vertices with the polygon's");
}

void PolygonReader::fail(const toml::node& node, const Path& path, std::string message) {
  report_.error(node, path.text(), std::move(message));
  failed_ = true;
}

void PolygonReader::fail(const narrowphase::RingNote& refusal) {
  report_.error(*places_[refusal.ring].node, places_[refusal.ring].path, refusal.text);
}

namespace {

std::size_t count_vertices(const toml::table& shape) {
  std::size_t count = 0;
  for (const char* key : {"polygon", "discs"})
    if (const toml::node* list = shape.get(key)) count += list->as_array()->size();
  if (const toml::node* holes = shape.get("holes"))
    for (const toml::node& hole : *holes->as_array()) count += hole.as_array()->size();
  return count;
}

}  // namespace

bool check_total(const toml::table& shapes, const Path& path, Report& report) {
  std::size_t total = 0;
  for (const auto& [name, entry] : shapes) {
    if (report.bad(entry)) continue;
    total += count_vertices(*entry.as_table());
    if (total <= kMostInShapes) continue;
    report.error(entry, Path(path, name.str()).text(),
                 "makes more than " + std::to_string(kMostInShapes) + " vertices and discs in all shapes");
    return false;
  }
  return true;
}

}  // namespace throng::scenarios
