// SPDX-License-Identifier: MIT
#include "sim/recording/trajectory_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numeric>

#include "sim/recording/build_info.h"
#include "sim/recording/fletcher32.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/scene_writer.h"
#include "sim/recording/utf8.h"

namespace throng::recording {

namespace {

h5::Handle create_file(const std::string& path) {
  h5::prepare();
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "cannot make a property list");
  h5::check(H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST), "cannot set the format");
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "cannot make the file"};
}

void write_h5md(hid_t file) {
  const h5::Handle group = h5::create_group(file, "h5md");
  constexpr std::int32_t version[] = {1, 1};
  h5::write_attribute(group, "version", std::span<const std::int32_t>(version));
  const h5::Handle author = h5::create_group(group, "author");
  const char* user = std::getenv("USER");
  h5::write_attribute(author, "name", std::string_view(as_utf8(user ? user : "unknown")));
  const h5::Handle creator = h5::create_group(group, "creator");
  h5::write_attribute(creator, "name", std::string_view("throng"));
  h5::write_attribute(creator, "version", std::string_view(version_text()));
}

void write_box(hid_t group, const Domain& domain) {
  const h5::Handle box = h5::create_group(group, "box");
  const std::string boundary = domain.kind == DomainKind::periodic ? "periodic" : "none";
  h5::write_attribute(box, "dimension", std::int64_t{2});
  h5::write_attribute(box, "boundary", std::vector<std::string>{boundary, boundary});
  const Vec edges = domain.max - domain.min;
  if (domain.kind != DomainKind::unbounded)
    h5::write_array(box, "edges", std::span<const double>(edges.data(), 2));
}

void link(hid_t from, const char* name, hid_t to) {
  h5::check(H5Lcreate_hard(from, name, to, name, H5P_DEFAULT, H5P_DEFAULT), "cannot link");
}

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

/// Puts what stands in a body's row of `from`, so many numbers, into row id - 1 of `to`.
template <int components>
void bring_into_order(const std::vector<std::uint32_t>& id, const double* from, std::vector<double>& to) {
  for (std::size_t row = 0; row < id.size(); ++row)
    for (std::size_t c = 0; c < components; ++c)
      to[components * (id[row] - std::size_t{1}) + c] = from[components * row + c];
}

}  // namespace

std::array<bool, kFields> recorded_fields(const Record& record) {
  return {record.position, record.angle, record.velocity, record.spin};
}

TrajectoryWriter::TrajectoryWriter(const std::string& path, const Scene& scene, const Provenance& provenance)
    : dt_(scene.time.dt),
      bodies_(scene.bodies.size()),
      single_(scene.record.single),
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
  create_parameters(scene, provenance);
  create_throng(scene);
  create_trajectory(scene);
  h5::check(H5Fstart_swmr_write(file_), "cannot let readers follow");
}

void TrajectoryWriter::create_parameters(const Scene& scene, const Provenance& provenance) {
  constexpr const char* engines[] = {"native", "box2d"};
  const h5::Handle group = h5::create_group(file_, "parameters");
  const std::string command_line = as_utf8(provenance.command_line);
  h5::write_attribute(group, "dt", scene.time.dt);
  h5::write_attribute(group, "until", scene.time.until);
  h5::write_attribute(group, "substeps", std::int64_t{scene.time.substeps});
  h5::write_attribute(group, "every", std::int64_t{scene.record.every});
  h5::write_attribute(group, "seed", scene.seed);
  h5::write_attribute(group, "threads", std::int64_t{provenance.threads});
  h5::write_attribute(group, "checkpoint", provenance.checkpoint);
  h5::write_attribute(group, "engine", std::string_view(engines[static_cast<int>(scene.engine)]));
  h5::write_attribute(group, "precision", std::string_view(single_ ? "single" : "double"));
  h5::write_attribute(group, "version", std::string_view(version_text()));
  h5::write_attribute(group, "compiler", std::string_view(compiler_text()));
  h5::write_attribute(group, "flags", std::string_view(flags_text()));
  h5::write_attribute(group, "scenario_hash", text_hash(provenance.scenario));
  h5::write_attribute(group, "resolved_hash", text_hash(provenance.resolved));
  h5::write_attribute(group, "command_line_hash", text_hash(command_line));
  h5::write_text(group, "scenario", provenance.scenario);
  h5::write_text(group, "resolved", provenance.resolved);
  h5::write_text(group, "command_line", command_line);
}

