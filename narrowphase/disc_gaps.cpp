// SPDX-License-Identifier: MIT
#include "narrowphase/disc_gaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "narrowphase/disc_gaps.cpp"
#include <hwy/foreach_target.h>  // compiles what follows for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace throng::narrowphase::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Rows `row` and those after it, elementwise: how many at a time changes no bit.
template <class Tag>
void find_gaps_at(Tag tag, const Discs& a, const Discs& b, DiscGaps& gaps, std::size_t row) {
  const auto x = hn::LoadU(tag, &a.x[row]), y = hn::LoadU(tag, &a.y[row]),
             radius = hn::LoadU(tag, &a.radius[row]);
  const auto to_x = hn::Sub(hn::LoadU(tag, &b.x[row]), x), to_y = hn::Sub(hn::LoadU(tag, &b.y[row]), y);
  const auto length = hn::Sqrt(hn::Add(hn::Mul(to_x, to_x), hn::Mul(to_y, to_y)));
  const auto one = hn::Set(tag, 1.0), zero = hn::Zero(tag);
  const auto apart = hn::Gt(length, zero);
  const auto scale = hn::Div(one, hn::IfThenElse(apart, length, one));
  const auto normal_x = hn::IfThenElse(apart, hn::Mul(to_x, scale), one), normal_y = hn::Mul(to_y, scale);
  hn::StoreU(hn::Sub(length, hn::Add(radius, hn::LoadU(tag, &b.radius[row]))), tag, &gaps.distance[row]);
  hn::StoreU(normal_x, tag, &gaps.normal_x[row]);
  hn::StoreU(normal_y, tag, &gaps.normal_y[row]);
  hn::StoreU(hn::Add(x, hn::Mul(radius, normal_x)), tag, &gaps.point_x[row]);
  hn::StoreU(hn::Add(y, hn::Mul(radius, normal_y)), tag, &gaps.point_y[row]);
}

void find_gaps(const Discs& a, const Discs& b, DiscGaps& gaps) {
  const hn::ScalableTag<double> wide;
  const hn::CappedTag<double, 1> single;
  const std::size_t rows = a.x.size(), lanes = hn::Lanes(wide);
  std::size_t row = 0;
  for (; row + lanes <= rows; row += lanes) find_gaps_at(wide, a, b, gaps, row);
  for (; row < rows; ++row) find_gaps_at(single, a, b, gaps, row);
}

}  // namespace throng::narrowphase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace throng::narrowphase {

HWY_EXPORT(find_gaps);

void find_gaps(const Discs& a, const Discs& b, DiscGaps& gaps) {
  for (auto* column : {&gaps.distance, &gaps.normal_x, &gaps.normal_y, &gaps.point_x, &gaps.point_y})
    column->resize(a.x.size());
  HWY_DYNAMIC_DISPATCH(find_gaps)(a, b, gaps);
}

}  // namespace throng::narrowphase
#endif
