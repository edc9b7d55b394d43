// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>

#include "sim/input_error.h"
#include "sim/recording/export.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/utf8.h"

namespace throng {

using namespace recording;

namespace {

using Frames = std::span<const std::size_t>;

/// A row of the table, in memory and in the file alike.
struct Row {
  std::int64_t id, frame;
  double x, y;  ///< m
};

/// The fewest digits that read back as the same number.
std::string text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

/// The floor of agents: PedPy's is one polygon, with holes.
std::string polygon_wkt(const Region& floor) {
  std::string wkt;
  for (const std::vector<Vec>& ring : floor.rings) {
    if (!wkt.empty() && !contains(Region{{floor.rings.front()}}, ring.front()))
      throw InputError("the walkable area is in pieces that don't hang together, which pedpy can't say");
    wkt += wkt.empty() ? "POLYGON (" : ", ";
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Vec& point = ring[i % ring.size()];
      wkt += (i == 0 ? "(" : ", ") + text(point.x()) + " " + text(point.y());
    }
    wkt += ")";
  }
  return wkt + ")";
}

/// The rectangle that bodies may be in, as far as can be told.
class Rectangle {
 public:
  explicit Rectangle(const Scene& scene) : bounded_(scene.domain.kind != DomainKind::unbounded) {
    if (bounded_) include(scene.domain.min), include(scene.domain.max);
    if (bounded_) return;
    for (const Wall& wall : scene.walls)
      for (const Vec& point : wall.points) include(point);
  }

  /// In a domain the body's centre alone: overlap with its border moves no border.
  void include(const Vec& centre, double radius) {
    const double reach = bounded_ ? 0.0 : radius;
    include(centre - Vec(reach, reach));
    include(centre + Vec(reach, reach));
  }

  std::string wkt() const {
    const std::string x0 = text(min_.x()), y0 = text(min_.y()), x1 = text(max_.x()), y1 = text(max_.y());
    return "POLYGON ((" + x0 + " " + y0 + ", " + x1 + " " + y0 + ", " + x1 + " " + y1 + ", " + x0 + " " + y1 +
           ", " + x0 + " " + y0 + "))";
  }

 private:
  void include(const Vec& point) {
    min_ = min_.cwiseMin(point);
    max_ = max_.cwiseMax(point);
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  bool bounded_;
  Vec min_{kInfinity, kInfinity}, max_{-kInfinity, -kInfinity};
};

/// A text of no fixed length: what h5py hands out as str, which PedPy needs.
void write_free_text(hid_t at, const char* name, const std::string& text) {
  const h5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "cannot make a text type");
  h5::check(H5Tset_size(type, H5T_VARIABLE), "cannot size a text");
  h5::check(H5Tset_cset(type, H5T_CSET_UTF8), "cannot make a text UTF-8");
  const h5::Handle scalar(H5Screate(H5S_SCALAR), H5Sclose, "cannot make a dataspace");
  h5::Handle attribute(H5Acreate2(at, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                       "cannot make an attribute");
  const std::string safe = as_utf8(text);
  const char* data = safe.c_str();
  h5::check(H5Awrite(attribute, type, &data), "cannot write an attribute");
  attribute.close("cannot write an attribute");
}

h5::Handle row_type() {
  h5::Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Row)), H5Tclose, "cannot make a type");
  h5::check(H5Tinsert(type, "id", offsetof(Row, id), h5::type<std::int64_t>()), "cannot make a type");
  h5::check(H5Tinsert(type, "frame", offsetof(Row, frame), h5::type<std::int64_t>()), "cannot make a type");
  h5::check(H5Tinsert(type, "x", offsetof(Row, x), h5::type<double>()), "cannot make a type");
  h5::check(H5Tinsert(type, "y", offsetof(Row, y), h5::type<double>()), "cannot make a type");
  return type;
}

