// SPDX-License-Identifier: MIT
// What TrajectoryWriter makes before the first frame: all of layout.h.
#include <algorithm>

#include "sim/recording/file_head.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/packed.h"
#include "sim/recording/scene_writer.h"
#include "sim/recording/trajectory_writer.h"

namespace throng::recording {

namespace {

h5::Handle create_file(const std::string& path) {
  h5::prepare();
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "cannot make a property list");
  h5::check(H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST), "cannot set the format");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "cannot make the file"};
}

}  // namespace

TrajectoryWriter::TrajectoryWriter(const std::string& path, const Scene& scene, const Provenance& provenance)
    : dt_(scene.time.dt),
      record_(scene.record),
      selection_(scene),
      digest_(kEmptyChain),
      file_(create_file(path)) {
  try {
    create_all(scene, provenance);
  } catch (...) {
    abandon();
    throw;
  }
}

void TrajectoryWriter::create_all(const Scene& scene, const Provenance& provenance) {
  write_h5md(file_);
  write_parameters(file_, scene, provenance);
  create_throng(scene);
  create_trajectory(scene);
  create_sampled(scene);
  h5::check(H5Fstart_swmr_write(file_), "cannot let readers follow");
}

void TrajectoryWriter::create_throng(const Scene& scene) {
  const h5::Handle group = h5::create_group(file_, "throng");
  constexpr std::int32_t version[] = {kMajor, kMinor};
  h5::write_attribute(group, "version", std::span<const std::int32_t>(version));
  write_scene(group, scene, selection_.ids());
  create_finished(group);
  if (scene.crowd.size() > 0) create_arrivals(group);
  const h5::Handle frames = h5::create_group(group, "frames");
  rows_[kStep] = RowLog::create<std::int64_t>(frames, "step");
  rows_[kTime] = RowLog::create<double>(frames, "time");
  rows_[kStateHash] = RowLog::create<std::uint64_t>(frames, "state_hash");
  rows_[kFrameHash] = RowLog::create<std::uint64_t>(frames, "frame_hash");
  create_rates(group);
}

void TrajectoryWriter::create_finished(hid_t throng) {
  finished_ = h5::create_fixed(throng, "finished", h5::type<std::uint64_t>(), {});
  const std::uint64_t no = 0;
  h5::check(H5Dwrite(finished_, h5::type<std::uint64_t>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &no),
            "cannot write");
}

void TrajectoryWriter::create_arrivals(hid_t throng) {
  const h5::Handle group = h5::create_group(throng, "arrivals");
  const auto create = [&](const char* name, hid_t type) {
    return h5::create_growing(group, name, type, {1}, {kRowChunk}, h5::Filters::fletcher32);
  };
  arrived_id_ = create("id", h5::type<std::uint32_t>());
  arrived_step_ = create("step", h5::type<std::int64_t>());
}

/// The rate whose steps are those of all frames needs no rows of its own.
void TrajectoryWriter::create_rates(hid_t throng) {
  std::vector<int> rates = throng::rates(record_);
  const int first = rates.front();
  if (std::ranges::all_of(rates, [&](int every) { return every % first == 0; })) rates.erase(rates.begin());
  if (rates.empty()) return;
  const h5::Handle group = h5::create_group(throng, "rates");
  for (int every : rates) {
    const h5::Handle rate = h5::create_group(group, std::to_string(every).c_str());
    rates_.push_back({every, RateRows(rate)});
  }
}

void TrajectoryWriter::create_trajectory(const Scene& scene) {
  const h5::Handle particles = h5::create_group(file_, "particles");
  const h5::Handle group = h5::create_group(particles, "trajectory");
  write_box(group, scene.domain);
  create_ids(group);
  for (RecordField field : kBodyFields)
    if (is_recorded(record_, field)) create_field(group, field);
}

