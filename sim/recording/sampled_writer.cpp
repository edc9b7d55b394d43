// SPDX-License-Identifier: MIT
#include "sim/recording/sampled_writer.h"

#include <bit>

namespace throng::recording {

namespace {

constexpr hsize_t kContactChunk = 16384;  // rows

/// One column of the rows, to a log and into a hash.
template <class F>
std::size_t add_column(std::span<const ContactRow> rows, F value, RowLog& log, FrameHash& hash) {
  std::vector<decltype(value(rows[0]))> column;
  column.reserve(rows.size());
  for (const ContactRow& row : rows) column.push_back(value(row));
  const auto bytes = std::as_bytes(std::span(column));
  hash.add(bytes);
  log.add(bytes);
  return bytes.size();
}

}  // namespace

RateRows::RateRows(hid_t group)
    : step_(RowLog::create<std::int64_t>(group, "step")), time_(RowLog::create<double>(group, "time")) {}

void RateRows::append(std::int64_t step, double time) {
  step_.add(step);
  time_.add(time);
}

ContactWriter::ContactWriter(hid_t group)
    : offset_(RowLog::create<std::uint64_t>(group, "offset")),
      a_(RowLog::create<std::uint32_t>(group, "a", 1, kContactChunk)),
      b_(RowLog::create<std::uint32_t>(group, "b", 1, kContactChunk)),
      impulse_(RowLog::create<double>(group, "impulse", 1, kContactChunk)),
      point_(RowLog::create<double>(group, "point", 2, kContactChunk)) {
  offset_.add(rows_);
}

std::size_t ContactWriter::append(std::span<const ContactRow> rows, FrameHash& hash) {
  rows_ += rows.size();
  offset_.add(rows_);
  return add_column(
             rows, [](const ContactRow& r) { return r.a; }, a_, hash) +
         add_column(
             rows, [](const ContactRow& r) { return r.b; }, b_, hash) +
         add_column(
             rows, [](const ContactRow& r) { return r.impulse; }, impulse_, hash) +
         add_column(
             rows,
             [](const ContactRow& r) {
               return std::array{r.point.x(), r.point.y()};
             },
             point_, hash);
}

std::size_t ObservableWriter::append(const Observables& observables, FrameHash& hash) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const auto value =
        std::as_bytes(std::span(kObservables[i].numbers(observables), kObservables[i].components));
    hash.add(value);
    logs_[i].add(value);
    bytes += value.size();
  }
  return bytes;
}

}  // namespace throng::recording
