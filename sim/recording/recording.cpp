// SPDX-License-Identifier: MIT
#include "sim/recording/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/input_error.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_read.h"
#include "sim/recording/layout.h"
#include "sim/recording/output_file.h"
#include "sim/recording/scene_reader.h"

namespace throng {

using namespace recording;

namespace {

constexpr std::nullopt_t kAny = std::nullopt;

/// What the first bytes tell before HDF5 sees the file: throng writes superblocks of version 3 only.
struct Superblock {
  bool open_for_writing;  ///< a writer holds it, or died
};

Superblock check_superblock(const std::string& path) {
  constexpr std::array<unsigned char, 8> signature{0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
  std::array<unsigned char, 12> head{};
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    throw InputError(path + " does not exist" +
                     (std::filesystem::exists(path + ".part", ignored)
                          ? "; " + path + ".part has the frames of a run that did not end"
                          : ""));
  if (!std::filesystem::is_regular_file(path, ignored)) throw InputError(path + " is no regular file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path + " cannot be opened");
  file.read(reinterpret_cast<char*>(head.data()), head.size());
  if (!file || !std::equal(signature.begin(), signature.end(), head.begin()))
    throw InputError(path + " is no HDF5 file");
  if (head[8] != 3) throw InputError(path + " is HDF5 but not throng's");
  return {head[11] != 0};
}

/// How often HDF5 looks again where a checksum is wrong, which may be a piece that is just being written. The
/// pauses double from 1 ns: these last 17 ms in the end, the 100 that are its own choice for ever.
constexpr unsigned kLooks = 24;

h5::Handle open_file(const std::string& path, bool open_for_writing, bool running) {
  const h5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "cannot make a property list");
  h5::check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "cannot set up");
  h5::check(H5Pset_metadata_read_attempts(access, running ? kLooks : 1), "cannot set up");
  const unsigned mode = H5F_ACC_RDONLY | (open_for_writing ? H5F_ACC_SWMR_READ : 0);
  return {H5Fopen(path.c_str(), mode, access), H5Fclose, "it cannot be opened"};
}

}  // namespace

struct Recording::Impl {
  explicit Impl(const std::string& name);

  void open();
  void check_version();
  void read_parameters();
  void read_rows();
  void check_rows() const;
  void open_fields();
  template <class T>
  void read_fields(std::size_t i, Frame& frame) const;

