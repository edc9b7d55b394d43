// SPDX-License-Identifier: MIT
#include "sim/recording/field_writer.h"

#include <stdexcept>
#include <utility>

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
      quantum_(is_quantized(record, field) ? record.quantum : 0.0) {
  if (quantum_ == 0.0) return;
  for (auto* numbers : {&now_, &before_, &earlier_}) numbers->resize(numbers_);
  stored_.resize(numbers_);
}

std::size_t FieldWriter::append(std::span<const double> numbers, FrameHash& hash) {
  return quantum_ > 0.0 ? append_quantized(numbers, hash) : append_numbers(numbers, hash);
}

std::size_t FieldWriter::append_numbers(std::span<const double> numbers, FrameHash& hash) {
  if (single_) singles_.assign(numbers.begin(), numbers.end());
  const auto bytes = single_ ? std::as_bytes(std::span(std::as_const(singles_))) : std::as_bytes(numbers);
  hash.add(bytes);
  blocks_.write(bytes);
  return bytes.size();
}

std::size_t FieldWriter::append_quantized(std::span<const double> numbers, FrameHash& hash) {
  try {
    quantize(numbers, quantum_, now_);
  } catch (const std::range_error&) {
    throw std::runtime_error("a position is too far out for record.quantize: at most 2^31 of it from 0");
  }
  predict(blocks_.frames(), now_, before_, earlier_, stored_);
  hash.add(std::as_bytes(std::span(now_)));
  earlier_.swap(before_);
  before_.swap(now_);
  return blocks_.write_packed(stored_);
}

}  // namespace throng::recording
