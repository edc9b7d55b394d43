// SPDX-License-Identifier: MIT
#include "tools/export.h"
#include "tools/text_file.h"

namespace throng::tools {

namespace {

void write_row(TextFile& out, const Frame& frame, std::size_t row) {
  out << frame.step << "," << frame.time << "," << std::int64_t{frame.id[row]};
  for (const std::vector<Vec>* vectors : {&frame.position, &frame.velocity})
    if (!vectors->empty()) out << "," << (*vectors)[row].x() << "," << (*vectors)[row].y();
  for (const std::vector<double>* scalars : {&frame.angle, &frame.spin})
    if (!scalars->empty()) out << "," << (*scalars)[row];
  out << "\n";
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
    for (std::size_t row = 0; row < frame.id.size(); ++row) write_row(out, frame, row);
  }
  out.close();
}

}  // namespace throng::tools
