// SPDX-License-Identifier: MIT
// The file: a header of fixed size, the scenario, then the state's arrays one after the other, contacts as
// columns. Little-endian; the header's hash covers the header, content_hash all that follows.
#include "sim/recording/checkpoint.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <span>
#include <type_traits>

#include "sim/input_error.h"
#include "sim/recording/contact_columns.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/output_file.h"
#include "sim/recording/soundness.h"
#include "sim/simulation_error.h"

namespace throng::recording {

namespace {

using Bytes = std::span<const std::byte>;

constexpr std::array<char, 8> kMagic{'t', 'h', 'r', 'o', 'n', 'g', 'C', 'K'};
constexpr std::uint64_t kLayout = 15;  // grows with every change of State

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint64_t layout = kLayout;
  std::array<char, 32> version{};
  std::int64_t step = 0;
  std::uint64_t scenario_bytes = 0, bodies = 0, disc_contacts = 0, point_contacts = 0;
  std::uint64_t agents = 0;  // rows of CrowdState: the last of the bodies
  std::uint64_t groups = 0, measures = 0, on_line = 0, sensors = 0;
  std::uint64_t sleepers = 0;  // rows of SleepState: as many as there are bodies, or none
  std::uint64_t sleeping_disc_contacts = 0, sleeping_point_contacts = 0;
  std::uint64_t arrivals = 0;
  std::int64_t wall_corrections = 0, squeezed = 0;
  std::int64_t pair_collisions = 0, wall_collisions = 0, pushed = 0;
  std::uint64_t virial = 0, equilibrium = 0;  // bits of Collisions
  std::uint64_t frames = 0, frames_hash = 0;
  std::uint64_t content_hash = 0;
  std::uint64_t hash = 0;  // of all above
};
static_assert(std::has_unique_object_representations_v<Header>);

std::uint64_t hash_of(const Header& header) {
  return hash_bytes(std::as_bytes(std::span(&header, 1)).first(offsetof(Header, hash)));
}

static_assert(sizeof(SensedSum) == 2 * sizeof(std::int64_t), "every byte of it is written");
static_assert(sizeof(Measured) == 6 * sizeof(std::int64_t) + 2 * sizeof(double),
              "every byte of it is written");
static_assert(std::has_unique_object_representations_v<OnLine>, "every byte of it is written");

template <class S, class F>
void for_each_array(S& state, F visit) {
  auto& [step, id, position, angle, velocity, spin, disc_contacts, point_contacts, sleep, crowd, sensed,
         collisions] = state;  // all
  visit(id), visit(position), visit(angle), visit(velocity), visit(spin);
}

/// All that follows the header, in the order of the file.
std::vector<Bytes> content(const std::string& scenario, const State& state, const AllColumns& contacts) {
  std::vector<Bytes> all{std::as_bytes(std::span(scenario))};
  const auto add = [&](const auto& array) { all.push_back(std::as_bytes(std::span(array))); };
  for_each_array(state, add);
  for_each_agent_array(state.crowd, add);
  add(state.crowd.waiting), add(state.crowd.measured), add(state.crowd.on_line);
  add(state.crowd.arrivals), add(state.crowd.arrived_id);
  add(state.sensed);
  add(state.sleep.squared_speed), add(state.sleep.calm), add(state.sleep.island);
  for_each_column(contacts, add);
  return all;
}

std::uint64_t hash_of(const std::vector<Bytes>& parts) {
  std::uint64_t chain = kEmptyChain;
  for (const Bytes& part : parts) chain = chain_hash(std::array{hash_bytes(part)}, chain);
  return chain;
}

[[noreturn]] void fail_to_write(const std::string& path) {
  throw std::runtime_error("cannot write " + path + ": " + std::strerror(errno));
}

/// An open file that closes itself.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) close(fd);
  }
};

void write_whole(int fd, Bytes bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t done = write(fd, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) fail_to_write(path);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

void write_file(const std::string& path, const Header& header, const std::vector<Bytes>& parts) {
  const Descriptor file{open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666)};
  if (file.fd < 0) fail_to_write(path);
  write_whole(file.fd, std::as_bytes(std::span(&header, 1)), path);
  for (const Bytes& part : parts) write_whole(file.fd, part, path);
  if (fsync(file.fd) != 0) fail_to_write(path);
}

