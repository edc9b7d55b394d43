// SPDX-License-Identifier: MIT
#include "sim/recording/trajectory_writer.h"

#include <algorithm>
#include <utility>

#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/numbers.h"

namespace throng::recording {

namespace {

/// Puts the numbers of the rows that are present to the front of `to`, which may be `from`.
std::span<const double> compact(const std::vector<std::uint8_t>& is_present, std::size_t components,
                                std::span<const double> from, std::vector<double>& to) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < is_present.size(); ++row)
    for (std::size_t c = 0; is_present[row] && c < components; ++c) to[count++] = from[row * components + c];
  return std::span(to).first(count);
}

/// The same numbers in the same places, 0 in the rows that are not present. `to` may be `from`.
std::span<const double> cleared(const std::vector<std::uint8_t>& is_present, std::size_t components,
                                std::span<const double> from, std::vector<double>& to) {
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = is_present[i / components] ? from[i] : 0.0;
  return to;
}

}  // namespace

bool TrajectoryWriter::holds(RecordField field, std::int64_t step) const {
  return is_due(every(record_, field), step);
}

void TrajectoryWriter::append(const State& state, std::uint64_t state_hash,
                              std::span<const ContactRow> contacts,
                              const std::optional<Observables>& observables, std::span<const Sensed> sensed) {
  gather(state);
  append_gathered(state.step, state_hash, contacts, observables, sensed);
}

void TrajectoryWriter::append(Frame&& frame) {
  gather(frame);
  std::vector<Sensed> sensed;
  for (std::optional<Sensed>& one : frame.sensed) sensed.push_back(std::move(one).value_or(Sensed{}));
  std::span<const ContactRow> contacts;
  if (frame.contacts) contacts = *frame.contacts;
  const std::uint64_t stored =
      append_gathered(frame.step, frame.state_hash, contacts, frame.observables, sensed);
  if (stored != frame.frame_hash)
    throw h5::Error("frame of step " + std::to_string(frame.step) + " would be stored otherwise");
}

/// Returns the frame's hash.
std::uint64_t TrajectoryWriter::append_gathered(std::int64_t step, std::uint64_t state_hash,
                                                std::span<const ContactRow> contacts,
                                                const std::optional<Observables>& observables,
                                                std::span<const Sensed> sensed) {
  const double time = static_cast<double>(step) * dt_;
  FrameHash hash(step, time, state_hash);
  std::size_t bytes = write_fields(step, hash);
  if (holds(RecordField::contacts, step)) bytes += contacts_.append(chosen(contacts), hash);
  bytes += write_sensed(step, sensed, hash);
  if (observables_ && is_due(record_.observables, step))
    bytes += observables_.append(observables.value(), hash);
  for (Rate& rate : rates_)
    if (is_due(rate.every, step)) rate.rows.append(step, time);
  rows_[kStep].add(step);
  rows_[kTime].add(time);
  rows_[kStateHash].add(state_hash);
  rows_[kFrameHash].add(hash.value());
  ++frames_;
  uncommitted_bytes_ += static_cast<double>(bytes);
  return hash.value();
}

/// A field's numbers in the order of the file: those of the state itself, where they stand so.
std::span<const double> TrajectoryWriter::in_rows(RecordField field, const State& state, bool stand_so) {
  const auto from = with_field(state, field, [](const auto& numbers) { return flat(numbers); });
  if (stand_so) return from;
  std::vector<double>& values = fields_[index(field)].values();
  if (selection_.changes()) std::ranges::fill(values, 0.0);  // of agents who are gone, nothing else
  components(field) == 2 ? selection_.bring<2>(state.id, from.data(), values)
                         : selection_.bring<1>(state.id, from.data(), values);
  return values;
}

void TrajectoryWriter::gather(const State& state) {
  const bool stand_so = selection_.is_order(state.id);
  for (RecordField field : kBodyFields)
    if (holds(field, state.step)) due_[index(field)] = in_rows(field, state, stand_so);
  if (!selection_.changes() || !has_bodies(record_, state.step)) return;
  is_present_.assign(selection_.rows(), 0);
  for (std::size_t body = 0; body < state.id.size(); ++body)
    if (const std::uint32_t row = selection_.row_of(state.id[body]); row != Selection::kNone)
      is_present_[row] = selection_.is_within(state.position[body]);
  keep_present(state.step);
}

/// The fields of a frame are in the file's order already.
void TrajectoryWriter::gather(const Frame& frame) {
  for (RecordField field : kBodyFields) {
    if (!holds(field, frame.step)) continue;
    due_[index(field)] = with_field(frame, field, [](const auto& numbers) { return flat(numbers); });
    if (due_[index(field)].size() != selection_.rows() * components(field))
      throw h5::Error(std::string(name(field)) + " is missing in a frame");
  }
  if (!selection_.changes() || !has_bodies(record_, frame.step)) return;
  is_present_ = frame.is_present;
  is_present_.resize(selection_.rows(), 1);
  keep_present(frame.step);
}

