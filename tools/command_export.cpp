// SPDX-License-Identifier: MIT
// throng export: a recording in the formats of the field's tools.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "sim/input_error.h"
#include "tools/commands.h"
#include "tools/export.h"
#include "tools/printable.h"
#include "tools/replace_file.h"
#include "tools/text_file.h"

namespace throng::tools {

namespace {

constexpr int kMostLinks = 40;  // as the system follows

struct ExportOptions {
  std::string file, format, output;
  std::optional<double> from, to;  // s
  std::int64_t every = 1;
  bool force = false;
};

/// As /dev/stdout and /proc/self/fd/1 do, whatever they stand for, and links to them.
bool names_open_file(std::filesystem::path output) {
  namespace fs = std::filesystem;
  std::error_code neither;
  for (int links = 0; links < kMostLinks; ++links) {
    const fs::path folder = fs::weakly_canonical(fs::absolute(output, neither).parent_path(), neither);
    if (folder == "/dev" || folder.string().starts_with("/proc/")) return true;
    if (!fs::is_symlink(output, neither)) return false;
    output = folder / fs::read_symlink(output, neither);
  }
  return false;
}

/// a.arrivals.csv beside a.csv; "" where nothing stands beside it, as of a pipe or a device, or in formats
/// that don't tell who arrived.
std::string arrivals_output(const ExportOptions& options) {
  std::error_code neither;
  const std::filesystem::path output = options.output;
  if (options.format != "csv" || options.output == kStandardOutput ||
      std::filesystem::is_other(output, neither) || names_open_file(output))
    return "";
  return (output.parent_path() / (output.stem().string() + ".arrivals" + output.extension().string()))
      .string();
}

void check_name(const std::string& output, const ExportOptions& options) {
  if (are_one_file(output, options.file))
    throw InputError("cannot write " + output + ": it is the recording");
  std::error_code neither;
  if (std::filesystem::is_directory(output, neither))
    throw InputError("cannot write " + output + ": it is a folder");
  if (!options.force && std::filesystem::is_regular_file(output, neither))
    throw InputError("cannot write " + output + ": it exists already; --force overwrites it");
}

void check_output(const ExportOptions& options) {
  const bool is_lines = options.format == "csv" || options.format == "lammps";
  if (options.output == kStandardOutput && !is_lines)
    throw InputError("-o - writes csv and lammps to the standard output; " + options.format +
                     " needs a file");
  if (options.output != kStandardOutput) check_name(options.output, options);
}

void check_contents(const ExportOptions& options, const Recording& recording) {
  if (recording.frames() == 0) throw InputError(options.file + " holds no frames to export");
  if (recording.bodies() == 0) throw InputError(options.file + " holds no bodies to export");
  const Record& record = recording.geometry().record;
  if (options.format != "csv" && !record.position)
    throw InputError(options.file + " holds no positions, which " + options.format + " can't do without");
  if (record.quantum > 0.0 && options.format == "xdmf")
    throw InputError(options.file +
                     " holds quantized positions, which ParaView can't read in place; csv, pedpy, "
                     "h5md3 and lammps unpack them");
}

std::string seconds_text(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", time);
  return text;
}

/// " from 1 s to 2 s", as far as that was asked for.
std::string span_text(const ExportOptions& options) {
  return (options.from ? " from " + seconds_text(*options.from) : "") +
         (options.to ? " to " + seconds_text(*options.to) : "");
}

/// Whether a frame has lines of csv; other formats know frames with positions alone.
bool has_lines(const Recording& recording, std::size_t frame) {
  return std::ranges::any_of(kRecordFields, [&](RecordField field) {
    return field != RecordField::contacts && recording.sample(field, frame);
  });
}

/// Those of --from to --to; nothing where the format or the recording has none.
std::optional<Arrivals> select_arrivals(const ExportOptions& options, const Recording& recording) {
  std::optional<Arrivals> all;
  if (options.format == "csv") all = recording.arrivals();
  if (!all) return std::nullopt;
  const double inf = std::numeric_limits<double>::infinity(), slack = 1e-9 * recording.times().back();
  Arrivals some;
  for (std::size_t i = 0; i < all->id.size(); ++i) {
    const double time = static_cast<double>(all->step[i]) * recording.geometry().time.dt;
    if (time < options.from.value_or(0.0) - slack || time > options.to.value_or(inf) + slack) continue;
    some.step.push_back(all->step[i]), some.id.push_back(all->id[i]);
  }
  return some;
}

/// Each --every-th of the frames that the format shows, from the first that is not before --from, up to
/// rounding.
std::vector<std::size_t> select(const ExportOptions& options, const Recording& recording) {
  const auto times = recording.times();
  const bool csv = options.format == "csv";
  const double slack = 1e-9 * times.back();
  const double from = options.from.value_or(times.front()), to = options.to.value_or(times.back());
  if (options.from && options.to && from > to)
    throw InputError("--from " + seconds_text(from) + " is after --to " + seconds_text(to));
  std::vector<std::size_t> frames;
  std::int64_t skip = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < from - slack || times[i] > to + slack || (csv && !has_lines(recording, i))) continue;
    if (skip-- > 0) continue;
    frames.push_back(i);
    skip = options.every - 1;
  }
  if (!frames.empty()) return frames;
  throw InputError(options.file + " has no frame" + (csv ? " of bodies" : "") + span_text(options) +
                   ": its frames go from " + seconds_text(times.front()) + " to " +
                   seconds_text(times.back()));
}

void warn_of_velocities(const ExportOptions& options, const Recording& recording,
                        std::span<const std::size_t> frames) {
  const Record& record = recording.geometry().record;
  if (options.format != "h5md3" || !record.velocity || have_velocities(recording, frames)) return;
  std::fprintf(
      stderr,
      "throng: warning: %s leaves out velocities, which MDAnalysis wants in every frame: %s has them "
      "each %d steps, positions each %d\n",
      printable(options.output).c_str(), printable(options.file).c_str(),
      every(record, RecordField::velocity), every(record, RecordField::position));
}