void TrajectoryWriter::create_throng(const Scene& scene) {
  const h5::Handle group = h5::create_group(file_, "throng");
  constexpr std::int32_t version[] = {kMajor, kMinor};
  h5::write_attribute(group, "version", std::span<const std::int32_t>(version));
  write_scene(group, scene);
  const h5::Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "cannot make a dataspace");
  finished_ = h5::Handle(
      H5Dcreate2(group, "finished", h5::type<std::uint64_t>(), scalar, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose, "cannot make a dataset");
  const std::uint64_t no = 0;
  h5::check(H5Dwrite(finished_, h5::type<std::uint64_t>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, &no),
            "cannot write");

  const h5::Handle frames = h5::create_group(group, "frames");
  constexpr const char* names[kRows] = {"step", "time", "state_hash", "frame_hash"};
  const hid_t types[kRows] = {h5::type<std::int64_t>(), h5::type<double>(), h5::type<std::uint64_t>(),
                              h5::type<std::uint64_t>()};
  for (int r = 0; r < kRows; ++r)
    rows_[r].set = h5::create_growing(frames, names[r], types[r], {1}, {kRowChunk}, false);
}

void TrajectoryWriter::create_trajectory(const Scene& scene) {
  const h5::Handle particles = h5::create_group(file_, "particles");
  const h5::Handle group = h5::create_group(particles, "trajectory");
  write_box(group, scene.domain);
  std::vector<std::int64_t> ids(bodies_);
  std::iota(ids.begin(), ids.end(), 1);
  h5::write_array(group, "id", std::span<const std::int64_t>(ids));
  const auto fields = recorded_fields(scene.record);
  for (int f = 0; f < kFields; ++f)
    if (fields[f]) create_field(group, f);
}

void TrajectoryWriter::create_field(hid_t group, int index) {
  Field& field = fields_[index];
  field.components = kComponents[index];
  field.values.resize(bodies_ * field.components);
  if (single_) field.singles.resize(field.values.size());

  const hid_t type = single_ ? h5::type<float>() : h5::type<double>();
  const hsize_t per_chunk = kMaxChunk / (H5Tget_size(type) * field.components);
  std::vector<hsize_t> dims{1, bodies_}, chunk{1, std::clamp<hsize_t>(bodies_, 1, per_chunk)};
  if (field.components == 2) dims.push_back(2), chunk.push_back(2);
  field.chunk_bytes = chunk[1] * field.components * H5Tget_size(type);

  const h5::Handle element = h5::create_group(group, kFieldName[index]);
  field.set = h5::create_growing(element, "value", type, dims, chunk, true);
  const h5::Handle frames(H5Gopen2(file_, "throng/frames", H5P_DEFAULT), H5Gclose, "cannot open a group");
  link(frames, "step", element);
  link(frames, "time", element);
}

void TrajectoryWriter::append(const State& state) {
  gather(state);
  append_gathered(state.step, hash(state));
}

void TrajectoryWriter::append(const Frame& frame) {
  gather(frame);
  if (append_gathered(frame.step, frame.state_hash) != frame.frame_hash)
    throw h5::Error("frame of step " + std::to_string(frame.step) + " would be stored otherwise");
}

/// Returns the frame's hash.
std::uint64_t TrajectoryWriter::append_gathered(std::int64_t step, std::uint64_t state_hash) {
  const std::uint64_t frame_hash = write_fields(step, state_hash);
  rows_[kStep].pending.push_back(static_cast<std::uint64_t>(step));
  rows_[kTime].pending.push_back(std::bit_cast<std::uint64_t>(static_cast<double>(step) * dt_));
  rows_[kStateHash].pending.push_back(state_hash);
  rows_[kFrameHash].pending.push_back(frame_hash);
  ++frames_;
  return frame_hash;
}

/// Brings the fields into the order of the file: body `id` in row id - 1.
void TrajectoryWriter::gather(const State& state) {
  const double* const from[kFields] = {flat(state.position), state.angle.data(), flat(state.velocity),
                                       state.spin.data()};
  for (int f = 0; f < kFields; ++f) {
    if (fields_[f].set < 0) continue;
    kComponents[f] == 2 ? bring_into_order<2>(state.id, from[f], fields_[f].values)
                        : bring_into_order<1>(state.id, from[f], fields_[f].values);
    if (!all_finite(fields_[f].values))
      throw std::runtime_error("the state of step " + std::to_string(state.step) + " is not finite");
  }
}

