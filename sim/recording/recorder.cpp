// SPDX-License-Identifier: MIT
#include "sim/recording/recorder.h"

#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>

#include <chrono>
#include <functional>
#include <future>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "sim/input_error.h"
#include "sim/recording/build_info.h"
#include "sim/recording/checkpoint.h"
#include "sim/recording/expected_bytes.h"
#include "sim/recording/frame_queue.h"
#include "sim/recording/output_file.h"
#include "sim/recording/trajectory_writer.h"

namespace throng {

using namespace recording;

namespace {

constexpr auto kCommitEach = std::chrono::seconds(1), kSyncEach = std::chrono::seconds(10);
constexpr double kCommitBytes = 16e6;
constexpr double kStateBytes = 150.0;  // a body, with three contacts
constexpr double kCheckpoints = 3.0;   // this one, the one before, the next
constexpr double kEnoughRoom = 4e6;    // bytes: below it, stop while the file can still be closed in order

/// Texts, and what stands beside the file.
double other_bytes(const Scene& scene, const Provenance& provenance) {
  const double texts = static_cast<double>(provenance.scenario.size() + provenance.resolved.size());
  const double bodies = static_cast<double>(scene.bodies.size());
  return kCheckpoints * kStateBytes * bodies + texts + 1e5;
}

/// Signals are for the threads that know what to do; a limit on the file's size comes back as an error
/// instead.
void block_signals() {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

/// HDF5 doesn't survive it when memory ends while it sets itself up: asks for as much beforehand.
void expect_memory() {
  constexpr std::size_t kRoom = std::size_t{48} << 20;
  void* const room = mmap(nullptr, kRoom, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  munmap(room, kRoom);
}

}  // namespace

/// The frames of an earlier run to begin with.
struct Kept {
  const Recording* recording = nullptr;
  std::size_t frames = 0;
};

struct Recorder::Impl {
  Impl(const std::string& path, const Scene& scene, const Provenance& provenance, bool force, Kept kept);
  ~Impl();

  void write_all(const Scene& scene, const Provenance& provenance, Kept kept, std::promise<void>& ready);
  std::unique_ptr<TrajectoryWriter> make_writer(const Scene& scene, const Provenance& provenance, Kept kept);
  void write_entries(TrajectoryWriter& writer);
  std::optional<Observables> observables(const QueueEntry& entry);
  void write_checkpoint(TrajectoryWriter& writer, const State& state);
  void commit(TrajectoryWriter& writer);
  void commit_when_due(TrajectoryWriter& writer);
  void end(TrajectoryWriter& writer);
  void keep_what_is_there(TrajectoryWriter& writer);
  void guarded(TrajectoryWriter& writer, const std::function<void()>& work);

  using Clock = std::chrono::steady_clock;
  OutputFile output;
  std::string scenario;              ///< resolved
  std::optional<Scene> observed;     ///< what observables are measured on, where any are
  std::optional<Observer> observer;  ///< of it; the writing thread's
  Clock::time_point last_commit = Clock::now(), last_sync = Clock::now();
  FrameQueue queue;
  /// As it is at the end; set before the queue closes: the file deserves its final name.
  const CrowdState* complete = nullptr;
  std::size_t frames = 0;
  std::thread writer_thread;
};

Recorder::Impl::Impl(const std::string& path, const Scene& scene, const Provenance& provenance, bool force,
                     Kept kept)
    : output(path, force),
      scenario(provenance.resolved),
      observed(scene.record.observables > 0 ? std::optional(scene) : std::nullopt),
      queue(scene.bodies.size()),
      frames(kept.frames) {
  if (kept.recording && output.was_there()) output.keep();
  expect_room(path, least_bytes(scene) + other_bytes(scene, provenance));
  expect_memory();
  std::promise<void> promise;
  std::future<void> ready = promise.get_future();
  writer_thread =
      std::thread([&, told = std::move(promise)]() mutable { write_all(scene, provenance, kept, told); });
  try {
    ready.get();
  } catch (...) {
    writer_thread.join();
    throw;
  }
}

Recorder::Impl::~Impl() {
  queue.close();
  if (writer_thread.joinable()) writer_thread.join();
}

/// The writer's whole life. `ready` is told when the file is made, or why it is not; the arguments live until
/// then.
void Recorder::Impl::write_all(const Scene& scene, const Provenance& provenance, Kept kept,
                               std::promise<void>& ready) {
  block_signals();
  std::unique_ptr<TrajectoryWriter> writer;
  try {
    writer = make_writer(scene, provenance, kept);
  } catch (const std::exception& error) {
    const std::string message = "cannot write " + output.part() + ": " + error.what();
    ready.set_exception(std::make_exception_ptr(std::runtime_error(message)));
    return;
  }
  ready.set_value();
  guarded(*writer, [&] {
    write_entries(*writer);
    end(*writer);
  });
}

/// Where frames are kept, they are copied beside what holds them, and take its place when they are safe.
std::unique_ptr<TrajectoryWriter> Recorder::Impl::make_writer(const Scene& scene,
                                                              const Provenance& provenance, Kept kept) {
  if (!kept.recording) {
    remove_checkpoints(output.path());
    return std::make_unique<TrajectoryWriter>(output.part(), scene, provenance);
  }
  const std::string fresh = output.part() + ".new";
  std::unique_ptr<TrajectoryWriter> writer;
  try {
    writer = std::make_unique<TrajectoryWriter>(fresh, scene, provenance);
    Frame frame;
    for (std::size_t i = 0; i < kept.frames; ++i) {
      kept.recording->read(i, frame);
      writer->append(std::move(frame));
      if (writer->uncommitted_bytes() >= kCommitBytes) writer->commit();
    }
    writer->commit();
    output.adopt(fresh);
  } catch (...) {
    if (writer) writer->abandon();
    std::remove(fresh.c_str());
    throw;
  }
  return writer;
}

/// Does `work`; after an error the file is closed in order, except that nothing follows a failed write.
void Recorder::Impl::guarded(TrajectoryWriter& writer, const std::function<void()>& work) {
  try {
    work();
  } catch (const h5::Error& error) {
    writer.abandon();
    if (writer.committed() > 0) output.keep();
    const std::string kept = writer.committed() > 0
                                 ? std::to_string(writer.committed()) + " frames in it are readable"
                                 : "nothing is kept";
    queue.fail(std::make_exception_ptr(
        std::runtime_error("writing " + output.part() + " failed: " + error.what() + "; " + kept)));
  } catch (...) {
    queue.fail(std::current_exception());
    guarded(writer, [&] { keep_what_is_there(writer); });
  }
}

void Recorder::Impl::write_entries(TrajectoryWriter& writer) {
  while (const QueueEntry* entry = queue.front([&] { commit_when_due(writer); })) {
    if (entry->checkpoint)
      write_checkpoint(writer, entry->state);
    else
      writer.append(entry->state, entry->hash ? *entry->hash : hash(entry->state), entry->contacts,
                    observables(*entry), entry->sensed);
    queue.pop();
    commit_when_due(writer);
  }
}

std::optional<Observables> Recorder::Impl::observables(const QueueEntry& entry) {
  if (!observed || !is_due(observed->record.observables, entry.state.step)) return std::nullopt;
  if (!observer) observer.emplace(*observed);
  return observer->observe(entry.state, entry.contacts);
}

/// First the frames reach the disk, then what says that they are there.
void Recorder::Impl::write_checkpoint(TrajectoryWriter& writer, const State& state) {
  commit(writer);
  output.sync();
  last_sync = Clock::now();
  const CheckpointOrigin origin{version_text(), scenario, writer.committed(), writer.digest()};
  try {
    recording::write_checkpoint(checkpoint_path(output.path()), origin, state);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + "; " + output.part() + " is kept, and its " +
                             std::to_string(writer.committed()) + " frames are readable");
  }
}

void Recorder::Impl::commit(TrajectoryWriter& writer) {
  writer.commit();
  output.keep();
  last_commit = Clock::now();
}

void Recorder::Impl::commit_when_due(TrajectoryWriter& writer) {
  const auto now = Clock::now();
  const double uncommitted = writer.uncommitted_bytes();
  if (now - last_commit < kCommitEach && uncommitted < kCommitBytes) return;
  if (!writer.has_uncommitted()) return;
  commit(writer);
  output.start_sync();
  if (now - last_sync >= kSyncEach) {
    output.sync();
    last_sync = now;
  }
  const double room = free_bytes(output.path());
  if (room >= uncommitted + kEnoughRoom) return;
  throw std::runtime_error("stopped writing " + output.part() + ": the disk is nearly full; " +
                           std::to_string(writer.committed()) + " frames in it are readable");
}

void Recorder::Impl::end(TrajectoryWriter& writer) {
  if (!complete) return keep_what_is_there(writer);
  writer.finish(*complete);
  output.publish();
}

void Recorder::Impl::keep_what_is_there(TrajectoryWriter& writer) {
  writer.close();
  if (writer.committed() > 0) output.keep();
}

Recorder::Recorder(const std::string& path, const Scene& scene, const Provenance& provenance, bool force)
    : impl_(std::make_unique<Impl>(path, scene, provenance, force, Kept{})) {}

Recorder::Recorder(const std::string& path, const Scene& scene, const Provenance& provenance,
                   const Recording& kept, std::size_t frames)
    : impl_(std::make_unique<Impl>(path, scene, provenance, true, Kept{&kept, frames})) {}

Recorder::~Recorder() = default;

void Recorder::expect_writable(const std::string& path, const Scene& scene, const Provenance& provenance,
                               bool force) {
  recording::expect_writable(path, force);
  expect_room(path, least_bytes(scene) + other_bytes(scene, provenance));
}

std::string Recorder::doubt(const std::string& path, const Scene& scene, const Provenance& provenance) {
  const std::string why = lacking_room(path, expected_bytes(scene) + other_bytes(scene, provenance));
  return why.empty() ? "" : "the recording may need " + why;
}

void Recorder::record(const State& state, std::span<const ContactRow> contacts,
                      std::span<const Sensed> sensed) {
  impl_->queue.push(state, contacts, sensed);
  ++impl_->frames;
}

void Recorder::checkpoint(const State& state) {
  impl_->queue.push_checkpoint(state);
}

void Recorder::finish(const CrowdState& crowd) {
  impl_->complete = &crowd;
  stop();
}

void Recorder::stop() {
  impl_->queue.close();
  if (impl_->writer_thread.joinable()) impl_->writer_thread.join();
  impl_->queue.check();
}

const std::string& Recorder::path() const {
  return impl_->output.path();
}
const std::string& Recorder::part() const {
  return impl_->output.part();
}
std::size_t Recorder::frames() const {
  return impl_->frames;
}

}  // namespace throng
