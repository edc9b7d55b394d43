// SPDX-License-Identifier: MIT
#include "sim/recording/sampled_writer.h"

#include <array>
#include <numeric>

namespace throng::recording {

namespace {

/// A column as it is, to a log and into a hash.
std::size_t add_all(std::span<const std::uint32_t> column, RowLog& log, FrameHash& hash) {
  const auto bytes = std::as_bytes(column);
  hash.add(bytes);
  log.add(bytes);
  return bytes.size();
}

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

ContactWriter::ContactWriter(hid_t group, std::size_t bodies)
    : offset_(RowLog::create<std::uint64_t>(group, "offset")),
      a_(RowLog::create<std::uint32_t>(group, "a", 1, contact_chunk(bodies))),
      b_(RowLog::create<std::uint32_t>(group, "b", 1, contact_chunk(bodies))),
      impulse_(RowLog::create<double>(group, "impulse", 1, contact_chunk(bodies))),
      point_(RowLog::create<double>(group, "point", 2, contact_chunk(bodies))) {
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

SensedWriter::SensedWriter(hid_t group, int every)
    : every_(every),
      offset_(RowLog::create<std::uint64_t>(group, "offset")),
      who_(RowLog::create<std::uint32_t>(group, "who", 1, kContactChunk)),
      count_(RowLog::create<std::uint32_t>(group, "count", 1, kContactChunk)),
      whom_offset_(RowLog::create<std::uint64_t>(group, "whom_offset")),
      whom_(RowLog::create<std::uint32_t>(group, "whom", 1, kContactChunk)) {
  offset_.add(rows_);
  whom_offset_.add(whom_rows_);
}

std::size_t SensedWriter::append(const Sensed& sensed, FrameHash& hash) {
  rows_ += sensed.who.size();
  whom_rows_ += sensed.whom.size();
  offset_.add(rows_);
  whom_offset_.add(whom_rows_);
  return add_all(sensed.who, who_, hash) + add_all(sensed.count, count_, hash) +
         add_all(sensed.whom, whom_, hash);
}

std::size_t ObservableWriter::append(const Observables& observables, FrameHash& hash) {
  const std::vector<double> numbers = numbers_of(observables);
  const auto add = [](std::size_t sum, const Observable& one) { return sum + one.components; };
  if (numbers.size() != std::accumulate(observables_.begin(), observables_.end(), std::size_t{0}, add))
    throw h5::Error("a frame has other observables");
  std::size_t at = 0;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    const auto value = std::as_bytes(std::span(numbers).subspan(at, observables_[i].components));
    hash.add(value);
    logs_[i].add(value);
    at += observables_[i].components;
  }
  return at * sizeof(double);
}

}  // namespace throng::recording
