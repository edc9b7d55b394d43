// SPDX-License-Identifier: MIT
#include "sim/recording/frame_reader.h"

#include <algorithm>

#include "sim/recording/frame_hash.h"
#include "sim/recording/numbers.h"
#include "sim/recording/observables.h"

namespace throng::recording {

namespace {

void clear(Frame& frame) {
  frame.is_present.clear();
  for (RecordField field : kBodyFields) with_field(frame, field, [](auto& numbers) { numbers.clear(); });
  frame.contacts.reset(), frame.observables.reset(), frame.sensed.clear();
}

std::span<double> resized(std::vector<Vec>& vectors, std::size_t bodies) {
  vectors.resize(bodies);
  return {vectors.empty() ? nullptr : vectors.front().data(), 2 * bodies};
}
std::span<double> resized(std::vector<double>& scalars, std::size_t bodies) {
  scalars.resize(bodies);
  return scalars;
}

}  // namespace

void FrameReader::read(std::size_t i, Frame& frame) const {
  clear(frame);
  FrameHash hash(frame.step, frame.time, frame.state_hash);
  const std::size_t present = read_present(i, frame, hash);
  for (RecordField field : kBodyFields) read_field(field, i, present, frame, hash);
  read_contacts(i, frame, hash);
  for (const StoredSensed& stored : sensed_) frame.sensed.push_back(read_sensed(stored, i, hash));
  read_observables(i, frame, hash);
  if (hash.value() != frame.frame_hash) throw h5::Error("it does not match its hash");
}

void FrameReader::read_angles(std::size_t i, std::vector<double>& angles) const {
  Frame frame;
  FrameHash unused(0, 0.0, 0);
  const std::size_t present = read_present(i, frame, unused);
  read_field(RecordField::angle, i, present, frame, unused);
  angles = std::move(frame.angle);
  for (std::size_t row = 0; row < angles.size(); ++row)
    if (!frame.has(row)) angles[row] = 0.0;
}

/// Returns how many bodies are in the frame: their ids stand in front, ascending. None where it has no ids.
std::size_t FrameReader::read_present(std::size_t i, Frame& frame, FrameHash& hash) const {
  if (!changes_) return ids_.size();
  frame.is_present.assign(ids_.size(), 0);
  const std::optional<std::size_t> sample = present_when_.sample(i);
  if (!sample) return 0;
  std::vector<std::uint32_t> found(ids_.size());
  h5::read_row<std::uint32_t>(present_, *sample, found.data(), found.size() * sizeof(std::uint32_t));
  const auto end = std::ranges::find(found, 0u);
  if (std::any_of(end, found.end(), [](std::uint32_t id) { return id != 0; }))
    throw h5::Error("id is not in order");
  found.erase(end, found.end());
  hash.add(std::as_bytes(std::span(found)));
  rows_.clear();
  for (std::uint32_t id : found) {
    const auto row = static_cast<std::uint32_t>(std::ranges::lower_bound(ids_, id) - ids_.begin());
    if (row == ids_.size() || ids_[row] != id || (!rows_.empty() && row <= rows_.back()))
      throw h5::Error("id is not in order");
    rows_.push_back(row);
    frame.is_present[row] = 1;
  }
  return found.size();
}

/// Reads numbers as stored (T), and hands them out as doubles.
template <class T>
void FrameReader::read_numbers(RecordField field, std::size_t sample, std::size_t present,
                               FrameHash& hash) const {
  std::vector<T>* stored;
  if constexpr (std::is_same_v<T, double>)
    stored = &numbers_;
  else
    stored = &singles_;
  stored->resize(ids_.size() * components(field));
  h5::read_row<T>(fields_[index(field)].set, sample, stored->data(), stored->size() * sizeof(T));
  stored->resize(present * components(field));
  hash.add(std::as_bytes(std::span(*stored)));
  if (!all_finite<T>(*stored)) throw h5::Error(std::string(name(field)) + " is not finite");
  if constexpr (!std::is_same_v<T, double>) numbers_.assign(stored->begin(), stored->end());
}

/// Of the bodies in the frame: those that are away have places, too.
void FrameReader::read_quantized(std::size_t sample, FrameHash& hash) const {
  quantized_.read(sample, numbers_, hash);
  if (!changes_) return;
  for (std::size_t k = 0; k < rows_.size(); ++k)
    for (std::size_t c = 0; c < 2; ++c) numbers_[2 * k + c] = numbers_[2 * rows_[k] + c];
  numbers_.resize(2 * rows_.size());
}

void FrameReader::read_field(RecordField field, std::size_t i, std::size_t present, Frame& frame,
                             FrameHash& hash) const {
  const std::optional<std::size_t> sample = schedule(field).sample(i);
  if (!sample) return;
  if (field == RecordField::position && quantized_.quantum() > 0.0)
    read_quantized(*sample, hash);
  else if (single_)
    read_numbers<float>(field, *sample, present, hash);
  else
    read_numbers<double>(field, *sample, present, hash);
  hand_out(field, frame);
}

/// Bodies that are not in the frame have no numbers.
void FrameReader::hand_out(RecordField field, Frame& frame) const {
  const std::size_t each = components(field), bodies = numbers_.size() / each;
  const auto row = [&](std::size_t k) { return changes_ ? rows_[k] : k; };
  with_field(frame, field, [&](auto& values) {
    const auto to = resized(values, ids_.size());
    if (changes_) std::ranges::fill(to, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t k = 0; k < bodies; ++k)
      for (std::size_t c = 0; c < each; ++c) to[each * row(k) + c] = numbers_[each * k + c];
  });
}

void FrameReader::read_contacts(std::size_t i, Frame& frame, FrameHash& hash) const {
  const std::optional<std::size_t> sample = schedule(RecordField::contacts).sample(i);
  if (!sample) return;
  const std::uint64_t first = contacts_.offset[*sample], count = contacts_.offset[*sample + 1] - first;
  const auto a = h5::read_rows<std::uint32_t>(contacts_.a, first, count),
             b = h5::read_rows<std::uint32_t>(contacts_.b, first, count);
  const auto impulse = h5::read_rows<double>(contacts_.impulse, first, count),
             point = h5::read_rows<double>(contacts_.point, first, count);
  hash.add(std::as_bytes(std::span(a)));
  hash.add(std::as_bytes(std::span(b)));
  hash.add(std::as_bytes(std::span(impulse)));
  hash.add(std::as_bytes(std::span(point)));
  if (!all_finite<double>(impulse) || !all_finite<double>(point)) throw h5::Error("contacts are not finite");
  const auto is_body = [&](std::uint32_t id) { return id >= 1 && id <= bodies_; };
  if (!std::ranges::all_of(a, is_body) ||
      !std::ranges::all_of(b, [&](std::uint32_t id) { return id == 0 || is_body(id); }))
    throw h5::Error("contacts are of bodies that there are not");
  frame.contacts.emplace();
  for (std::size_t k = 0; k < count; ++k)
    frame.contacts->push_back({a[k], b[k], impulse[k], {point[2 * k], point[2 * k + 1]}});
}

/// Ids that ascend, of bodies of the run.
void FrameReader::expect_names(std::span<const std::uint32_t> ids) const {
  std::uint32_t last = 0;
  for (const std::uint32_t id : ids) {
    if (id <= last || id > bodies_) throw h5::Error("sensed ids are not in order");
    last = id;
  }
}

std::optional<Sensed> FrameReader::read_sensed(const StoredSensed& stored, std::size_t i,
                                               FrameHash& hash) const {
  const std::optional<std::size_t> sample = stored.when.sample(i);
  if (!sample) return std::nullopt;
  const auto read = [&](const h5::Dataset& column, const std::vector<std::uint64_t>& offset) {
    auto ids = h5::read_rows<std::uint32_t>(column, offset[*sample], offset[*sample + 1] - offset[*sample]);
    hash.add(std::as_bytes(std::span(ids)));
    return ids;
  };
  Sensed sensed;
  sensed.who = read(stored.who, stored.offset);
  sensed.count = read(stored.count, stored.offset);
  sensed.whom = read(stored.whom, stored.whom_offset);
  expect_names(sensed.who);
  std::size_t at = 0;
  for (const std::uint32_t count : sensed.count) {
    if (count > sensed.whom.size() - at) throw h5::Error("sensed rows are too few");
    expect_names(std::span(sensed.whom).subspan(at, count));
    at += count;
  }
  if (at != sensed.whom.size()) throw h5::Error("sensed rows are too many");
  return sensed;
}

void FrameReader::read_observables(std::size_t i, Frame& frame, FrameHash& hash) const {
  const std::optional<std::size_t> sample = observables_.when.sample(i);
  if (!sample) return;
  std::vector<double> found;
  for (std::size_t k = 0; k < observables_.values.size(); ++k) {
    const Observable& observable = observables_.observables[k];
    const std::size_t n = observable.components;
    const auto numbers = std::span(observables_.values[k]).subspan(*sample * n, n);
    if (!observable.may_be_nan && !all_finite<double>(numbers))
      throw h5::Error(observable.name + " is not finite");
    found.insert(found.end(), numbers.begin(), numbers.end());
    hash.add(std::as_bytes(numbers));
  }
  frame.observables = observables_from(found, observables_.crowd);
}

}  // namespace throng::recording
