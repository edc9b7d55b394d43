// SPDX-License-Identifier: MIT
#include "broadphase/all_lists.h"

#include <algorithm>
#include <cassert>

#include "broadphase/list_chunks.h"
#include "broadphase/list_kernel.h"

namespace throng::broadphase {

namespace {
constexpr std::size_t kTogether = 256;  // lists that are copied at once: small enough to be still at hand
constexpr double kLargest = 1e140;      // m: cells of this size can be told apart from those beside them

/// Whether the mean square is at least a quarter of the largest's: then most of what a cell holds is near.
bool alike(std::span<const double> own, double largest) {
  double squares = 0.0;
  for (const double r : own) squares += r * r;
  return own.empty() || 4.0 * squares >= static_cast<double>(own.size()) * largest * largest;
}

}  // namespace

struct AllLists::Scratch {
  explicit Scratch(int threads) : team(threads) {}

  Team team;
  CellOrder cells;
  std::vector<std::uint32_t> count;  // of each place's neighbours
  std::vector<Answers> found;        // of each part, before they are brought to their rows
  ProximityTree tree;
  NeighbourSearch search;

  void find(std::span<const Point> points, double radius, std::span<const double> own, const Period* period,
            NeighbourLists& lists);
  bool alike_in_cells(std::span<const double> own, double largest) const;
  void find(const ListQuestion& question, NeighbourLists& lists);
};

AllLists::AllLists(int threads) : scratch_(std::make_unique<Scratch>(threads)) {}
AllLists::~AllLists() = default;
AllLists::AllLists(AllLists&&) noexcept = default;
AllLists& AllLists::operator=(AllLists&&) noexcept = default;

void AllLists::find(std::span<const Point> points, double radius, const Period* period,
                    NeighbourLists& lists) {
  assert(radius >= 0.0);
  scratch_->find(points, radius, {}, period, lists);
}

void AllLists::find(std::span<const Point> points, std::span<const double> radius, const Period* period,
                    NeighbourLists& lists) {
  assert(radius.size() == points.size());
  double largest = 0.0;
  for (const double r : radius) {
    assert(r >= 0.0);
    largest = std::max(largest, r);
  }
  scratch_->find(points, largest, radius, period, lists);
}

void AllLists::Scratch::find(std::span<const Point> points, double radius, std::span<const double> own,
                             const Period* period, NeighbourLists& lists) {
  assert(points.size() < std::size_t{1} << 30);
  if (!points.empty() && radius < kLargest && alike(own, radius) &&
      cells.rebuild(points, radius, period, team) && alike_in_cells(own, radius)) {
    find({cells, period, radius, own}, lists);
    return;
  }
  tree.build(points, period);
  search.find(tree, {.at = points, .radius = own, .own = 0}, {.radius = radius}, lists,
              static_cast<int>(team.threads()));
}

/// Else a crowd that looks nowhere would meet all of its cells because of one who looks far.
bool AllLists::Scratch::alike_in_cells(std::span<const double> own, double largest) const {
  if (own.empty()) return true;
  double squares = 0.0, meetings = 0.0;
  for (std::size_t bucket = 0; bucket < cells.cells().buckets(); ++bucket) {
    const std::size_t first = cells.start()[bucket], end = cells.start()[bucket + 1];
    const double together = static_cast<double>(end - first);
    meetings += together * together;
    for (std::size_t i = first; i < end; ++i) squares += together * own[cells.row()[i]] * own[cells.row()[i]];
  }
  return 4.0 * squares >= meetings * largest * largest;
}

/// Counts first, so that nothing but some hundred lists is held twice.
void AllLists::Scratch::find(const ListQuestion& question, NeighbourLists& lists) {
  constexpr std::size_t kPart = 2048;  // points: enough work for a thread
  const std::size_t n = cells.size(), parts = team.threads() == 1 ? 1 : (n + kPart - 1) / kPart;
  if (found.size() < parts) found.resize(parts);
  count.resize(n);
  lists.begin.assign(n + 1, 0);
  team.for_each(parts, [&](std::size_t part) {
    const std::size_t first = n * part / parts, end = n * (part + 1) / parts;
    count_neighbours(question, first, end, count.data());
    for (std::size_t i = first; i < end; ++i) lists.begin[cells.row()[i] + std::size_t{1}] = count[i];
  });
  for (std::size_t i = 0; i < n; ++i) lists.begin[i + 1] += lists.begin[i];
  lists.row.resize(lists.begin[n]);
  lists.distance.resize(lists.begin[n]);
  team.for_each(parts, [&](std::size_t part) {
    const std::size_t end = n * (part + 1) / parts;
    for (std::size_t i = n * part / parts; i < end; i += kTogether) {
      const std::size_t next = std::min(i + kTogether, end);
      found[part].size = 0;
      gather_neighbours(question, i, next, found[part]);
      copy_lists(found[part], {cells.row() + i, next - i}, lists);
    }
  });
}

}  // namespace throng::broadphase