/// For people.
std::string output_name(const ExportOptions& options) {
  return options.output == kStandardOutput ? "the standard output" : options.output;
}

/// No format has a place for what is not of a body.
void warn_of_other_things(const ExportOptions& options, const Recording& recording, bool without_arrivals) {
  const Record& record = recording.geometry().record;
  std::string left_out;
  const auto add = [&](bool is_there, const char* what) {
    if (is_there) left_out += (left_out.empty() ? "" : ", ") + std::string(what);
  };
  add(record.contacts, "contacts");
  add(record.observables > 0, "observables");
  add(!record.sensors.empty(), "what sensors found");
  add(without_arrivals, "who arrived");
  if (!left_out.empty())
    std::fprintf(stderr, "throng: warning: %s leaves out %s, which throng_read.py reads\n",
                 printable(output_name(options)).c_str(), left_out.c_str());
}

void write_format(const Recording& recording, const ExportOptions& options,
                  std::span<const std::size_t> frames, const ExportTarget& target) {
  if (options.format == "csv") export_csv(recording, frames, target);
  if (options.format == "pedpy") export_pedpy(recording, frames, target);
  if (options.format == "xdmf") export_xdmf(recording, options.file, frames, target);
  if (options.format == "h5md3") export_h5md3(recording, frames, target);
  if (options.format == "lammps") export_lammps(recording, frames, target);
}

/// Those of another recording would be taken for this one's.
void remove_arrivals(const std::string& beside, const ExportOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(beside, error) || are_one_file(beside, options.file)) return;
  if (!std::filesystem::remove(beside, error) && error)
    throw InputError("cannot remove " + beside + ": " + error.message());
}

/// `beside` is the name of their file.
void write_arrivals(const Arrivals& arrivals, const Recording& recording, const std::string& beside) {
  replace_file(beside, [&](const std::string& path) {
    export_arrivals_csv(arrivals, recording.geometry().time.dt, {path, beside});
  });
}

int export_recording(const ExportOptions& options) {
  check_output(options);
  const Recording recording(options.file,
                            options.format == "csv" ? FrameChoice::all : FrameChoice::with_position);
  say_where_incomplete(recording, options.file);
  check_contents(options, recording);
  const std::vector<std::size_t> frames = select(options, recording);
  warn_of_velocities(options, recording, frames);
  const std::optional<Arrivals> arrivals = select_arrivals(options, recording);
  const std::string beside = arrivals_output(options);
  if (arrivals && !beside.empty()) check_name(beside, options);
  warn_of_other_things(options, recording, arrivals && beside.empty());
  const auto write = [&](const std::string& path) {
    write_format(recording, options, frames, {path, options.output});
  };
  if (options.output == kStandardOutput)
    write(options.output);
  else
    replace_file(options.output, write);
  if (beside.empty()) return 0;
  if (arrivals)
    write_arrivals(*arrivals, recording, beside);
  else if (options.force)
    remove_arrivals(beside, options);
  return 0;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand("export", "Writes a recording for the field's tools");
  command->add_option("FILE", options->file, "recording (.h5, or the .h5.part of a run)")->required();
  command->add_option("--format", options->format, "csv, pedpy, xdmf, h5md3 or lammps")
      ->required()
      ->check(CLI::IsMember({"csv", "pedpy", "xdmf", "h5md3", "lammps"}));
  command
      ->add_option("-o,--output", options->output, "file to write; - for the standard output (csv, lammps)")
      ->required();
  command->add_option("--from", options->from, "no frame before this time (s); from the first one without it")
      ->check(real_number());
  command->add_option("--to", options->to, "no frame after this time (s); up to the last one without it")
      ->check(real_number());
  command->add_option("--every", options->every, "exports each Nth of the frames that the format shows")
      ->transform(whole_number(1, std::int64_t{1} << 40));
  command->add_flag(
      "--force", options->force,
      "overwrites the output where it exists; F.arrivals.csv goes where the recording has none");
  command->footer(
      "csv    a line a frame and body: step, time (s), id, and what was recorded of x, y (m), vx, vy (m/s),\n"
      "       angle (rad), spin (rad/s); of a crowd also F.arrivals.csv beside F.csv, a line each who "
      "arrived:\n"
      "       id, step, time (s)\n"
      "pedpy  HDF5 for pedpy.load_trajectory_from_ped_data_archive_hdf5 and load_walkable_area_from_...: all "
      "agents,\n"
      "       where there are none all bodies but the static ones; the walkable area is that of the "
      "scenario,\n"
      "       else the domain, else a rectangle around the walls and all that moves\n"
      "xdmf   XML through which ParaView reads the recording where it lies, by its path from the XML: points "
      "with\n"
      "       id, radius, vx, vy, angle, spin; its frames are held against their hashes now, and not when\n"
      "       ParaView reads them\n"
      "h5md3  HDF5 in three dimensions (z = 0) for MDAnalysis, lengths in m:\n"
      "       Universe.empty(bodies, trajectory=True).load_new(F, format=\"H5MD\", convert_units=False)\n"
      "lammps a text dump as LAMMPS writes it, for OVITO, in SI units: id, type (the shape), x, y, z = 0,\n"
      "       radius, mass, and what was recorded of vx, vy, the orientation and omegaz\n"
      "Example: throng export pile.h5 --format pedpy -o pile.ped.h5 --from 2 --to 8 --every 4");
  command->callback([options, &exit_code] { exit_code = export_recording(*options); });
}

}  // namespace throng::tools
