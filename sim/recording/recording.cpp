// SPDX-License-Identifier: MIT
#include "sim/recording/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "sim/input_error.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/frame_reader.h"
#include "sim/recording/h5_read.h"
#include "sim/recording/layout.h"
#include "sim/recording/output_file.h"
#include "sim/recording/scene_reader.h"
#include "sim/recording/scene_tables.h"
#include "sim/recording/soundness.h"

namespace throng {

using namespace recording;

namespace {

constexpr std::int64_t kMostBodies = 0xffffffff;

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
  Impl(const std::string& name, FrameChoice choice);

  void open();
  void check_version();
  void read_parameters();
  void read_rows();
  void check_rows() const;
  void open_fields();
  void choose(FrameChoice choice);
  AgentIds agent_ids() const;
  std::size_t in_file(std::size_t i) const { return chosen.empty() ? i : chosen[i]; }
  template <class Work>
  void read_frame(std::size_t i, Work work) const;

  std::string path;
  bool running = false, complete = false;
  std::uintmax_t bytes = 0;
  h5::File file;
  Scene scene;
  RecordingOrigin origin;
  FrameReader reader;
  std::size_t bodies_of_run = 0, frames_of_file = 0;
  std::vector<std::size_t> chosen;  ///< frames of the file; empty: all
  std::vector<std::int64_t> steps;
  std::vector<double> times;
  std::vector<std::uint64_t> state_hashes, frame_hashes;
};

Recording::Impl::Impl(const std::string& name, FrameChoice choice) : path(name) {
  const bool open_for_writing = check_superblock(path).open_for_writing;
  running = open_for_writing && is_being_written(path);
  try {
    h5::prepare();
    file = {open_file(path, open_for_writing, running), path, open_for_writing};
    bytes = std::filesystem::file_size(path);
    open();
    choose(choice);
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
  const std::string engine = h5::read_attribute_text(group, "engine");
  scene.engine = engine_named(engine);
  if (engine != engine_name(scene.engine)) throw h5::Error("engine is unknown");
  scene.time.dt = h5::read_attribute<double>(group, "dt");
  scene.time.until = h5::read_attribute<double>(group, "until");
  scene.time.substeps = static_cast<int>(h5::read_attribute<std::int64_t>(group, "substeps"));
  const auto every = h5::read_attribute<std::int64_t>(group, "every");
  if (every < 1 || every > std::numeric_limits<int>::max()) throw h5::Error("every is out of range");
  scene.record.every = static_cast<int>(every);
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
  steps = h5::read_all<std::int64_t>(h5::open_dataset<std::int64_t>(file, group, "step", {h5::kAny}), n);
  times = h5::read_all<double>(h5::open_dataset<double>(file, group, "time", {h5::kAny}), n);
  state_hashes =
      h5::read_all<std::uint64_t>(h5::open_dataset<std::uint64_t>(file, group, "state_hash", {h5::kAny}), n);
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
  const h5::Handle group = h5::open_group(file.handle, "parameters");
  scene.record.single = h5::read_attribute_text(group, "precision") == "single";
  const auto bodies = origin.minor >= 2 ? h5::read_attribute<std::int64_t>(group, "bodies")
                                        : static_cast<std::int64_t>(scene.bodies.size());
  if (bodies < static_cast<std::int64_t>(scene.bodies.size()) || bodies > kMostBodies)
    throw h5::Error("bodies is out of range");
  bodies_of_run = static_cast<std::size_t>(bodies);
  scene.sensors = read_sensors(h5::open_group(file.handle, "throng"));
  for (const Sensor& sensor : scene.sensors) scene.record.sensors.push_back(sensor.every);
  reader = FrameReader(file, scene, steps, origin.minor, bodies_of_run, scene.record);
}

/// From now on frame i is the chosen[i]-th of the file.
void Recording::Impl::choose(FrameChoice choice) {
  frames_of_file = steps.size();
  const Schedule& positions = reader.schedule(RecordField::position);
  if (choice == FrameChoice::all || positions.every() == 0 || positions.samples() == steps.size()) return;
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (positions.sample(i)) chosen.push_back(i);
  const auto keep = [&](auto& all) {
    for (std::size_t i = 0; i < chosen.size(); ++i) all[i] = all[chosen[i]];
    all.resize(chosen.size());
  };
  keep(steps), keep(times), keep(state_hashes), keep(frame_hashes);
}

Recording::Recording(const std::string& path, FrameChoice choice)
    : impl_(std::make_unique<Impl>(path, choice)) {}
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
std::size_t Recording::bodies_of_run() const {
  return impl_->bodies_of_run;
}
std::span<const std::uint32_t> Recording::ids() const {
  return impl_->reader.ids();
}
std::size_t Recording::frame_of_file(std::size_t i) const {
  return impl_->in_file(i);
}
std::size_t Recording::frames_of_file() const {
  return impl_->frames_of_file;
}
std::optional<std::size_t> Recording::sample(RecordField field, std::size_t i) const {
  return impl_->reader.schedule(field).sample(impl_->in_file(i));
}
std::optional<std::size_t> Recording::sensor_sample(std::size_t sensor, std::size_t i) const {
  return impl_->reader.sensor_schedule(sensor).sample(impl_->in_file(i));
}
std::optional<std::size_t> Recording::id_sample(std::size_t i) const {
  return impl_->reader.id_schedule().sample(impl_->in_file(i));
}
std::size_t Recording::id_samples() const {
  return impl_->reader.id_schedule().samples();
}
std::size_t Recording::samples(RecordField field) const {
  return impl_->reader.schedule(field).samples();
}
std::vector<std::string> Recording::observed() const {
  std::vector<std::string> names;
  for (const Observable& one : impl_->reader.observables()) names.push_back(one.name);
  return names;
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

/// Does what reads frame i of the file.
template <class Work>
void Recording::Impl::read_frame(std::size_t i, Work work) const {
  try {
    h5::prepare();
    work();
  } catch (const h5::Error& error) {
    throw InputError(path + " is damaged: frame " + std::to_string(i) + ": " + error.what());
  }
}

void Recording::read(std::size_t i, Frame& frame) const {
  frame.step = impl_->steps[i];
  frame.time = impl_->times[i];
  frame.state_hash = impl_->state_hashes[i];
  frame.frame_hash = impl_->frame_hashes[i];
  frame.id = impl_->reader.ids();
  const std::size_t in_file = impl_->in_file(i);
  impl_->read_frame(in_file, [&] { impl_->reader.read(in_file, frame); });
}

std::vector<double> Recording::masses() const {
  try {
    h5::prepare();
    const h5::Handle throng = h5::open_group(impl_->file.handle, "throng");
    std::vector<double> result =
        h5::read_array<double>(impl_->file, h5::open_group(throng, "bodies"), "mass", {bodies()});
    const auto is_sound = [](double mass) { return mass > 0.0 && std::isfinite(mass); };
    if (!std::ranges::all_of(result, is_sound)) throw h5::Error("mass is not above 0");
    return result;
  } catch (const h5::Error& error) {
    throw InputError(impl_->path + " is damaged: " + error.what());
  }
}

/// As far as the file tells: they are the last of the run, behind all recorded bodies that are none.
AgentIds Recording::Impl::agent_ids() const {
  AgentIds agents{1, static_cast<std::uint32_t>(bodies_of_run)};
  const auto ids = reader.ids();
  for (std::size_t row = 0; row < ids.size(); ++row)
    if (scene.bodies.kind[row] != BodyKind::agent) agents.first = std::max(agents.first, ids[row] + 1);
  return agents;
}

std::optional<Arrivals> Recording::arrivals() const {
  const bool agents = !impl_->scene.crowd.walkable.empty();
  if (!agents || !impl_->complete || impl_->origin.minor < 10) return std::nullopt;
  try {
    h5::prepare();
    const h5::Handle group = h5::open_group(h5::open_group(impl_->file.handle, "throng"), "arrivals");
    Arrivals all{h5::read_array<std::int64_t>(impl_->file, group, "step"),
                 h5::read_array<std::uint32_t>(impl_->file, group, "id")};
    if (!recording::are_arrivals(all.step, all.id, impl_->scene.time.steps(), impl_->agent_ids()))
      throw h5::Error("no run leaves such lists");
    return all;
  } catch (const h5::Error& error) {
    throw InputError(impl_->path + " is damaged: who arrived: " + error.what());
  }
}

void Recording::expect_tables(const Scene& scene) const {
  try {
    h5::prepare();
    recording::expect_tables(impl_->file, impl_->scene, impl_->reader.ids(), scene, impl_->origin.minor);
    expect_bins(impl_->reader.observables(), scene);
  } catch (const h5::Error& error) {
    throw InputError(impl_->path + " is damaged: " + error.what());
  }
}

void Recording::carry_angles(std::size_t i, Frame& frame) const {
  const Schedule& when = impl_->reader.schedule(RecordField::angle);
  if (!frame.angle.empty() || when.every() == 0) return;
  std::size_t last = impl_->in_file(i);
  while (last > 0 && !when.sample(last)) --last;
  impl_->read_frame(last, [&] { impl_->reader.read_angles(last, frame.angle); });
}

std::size_t Recording::index_at(double time) const {
  const auto& times = impl_->times;
  const std::size_t after = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  if (after == 0) return 0;
  if (after == times.size()) return after - 1;
  return times[after] - time < time - times[after - 1] ? after : after - 1;
}

}  // namespace throng
