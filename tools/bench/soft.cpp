// SPDX-License-Identifier: MIT
// throng bench soft: a settled bed of discs on springs and dashpots, as granular physics has it.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "sim/input_error.h"
#include "sim/simulation.h"
#include "sim/soft_timing.h"
#include "tools/bench/benchmarks.h"
#include "tools/bench/interleave.h"
#include "tools/bench/peers/lammps.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

constexpr double kDt = 5e-3;          // s, from one search for pairs to the next
constexpr double kPerContact = 50.0;  // substeps
constexpr double kSettle = 12.0;      // s, rigidly: springs would take days
constexpr double kRingDown = 1.5;     // s, softly: until those that were rigid have found their springs
constexpr double kJoin = 0.1;         // s, softly: until beds side by side have found each other
constexpr int kPeerSteps = 5;         // steps of kDt behind a figure of LAMMPS, which begins anew each time

struct Bed {
  const char* name;
  int copies;  // of the gallery's pile, side by side: for a wide one to settle would take days, too
};

constexpr Bed kBeds[] = {{"bed n=10000", 1}, {"bed n=100000", 10}};

/// The bed on springs: `contact` is how stiff.
Scene softened(Scene scene, ContactModel model) {
  scene.contact = model;
  scene.soft.stiffness = 1e5;
  scene.soft.youngs_modulus = 1e7;
  scene.time.dt = kDt;
  scene.time.substeps = static_cast<int>(std::ceil(kDt * kPerContact / soft_timing(scene).contact));
  if (const std::string refusal = soft_refusal(scene); !refusal.empty()) throw InputError("bed: " + refusal);
  return scene;
}

struct Runner {
  explicit Runner(const Scene& soft) : scene(soft), run(simulation(scene)) {}

  const Scene scene;
  std::unique_ptr<Simulation> run;
};

/// LAMMPS on the bed as a runner of spring has it by then.
class Peer {
 public:
  Peer(const Runner& runner, int steps)
      : scene_(begun_at(runner.scene, runner.run->state())), bed_(scene_, steps * scene_.time.substeps) {}

  /// One figure more, unless it couldn't play before.
  void play() {
    if (!last_.fault.empty()) return;
    last_ = bed_.run();
    if (last_.fault.empty()) ms_.push_back(1e3 * last_.seconds / last_.steps * scene_.time.substeps);
  }
  const Scene& scene() const { return scene_; }
  const std::vector<double>& ms() const { return ms_; }
  const LammpsRun& last() const { return last_; }

 private:
  Scene scene_;
  LammpsBed bed_;
  LammpsRun last_;
  std::vector<double> ms_;  // of as many of its steps as a step here has substeps
};

/// Pairs of discs that press on each other; walls are nobody's.
double touching(const Simulation& run) {
  std::vector<ContactRow> rows;
  run.list_contacts(rows);
  return static_cast<double>(
      std::ranges::count_if(rows, [](const ContactRow& row) { return row.a > 0 && row.b > 0; }));
}

Row row_of(const Bed& bed, const std::string& engine, const Scene& scene, const std::vector<double>& ms,
           double touching) {
  const double discs = static_cast<double>(scene.bodies.size()), substeps = scene.time.substeps;
  return {"soft",
          bed.name,
          engine,
          1,
          ms,
          substeps,
          "",
          {{"us_per_disc_and_substep", 1e3 * minimum(ms) / (discs * substeps)},
           {"contacts_per_disc", 2.0 * touching / discs}}};
}

Row row_of(const Bed& bed, const Peer& peer) {
  const LammpsRun& last = peer.last();
  if (last.fault.empty()) return row_of(bed, "lammps", peer.scene(), peer.ms(), last.touching);
  return {"soft", bed.name, "lammps", 1, {0.0}, 0.0, "", {{"note", last.fault}}};
}

/// Steps for so long (s).
void pass(Runner& runner, double seconds) {
  for (int i = 0; i < seconds / kDt; ++i) runner.run->step();
}

/// The bed at rest on springs. `part`: how much of the times that it takes.
std::unique_ptr<Runner> at_rest(const Bed& bed, const Scene& rigid, ContactModel model, double part) {
  auto runner = std::make_unique<Runner>(softened(rigid, model));
  pass(*runner, part * kRingDown);
  if (bed.copies == 1) return runner;
  auto wide =
      std::make_unique<Runner>(side_by_side(begun_at(runner->scene, runner->run->state()), bed.copies));
  pass(*wide, part * kJoin);
  return wide;
}

void play(const Bed& bed, const Options& options, std::vector<Row>& rows) {
  const double part = options.quick ? 0.05 : 1.0;
  const Scene rigid = settled(gallery_scene(options.scenarios, "pile"), part * kSettle);
  const auto spring = at_rest(bed, rigid, ContactModel::spring, part);
  const auto hertz = at_rest(bed, rigid, ContactModel::hertz, part);
  Peer lammps(*spring, options.quick ? 1 : kPeerSteps);
  std::vector<Contestant> contestants{{"spring", [&] { spring->run->step(); }, {}, [&] { lammps.play(); }},
                                      {"hertz", [&] { hertz->run->step(); }}};
  interleave(contestants, options.blocks, 1);
  for (std::size_t i = 0; i < 2; ++i) {
    const Runner& runner = i == 0 ? *spring : *hertz;
    rows.push_back(
        row_of(bed, contestants[i].engine, runner.scene, contestants[i].ms, touching(*runner.run)));
  }
  rows.push_back(row_of(bed, lammps));
}

}  // namespace

std::vector<Row> bench_soft(const Options& options) {
  std::vector<Row> rows;
  for (const Bed& bed : kBeds)
    if (chosen(bed.name, options)) {
      play(bed, options, rows);
      options.show(rows);
    }
  return rows;
}

}  // namespace throng::bench