/// Frames a second. PedPy has one number for all of them.
double frame_rate(const Recording& recording, Frames frames) {
  const auto steps = recording.steps();
  const std::int64_t apart = frames.size() > 1 ? steps[frames[1]] - steps[frames[0]]
                                               : every(recording.geometry().record, RecordField::position);
  for (std::size_t k = 1; k < frames.size(); ++k)
    if (steps[frames[k]] - steps[frames[k - 1]] != apart)
      throw InputError("the frames are not evenly spaced in time, which pedpy can't do without");
  return 1.0 / (static_cast<double>(apart) * recording.geometry().time.dt);
}

/// The rows of `scene.bodies` that count as people: agents alone where there are any.
std::vector<std::size_t> who_moves(const Scene& scene) {
  const std::vector<BodyKind>& kinds = scene.bodies.kind;
  const bool has_agents = std::ranges::find(kinds, BodyKind::agent) != kinds.end();
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < kinds.size(); ++row)
    if (has_agents ? kinds[row] == BodyKind::agent : kinds[row] != BodyKind::fixed) rows.push_back(row);
  if (rows.empty()) throw InputError("all bodies are static: there is no trajectory for pedpy");
  return rows;
}

/// The file under construction. What a write left behind when it failed must not be closed: h5.h.
class Table {
 public:
  Table(const std::string& output, std::size_t rows, double rate)
      : type_(row_type()), file_(h5::create_file(output)) {
    try {
      set_ = h5::create_fixed(file_, "trajectory", type_, {rows});
      h5::write_attribute(set_, "fps", rate);
    } catch (...) {
      abandon();
      throw;
    }
  }
  ~Table() { abandon(); }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  void append(const std::vector<Row>& rows) {
    h5::write_rows(set_, written_, rows.size(), type_, rows.data());
    written_ += rows.size();
  }

  void close(const Recording& recording, const std::string& area) {
    write_free_text(file_, "wkt_geometry", area);
    write_free_text(file_, "run_name", recording.geometry().name);
    write_free_text(file_, "source", "throng " + recording.origin().version);
    set_.close("cannot close it");
    file_.close("cannot close it");
  }

 private:
  void abandon() {
    set_.abandon();
    file_.abandon();
  }

  h5::Handle type_, file_, set_;
  hsize_t written_ = 0;
};

/// Frames may hold some bodies only: how many rows there are shows when all are read.
std::size_t count_rows(const Recording& recording, Frames frames, std::span<const std::size_t> moving) {
  if (!bodies_come_and_go(recording.geometry())) return frames.size() * moving.size();
  std::size_t rows = 0;
  Frame frame;
  for (std::size_t i : frames) {
    recording.read(i, frame);
    for (std::size_t row : moving) rows += frame.has(row);
  }
  return rows;
}

void write_table(const Recording& recording, Frames frames, const std::string& output) {
  const Scene& scene = recording.geometry();
  const std::vector<std::size_t> moving = who_moves(scene);
  Table table(output, count_rows(recording, frames, moving), frame_rate(recording, frames));
  Rectangle area(scene);
  Frame frame;
  std::vector<Row> rows;
  for (std::size_t number = 0; number < frames.size(); ++number) {
    recording.read(frames[number], frame);
    rows.clear();
    for (std::size_t row : moving) {
      if (!frame.has(row)) continue;
      const Vec& at = frame.position[row];
      area.include(at, scene.bodies.radius[row]);
      rows.push_back({frame.id[row], static_cast<std::int64_t>(number), at.x(), at.y()});
    }
    if (!rows.empty()) table.append(rows);
  }
  table.close(recording, scene.crowd.walkable.empty() ? area.wkt() : polygon_wkt(scene.crowd.walkable));
}

}  // namespace

void export_pedpy(const Recording& recording, Frames frames, const ExportTarget& target) {
  try {
    write_table(recording, frames, target.path);
  } catch (const h5::Error& error) {
    throw InputError("cannot write " + target.name + ": " + error.what());
  }
}

}  // namespace throng
