// SPDX-License-Identifier: MIT
#include "sim/recording/field_writer.h"

#include <algorithm>
#include <stdexcept>

#include "sim/recording/packed.h"

namespace throng::recording {

namespace {

FrameBlocks make_blocks(hid_t element, FieldIndex field, const Record& record, const Selection& selection) {
  FrameBlocks::Form form{selection.rows(), static_cast<hsize_t>(kComponents[field]), 0};
  if (is_quantized(record, field)) {
    form.most_per_chunk = kMaxChunk / (sizeof(std::uint32_t) * form.columns);
    form.packed = true;
    return {element, kFieldName[field], h5::type<std::uint32_t>(), form};
  }
  const hid_t type = record.single ? h5::type<float>() : h5::type<double>();
  form.most_per_chunk = selection.changes() ? kRegionChunk : kMaxChunk / (H5Tget_size(type) * form.columns);
  return {element, "value", type, form};
}

}  // namespace

FieldWriter::FieldWriter(hid_t element, FieldIndex field, const Record& record, const Selection& selection)
    : blocks_(make_blocks(element, field, record, selection)),
      components_(static_cast<std::size_t>(kComponents[field])),
      single_(record.single),
      quantum_(is_quantized(record, field) ? record.quantum : 0.0),
      values_(selection.rows() * components_) {
  if (quantum_ > 0.0) {
    for (auto* numbers : {&now_, &before_, &earlier_}) numbers->resize(values_.size());
    stored_.resize(values_.size());
  } else if (single_) {
    singles_.resize(values_.size());
  }
}

std::size_t FieldWriter::append(std::size_t bodies, FrameHash& hash) {
  return quantum_ > 0.0 ? append_quantized(hash) : append_numbers(bodies, hash);
}

std::size_t FieldWriter::append_numbers(std::size_t bodies, FrameHash& hash) {
  const std::size_t count = bodies * components_;
  if (single_) std::copy_n(values_.begin(), count, singles_.begin());
  const auto bytes = single_ ? std::as_bytes(std::span(singles_).first(count))
                             : std::as_bytes(std::span(values_).first(count));
  hash.add(bytes);
  blocks_.write(bytes);
  return bytes.size();
}

std::size_t FieldWriter::append_quantized(FrameHash& hash) {
  try {
    for (std::size_t i = 0; i < values_.size(); ++i) now_[i] = quantized(values_[i], quantum_);
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