Header header_for(const CheckpointOrigin& origin, const State& state) {
  Header header;
  std::copy_n(origin.version.begin(), std::min(origin.version.size(), header.version.size() - 1),
              header.version.begin());
  header.step = state.step;
  header.scenario_bytes = origin.scenario.size();
  header.bodies = state.id.size();
  header.disc_contacts = state.disc_contacts.size();
  header.point_contacts = state.point_contacts.size();
  header.agents = state.crowd.stand.size();
  header.groups = state.crowd.waiting.size();
  header.measures = state.crowd.measured.size();
  header.on_line = state.crowd.on_line.size();
  header.sensors = state.sensed.size();
  header.sleepers = state.sleep.island.size();
  header.sleeping_disc_contacts = state.sleep.disc_contacts.size();
  header.sleeping_point_contacts = state.sleep.point_contacts.size();
  header.arrivals = state.crowd.arrivals.size();
  header.wall_corrections = state.crowd.wall_corrections;
  header.squeezed = state.crowd.squeezed;
  header.pair_collisions = state.collisions.pairs;
  header.wall_collisions = state.collisions.walls;
  header.pushed = state.collisions.pushed;
  header.virial = std::bit_cast<std::uint64_t>(state.collisions.virial);
  header.equilibrium = std::bit_cast<std::uint64_t>(state.collisions.equilibrium);
  header.frames = origin.frames;
  header.frames_hash = origin.frames_hash;
  return header;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(path + " " + why);
}

[[noreturn]] void refuse_damaged(const std::string& path, const char* why) {
  refuse(path, std::string("is damaged: ") + why);
}

void read_whole(int fd, std::span<std::byte> bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t done = read(fd, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) refuse(path, std::string("cannot be read: ") + std::strerror(errno));
    if (done == 0) refuse_damaged(path, "it ends too soon");
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

Header read_header(int fd, const std::string& path, std::uint64_t size) {
  Header header;
  if (size < sizeof header) refuse(path, "is no checkpoint");
  read_whole(fd, std::as_writable_bytes(std::span(&header, 1)), path);
  if (header.magic != kMagic) refuse(path, "is no checkpoint");
  if (header.hash != hash_of(header)) refuse_damaged(path, "its header does not match its hash");
  if (header.layout != kLayout)
    refuse(path, "was written by " + std::string(header.layout > kLayout ? "a newer" : "an older") +
                     " throng: its layout is " + std::to_string(header.layout) + ", this throng reads " +
                     std::to_string(kLayout));
  return header;
}

/// The arrays take exactly what the header leaves of the file; a count cannot overflow what it is held
/// against.
void expect_size(const std::string& path, const Header& header, std::uint64_t size) {
  constexpr std::uint64_t body = sizeof(std::uint32_t) + 6 * sizeof(double);
  constexpr std::uint64_t agent = 6 * sizeof(double) + 3 * sizeof(std::int64_t) + 3 * sizeof(std::uint32_t);
  constexpr std::uint64_t contact = sizeof(std::uint64_t) + sizeof(std::uint32_t) + 4 * sizeof(double);
  constexpr std::uint64_t arrival = sizeof(std::int64_t) + sizeof(std::uint32_t);
  constexpr std::uint64_t sleeper = sizeof(double) + 2 * sizeof(std::uint32_t);
  constexpr std::uint64_t sleeping = contact + 3 * sizeof(std::uint32_t) + 2 * sizeof(double);
  const std::uint64_t counts[] = {header.scenario_bytes,
                                  header.bodies,
                                  header.agents,
                                  header.groups,
                                  header.measures,
                                  header.on_line,
                                  header.arrivals,
                                  header.sensors,
                                  header.disc_contacts,
                                  header.point_contacts,
                                  header.sleepers,
                                  header.sleeping_disc_contacts,
                                  header.sleeping_point_contacts};
  const bool bounded = std::all_of(std::begin(counts), std::end(counts), [&](auto n) { return n <= size; });
  const bool crowd = header.agents <= header.bodies;
  if (!bounded || !crowd ||
      size != sizeof header + header.scenario_bytes + body * header.bodies + agent * header.agents +
                  sizeof(std::uint32_t) * header.groups + sizeof(Measured) * header.measures +
                  sizeof(OnLine) * header.on_line + arrival * header.arrivals +
                  sizeof(SensedSum) * header.sensors +
                  contact * (header.disc_contacts + header.point_contacts) + sleeper * header.sleepers +
                  sleeping * (header.sleeping_disc_contacts + header.sleeping_point_contacts))
    refuse_damaged(path, "its size is not what its header says");
}

Checkpoint read_content(int fd, const std::string& path, const Header& header) {
  Checkpoint result;
  auto& [origin, state] = result;
  origin.version.assign(header.version.data(), strnlen(header.version.data(), header.version.size()));
  origin.frames = header.frames, origin.frames_hash = header.frames_hash;
  state.step = header.step;
  const auto read_array = [&](auto& array) {
    read_whole(fd, std::as_writable_bytes(std::span(array)), path);
  };
  AllColumns contacts{Columns(header.disc_contacts), Columns(header.point_contacts),
                      SleepingColumns(header.sleeping_disc_contacts),
                      SleepingColumns(header.sleeping_point_contacts)};
  origin.scenario.resize(header.scenario_bytes);
  read_array(origin.scenario);
  for_each_array(state, [&](auto& array) {
    array.resize(header.bodies);
    read_array(array);
  });
  for_each_agent_array(state.crowd, [&](auto& array) {
    array.resize(header.agents);
    read_array(array);
  });
  state.crowd.waiting.resize(header.groups), state.crowd.measured.resize(header.measures);
  state.crowd.arrivals.resize(header.arrivals), state.crowd.arrived_id.resize(header.arrivals);
  state.crowd.on_line.resize(header.on_line), state.sensed.resize(header.sensors);
  read_array(state.crowd.waiting), read_array(state.crowd.measured), read_array(state.crowd.on_line);
  read_array(state.crowd.arrivals), read_array(state.crowd.arrived_id);
  read_array(state.sensed);
  state.crowd.arrived = std::ssize(state.crowd.arrivals);
  state.crowd.wall_corrections = header.wall_corrections;
  state.crowd.squeezed = header.squeezed;
  state.collisions = {header.pair_collisions, header.wall_collisions, header.pushed,
                      std::bit_cast<double>(header.virial), std::bit_cast<double>(header.equilibrium)};
  state.sleep.squared_speed.resize(header.sleepers);
  state.sleep.calm.resize(header.sleepers), state.sleep.island.resize(header.sleepers);
  read_array(state.sleep.squared_speed), read_array(state.sleep.calm), read_array(state.sleep.island);
  for_each_column(contacts, read_array);
  if (header.content_hash != hash_of(content(origin.scenario, state, contacts)))
    refuse_damaged(path, "it does not match its hash");
  state.disc_contacts = contacts.discs.contacts(), state.point_contacts = contacts.points.contacts();
  state.sleep.disc_contacts = contacts.sleeping_discs.contacts();
  state.sleep.point_contacts = contacts.sleeping_points.contacts();
  if (!is_sound(state)) refuse_damaged(path, "its state cannot be that of a run");
  return result;
}

std::string temporary(const std::string& path) {
  return path + ".tmp";
}

}  // namespace

