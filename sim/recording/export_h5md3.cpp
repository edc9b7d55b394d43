// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sim/input_error.h"
#include "sim/recording/export.h"
#include "sim/recording/h5_write.h"

namespace throng {

using namespace recording;

namespace {

using Frames = std::span<const std::size_t>;

/// The file under construction. What a write left behind when it failed must not be closed: h5.h.
class H5md3 {
 public:
  H5md3(const Recording& recording, Frames frames, const std::string& output);
  ~H5md3() { abandon(); }
  H5md3(const H5md3&) = delete;
  H5md3& operator=(const H5md3&) = delete;

  void write_frames();
  void close();

 private:
  void create_all();
  void write_head();
  void write_times(hid_t position);
  void write_box();
  void write_bodies();
  h5::Handle create_sampled(const char* name);
  h5::Handle create_vectors(hid_t element);
  void write(const h5::Handle& set, std::size_t row, const std::vector<Vec>& vectors);
  void write_present(std::size_t row, const Frame& frame);
  void abandon();

  const Recording& recording_;
  const Scene& scene_;
  Frames frames_;
  std::vector<double> values_;  // x, y, 0 of each body
  h5::Handle file_, trajectory_, position_, velocity_;
  h5::Handle present_;  // ids by frame, where bodies come and go
};

H5md3::H5md3(const Recording& recording, Frames frames, const std::string& output)
    : recording_(recording),
      scene_(recording.geometry()),
      frames_(frames),
      values_(3 * recording.bodies()),
      file_(h5::create_file(output)) {
  try {
    create_all();
  } catch (...) {
    abandon();
    throw;
  }
}

void H5md3::create_all() {
  write_head();
  trajectory_ = h5::create_group(h5::create_group(file_, "particles"), "trajectory");
  const h5::Handle position = h5::create_group(trajectory_, "position");
  write_times(position);
  position_ = create_vectors(position);
  if (have_velocities(recording_, frames_)) velocity_ = create_vectors(create_sampled("velocity"));
  write_box();
  write_bodies();
}

void H5md3::write_head() {
  const h5::Handle group = h5::create_group(file_, "h5md");
  constexpr std::int32_t version[] = {1, 1};
  h5::write_attribute(group, "version", std::span<const std::int32_t>(version));
  const RecordingOrigin& origin = recording_.origin();
  h5::write_attribute(h5::create_group(group, "author"), "name", std::string_view(origin.author));
  const h5::Handle creator = h5::create_group(group, "creator");
  h5::write_attribute(creator, "name", std::string_view("throng"));
  h5::write_attribute(creator, "version", std::string_view(origin.version));
}

void H5md3::write_times(hid_t position) {
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  for (std::size_t i : frames_) {
    steps.push_back(recording_.steps()[i]);
    times.push_back(recording_.times()[i]);
  }
  h5::write_array(position, "step", std::span<const std::int64_t>(steps));
  h5::write_array(position, "time", std::span<const double>(times));
}

/// H5MD wants edges where the domain is periodic; MDAnalysis wants them as a matrix a frame.
void H5md3::write_box() {
  const bool periodic = scene_.domain.kind == DomainKind::periodic;
  const std::string boundary = periodic ? "periodic" : "none";
  const h5::Handle box = h5::create_group(trajectory_, "box");
  h5::write_attribute(box, "dimension", std::int64_t{3});
  h5::write_attribute(box, "boundary", std::vector<std::string>{boundary, boundary, "none"});
  if (!periodic) return;
  const Vec size = scene_.domain.max - scene_.domain.min;
  std::vector<double> edges;
  for (std::size_t row = 0; row < frames_.size(); ++row)
    edges.insert(edges.end(), {size.x(), 0, 0, 0, size.y(), 0, 0, 0, 1});
  const h5::Handle element = create_sampled("box/edges");
  const h5::Handle set = h5::create_fixed(element, "value", h5::type<double>(), {frames_.size(), 3, 3});
  h5::write_rows(set, 0, frames_.size(), h5::type<double>(), edges.data());
}

void H5md3::write_bodies() {
  const std::vector<std::int64_t> ids(recording_.ids().begin(), recording_.ids().end());
  const std::vector<double> masses = recording_.masses();
  if (bodies_come_and_go(scene_))
    present_ = h5::create_fixed(create_sampled("id"), "value", h5::type<std::int64_t>(),
                                {frames_.size(), ids.size()});
  else
    h5::write_array(trajectory_, "id", std::span<const std::int64_t>(ids));
  h5::write_array(trajectory_, "mass", std::span<const double>(masses));
  h5::write_array(trajectory_, "radius", std::span<const double>(scene_.bodies.radius));
}

/// A group for a quantity that is sampled with the positions.
h5::Handle H5md3::create_sampled(const char* name) {
  h5::Handle group = h5::create_group(trajectory_, name);
  for (const char* row : {"step", "time"}) {
    const std::string target = std::string("/particles/trajectory/position/") + row;
    h5::check(H5Lcreate_hard(file_, target.c_str(), group, row, H5P_DEFAULT, H5P_DEFAULT), "cannot link");
  }
  return group;
}

h5::Handle H5md3::create_vectors(hid_t element) {
  const hid_t type = scene_.record.single ? h5::type<float>() : h5::type<double>();
  return h5::create_fixed(element, "value", type, {frames_.size(), recording_.bodies(), 3});
}

void H5md3::write(const h5::Handle& set, std::size_t row, const std::vector<Vec>& vectors) {
  for (std::size_t body = 0; body < vectors.size(); ++body) {
    values_[3 * body] = vectors[body].x();
    values_[3 * body + 1] = vectors[body].y();
    values_[3 * body + 2] = 0.0 * vectors[body].x();  // no number where there is no body
  }
  h5::write_rows(set, row, 1, h5::type<double>(), values_.data());
}

/// 0, the fill value, is to H5MD the id of who is not there.
void H5md3::write_present(std::size_t row, const Frame& frame) {
  std::vector<std::int64_t> ids(frame.id.begin(), frame.id.end());
  for (std::size_t body = 0; body < ids.size(); ++body)
    if (!frame.has(body)) ids[body] = 0;
  h5::write_rows(present_, row, 1, h5::type<std::int64_t>(), ids.data());
}

void H5md3::write_frames() {
  Frame frame;
  for (std::size_t row = 0; row < frames_.size(); ++row) {
    recording_.read(frames_[row], frame);
    write(position_, row, frame.position);
    if (velocity_ >= 0) write(velocity_, row, frame.velocity);
    if (present_ >= 0) write_present(row, frame);
  }
}

void H5md3::close() {
  for (h5::Handle* handle : {&present_, &velocity_, &position_, &trajectory_, &file_})
    handle->close("cannot close it");
}

void H5md3::abandon() {
  for (h5::Handle* handle : {&present_, &velocity_, &position_, &trajectory_, &file_}) handle->abandon();
}

}  // namespace

/// H5MD would take velocities at other steps than positions, MDAnalysis does not.
bool have_velocities(const Recording& recording, Frames frames) {
  return std::ranges::all_of(
      frames, [&](std::size_t i) { return recording.sample(RecordField::velocity, i).has_value(); });
}

void export_h5md3(const Recording& recording, Frames frames, const ExportTarget& target) {
  try {
    H5md3 file(recording, frames, target.path);
    file.write_frames();
    file.close();
  } catch (const h5::Error& error) {
    throw InputError("cannot write " + target.name + ": " + error.what());
  }
}

}  // namespace throng