/// Leaves of what was gathered those who are present. Quantized numbers keep their places, from
/// which the next frame goes on.
void TrajectoryWriter::keep_present(std::int64_t step) {
  present_.clear();
  for (std::size_t row = 0; row < is_present_.size(); ++row)
    if (is_present_[row]) present_.push_back(selection_.ids()[row]);
  for (RecordField field : kBodyFields)
    if (holds(field, step))
      due_[index(field)] = (is_quantized(record_, field) ? cleared : compact)(
          is_present_, components(field), due_[index(field)], fields_[index(field)].values());
}

/// Returns the bytes that they took.
std::size_t TrajectoryWriter::write_fields(std::int64_t step, FrameHash& hash) {
  std::size_t bytes = 0;
  if (ids_ && has_bodies(record_, step)) {
    const auto ids = std::as_bytes(std::span(present_));
    BytesHash column;
    ids_.write(ids, [&](std::span<const std::byte> piece) { column.add(piece); });
    hash.add(column);
    id_times_.append(step, static_cast<double>(step) * dt_);
    bytes += ids.size();
  }
  for (RecordField field : kBodyFields)
    if (holds(field, step)) bytes += fields_[index(field)].append(step, due_[index(field)], hash);
  return bytes;
}

/// Returns the bytes that they took.
std::size_t TrajectoryWriter::write_sensed(std::int64_t step, std::span<const Sensed> sensed,
                                           FrameHash& hash) {
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < sensed_.size(); ++i) {
    if (!is_due(sensed_[i].every(), step)) continue;
    if (i >= sensed.size()) throw h5::Error("a frame lacks what a sensor found");
    bytes += sensed_[i].append(sensed[i], hash);
  }
  return bytes;
}

/// Contacts of which one side is in the frame.
std::span<const ContactRow> TrajectoryWriter::chosen(std::span<const ContactRow> contacts) {
  if (selection_.all() && !selection_.changes()) return contacts;
  chosen_.clear();
  for (const ContactRow& row : contacts)
    if (selection_.keeps(row, is_present_)) chosen_.push_back(row);
  return chosen_;
}

/// Those of the frames come last, and of these the hashes.
template <class F>
void TrajectoryWriter::for_each_log(F f) {
  if (selection_.changes()) id_times_.for_each_log(f);
  for (Rate& rate : rates_) rate.rows.for_each_log(f);
  if (contacts_) contacts_.for_each_log(f);
  for (SensedWriter& sensor : sensed_) sensor.for_each_log(f);
  if (observables_) observables_.for_each_log(f);
  for (RowLog& log : rows_) f(log);
}

void TrajectoryWriter::commit() {
  if (frames_ == committed_) return;
  if (ids_) ids_.flush();
  for (FieldWriter& field : fields_)
    if (field) field.flush();
  const auto pending = rows_[kFrameHash].pending();
  std::vector<std::uint64_t> hashes(pending.size() / sizeof(std::uint64_t));
  std::ranges::copy(pending, std::as_writable_bytes(std::span(hashes)).begin());
  for_each_log([](RowLog& log) { log.commit(); });
  digest_ = chain_hash(hashes, digest_);
  committed_ = frames_;
  uncommitted_bytes_ = 0.0;
}

/// At once, as a chunk that has a checksum can't be added to; on their way to the file before what says that
/// it is complete.
void TrajectoryWriter::write_arrivals(const CrowdState& crowd) {
  const hsize_t count = crowd.arrivals.size();
  if (arrived_id_ < 0 || count == 0) return;
  for (const hid_t set : {hid_t{arrived_id_}, hid_t{arrived_step_}})
    h5::check(H5Dset_extent(set, &count), "cannot add who arrived");
  h5::write_rows(arrived_id_, 0, count, h5::type<std::uint32_t>(), crowd.arrived_id.data());
  h5::write_rows(arrived_step_, 0, count, h5::type<std::int64_t>(), crowd.arrivals.data());
  for (const hid_t set : {hid_t{arrived_id_}, hid_t{arrived_step_}})
    h5::check(H5Dflush(set), "cannot write who arrived");
}

void TrajectoryWriter::finish(const CrowdState& crowd) {
  commit();
  write_arrivals(crowd);
  h5::check(H5Dwrite(finished_, h5::type<std::uint64_t>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &digest_),
            "cannot finish");
  close();
}

void TrajectoryWriter::close() {
  if (file_ < 0) return;
  commit();
  ids_.close();
  for (FieldWriter& field : fields_) field.close();
  for_each_log([](RowLog& log) { log.close(); });
  finished_.close("cannot close the file");
  arrived_id_.close("cannot close the file");
  arrived_step_.close("cannot close the file");
  file_.close("cannot close the file");
}

void TrajectoryWriter::abandon() {
  ids_.abandon();
  for (FieldWriter& field : fields_) field.abandon();
  for_each_log([](RowLog& log) { log.abandon(); });
  finished_.abandon();
  arrived_id_.abandon(), arrived_step_.abandon();
  file_.abandon();
}

}  // namespace throng::recording