  std::string path;
  bool running = false, complete = false;
  std::uintmax_t bytes = 0;
  h5::File file;
  Scene scene;
  RecordingOrigin origin;
  std::array<h5::Dataset, kFields> fields;
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<std::uint64_t> state_hashes, frame_hashes;
};

Recording::Impl::Impl(const std::string& name) : path(name) {
  const bool open_for_writing = check_superblock(path).open_for_writing;
  running = open_for_writing && is_being_written(path);
  try {
    h5::prepare();
    file = {open_file(path, open_for_writing, running), path, open_for_writing};
    bytes = std::filesystem::file_size(path);
    open();
  } catch (const h5::Error& error) {
    throw InputError(path + " is damaged: " + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError(path + " cannot be read: " + error.code().message());
  } catch (const std::bad_alloc&) {
    throw InputError(path + " needs more memory than there is");
  }
}

void Recording::Impl::open() {
  check_version();
  scene = read_scene(file, h5::open_group(file.handle, "throng"));
  read_parameters();
  read_rows();
  check_rows();
  open_fields();
}

void Recording::Impl::check_version() {
  if (!h5::exists(file.handle, "throng") || !h5::exists(file.handle, "h5md"))
    throw InputError(path + " is HDF5 but not throng's");
  const h5::Handle throng = h5::open_group(file.handle, "throng");
  const auto version = h5::read_attribute<std::int32_t>(throng, "version", 2);
  if (version[0] > kMajor)
    throw InputError(path + " was written by a newer throng: its layout is " + std::to_string(version[0]) +
                     "." + std::to_string(version[1]) + ", this throng reads up to " +
                     std::to_string(kMajor));
  if (version[0] != kMajor || version[1] < 0) throw h5::Error("version is unknown");
  origin.minor = version[1];
}

void Recording::Impl::read_parameters() {
  const h5::Handle group = h5::open_group(file.handle, "parameters");
  Provenance& from = origin.provenance;
  from.scenario = h5::read_text(file, group, "scenario");
  from.resolved = h5::read_text(file, group, "resolved");
  from.command_line = h5::read_text(file, group, "command_line");
  if (h5::read_attribute<std::uint64_t>(group, "scenario_hash") != text_hash(from.scenario) ||
      h5::read_attribute<std::uint64_t>(group, "resolved_hash") != text_hash(from.resolved) ||
      h5::read_attribute<std::uint64_t>(group, "command_line_hash") != text_hash(from.command_line))
    throw h5::Error("the scenario does not match its hash");
  from.threads = static_cast<int>(h5::read_attribute<std::int64_t>(group, "threads"));
  if (origin.minor >= 1) from.checkpoint = h5::read_attribute<double>(group, "checkpoint");
  if (!(from.checkpoint == 0.0 ||
        (from.checkpoint >= kShortestCheckpoint && from.checkpoint <= kLongestCheckpoint)))
    throw h5::Error("checkpoint is out of range");
  origin.version = h5::read_attribute_text(group, "version");
  origin.compiler = h5::read_attribute_text(group, "compiler");
  origin.flags = h5::read_attribute_text(group, "flags");
  origin.author =
      h5::read_attribute_text(h5::open_group(h5::open_group(file.handle, "h5md"), "author"), "name");

  scene.seed = h5::read_attribute<std::uint64_t>(group, "seed");
  scene.engine = h5::read_attribute_text(group, "engine") == "box2d" ? Engine::box2d : Engine::native;
  scene.time.dt = h5::read_attribute<double>(group, "dt");
  scene.time.until = h5::read_attribute<double>(group, "until");
  scene.time.substeps = static_cast<int>(h5::read_attribute<std::int64_t>(group, "substeps"));
  scene.record.every = static_cast<int>(h5::read_attribute<std::int64_t>(group, "every"));
  if (!(std::isfinite(scene.time.dt) && scene.time.dt > 0)) throw h5::Error("dt is not above 0");
}

/// The frames that count: those whose hash row stands.
void Recording::Impl::read_rows() {
  const h5::Handle throng = h5::open_group(file.handle, "throng"), group = h5::open_group(throng, "frames");
  frame_hashes = h5::read_array<std::uint64_t>(file, group, "frame_hash");
  const std::uint64_t finished = h5::read_array<std::uint64_t>(file, throng, "finished", {})[0];
  // The mark is written before the file is closed: where that failed, it may be there in part.
  complete = finished != 0 && !file.unfinished;
  while (!complete && !frame_hashes.empty() && frame_hashes.back() == 0) frame_hashes.pop_back();
  const std::size_t n = frame_hashes.size();
  steps = h5::read_all<std::int64_t>(h5::open_dataset<std::int64_t>(file, group, "step", {kAny}), n);
  times = h5::read_all<double>(h5::open_dataset<double>(file, group, "time", {kAny}), n);
  state_hashes =
      h5::read_all<std::uint64_t>(h5::open_dataset<std::uint64_t>(file, group, "state_hash", {kAny}), n);
  if (complete && finished != chain_hash(frame_hashes))
    throw h5::Error("the list of frames does not match its hash");
}

void Recording::Impl::check_rows() const {
  const std::size_t n = frame_hashes.size();
  if (steps.size() != n || times.size() != n || state_hashes.size() != n)
    throw h5::Error("the lists of frames differ in length");
  for (std::size_t i = 0; i < n; ++i) {
    const bool ascends = i == 0 ? steps[i] >= 0 : steps[i] > steps[i - 1];
    if (frame_hashes[i] == 0 || !ascends || times[i] != static_cast<double>(steps[i]) * scene.time.dt)
      throw h5::Error("the list of frames is wrong at frame " + std::to_string(i));
  }
}

void Recording::Impl::open_fields() {
  const h5::Handle particles = h5::open_group(file.handle, "particles");
  const h5::Handle group = h5::open_group(particles, "trajectory");
  const std::size_t n = scene.bodies.size();
  const std::vector<std::int64_t> ids = h5::read_array<std::int64_t>(file, group, "id", {n});
  for (std::size_t row = 0; row < n; ++row)
    if (ids[row] != static_cast<std::int64_t>(row) + 1) throw h5::Error("id is not in order");
  bool* recorded[] = {&scene.record.position, &scene.record.angle, &scene.record.velocity,
                      &scene.record.spin};
  scene.record.single =
      h5::read_attribute_text(h5::open_group(file.handle, "parameters"), "precision") == "single";
  for (int f = 0; f < kFields; ++f) {
    *recorded[f] = h5::exists(group, kFieldName[f]);
    if (!*recorded[f]) continue;
    const h5::Handle element = h5::open_group(group, kFieldName[f]);
    std::vector<std::optional<hsize_t>> dims{kAny, n};
    if (kComponents[f] == 2) dims.push_back(2);
    fields[f] = scene.record.single ? h5::open_dataset<float>(file, element, "value", dims)
                                    : h5::open_dataset<double>(file, element, "value", dims);
    if (fields[f].dims[0] < steps.size()) throw h5::Error(std::string(kFieldName[f]) + " has too few frames");
  }
}

/// Reads the fields as stored (T), holds them against the frame's hash, and hands them out as doubles.
template <class T>
void Recording::Impl::read_fields(std::size_t i, Frame& frame) const {
  FrameHash hash(frame.step, frame.time, frame.state_hash);
  const std::size_t n = scene.bodies.size();
  std::vector<double>* scalars[] = {nullptr, &frame.angle, nullptr, &frame.spin};
  std::vector<Vec>* vectors[] = {&frame.position, nullptr, &frame.velocity, nullptr};
  std::vector<T> stored;
  for (int f = 0; f < kFields; ++f) {
    if (scalars[f]) scalars[f]->clear();
    if (vectors[f]) vectors[f]->clear();
    if (fields[f].set < 0) continue;
    stored.resize(n * kComponents[f]);
    h5::read_row<T>(fields[f], i, stored.data(), stored.size() * sizeof(T));
    hash.add(std::as_bytes(std::span(stored)));
    if (!std::all_of(stored.begin(), stored.end(), [](T x) { return std::isfinite(x); }))
      throw h5::Error(std::string(kFieldName[f]) + " is not finite");
    if (scalars[f]) scalars[f]->assign(stored.begin(), stored.end());
    for (std::size_t row = 0; vectors[f] && row < n; ++row)
      vectors[f]->push_back({stored[2 * row], stored[2 * row + 1]});
  }
  if (hash.value() != frame.frame_hash) throw h5::Error("it does not match its hash");
}

Recording::Recording(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
Recording::~Recording() = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;

bool Recording::complete() const {
  return impl_->complete;
}
bool Recording::running() const {
  return impl_->running;
}
double Recording::bytes() const {
  return static_cast<double>(impl_->bytes);
}
const Scene& Recording::geometry() const {
  return impl_->scene;
}
const RecordingOrigin& Recording::origin() const {
  return impl_->origin;
}
std::size_t Recording::frames() const {
  return impl_->steps.size();
}
std::size_t Recording::bodies() const {
  return impl_->scene.bodies.size();
}
std::span<const std::int64_t> Recording::steps() const {
  return impl_->steps;
}
std::span<const double> Recording::times() const {
  return impl_->times;
}
std::span<const std::uint64_t> Recording::state_hashes() const {
  return impl_->state_hashes;
}

std::span<const std::uint64_t> Recording::frame_hashes() const {
  return impl_->frame_hashes;
}

Frame Recording::frame(std::size_t i) const {
  Frame result;
  read(i, result);
  return result;
}

void Recording::read(std::size_t i, Frame& frame) const {
  frame.step = impl_->steps[i];
  frame.time = impl_->times[i];
  frame.state_hash = impl_->state_hashes[i];
  frame.frame_hash = impl_->frame_hashes[i];
  frame.id.resize(bodies());
  for (std::size_t row = 0; row < frame.id.size(); ++row) frame.id[row] = static_cast<std::uint32_t>(row + 1);
  try {
    h5::prepare();
    impl_->scene.record.single ? impl_->read_fields<float>(i, frame) : impl_->read_fields<double>(i, frame);
  } catch (const h5::Error& error) {
    throw InputError(impl_->path + " is damaged: frame " + std::to_string(i) + ": " + error.what());
  }
}

std::size_t Recording::index_at(double time) const {
  const auto& times = impl_->times;
  const std::size_t after = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  if (after == 0) return 0;
  if (after == times.size()) return after - 1;
  return times[after] - time < time - times[after - 1] ? after : after - 1;
}

}  // namespace throng
