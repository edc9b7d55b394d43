// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "sim/input_error.h"
#include "sim/recording/utf8.h"
#include "tools/export.h"
#include "tools/printable.h"
#include "tools/text_file.h"

namespace throng::tools {

namespace {

namespace fs = std::filesystem;

std::string xml(const std::string& text) {
  std::string safe;
  for (char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return safe;
}

/// A path is bytes, of which XML can't say all.
void expect_text(const std::string& path) {
  const bool controls = std::ranges::any_of(path, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  if (controls || recording::as_utf8(path) != path)
    throw InputError("cannot point to " + printable(recording::as_utf8(path)) +
                     ": XML names no file whose path has control characters or is not UTF-8");
}

/// HDF5 itself, which is all that ParaView has, opens no file whose writer did not close it.
void expect_closed(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  char head[12] = {};
  in.read(head, sizeof head);
  if (head[11] != 0)
    throw InputError(
        file + " was not closed by its run, and ParaView would not open it: 'throng resume' ends the run, " +
        "'h5clear -s' closes a copy of what there is");
}

std::string path_to(const std::string& file, const std::string& place) {
  const fs::path recording = fs::canonical(file);
  std::error_code none;
  if (fs::exists(place, none) && !fs::is_regular_file(place, none)) return recording.string();
  return recording.lexically_relative(fs::weakly_canonical(fs::absolute(place)).parent_path()).string();
}

/// What of a recorded field an element shows: `columns` of its numbers a body, from `first` on.
struct Part {
  const char* field;
  int width;  ///< numbers that the field has a body: 1 or 2
  int first, columns;
  RecordField recorded;
};

/// Writes elements that point into the recording.
class Pointers {
 public:
  Pointers(TextFile& out, const Recording& recording, const std::string& path)
      : out_(out),
        recording_(recording),
        path_(xml(path)),
        rows_(std::to_string(recording.bodies())),
        bodies_(rows_),
        bytes_(recording.geometry().record.single ? "4" : "8") {}

  /// How many stand in front of the rows that are pointed to.
  void show(std::size_t bodies) { bodies_ = std::to_string(bodies); }

  void write_points(std::size_t frame) const {
    out_ << "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" << bodies_
         << "\" NodesPerElement=\"1\"/>\n"
         << "<Geometry GeometryType=\"XY\">";
    write_slab(frame, {"position", 2, 0, 2, RecordField::position});
    out_ << "</Geometry>\n";
  }

  /// A number a body that is the same in all frames.
  void write_constant(const char* name, const char* type, const char* path) const {
    begin_attribute(name);
    out_ << "<DataItem Format=\"HDF\" Dimensions=\"" << bodies_ << "\" NumberType=\"" << type
         << "\" Precision=\"8\">" << path_ << ":" << path << "</DataItem></Attribute>\n";
  }

  void write_scalar(const char* name, std::size_t frame, const Part& part) const {
    begin_attribute(name);
    write_slab(frame, part);
    out_ << "</Attribute>\n";
  }

  /// The ids of a frame, where bodies come and go.
  void write_ids(std::size_t frame) const {
    begin_attribute("id");
    write_id_slab(frame);
    out_ << "</Attribute>\n";
  }

  /// The radii of those in a frame, found by their ids. Expects all bodies of the run to be recorded.
  void write_radii_by_id(std::size_t frame) const {
    begin_attribute("radius");
    out_ << "<DataItem ItemType=\"Function\" Function=\"$0[$1 - 1]\" Dimensions=\"" << bodies_
         << "\"><DataItem Format=\"HDF\" Dimensions=\"" << rows_ << "\" NumberType=\"Float\" Precision=\"8\">"
         << path_ << ":/throng/bodies/radius</DataItem>";
    write_id_slab(frame);
    out_ << "</DataItem></Attribute>\n";
  }

  /// The same where some of the run's bodies are recorded, whose ids are no rows: as numbers.
  void write_radii(const Frame& frame) const {
    begin_attribute("radius");
    out_ << "<DataItem Format=\"XML\" Dimensions=\"" << bodies_ << "\" NumberType=\"Float\" Precision=\"8\">";
    for (std::size_t row = 0; row < frame.is_present.size(); ++row)
      if (frame.has(row)) out_ << " " << recording_.geometry().bodies.radius[row];
    out_ << "</DataItem></Attribute>\n";
  }

  /// A frame of nobody. A grid of no points is read as an error, and without one ParaView shows the frame
  /// before: a point at a place (m), of which no cell is made.
  void write_nobody(const Vec& place) const {
    out_ << "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"0\" NodesPerElement=\"1\"/>\n"
         << "<Geometry GeometryType=\"XY\"><DataItem Format=\"XML\" Dimensions=\"1 2\">" << place.x() << " "
         << place.y() << "</DataItem></Geometry>\n";
  }

 private:
  void begin_attribute(const char* name) const {
    out_ << "<Attribute Name=\"" << name << "\" AttributeType=\"Scalar\" Center=\"Node\">";
  }

  void write_id_slab(std::size_t frame) const {
    out_ << "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" << bodies_
         << "\"><DataItem Format=\"XML\" Dimensions=\"3 2\">"
         << std::to_string(recording_.id_sample(frame).value()) << " 0 1 1 1 " << bodies_
         << "</DataItem><DataItem Format=\"HDF\" Dimensions=\"" << std::to_string(recording_.id_samples())
         << " " << rows_ << "\" NumberType=\"UInt\" Precision=\"4\">" << path_
         << ":/particles/trajectory/id/value</DataItem></DataItem>";
  }

  /// A selection, start, stride and count of each dimension, and all of what it is taken from.
  void write_slab(std::size_t frame, const Part& part) const {
    const bool flat = part.width == 1;
    const std::size_t sample = recording_.sample(part.recorded, frame).value();
    const std::string columns = " " + std::to_string(part.columns);
    out_ << "<DataItem ItemType=\"HyperSlab\" Dimensions=\"" << bodies_ << (part.columns == 1 ? "" : columns)
         << "\"><DataItem Format=\"XML\" Dimensions=\"3 " << (flat ? "2" : "3") << "\">"
         << std::to_string(sample) << " 0" << (flat ? "" : " " + std::to_string(part.first))
         << (flat ? " 1 1" : " 1 1 1") << " 1 " << bodies_ << (flat ? "" : columns)
         << "</DataItem><DataItem Format=\"HDF\" Dimensions=\""
         << std::to_string(recording_.samples(part.recorded)) << " " << rows_ << (flat ? "" : " 2")
         << "\" NumberType=\"Float\" Precision=\"" << bytes_ << "\">" << path_ << ":/particles/trajectory/"
         << part.field << "/value</DataItem></DataItem>";
  }

  TextFile& out_;
  const Recording& recording_;
  std::string path_, rows_, bodies_, bytes_;  // rows_: of bodies that there may be
};

/// `present`: who is in the frame, where bodies come and go.
void write_attributes(const Pointers& to, const Recording& recording, std::size_t frame,
                      const Frame& present) {
  if (recording.id_sample(frame)) {
    to.write_ids(frame);
    recording.bodies() == recording.bodies_of_run() ? to.write_radii_by_id(frame) : to.write_radii(present);
  } else {
    to.write_constant("id", "Int", "/particles/trajectory/id");
    to.write_constant("radius", "Float", "/throng/bodies/radius");
  }
  const std::pair<const char*, Part> scalars[] = {{"vx", {"velocity", 2, 0, 1, RecordField::velocity}},
                                                  {"vy", {"velocity", 2, 1, 1, RecordField::velocity}},
                                                  {"angle", {"angle", 1, 0, 1, RecordField::angle}},
                                                  {"spin", {"spin", 1, 0, 1, RecordField::spin}}};
  for (const auto& [name, part] : scalars)
    if (recording.sample(part.recorded, frame)) to.write_scalar(name, frame, part);
}

/// A place where bodies may be, so that those who look at a frame of nobody look there.
Vec corner_of(const Scene& scene) {
  if (scene.record.within) return scene.record.within->min();
  if (scene.domain.kind != DomainKind::unbounded) return scene.domain.min;
  return scene.crowd.walkable.empty() ? Vec(0.0, 0.0) : scene.crowd.walkable.rings[0][0];
}

}  // namespace

void export_xdmf(const Recording& recording, const std::string& file, std::span<const std::size_t> frames,
                 const ExportTarget& target) {
  expect_closed(file);
  const std::string path = path_to(file, target.name);
  expect_text(path);
  TextFile out(target);
  Pointers to(out, recording, path);
  Frame present;
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"2.0\"><Domain>\n<Grid Name=\""
      << xml(recording.geometry().name) << "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const Vec corner = corner_of(recording.geometry());
  for (std::size_t i : frames) {
    recording.read(i, present);  // against its hash, once: ParaView reads it without
    const bool nobody = recording.id_sample(i) && present.bodies() == 0;
    if (recording.id_sample(i)) to.show(present.bodies());
    out << "<Grid Name=\"bodies\"><Time Value=\"" << recording.times()[i] << "\"/>\n";
    if (nobody) {
      to.write_nobody(corner);
    } else {
      to.write_points(i);
      write_attributes(to, recording, i, present);
    }
    out << "</Grid>\n";
  }
  out << "</Grid>\n</Domain></Xdmf>\n";
  out.close();
}

}  // namespace throng::tools
