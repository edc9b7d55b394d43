// SPDX-License-Identifier: MIT
// throng export: a recording in the formats of the field's tools.
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

#include "sim/input_error.h"
#include "tools/commands.h"
#include "tools/export.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

struct Options {
  std::string file, format, output;
  double from = -std::numeric_limits<double>::infinity(), to = -from;  // s
  std::int64_t every = 1;
  bool force = false;
};

void check_output(const Options& options) {
  if (are_one_file(options.output, options.file))
    throw InputError("cannot write " + options.output + ": it is the recording");
  std::error_code neither;
  if (!options.force && std::filesystem::is_regular_file(options.output, neither))
    throw InputError("cannot write " + options.output + ": it exists already; --force overwrites it");
}

void check_contents(const Options& options, const Recording& recording) {
  if (recording.frames() == 0) throw InputError(options.file + " holds no frames to export");
  if (recording.bodies() == 0) throw InputError(options.file + " holds no bodies to export");
  if (options.format != "csv" && !recording.geometry().record.position)
    throw InputError(options.file + " holds no positions, which " + options.format + " can't do without");
}

/// Each --every-th frame from the first that is not before --from, up to rounding.
std::vector<std::size_t> select(const Options& options, const Recording& recording) {
  const auto times = recording.times();
  const double slack = 1e-9 * times.back();
  std::vector<std::size_t> frames;
  std::int64_t skip = 0;
  for (std::size_t i = 0; i < times.size(); ++i)
    if (times[i] >= options.from - slack && times[i] <= options.to + slack && skip-- == 0) {
      frames.push_back(i);
      skip = options.every - 1;
    }
  if (!frames.empty()) return frames;
  char text[160];
  std::snprintf(text, sizeof text, " has no frame from --from %g to --to %g: it goes from %g s to %g s",
                options.from, options.to, times.front(), times.back());
  throw InputError(options.file + text);
}

int export_recording(const Options& options) {
  check_output(options);
  const Recording recording(options.file);
  say_where_incomplete(recording, options.file);
  check_contents(options, recording);
  const std::vector<std::size_t> frames = select(options, recording);
  replace_file(options.output, [&](const std::string& path) {
    const ExportTarget target{path, options.output};
    if (options.format == "csv") export_csv(recording, frames, target);
    if (options.format == "pedpy") export_pedpy(recording, frames, target);
    if (options.format == "xdmf") export_xdmf(recording, options.file, frames, target);
    if (options.format == "h5md3") export_h5md3(recording, frames, target);
    if (options.format == "lammps") export_lammps(recording, frames, target);
  });
  return 0;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("export", "Writes a recording for the field's tools");
  command->add_option("FILE", options->file, "recording (.h5, or the .h5.part of a run)")->required();
  command->add_option("--format", options->format, "csv, pedpy, xdmf, h5md3 or lammps")
      ->required()
      ->check(CLI::IsMember({"csv", "pedpy", "xdmf", "h5md3", "lammps"}));
  command->add_option("-o,--output", options->output, "file to write")->required();
  command->add_option("--from", options->from,
                      "time of the first frame (s); that of the recording without it");
  command->add_option("--to", options->to, "time of the last frame (s); likewise");
  command->add_option("--every", options->every, "exports each Nth recorded frame")
      ->transform(whole_number() & CLI::Range(std::int64_t{1}, std::int64_t{1} << 40));
  command->add_flag("--force", options->force, "overwrites the output where it exists");
  command->footer(
      "csv    a line a frame and body: step, time (s), id, and what was recorded of x, y (m), vx, vy (m/s),\n"
      "       angle (rad), spin (rad/s)\n"
      "pedpy  HDF5 for pedpy.load_trajectory_from_ped_data_archive_hdf5 and load_walkable_area_from_...: all "
      "bodies\n"
      "       but the static ones; the walkable area is the domain, without one a rectangle around\n"
      "       the walls and all that moves\n"
      "xdmf   XML through which ParaView reads the recording where it lies, by its path from the XML: points "
      "with\n"
      "       id, radius, vx, vy, angle, spin\n"
      "h5md3  HDF5 in three dimensions (z = 0) for MDAnalysis, lengths in m:\n"
      "       Universe.empty(bodies, trajectory=True).load_new(F, format=\"H5MD\", convert_units=False)\n"
      "lammps a text dump as LAMMPS writes it, for OVITO, in SI units: id, type (the shape), x, y, z = 0,\n"
      "       radius, mass, and what was recorded of vx, vy, the orientation and omegaz\n"
      "Example: throng export pile.h5 --format pedpy -o pile.ped.h5 --from 2 --to 8 --every 4");
  command->callback([options, &exit_code] { exit_code = export_recording(*options); });
}

}  // namespace throng::tools
