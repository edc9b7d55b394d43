// SPDX-License-Identifier: MIT
#include "sim/recording/field_writer.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "sim/recording/numbers.h"
#include "sim/recording/packed.h"

namespace throng::recording {

namespace {

FrameBlocks make_blocks(hid_t element, RecordField field, const Record& record, const Selection& selection) {
  FrameBlocks::Form form{selection.rows(), components(field), 0};
  if (is_quantized(record, field)) {
    form.most_per_chunk = kMaxChunk / (sizeof(std::uint32_t) * form.columns);
    form.packed = true;
    return {element, name(field), h5::type<std::uint32_t>(), form};
  }
  form.sparse = selection.changes();
  const hid_t type = record.single ? h5::type<float>() : h5::type<double>();
  form.most_per_chunk = selection.changes() ? kRegionChunk : kMaxChunk / (H5Tget_size(type) * form.columns);
  return {element, "value", type, form};
}

}  // namespace

FieldWriter::FieldWriter(hid_t element, RecordField field, const Record& record, const Selection& selection)
    : blocks_(make_blocks(element, field, record, selection)),
      numbers_(selection.rows() * components(field)),
      single_(record.single),
      quantum_(is_quantized(record, field) ? record.quantum : 0.0),
      ids_(selection.ids()) {
  if (quantum_ == 0.0) return;
  for (auto* numbers : {&now_, &before_, &earlier_}) numbers->resize(numbers_);
  stored_.resize(numbers_);
}

std::size_t FieldWriter::append(std::int64_t step, std::span<const double> numbers, FrameHash& hash) {
  bool finite = true;
  std::size_t bytes = numbers.size() * (single_ ? sizeof(float) : sizeof(double));
  if (quantum_ > 0.0) {
    finite = all_finite(numbers);
    if (finite) bytes = append_quantized(step, numbers, hash);
  } else if (single_) {
    singles_.assign(numbers.begin(), numbers.end());
    finite = append_numbers<float>(singles_, hash);
  } else {
    finite = append_numbers(numbers, hash);
  }
  if (!finite) throw std::runtime_error("the state of step " + std::to_string(step) + " is not finite");
  return bytes;
}

/// Returns whether all are finite.
template <class T>
bool FieldWriter::append_numbers(std::span<const T> numbers, FrameHash& hash) {
  BytesHash field;
  bool finite = true;
  blocks_.write(std::as_bytes(numbers), [&](std::span<const std::byte> piece) {
    field.add(piece);
    finite &= all_finite(std::span(reinterpret_cast<const T*>(piece.data()), piece.size() / sizeof(T)));
  });
  hash.add(field);
  return finite;
}

std::size_t FieldWriter::append_quantized(std::int64_t step, std::span<const double> numbers,
                                          FrameHash& hash) {
  try {
    quantize(numbers, quantum_, now_);
  } catch (const std::range_error&) {
    throw std::runtime_error(too_far(step, numbers));
  }
  predict(blocks_.frames(), now_, before_, earlier_, stored_);
  hash.add(std::as_bytes(std::span(now_)));
  earlier_.swap(before_);
  before_.swap(now_);
  return blocks_.write_packed(stored_);
}

/// Of whom, and what would do for all of this frame.
std::string FieldWriter::too_far(std::int64_t step, std::span<const double> numbers) const {
  const auto farthest = std::ranges::max_element(numbers, {}, [](double x) { return std::abs(x); });
  const std::size_t row = static_cast<std::size_t>(farthest - numbers.begin()) / 2;
  char text[200];
  std::snprintf(text, sizeof text,
                "position of body %u at step %" PRId64
                " is (%.6g, %.6g) m, too far out for record.quantize = %.2g: there it must be at least %.2g",
                ids_[row], step, numbers[2 * row], numbers[2 * row + 1], quantum_,
                least_quantum(std::abs(*farthest)));
  return text;
}

}  // namespace throng::recording
