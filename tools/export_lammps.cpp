// SPDX-License-Identifier: MIT
// The dump of LAMMPS in its text form: a header a frame, then a line a body.
#include <Eigen/Geometry>

#include "narrowphase/trigonometry.h"
#include "tools/export.h"
#include "tools/text_file.h"

namespace throng::tools {

namespace {

/// What encloses the bodies of a frame; where it has none, as where bodies left the region, one point.
Domain extent(const Scene& scene, const Frame& frame) {
  Eigen::AlignedBox<double, 2> box;
  for (std::size_t row = 0; row < frame.position.size(); ++row) {
    if (!frame.has(row)) continue;
    const Vec reach = Vec::Constant(scene.bodies.radius[row]);
    box.extend(frame.position[row] - reach).extend(frame.position[row] + reach);
  }
  if (box.isEmpty()) box.extend(Vec(0.0, 0.0));
  return {DomainKind::unbounded, box.min(), box.max()};
}

void write_head(TextFile& out, const Scene& scene, const Frame& frame) {
  constexpr const char* borders[] = {"ss ss pp", "ff ff pp", "pp pp pp"};  // a thin sheet, periodic in z
  const bool unbounded = scene.domain.kind == DomainKind::unbounded;
  const Domain domain = unbounded ? extent(scene, frame) : scene.domain;
  out << "ITEM: TIMESTEP\n" << frame.step << "\nITEM: NUMBER OF ATOMS\n";
  out << static_cast<std::int64_t>(frame.bodies()) << "\nITEM: BOX BOUNDS "
      << borders[static_cast<int>(domain.kind)] << "\n";
  for (int axis : {0, 1}) out << domain.min[axis] << " " << domain.max[axis] << "\n";
  out << "-0.5 0.5\nITEM: ATOMS id type x y z radius mass";
  if (!frame.velocity.empty()) out << " vx vy vz";
  if (!frame.angle.empty()) out << " quati quatj quatk quatw angle";
  if (!frame.spin.empty()) out << " omegax omegay omegaz";
  out << "\n";
}

void write_body(TextFile& out, const Scene& scene, const Frame& frame, std::size_t row, double mass) {
  const Vec& p = frame.position[row];
  out << std::int64_t{frame.id[row]} << " " << std::int64_t{scene.bodies.shape[row]} + 1 << " " << p.x()
      << " " << p.y() << " 0 " << scene.bodies.radius[row] << " " << mass;
  if (!frame.velocity.empty())
    out << " " << frame.velocity[row].x() << " " << frame.velocity[row].y() << " 0";
  if (!frame.angle.empty()) {
    const auto [sin, cos] = narrowphase::sin_cos(frame.angle[row] / 2.0);
    out << " 0 0 " << sin << " " << cos << " " << frame.angle[row];
  }
  if (!frame.spin.empty()) out << " 0 0 " << frame.spin[row];
  out << "\n";
}

}  // namespace

void export_lammps(const Recording& recording, std::span<const std::size_t> frames,
                   const ExportTarget& target) {
  const Scene& scene = recording.geometry();
  const std::vector<double> masses = recording.masses();
  TextFile out(target);
  Frame frame;
  for (std::size_t i : frames) {
    recording.read(i, frame);
    write_head(out, scene, frame);
    for (std::size_t row = 0; row < frame.id.size(); ++row)
      if (frame.has(row)) write_body(out, scene, frame, row, masses[row]);
  }
  out.close();
}

}  // namespace throng::tools