void TrajectoryWriter::create_ids(hid_t group) {
  const std::vector<std::int64_t> ids(selection_.ids().begin(), selection_.ids().end());
  if (!selection_.changes()) return h5::write_array(group, "id", std::span<const std::int64_t>(ids));
  const h5::Handle throng(H5Gopen2(file_, "throng", H5P_DEFAULT), H5Gclose, "cannot open a group");
  h5::write_array(h5::Handle(H5Gopen2(throng, "bodies", H5P_DEFAULT), H5Gclose, "cannot open a group"), "id",
                  std::span<const std::int64_t>(ids));
  const h5::Handle element = h5::create_group(group, "id");
  if (record_.within) {
    h5::write_attribute(element, "min", std::span<const double>(record_.within->min().data(), 2));
    h5::write_attribute(element, "max", std::span<const double>(record_.within->max().data(), 2));
  }
  ids_ = FrameBlocks(element, "value", h5::type<std::uint32_t>(),
                     FrameBlocks::Form{selection_.rows(), 1, kRegionChunk, false, true});
  id_times_ = RateRows(element);
}

void TrajectoryWriter::create_field(hid_t group, RecordField field) {
  const int rate = every(record_, field);
  h5::Handle element;
  if (is_quantized(record_, field)) {
    element = h5::create_group(file_, "throng/quantized");
    h5::write_attribute(element, "quantum", record_.quantum);
    h5::write_attribute(element, "key_every", static_cast<std::int64_t>(kKeyEvery));
    h5::write_attribute(element, "how", std::string_view(kHowQuantized));
  } else {
    element = h5::create_group(group, name(field));
  }
  h5::write_attribute(element, "every", std::int64_t{rate});
  fields_[index(field)] = FieldWriter(element, field, record_, selection_);
  link_times(element, rate);
}

/// Of the sensors that are recorded, numbered from 0.
void TrajectoryWriter::create_sensed(std::span<const Sensor> sensors) {
  for (const Sensor& sensor : recorded(sensors)) {
    const std::string path = "throng/sensors/" + std::to_string(sensed_.size());
    const h5::Handle group = h5::create_groups(file_, path.c_str());
    h5::write_attribute(group, "name", std::string_view(sensor.name));
    h5::write_attribute(group, "every", std::int64_t{sensor.every});
    h5::write_attribute(group, "radius", sensor.radius);
    h5::write_attribute(group, "fov_degrees", sensor.fov);
    h5::write_attribute(group, "sight", std::string_view(name(sensor.screens)));
    sensed_.emplace_back(group, sensor.every);
    link_times(group, sensor.every);
  }
}

void TrajectoryWriter::create_sampled(const Scene& scene) {
  if (const int rate = every(record_, RecordField::contacts)) {
    const h5::Handle group = h5::create_group(file_, "throng/contacts");
    h5::write_attribute(group, "every", std::int64_t{rate});
    contacts_ = ContactWriter(group, scene.bodies.size());
    link_times(group, rate);
  }
  create_sensed(scene.sensors);
  if (record_.observables == 0) return;
  const h5::Handle group = h5::create_group(file_, "observables");
  h5::write_attribute(group, "every", std::int64_t{record_.observables});
  observables_ = ObservableWriter(
      group, observables_of(scene.crowd.size() > 0, scene.crowd.measures, asked_columns(scene)),
      [&](hid_t element) { link_times(element, record_.observables); });
}

/// To the rows of that rate; to those of all frames for 0.
void TrajectoryWriter::link_times(hid_t element, int every) {
  const bool own = std::ranges::any_of(rates_, [&](const Rate& rate) { return rate.every == every; });
  const std::string from = own ? "/throng/rates/" + std::to_string(every) : "/throng/frames";
  for (const char* name : {"/step", "/time"})
    h5::check(H5Lcreate_hard(file_, (from + name).c_str(), element, name + 1, H5P_DEFAULT, H5P_DEFAULT),
              "cannot link");
}

}  // namespace throng::recording
