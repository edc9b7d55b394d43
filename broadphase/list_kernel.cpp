// SPDX-License-Identifier: MIT
#include "broadphase/list_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broadphase/list_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <array>

#include "broadphase/proximity_keep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace throng::broadphase::HWY_NAMESPACE {

/// The stretches of places in which the neighbours of one cell's points stand: those of three cells of three
/// rows, in two parts where they reach across a seam.
struct Around {
  std::array<std::uint32_t, 6> first, end;
  std::size_t count = 0, places = 0;

  Around(const CellOrder& order, const Cell& cell) {
    const Cells& cells = order.cells();
    Range range{{cell.x - 1, cell.y - 1}, {cell.x + 1, cell.y + 1}};
    clip(cells.periodic(), cells.columns(), range.first.x, range.last.x);
    clip(cells.periodic(), cells.rows(), range.first.y, range.last.y);
    cells.for_each_run(range, [&](const Run& run) {
      first[count] = order.start()[run.bucket];
      end[count] = order.start()[run.end_bucket];
      places += end[count] - first[count];
      ++count;
    });
  }

 private:
  static void clip(bool periodic, std::int64_t cells, std::int64_t& first, std::int64_t& last) {
    if (periodic && cells > 1) return;  // then there are three or more
    first = std::max<std::int64_t>(first, 0);
    last = std::min(last, cells - 1);
  }
};

/// The squared distances from place `at` to those of the vector that begins at `other`, and which of these
/// are before `end` and at most the root of `limit` away.
template <class Space>
struct Near {
  HWY_INLINE Near(const CellOrder& order, const Space& space, std::size_t at, double limit)
      : order_(order),
        space_(space),
        x_(hn::Set(D(), order.x()[at])),
        y_(hn::Set(D(), order.y()[at])),
        limit_(hn::Set(D(), limit)) {}

  HWY_INLINE Mask ask(std::size_t other, std::size_t end, Reals& squares) const {
    squares = squared(space_.template to<0>(x_, hn::LoadU(D(), order_.x() + other)),
                      space_.template to<1>(y_, hn::LoadU(D(), order_.y() + other)));
    return hn::And(hn::Le(squares, limit_), hn::FirstN(D(), end - other));
  }

 private:
  const CellOrder& order_;
  const Space space_;
  const Reals x_, y_, limit_;
};

template <class Space>
HWY_INLINE std::size_t count_near(const Near<Space>& near, const Around& around) {
  std::size_t count = 0;
  Reals squares;
  for (std::size_t k = 0; k < around.count; ++k)
    for (std::size_t j = around.first[k]; j < around.end[k]; j += kLanes)
      count += hn::CountTrue(D(), near.ask(j, around.end[k], squares));
  return count - 1;  // but itself
}

/// Keeps them, but `row` itself; returns how many.
template <class Space>
HWY_INLINE std::size_t keep_near(const Near<Space>& near, const Around& around, const std::uint32_t* rows,
                                 std::uint32_t row, Answers& answers) {
  make_room(around.places + around.count * kLanes, answers);
  double* key = answers.key.data();
  std::uint64_t* who = answers.who.data();
  const hn::Rebind<std::uint32_t, U> narrow;
  const Rows own = hn::Set(U(), row);
  std::size_t count = 0;
  Reals squares;
  for (std::size_t k = 0; k < around.count; ++k)
    for (std::size_t j = around.first[k]; j < around.end[k]; j += kLanes) {
      const Mask there = near.ask(j, around.end[k], squares);
      const Rows others = hn::PromoteTo(U(), hn::LoadU(narrow, rows + j));
      const Mask other = hn::RebindMask(D(), hn::Ne(others, own));
      count += keep(hn::And(there, other), squares, others, key + count, who + count);
    }
  return count;
}

/// Calls `f(place, around, limit)` for each place.
template <class F>
HWY_INLINE void for_each_place(const ListQuestion& question, std::size_t at, std::size_t end, F&& f) {
  const CellOrder& order = question.cells;
  while (at < end) {
    const Cell cell = order.cells().cell({order.x()[at], order.y()[at]});
    const Around around(order, cell);
    const std::size_t last = std::min<std::size_t>(end, order.start()[order.cells().bucket(cell) + 1]);
    for (; at < last; ++at) {
      const double radius = question.own.empty() ? question.radius : question.own[order.row()[at]];
      f(at, around, radius * radius);
    }
  }
}

/// Calls `f(space)` with the space that suits the domain.
template <class F>
HWY_INLINE void choose_space(const Period* period, F&& f) {
  if (period)
    f(Torus(*period));
  else
    f(Plane({}));
}

void CountNeighbours(const ListQuestion& question, std::size_t first, std::size_t end, std::uint32_t* count) {
  choose_space(question.period, [&]<class Space>(const Space& space) HWY_ATTR {
    for_each_place(question, first, end, [&](std::size_t at, const Around& around, double limit) HWY_ATTR {
      count[at] =
          static_cast<std::uint32_t>(count_near(Near<Space>(question.cells, space, at, limit), around));
    });
  });
}

void GatherNeighbours(const ListQuestion& question, std::size_t first, std::size_t end, Answers& answers) {
  const CellOrder& order = question.cells;
  choose_space(question.period, [&]<class Space>(const Space& space) HWY_ATTR {
    for_each_place(question, first, end, [&](std::size_t at, const Around& around, double limit) HWY_ATTR {
      const Near<Space> near(order, space, at, limit);
      append_sorted<true>(keep_near(near, around, order.row(), order.row()[at], answers), answers);
    });
  });
}

}  // namespace throng::broadphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace throng::broadphase {

HWY_EXPORT(CountNeighbours);
HWY_EXPORT(GatherNeighbours);

void count_neighbours(const ListQuestion& question, std::size_t first, std::size_t end,
                      std::uint32_t* count) {
  HWY_DYNAMIC_DISPATCH(CountNeighbours)(question, first, end, count);
}

void gather_neighbours(const ListQuestion& question, std::size_t first, std::size_t end, Answers& answers) {
  HWY_DYNAMIC_DISPATCH(GatherNeighbours)(question, first, end, answers);
}

}  // namespace throng::broadphase

#endif
