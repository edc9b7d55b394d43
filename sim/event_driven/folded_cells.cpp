// SPDX-License-Identifier: MIT
#include "sim/event_driven/folded_cells.h"

#include <algorithm>
#include <cmath>

namespace throng {

namespace {

constexpr double kDiscsInACell = 0.7;  // fewer: more crossings of borders; more: more pairs to look at
constexpr double kEmpty = 1e9;         // m, of a cell where nobody flies
constexpr double kMostAcross = 1e6;
constexpr std::int64_t kFewestInAPeriod = 3;  // in which two discs are near each other in one image at most

/// m, `least` or more: as many cells as discs, but of a domain as thin as a thread no more than kMostAcross.
double fitting_edge(const Vec& size, double least, double discs) {
  const double area = std::max(size.x(), least) * std::max(size.y(), least);
  return std::max({least, std::sqrt(kDiscsInACell * area / discs), size.maxCoeff() / kMostAcross});
}

}  // namespace

FoldedCells::FoldedCells(const Domain& domain, const Eigen::AlignedBox2d& around, double least, std::size_t n)
    : next_(n, kNobody) {
  const bool bounded = domain.kind != DomainKind::unbounded;
  const std::int64_t fewest = domain.kind == DomainKind::periodic ? kFewestInAPeriod : 1;
  origin_ = bounded ? domain.min : around.min();
  const Vec size = (bounded ? domain.max : around.max()) - origin_;
  const double edge = n == 0 ? kEmpty : fitting_edge(size, least, static_cast<double>(n));
  for (int axis : {0, 1}) {
    count_[axis] = std::max(fewest, static_cast<std::int64_t>(size[axis] / edge));
    edge_[axis] = bounded ? size[axis] / static_cast<double>(count_[axis]) : edge;
  }
  const auto slots = static_cast<std::size_t>(count_[0] * count_[1]);
  first_.assign(slots, {{}, 0});
  more_.assign(slots, kNobody);
}

Cell FoldedCells::cell_of(const Vec& place) const {
  Cell cell;
  for (int axis : {0, 1})
    cell.at[axis] = static_cast<std::int64_t>(std::floor((place[axis] - origin_[axis]) / edge_[axis]));
  return cell;
}

void FoldedCells::add(std::uint32_t disc, std::size_t slot) {
  Slot& first = first_[slot];
  if (first.count < kFirst) {
    first.disc[first.count] = disc;
  } else {
    next_[disc] = more_[slot];
    more_[slot] = disc;
  }
  ++first.count;
}

/// Into its place comes the first of those that had none, or the last one.
void FoldedCells::remove(std::uint32_t disc, std::size_t slot) {
  Slot& first = first_[slot];
  const std::size_t place =
      static_cast<std::size_t>(std::ranges::find(first.disc, disc) - first.disc.begin());
  --first.count;
  if (first.count < kFirst) [[likely]] {
    first.disc[place] = first.disc[first.count];
    return;
  }
  std::uint32_t* link = &more_[slot];
  if (place < kFirst) {
    first.disc[place] = *link;
    *link = next_[*link];
  } else {
    while (*link != disc) link = &next_[*link];
    *link = next_[disc];
  }
}

/// Each slot once that the box's cells fold to.
template <class Visit>
void FoldedCells::for_each_slot(const Eigen::AlignedBox2d& box, Visit visit) const {
  const Cell low = cell_of(box.min()), high = cell_of(box.max());
  const std::int64_t columns = std::min(high.at[0] - low.at[0] + 1, count_[0]);
  const std::int64_t rows = std::min(high.at[1] - low.at[1] + 1, count_[1]);
  for (std::int64_t y = 0; y < rows; ++y)
    for (std::int64_t x = 0; x < columns; ++x) visit(slot({{low.at[0] + x, low.at[1] + y}}));
}

void FoldedCells::list(const Obstacles& obstacles, double reach) {
  if (obstacles.size() == 0) return;
  std::vector<std::pair<std::size_t, std::uint32_t>> listed;
  const Vec end(border(0, count_[0]), border(1, count_[1])), grown(reach, reach);
  for (std::uint32_t row = 0; row < obstacles.size(); ++row) {
    Eigen::AlignedBox2d box(origin_, end);
    if (obstacles.is_side(row)) {  // from its line inwards
      const narrowphase::HalfPlane& side = obstacles.side[row];
      const int axis = side.normal.x() != 0.0 ? 0 : 1;
      (side.normal[axis] > 0.0 ? box.max() : box.min())[axis] = side.point[axis];
    } else {
      box = bounds(obstacles.part_at(row));
    }
    box.min() -= grown, box.max() += grown;
    for_each_slot(box, [&](std::size_t slot) { listed.emplace_back(slot, row); });
  }
  std::ranges::sort(listed);
  begin_.assign(slots() + 1, 0);
  for (const auto& [slot, row] : listed) ++begin_[slot + 1], obstacle_.push_back(row);
  for (std::size_t slot = 0; slot < slots(); ++slot) begin_[slot + 1] += begin_[slot];
}

std::span<const std::uint32_t> FoldedCells::obstacles(std::size_t slot) const {
  if (begin_.empty()) return {};
  return {obstacle_.data() + begin_[slot], obstacle_.data() + begin_[slot + 1]};
}

}  // namespace throng
