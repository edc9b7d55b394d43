// SPDX-License-Identifier: MIT
#include "tools/export.h"
#include "tools/text_file.h"

namespace throng::tools {

namespace {

/// What of a field, if the recording has it, a line shows: nothing between the commas where the frame lacks
/// it.
void write_vector(TextFile& out, bool recorded, const std::vector<Vec>& vectors, std::size_t row) {
  if (!recorded) return;
  if (vectors.empty())
    out << ",,";
  else
    out << "," << vectors[row].x() << "," << vectors[row].y();
}

void write_scalar(TextFile& out, bool recorded, const std::vector<double>& scalars, std::size_t row) {
  if (!recorded) return;
  out << ",";
  if (!scalars.empty()) out << scalars[row];
}

void write_row(TextFile& out, const Record& record, const Frame& frame, std::size_t row) {
  out << frame.step << "," << frame.time << "," << std::int64_t{frame.id[row]};
  write_vector(out, record.position, frame.position, row);
  write_vector(out, record.velocity, frame.velocity, row);
  write_scalar(out, record.angle, frame.angle, row);
  write_scalar(out, record.spin, frame.spin, row);
  out << "\n";
}

bool has_fields(const Frame& frame) {
  return !frame.position.empty() || !frame.velocity.empty() || !frame.angle.empty() || !frame.spin.empty();
}

}  // namespace

void export_csv(const Recording& recording, std::span<const std::size_t> frames, const ExportTarget& target) {
  const Record& record = recording.geometry().record;
  TextFile out(target);
  out << "step,time,id" << (record.position ? ",x,y" : "") << (record.velocity ? ",vx,vy" : "")
      << (record.angle ? ",angle" : "") << (record.spin ? ",spin" : "") << "\n";
  Frame frame;
  for (std::size_t i : frames) {
    recording.read(i, frame);
    for (std::size_t row = 0; has_fields(frame) && row < frame.id.size(); ++row)
      if (frame.has(row)) write_row(out, record, frame, row);
  }
  out.close();
}

void export_arrivals_csv(const Arrivals& arrivals, double dt, const ExportTarget& target) {
  TextFile out(target);
  out << "id,step,time\n";
  for (std::size_t i = 0; i < arrivals.id.size(); ++i)
    out << std::int64_t{arrivals.id[i]} << "," << arrivals.step[i] << ","
        << static_cast<double>(arrivals.step[i]) * dt << "\n";
  out.close();
}

}  // namespace throng::tools
