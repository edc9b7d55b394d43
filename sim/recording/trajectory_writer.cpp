// SPDX-License-Identifier: MIT
#include "sim/recording/trajectory_writer.h"

#include <algorithm>

#include "sim/recording/frame_hash.h"

namespace throng::recording {

namespace {

/// No branch for each number: 0 x is 0 unless x is not finite.
bool all_finite(const std::vector<double>& values) {
  double sums[4] = {0, 0, 0, 0};
  const std::size_t whole = values.size() / 4 * 4;
  for (std::size_t i = 0; i < whole; i += 4)
    for (std::size_t k = 0; k < 4; ++k) sums[k] += 0.0 * values[i + k];
  for (std::size_t i = whole; i < values.size(); ++i) sums[0] += 0.0 * values[i];
  return sums[0] + sums[1] + sums[2] + sums[3] == 0.0;
}

const double* flat(const std::vector<Vec>& vectors) {
  return vectors.empty() ? nullptr : vectors.front().data();
}

/// Moves the numbers of the rows that are present to the front. Returns how many rows they are.
void compact(const std::vector<std::uint8_t>& is_present, std::size_t components,
             std::vector<double>& values) {
  std::size_t to = 0;
  for (std::size_t row = 0; row < is_present.size(); ++row)
    for (std::size_t c = 0; is_present[row] && c < components; ++c)
      values[to++] = values[row * components + c];
}

}  // namespace

bool TrajectoryWriter::holds(int field, std::int64_t step) const {
  return is_due(every(record_, static_cast<RecordField>(field)), step);
}

void TrajectoryWriter::append(const State& state, std::span<const ContactRow> contacts,
                              const std::optional<Observables>& observables) {
  gather(state);
  append_gathered(state.step, hash(state), contacts, observables);
}

void TrajectoryWriter::append(const Frame& frame) {
  gather(frame);
  const std::uint64_t stored = append_gathered(
      frame.step, frame.state_hash, frame.contacts.value_or(std::vector<ContactRow>{}), frame.observables);
  if (stored != frame.frame_hash)
    throw h5::Error("frame of step " + std::to_string(frame.step) + " would be stored otherwise");
}

/// Returns the frame's hash.
std::uint64_t TrajectoryWriter::append_gathered(std::int64_t step, std::uint64_t state_hash,
                                                std::span<const ContactRow> contacts,
                                                const std::optional<Observables>& observables) {
  const double time = static_cast<double>(step) * dt_;
  FrameHash hash(step, time, state_hash);
  std::size_t bytes = write_fields(step, hash);
  if (holds(kContacts, step)) bytes += contacts_.append(chosen(contacts), hash);
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

/// Brings what is due into the order of the file.
void TrajectoryWriter::gather(const State& state) {
  const double* const from[kFields] = {flat(state.position), state.angle.data(), flat(state.velocity),
                                       state.spin.data()};
  for (int f = 0; f < kFields; ++f) {
    if (!holds(f, state.step)) continue;
    std::vector<double>& values = fields_[f].values();
    kComponents[f] == 2 ? selection_.bring<2>(state.id, from[f], values)
                        : selection_.bring<1>(state.id, from[f], values);
    if (!all_finite(values))
      throw std::runtime_error("the state of step " + std::to_string(state.step) + " is not finite");
  }
  if (!selection_.changes()) return;
  is_present_.assign(selection_.rows(), 0);
  for (std::size_t body = 0; body < state.id.size(); ++body)
    if (const std::uint32_t row = selection_.row_of(state.id[body]); row != Selection::kNone)
      is_present_[row] = selection_.is_within(state.position[body]);
  keep_present(state.step);
}

/// The fields of a frame are in the file's order already.
void TrajectoryWriter::gather(const Frame& frame) {
  const std::vector<Vec>* vectors[kFields] = {&frame.position, nullptr, &frame.velocity, nullptr};
  const std::vector<double>* scalars[kFields] = {nullptr, &frame.angle, nullptr, &frame.spin};
  for (int f = 0; f < kFields; ++f) {
    if (!holds(f, frame.step)) continue;
    const std::size_t rows = vectors[f] ? vectors[f]->size() : scalars[f]->size();
    if (rows != selection_.rows()) throw h5::Error(std::string(kFieldName[f]) + " is missing in a frame");
    if (rows == 0) continue;
    const double* values = scalars[f] ? scalars[f]->data() : vectors[f]->front().data();
    std::copy_n(values, fields_[f].values().size(), fields_[f].values().begin());
  }
  if (!selection_.changes()) return;
  is_present_ = frame.is_present;
  is_present_.resize(selection_.rows(), 1);
  keep_present(frame.step);
}

/// Leaves of what was gathered those who are within the region.
void TrajectoryWriter::keep_present(std::int64_t step) {
  present_.clear();
  for (std::size_t row = 0; row < is_present_.size(); ++row)
    if (is_present_[row]) present_.push_back(selection_.ids()[row]);
  for (int f = 0; f < kFields; ++f)
    if (holds(f, step)) compact(is_present_, static_cast<std::size_t>(kComponents[f]), fields_[f].values());
}

/// Returns the bytes that they took.
std::size_t TrajectoryWriter::write_fields(std::int64_t step, FrameHash& hash) {
  std::size_t bytes = 0;
  if (ids_) {
    const auto ids = std::as_bytes(std::span(present_));
    hash.add(ids);
    ids_.write(ids);
    bytes += ids.size();
  }
  const std::size_t bodies = ids_ ? present_.size() : selection_.rows();
  for (int f = 0; f < kFields; ++f)
    if (holds(f, step)) bytes += fields_[f].append(bodies, hash);
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
  for (Rate& rate : rates_) rate.rows.for_each_log(f);
  if (contacts_) contacts_.for_each_log(f);
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

void TrajectoryWriter::finish() {
  commit();
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
  file_.close("cannot close the file");
}

void TrajectoryWriter::abandon() {
  ids_.abandon();
  for (FieldWriter& field : fields_) field.abandon();
  for_each_log([](RowLog& log) { log.abandon(); });
  finished_.abandon();
  file_.abandon();
}

}  // namespace throng::recording
