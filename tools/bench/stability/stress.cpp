// SPDX-License-Identifier: MIT
#include "tools/bench/stability/stress.h"

#include <cmath>
#include <cstdio>

#include "scenarios/load.h"
#include "sim/input_error.h"

namespace throng::bench {

namespace {

constexpr double kOrdinaryDt = 1.0 / 60.0, kOrdinarySubsteps = 8.0;
constexpr double kSeconds = 6.0;  // of a run in which lengths are metres

std::string toml_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  const std::string plain = text;
  return plain.find_first_of(".en") == std::string::npos ? plain + ".0" : plain;
}

/// "[x, y]", scaled and moved.
class Places {
 public:
  explicit Places(const Stress& stress)
      : scale_(stress[std::size_t(Factor::scale)]), offset_(stress[std::size_t(Factor::offset)]) {}

  std::string at(double x, double y) const {
    return "[" + toml_number(offset_ + scale_ * x) + ", " + toml_number(offset_ + scale_ * y) + "]";
  }
  std::string box(double x, double y, double x2, double y2) const {
    return "[" + at(x, y) + ", " + at(x2, y2) + "]";
  }
  std::string size(double length) const { return toml_number(scale_ * length); }

 private:
  double scale_, offset_;
};

std::string square_bodies(const char* material, int first, int count, const Places& places) {
  return "[[bodies]]\nshape = 'box'\nmaterial = '" + std::string(material) +
         "'\nplace.lattice = { origin = " + places.at(0.0, 0.5 + first) + ", spacing = [" + places.size(1) +
         ", " + places.size(1) + "], size = [1, " + std::to_string(count) + "] }\n";
}

std::string discs(const char* material, int count, const std::string& velocity, const Places& places) {
  return "[[bodies]]\nshape = 'disc'\nmaterial = '" + std::string(material) +
         "'\ncount = " + std::to_string(count) + "\nplace.random = { within = " + places.box(0, 0, 12, 20) +
         " }\n" + velocity;
}

std::string bodies(Stressed scene, const Places& places) {
  if (scene == Stressed::stack)
    return "[[walls]]\nsegment = " + places.box(-20, 0, 20, 0) + "\n" + square_bodies("light", 0, 9, places) +
           square_bodies("heavy", 9, 1, places);
  const std::string velocity =
      scene == Stressed::gas ? "velocity.maxwell = " + places.size(1) + "\n" : std::string();
  return "[domain]\nbox = " + places.box(0, 0, 12, 20) + "\n" + discs("light", 135, velocity, places) +
         discs("heavy", 15, velocity, places);
}

}  // namespace

const char* factor_name(Factor factor) {
  constexpr std::array names{"scale",       "offset (m)", "mass ratio", "dt (s)",
                             "restitution", "friction",   "substeps"};
  return names[static_cast<std::size_t>(factor)];
}

std::vector<double> values_of(Factor factor, bool quick) {
  static const std::array<std::vector<double>, kFactors> all{{
      {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3},
      {0.0, 1e3, 1e6},
      {1.0, 10.0, 100.0, 1e3, 1e4, 1e5},
      {1.0 / 240, 1.0 / 120, 1.0 / 60, 1.0 / 30, 1.0 / 15, 1.0 / 10},
      {0.0, 0.5, 1.0},
      {0.0, 0.5, 1.2},
      {1.0, 2.0, 4.0, 8.0, 16.0},
  }};
  const std::vector<double>& values = all[static_cast<std::size_t>(factor)];
  if (!quick) return values;
  return {values.front(), values[values.size() / 2], values.back()};
}

const char* stressed_name(Stressed scene) {
  constexpr std::array names{"stack", "pile", "gas"};
  return names[static_cast<std::size_t>(scene)];
}

Stress ordinary(Stressed scene) {
  const bool gas = scene == Stressed::gas;
  return {1.0, 0.0, 1.0, kOrdinaryDt, gas ? 1.0 : 0.0, gas ? 0.0 : 0.5, kOrdinarySubsteps};
}

Scene stressed_scene(Stressed scene, const Stress& stress) {
  const auto value = [&](Factor factor) { return stress[static_cast<std::size_t>(factor)]; };
  const Places places(stress);
  const std::string surface = "restitution = " + toml_number(value(Factor::restitution)) +
                              ", friction = " + toml_number(value(Factor::friction)) + " }\n";
  const bool falls = scene != Stressed::gas;
  const double until = kSeconds * std::max(1.0, falls ? std::sqrt(value(Factor::scale)) : 1.0);
  const std::string text =
      "throng = 1\nseed = 2\nsleep = false\n" + std::string(falls ? "gravity = [0, -9.81]\n" : "") +
      "time = { dt = " + toml_number(value(Factor::dt)) + ", until = " + toml_number(until) +
      ", substeps = " + std::to_string(static_cast<int>(value(Factor::substeps))) + " }\n" +
      "materials.light = { density = 1.0, " + surface +
      "materials.heavy = { density = " + toml_number(value(Factor::mass_ratio)) + ", " + surface +
      "materials.default = { " + surface + "shapes.disc.disc.radius = " + places.size(0.45) +
      "\nshapes.box.polygon = [[0, 0], [" + places.size(1) + ", 0], [" + places.size(1) + ", " +
      places.size(1) + "], [0, " + places.size(1) + "]]\n" + bodies(scene, places);
  Loaded loaded = load_scenario_text(text, "stress.toml");
  if (loaded.errors() > 0) throw InputError(to_string(loaded.diagnostics, "stress.toml"));
  return std::move(loaded.scene);
}

}  // namespace throng::bench
