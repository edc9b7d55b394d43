// SPDX-License-Identifier: MIT
#include "tools/bench/accuracy/race.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "sim/input_error.h"
#include "tools/bench/accuracy/players.h"
#include "tools/bench/scenes.h"

namespace throng::bench {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr double kLeastMs = 2.0;  // of stepping behind one figure
constexpr std::size_t kQuickSteps = 3;

/// An engine at one setting.
struct Entry {
  const Player* player;
  int knob;
  Scene scene;
  Json error;
  std::uint64_t hash = 0;  // of the last state
  std::vector<double> ms = {};

  bool plays() const { return !error["error"].is_null(); }
  std::unique_ptr<Simulation> start() const { return player->start(scene, knob); }
};

/// One run that is looked at. False where the engine isn't there, or is none for this scene.
bool judge(Entry& entry, const JudgeMaker& judges) {
  const auto simulation = entry.start();
  if (!simulation) return false;
  const auto judge = judges(entry.scene);
  for (std::int64_t i = 1; i <= entry.scene.time.steps(); ++i) {
    simulation->step();
    judge->look(static_cast<double>(i) * entry.scene.time.dt, *simulation);
  }
  for (const auto& [name, value] : judge->figures()) entry.error[name] = value;
  entry.hash = hash(simulation->state());
  return true;
}

/// What of a message fits into a table: what stands before the first line's end.
std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string setting_of(const Player& player, int knob) {
  const std::string number = std::to_string(knob);
  return player.asked ? player.knob + number : *player.knob ? player.knob + (" " + number) : "";
}

/// The engine at that setting, looked at; nothing where the engine isn't there. Where it can't play the scene
/// its error is null, and "note" says why.
std::optional<Entry> seen(const Player& player, int knob, double dt, const Scene& base,
                          const JudgeMaker& judges) {
  Entry entry{&player, knob, base, {{"error", nullptr}, {"dt", dt}}};
  entry.error["setting"] = setting_of(player, knob);
  if (player.peer) entry.error["peer"] = true;
  if (player.asked) entry.error["asked"] = player.asked(knob);
  try {
    entry.scene.time.dt = dt;
    entry.scene = player.prepared(std::move(entry.scene), knob);
    entry.error["dt"] = entry.scene.time.dt;
    if (!judge(entry, judges)) return {};
  } catch (const InputError& error) {
    entry.error["note"] = first_line(error.what());
  } catch (const SimulationError& error) {
    entry.error["note"] = first_line(error.what());
  }
  return entry;
}

/// All engines at all of their settings; of those at which one can't play, only the first.
std::vector<Entry> all_seen(const AccuracyCase& one, const Options& options) {
  Scene base = gallery_scene(of_clone("tools/bench/accuracy/scenes"), one.scene, one.overrides);
  if (options.quick && one.heavy) base.time.until *= 0.1;
  const JudgeMaker judges = one.judges(base);
  const std::size_t steps = std::min(options.quick ? kQuickSteps : one.dts.size(), one.dts.size());
  const std::size_t knobs = options.quick ? 1 : one.knobs;
  std::vector<Entry> entries;
  for (const Player& player : players()) {
    if (!options.engines.empty() &&
        std::ranges::find(options.engines, player.engine) == options.engines.end())
      continue;
    if ((player.asked && !one.promised) || (one.instant && !player.instant)) continue;
    bool refused = false;
    for (const int knob : player.knobs.first(std::min(knobs, player.knobs.size())))
      for (std::size_t i = 0; i < (player.asked ? 1 : steps); ++i) {
        std::optional<Entry> entry = seen(player, knob, one.dts[i], base, judges);
        if (!entry || (refused && !entry->plays())) continue;
        refused = refused || !entry->plays();
        entries.push_back(std::move(*entry));
      }
  }
  return entries;
}

/// ms per simulated second; the world is made anew for each run, untimed.
double timed(const Entry& entry) {
  Clock::duration spent{0};
  int runs = 0;
  const std::int64_t steps = entry.scene.time.steps();
  do {
    const auto simulation = entry.start();
    const auto begin = Clock::now();
    for (std::int64_t i = 0; i < steps; ++i) simulation->step();
    spent += Clock::now() - begin;
    ++runs;
    if (hash(simulation->state()) != entry.hash)
      throw std::runtime_error(std::string(entry.player->engine) + " ends in other bits when it runs again");
  } while (spent < std::chrono::duration<double, std::milli>(kLeastMs));
  const double seconds = runs * static_cast<double>(steps) * entry.scene.time.dt;
  return std::chrono::duration<double, std::milli>(spent).count() / seconds;
}

}  // namespace

std::vector<Row> race(const AccuracyCase& one, const Options& options) {
  std::fprintf(stderr, "%s\n", one.name);
  std::vector<Entry> entries = all_seen(one, options);
  for (int block = 0; block < options.blocks; ++block)
    for (Entry& entry : entries)
      if (entry.plays()) entry.ms.push_back(timed(entry));
  std::vector<Row> rows;
  for (Entry& entry : entries) {
    entry.error["what"] = one.error;
    rows.push_back({"accuracy", one.name, entry.player->engine, 1,
                    entry.plays() ? entry.ms : std::vector<double>{0.0},
                    static_cast<double>(entry.scene.time.steps()), one.what, entry.error});
  }
  return rows;
}

}  // namespace throng::bench
