// SPDX-License-Identifier: MIT
// What FrameReader looks at before it reads a frame.
#include <algorithm>
#include <cmath>

#include "sim/recording/frame_reader.h"
#include "sim/recording/observables.h"

namespace throng::recording {

namespace {

int read_every(hid_t element) {
  const auto every = h5::read_attribute<std::int64_t>(element, "every");
  if (every < 1 || every > kRarest) throw h5::Error("every is out of range");
  return static_cast<int>(every);
}

void expect_samples(std::size_t found, std::size_t samples, const char* name) {
  if (found < samples) throw h5::Error(std::string(name) + " has too few frames");
}

}  // namespace

FrameReader::FrameReader(const h5::File& file, const Scene& scene, std::span<const std::int64_t> steps,
                         int minor, std::size_t bodies, Record& record)
    : file_(&file),
      bodies_(bodies),
      dt_(scene.time.dt),
      minor_(minor),
      every_(record.every),
      single_(record.single),
      ids_(scene.bodies.size()),
      sensed_(scene.sensors.size()) {
  const h5::Handle throng = h5::open_group(file.handle, "throng");
  const h5::Handle trajectory = h5::open_group(h5::open_group(file.handle, "particles"), "trajectory");
  open_ids(throng, trajectory, steps, record);
  for (RecordField field : kBodyFields)
    if (h5::exists(trajectory, name(field))) open_field(trajectory, field, steps);
  if (h5::exists(throng, "quantized")) open_quantized(throng, steps, record);
  if (h5::exists(throng, "contacts")) open_contacts(throng, steps);
  if (!scene.sensors.empty()) open_sensed(h5::open_group(throng, "sensors"), steps);
  if (h5::exists(file.handle, "observables")) open_observables(scene, steps);
  if (changes_) expect_ids(steps);
  complete(record);
}

/// Before 1.2 all fields had the rate of all frames.
Schedule FrameReader::open_schedule(hid_t element, std::span<const std::int64_t> steps) {
  return minor_ >= 2 ? Schedule(read_every(element), steps) : Schedule(1, steps);
}

/// What other readers take for the steps and times of samples.
void FrameReader::expect_times(std::span<const std::int64_t> found_steps, std::span<const double> found_times,
                               const Schedule& when, std::span<const std::int64_t> steps) const {
  expect_samples(found_steps.size(), when.samples(), "step");
  expect_samples(found_times.size(), when.samples(), "time");
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (const auto k = when.sample(i);
        k && (found_steps[*k] != steps[i] || found_times[*k] != static_cast<double>(steps[i]) * dt_))
      throw h5::Error("the steps and times of samples are not those of their frames");
}

/// Those of an element that has a rate: links to rows that all elements of that rate share, which are read
/// once.
void FrameReader::expect_times(hid_t element, const Schedule& when, std::span<const std::int64_t> steps) {
  const h5::Dataset step = h5::open_dataset<std::int64_t>(*file_, element, "step", {h5::kAny}),
                    time = h5::open_dataset<double>(*file_, element, "time", {h5::kAny});
  const CheckedTimes these{h5::address(step), h5::address(time), when.every()};
  if (std::ranges::find(checked_, these) != checked_.end()) return;
  expect_times(h5::read_all<std::int64_t>(step, when.samples()), h5::read_all<double>(time, when.samples()),
               when, steps);
  checked_.push_back(these);
}

void FrameReader::open_ids(hid_t throng, hid_t trajectory, std::span<const std::int64_t> steps,
                           Record& record) {
  const h5::Handle table = h5::open_group(throng, "bodies");
  changes_ = h5::exists(table, "id");
  const auto ids = changes_ ? h5::read_array<std::int64_t>(*file_, table, "id", {ids_.size()})
                            : h5::read_array<std::int64_t>(*file_, trajectory, "id", {ids_.size()});
  for (std::size_t row = 0; row < ids.size(); ++row) {
    const bool ascends = ids[row] > (row == 0 ? 0 : ids[row - 1]);
    if (!ascends || ids[row] > static_cast<std::int64_t>(bodies_)) throw h5::Error("id is not in order");
    ids_[row] = static_cast<std::uint32_t>(ids[row]);
  }
  if (ids_.size() < bodies_) record.ids = ids_;
  if (!changes_) return;
  const h5::Handle element = h5::open_group(trajectory, "id");
  if (h5::has_attribute(element, "min")) open_region(element, record);
  const auto listed = h5::read_array<std::int64_t>(*file_, element, "step");
  present_when_ = Schedule(listed, steps);
  expect_times(listed, h5::read_array<double>(*file_, element, "time"), present_when_, steps);
  present_ =
      h5::open_dataset<std::uint32_t>(*file_, element, "value", {h5::kAny, ids_.size()}, h5::Storage::sparse);
  expect_samples(present_.dims[0], present_when_.samples(), "id");
}

void FrameReader::open_region(hid_t element, Record& record) const {
  const auto low = h5::read_attribute<double>(element, "min", 2),
             high = h5::read_attribute<double>(element, "max", 2);
  record.within = Eigen::AlignedBox2d(Vec(low[0], low[1]), Vec(high[0], high[1]));
  if (!(low[0] < high[0] && low[1] < high[1] && std::isfinite(high[0] - low[0] + high[1] - low[1])))
    throw h5::Error("the region is turned round");
}

void FrameReader::open_field(hid_t trajectory, RecordField field, std::span<const std::int64_t> steps) {
  const h5::Handle element = h5::open_group(trajectory, name(field));
  std::vector<std::optional<hsize_t>> dims{h5::kAny, ids_.size()};
  if (components(field) == 2) dims.push_back(2);
  const h5::Storage storage = changes_ ? h5::Storage::sparse : h5::Storage::whole;
  Stored& stored = fields_[index(field)];
  stored.when = open_schedule(element, steps);
  expect_times(element, stored.when, steps);
  stored.set = single_ ? h5::open_dataset<float>(*file_, element, "value", dims, storage)
                       : h5::open_dataset<double>(*file_, element, "value", dims, storage);
  expect_samples(stored.set.dims[0], stored.when.samples(), name(field));
}

void FrameReader::open_quantized(hid_t throng, std::span<const std::int64_t> steps, Record& record) {
  Schedule& when = fields_[index(RecordField::position)].when;
  if (when.every() > 0) throw h5::Error("positions are stored in two ways");
  const h5::Handle group = h5::open_group(throng, "quantized");
  quantized_ = QuantizedReader(*file_, group, ids_.size());
  record.quantum = quantized_.quantum();
  when = open_schedule(group, steps);
  expect_times(group, when, steps);
  expect_samples(quantized_.samples(), when.samples(), "quantized");
}

void FrameReader::open_contacts(hid_t throng, std::span<const std::int64_t> steps) {
  const h5::Handle group = h5::open_group(throng, "contacts");
  Schedule& when = fields_[index(RecordField::contacts)].when;
  when = open_schedule(group, steps);
  expect_times(group, when, steps);
  const h5::Dataset offset = h5::open_dataset<std::uint64_t>(*file_, group, "offset", {h5::kAny});
  if (when.samples() > 0) expect_samples(offset.dims[0], when.samples() + 1, "contacts");
  contacts_ = {h5::read_all<std::uint64_t>(offset, when.samples() + 1),
               h5::open_dataset<std::uint32_t>(*file_, group, "a", {h5::kAny}),
               h5::open_dataset<std::uint32_t>(*file_, group, "b", {h5::kAny}),
               h5::open_dataset<double>(*file_, group, "impulse", {h5::kAny}),
               h5::open_dataset<double>(*file_, group, "point", {h5::kAny, 2})};
  if (contacts_.offset.empty()) return;
  for (const h5::Dataset* column : {&contacts_.a, &contacts_.b, &contacts_.impulse, &contacts_.point})
    if (column->dims[0] < contacts_.offset.back()) throw h5::Error("contacts are missing");
  if (!std::ranges::is_sorted(contacts_.offset)) throw h5::Error("the offsets of contacts run backwards");
}

/// Ends of runs of rows, one more than samples, none where nothing was committed.
std::vector<std::uint64_t> FrameReader::read_ends(hid_t group, const char* name, std::size_t samples) const {
  const h5::Dataset offset = h5::open_dataset<std::uint64_t>(*file_, group, name, {h5::kAny});
  if (samples > 0) expect_samples(offset.dims[0], samples + 1, name);
  auto ends = h5::read_all<std::uint64_t>(offset, std::min<hsize_t>(offset.dims[0], samples + 1));
  if (!std::ranges::is_sorted(ends)) throw h5::Error(std::string(name) + " runs backwards");
  return ends;
}

void FrameReader::open_sensed(hid_t sensors, std::span<const std::int64_t> steps) {
  for (std::size_t k = 0; k < sensed_.size(); ++k) {
    const h5::Handle group = h5::open_group(sensors, std::to_string(k).c_str());
    StoredSensed& stored = sensed_[k];
    stored.when = open_schedule(group, steps);
    expect_times(group, stored.when, steps);
    stored.offset = read_ends(group, "offset", stored.when.samples());
    stored.whom_offset = read_ends(group, "whom_offset", stored.when.samples());
    const auto open = [&](const char* name, const std::vector<std::uint64_t>& ends) {
      h5::Dataset column = h5::open_dataset<std::uint32_t>(*file_, group, name, {h5::kAny});
      if (!ends.empty() && column.dims[0] < ends.back()) throw h5::Error("sensed rows are missing");
      return column;
    };
    stored.who = open("who", stored.offset);
    stored.count = open("count", stored.offset);
    stored.whom = open("whom", stored.whom_offset);
  }
}

namespace {

/// The element at the end of a path, each group of it the file's own.
h5::Handle open_path(hid_t at, std::string_view path) {
  const std::size_t slash = path.find('/');
  h5::Handle group = h5::open_group(at, std::string(path.substr(0, slash)).c_str());
  return slash == path.npos ? std::move(group) : open_path(group, path.substr(slash + 1));
}

/// Those that the file has of what scenes may ask for.
std::vector<AskedColumn> asked_in(const h5::File& file, hid_t group) {
  std::vector<AskedColumn> found;
  for (AskedColumn column : known_columns()) {
    if (!h5::exists(group, column.name)) continue;
    if (column.bins) {
      const h5::Handle element = h5::open_group(group, column.name);
      column.numbers = h5::open_dataset<double>(file, element, "value", {h5::kAny, h5::kAny}).dims[1];
      column.bins.up_to = h5::read_attribute<double>(element, "up_to");
      if (column.numbers < 1 || column.numbers > kMostBins || !(column.bins.up_to > 0.0) ||
          !std::isfinite(column.bins.up_to))
        throw h5::Error(std::string(column.name) + " has bins that can't be");
      column.bins.count = static_cast<int>(column.numbers);
    }
    found.push_back(column);
  }
  return found;
}

}  // namespace

void FrameReader::open_observables(const Scene& scene, std::span<const std::int64_t> steps) {
  const h5::Handle group = h5::open_group(file_->handle, "observables");
  observables_.when = open_schedule(group, steps);
  observables_.crowd = h5::exists(group, "agents");
  const std::vector<AskedColumn> asked =
      observables_.crowd ? std::vector<AskedColumn>() : asked_in(*file_, group);
  observables_.observables = observables_of(observables_.crowd, scene.crowd.measures, asked);
  const std::uint64_t room = file_->room();
  std::uint64_t bytes = 0;
  for (const Observable& observable : observables_.observables) {
    bytes += observables_.when.samples() * observable.components * sizeof(double);
    if (bytes > room) throw h5::Error("observables claim more than the file can hold");
    const h5::Handle element = open_path(group, observable.name);
    expect_times(element, observables_.when, steps);
    std::vector<std::optional<hsize_t>> dims{h5::kAny};
    if (observable.components > 1) dims.push_back(observable.components);
    const h5::Dataset set = h5::open_dataset<double>(*file_, element, "value", dims);
    expect_samples(set.dims[0], observables_.when.samples(), observable.name.c_str());
    observables_.values.push_back(h5::read_all<double>(set, observables_.when.samples()));
  }
}

/// A frame that holds anything of bodies says which they are.
void FrameReader::expect_ids(std::span<const std::int64_t> steps) const {
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (!present_when_.sample(i) &&
        std::ranges::any_of(fields_, [&](const Stored& stored) { return stored.when.sample(i).has_value(); }))
      throw h5::Error("id has too few frames");
}

/// As the scenario had it: rates of their own where they are not `every`.
void FrameReader::complete(Record& record) const {
  for (RecordField field : kRecordFields) {
    const int rate = schedule(field).every();
    flag(record, field) = rate > 0;
    record.own_every[index(field)] = minor_ >= 2 && rate != every_ ? rate : 0;
  }
  record.observables = observables_.when.every();
}

}  // namespace throng::recording
