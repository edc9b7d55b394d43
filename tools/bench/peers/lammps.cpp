// SPDX-License-Identifier: MIT
#include "tools/bench/peers/lammps.h"

#include <sys/wait.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <optional>

#include "sim/contact/soft_law.h"
#include "tools/bench/rows.h"

namespace throng::bench {

namespace {

constexpr const char* kSilent = "tells no time";
constexpr int kTimeLimit = 600;  // s of a run
constexpr double kSkin = 0.2;    // of the mean radius, beyond touching: who is listed as a neighbour

[[gnu::format(printf, 1, 2)]] std::string line(const char* format, ...) {
  char text[512];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return std::string(text) + '\n';
}

/// Its atoms are balls: a density makes each as heavy as the disc.
std::string data(const Scene& scene) {
  const Bodies& bodies = scene.bodies;
  std::string text = line("throng\n\n%zu atoms\n1 atom types", bodies.size());
  for (int axis : {0, 1})
    text +=
        line("%.17g %.17g %clo %chi", scene.domain.min[axis], scene.domain.max[axis], "xy"[axis], "xy"[axis]);
  text += line("-0.5 0.5 zlo zhi\n\nAtoms # sphere\n");
  for (std::size_t row = 0; row < bodies.size(); ++row) {
    const double radius = bodies.radius[row];
    const double density = mass(scene, row) / (4.0 / 3.0 * std::numbers::pi * radius * radius * radius);
    text += line("%zu 1 %.17g %.17g %.17g %.17g 0", row + 1, 2.0 * radius, density, bodies.position[row].x(),
                 bodies.position[row].y());
  }
  text += line("\nVelocities\n");
  for (std::size_t row = 0; row < bodies.size(); ++row)
    text += line("%zu %.17g %.17g 0 0 0 %.17g", row + 1, bodies.velocity[row].x(), bodies.velocity[row].y(),
                 bodies.spin[row]);
  return text;
}

/// Kn Kt gamma_n gamma_t xmu, and that the tangential dashpot is there.
std::string law(const Scene& scene) {
  double all = 0.0;  // kg
  for (std::size_t row = 0; row < scene.bodies.size(); ++row) all += mass(scene, row);
  const double reduced = 0.5 * all / static_cast<double>(scene.bodies.size());
  const Material& material = scene.materials[0];
  const SoftRatios tangential = soft_ratios(scene);
  const double damping =
      soft_pair(scene, reduced, 0.0, damping_ratio(material.restitution)).damping / reduced;
  char text[160];
  std::snprintf(text, sizeof text, "%.17g %.17g %.17g %.17g %.17g 1", scene.soft.stiffness,
                tangential.stiffness * scene.soft.stiffness, damping, tangential.damping * damping,
                material.friction);
  return text;
}

std::string script(const Scene& scene, int steps) {
  const std::string contact = "hooke/history " + law(scene);
  std::string text =
      "units si\ndimension 2\nboundary f f p\nnewton off\natom_style sphere\ncomm_modify vel yes\n"
      "read_data bed.data\npair_style gran/" +
      contact + "\npair_coeff * *\n";
  text +=
      line("neighbor %.17g bin\nneigh_modify every 1 delay 0 check yes", kSkin * mean(scene.bodies.radius));
  text += line("timestep %.17g\nfix move all nve/sphere disc", scene.time.dt / scene.time.substeps);
  text += line("fix pull all gravity %.17g vector %.17g %.17g 0", scene.gravity.norm(), scene.gravity.x(),
               scene.gravity.y());
  for (int axis : {0, 1})
    text += "fix " + std::string(axis == 0 ? "sides" : "ends") + " all wall/gran " + contact +
            line(" %cplane %.17g %.17g", "xy"[axis], scene.domain.min[axis], scene.domain.max[axis]);
  return text +
         line(
             "fix flat all enforce2d\ncompute touching all contact/atom\n"
             "compute ends all reduce sum c_touching\nthermo_style custom step c_ends\nthermo 0\nrun %d\n"
             "print \"touching $(0.5*c_ends)\"",
             steps);
}

/// What stands behind the last `word` at the beginning of a line; nothing where there is none.
std::optional<double> number_after(const std::string& output, const std::string& word) {
  const std::size_t found = output.rfind('\n' + word);
  double number = 0.0;
  if (found == output.npos || std::sscanf(output.c_str() + found + 1 + word.size(), "%lf", &number) != 1)
    return {};
  return number;
}

/// One word for a shell, whatever the text holds.
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + '\'';
}

}  // namespace

LammpsRun read_lammps(const std::string& output) {
  const std::size_t error = output.find("ERROR");
  if (error != output.npos) return {.fault = output.substr(error, output.find('\n', error) - error)};
  const std::size_t loop = output.rfind("\nLoop time of ");
  LammpsRun run;
  const auto touching = number_after(output, "touching ");
  if (loop == output.npos || !touching ||
      std::sscanf(output.c_str() + loop, "\nLoop time of %lf on %*d procs for %lf steps", &run.seconds,
                  &run.steps) != 2)
    return {.fault = kSilent};
  run.touching = *touching;
  return run;
}

LammpsBed::LammpsBed(const Scene& scene, int steps) {
  std::ofstream(folder_.path + "/bed.data") << data(scene);
  std::ofstream(folder_.path + "/bed.lmp") << script(scene, steps);
}

LammpsRun LammpsBed::run() const {
  constexpr int kTimedOut = 124;  // of timeout
  if (std::system("command -v lmp >/dev/null 2>&1") != 0) return {.fault = "not installed"};
  const std::string command = "cd " + quoted(folder_.path) + " && timeout --foreground " +
                              std::to_string(kTimeLimit) +
                              " lmp -in bed.lmp -log none >output 2>&1 </dev/null";
  const int status = std::system(command.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == kTimedOut) return {.fault = "takes longer than " + std::to_string(kTimeLimit) + " s"};
  std::ifstream in(folder_.path + "/output");
  LammpsRun run = read_lammps({std::istreambuf_iterator<char>(in), {}});
  if (run.fault == kSilent && code != 0) run.fault = "fails with exit code " + std::to_string(code);
  return run;
}

}  // namespace throng::bench