/// The fields that the file has, which are already in its order.
void TrajectoryWriter::gather(const Frame& frame) {
  const std::vector<Vec>* vectors[kFields] = {&frame.position, nullptr, &frame.velocity, nullptr};
  const std::vector<double>* scalars[kFields] = {nullptr, &frame.angle, nullptr, &frame.spin};
  for (int f = 0; f < kFields; ++f) {
    if (fields_[f].set < 0) continue;
    const std::size_t rows = vectors[f] ? vectors[f]->size() : scalars[f]->size();
    if (rows != bodies_) throw h5::Error(std::string(kFieldName[f]) + " is missing in a frame");
    if (rows == 0) continue;
    const double* values = scalars[f] ? scalars[f]->data() : vectors[f]->front().data();
    std::copy_n(values, fields_[f].values.size(), fields_[f].values.begin());
  }
}

std::uint64_t TrajectoryWriter::write_fields(std::int64_t step, std::uint64_t state_hash) {
  FrameHash frame_hash(step, static_cast<double>(step) * dt_, state_hash);
  for (Field& field : fields_) {
    if (field.set < 0) continue;
    if (single_) std::copy(field.values.begin(), field.values.end(), field.singles.begin());
    const auto bytes =
        single_ ? std::as_bytes(std::span(field.singles)) : std::as_bytes(std::span(field.values));
    frame_hash.add(bytes);
    write_field(field, bytes);
  }
  return frame_hash.value();
}

/// Past HDF5's own pipeline, which copies each chunk once more to put its checksum behind it.
void TrajectoryWriter::write_field(Field& field, std::span<const std::byte> bytes) {
  const hsize_t dims[] = {frames_ + 1, bodies_, 2};
  h5::check(H5Dset_extent(field.set, dims), "cannot add a frame");
  const std::size_t chunk = field.chunk_bytes, body = bodies_ == 0 ? 0 : bytes.size() / bodies_;
  for (std::size_t at = 0; at < bytes.size(); at += chunk) {
    const auto part = bytes.subspan(at, std::min(chunk, bytes.size() - at));
    chunk_.resize(chunk + sizeof(std::uint32_t));
    std::fill(std::copy(part.begin(), part.end(), chunk_.begin()), chunk_.end(), std::byte{0});
    const std::uint32_t sum = fletcher32(std::span(chunk_).first(chunk));
    std::memcpy(chunk_.data() + chunk, &sum, sizeof sum);
    const hsize_t place[] = {frames_, at / body, 0};
    h5::check(H5Dwrite_chunk(field.set, H5P_DEFAULT, 0, place, chunk_.size(), chunk_.data()),
              "cannot write a frame");
  }
}

void TrajectoryWriter::write_rows(Rows& rows) {
  const hsize_t start[] = {committed_}, count[] = {rows.pending.size()}, dims[] = {frames_};
  h5::check(H5Dset_extent(rows.set, dims), "cannot add a frame");
  const h5::Handle to(H5Dget_space(rows.set), H5Sclose, "cannot add a frame");
  const h5::Handle from(H5Screate_simple(1, count, nullptr), H5Sclose, "cannot add a frame");
  const h5::Handle type(H5Dget_type(rows.set), H5Tclose, "cannot add a frame");
  h5::check(H5Sselect_hyperslab(to, H5S_SELECT_SET, start, nullptr, count, nullptr), "cannot add a frame");
  h5::check(H5Dwrite(rows.set, type, from, to, H5P_DEFAULT, rows.pending.data()), "cannot write a frame");
  h5::check(H5Dflush(rows.set), "cannot write a frame");
}

void TrajectoryWriter::commit() {
  if (frames_ == committed_) return;
  for (const Field& field : fields_)
    if (field.set >= 0) h5::check(H5Dflush(field.set), "cannot write a frame");
  for (Rows& rows : rows_) write_rows(rows);
  digest_ = chain_hash(rows_[kFrameHash].pending, digest_);
  for (Rows& rows : rows_) rows.pending.clear();
  committed_ = frames_;
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
  for (Field& field : fields_) field.set.close("cannot close the file");
  for (Rows& rows : rows_) rows.set.close("cannot close the file");
  finished_.close("cannot close the file");
  file_.close("cannot close the file");
}

void TrajectoryWriter::abandon() {
  for (Field& field : fields_) field.set.abandon();
  for (Rows& rows : rows_) rows.set.abandon();
  finished_.abandon();
  file_.abandon();
}

}  // namespace throng::recording