std::string checkpoint_path(const std::string& recording) {
  return recording + ".ckpt";
}

std::string previous_checkpoint_path(const std::string& recording) {
  return checkpoint_path(recording) + ".prev";
}

void write_checkpoint(const std::string& path, const CheckpointOrigin& origin, const State& state) {
  const AllColumns contacts{Columns(state.disc_contacts), Columns(state.point_contacts),
                            SleepingColumns(state.sleep.disc_contacts),
                            SleepingColumns(state.sleep.point_contacts)};
  const std::vector<Bytes> parts = content(origin.scenario, state, contacts);
  Header header = header_for(origin, state);
  header.content_hash = hash_of(parts);
  header.hash = hash_of(header);
  try {
    write_file(temporary(path), header, parts);
  } catch (...) {
    unlink(temporary(path).c_str());
    throw;
  }
  const bool kept = std::rename(path.c_str(), (path + ".prev").c_str()) == 0 || errno == ENOENT;
  if (!kept || std::rename(temporary(path).c_str(), path.c_str()) != 0) fail_to_write(path);
  sync_folder(path);
}

Checkpoint read_checkpoint(const std::string& path) {
  const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.fd < 0)
    refuse(path, errno == ENOENT ? "does not exist" : std::string("cannot be read: ") + std::strerror(errno));
  struct stat found;
  if (fstat(file.fd, &found) != 0 || !S_ISREG(found.st_mode)) refuse(path, "is no regular file");
  const auto size = static_cast<std::uint64_t>(found.st_size);
  const Header header = read_header(file.fd, path, size);
  expect_size(path, header, size);
  return read_content(file.fd, path, header);
}

void remove_checkpoints(const std::string& recording) {
  const std::string path = checkpoint_path(recording);
  for (const std::string& name : {path, previous_checkpoint_path(recording), temporary(path)})
    unlink(name.c_str());
}

}  // namespace throng::recording
