// SPDX-License-Identifier: MIT
#include "sim/recording/file_head.h"

#include <cstdlib>

#include "sim/recording/build_info.h"
#include "sim/recording/frame_hash.h"
#include "sim/recording/h5_write.h"
#include "sim/recording/utf8.h"

namespace throng::recording {

void write_h5md(hid_t file) {
  const h5::Handle group = h5::create_group(file, "h5md");
  constexpr std::int32_t version[] = {1, 1};
  h5::write_attribute(group, "version", std::span<const std::int32_t>(version));
  const h5::Handle author = h5::create_group(group, "author");
  const char* user = std::getenv("USER");
  h5::write_attribute(author, "name", std::string_view(as_utf8(user ? user : "unknown")));
  const h5::Handle creator = h5::create_group(group, "creator");
  h5::write_attribute(creator, "name", std::string_view("throng"));
  h5::write_attribute(creator, "version", std::string_view(version_text()));
}

void write_parameters(hid_t file, const Scene& scene, const Provenance& provenance) {
  const h5::Handle group = h5::create_group(file, "parameters");
  const std::string command_line = as_utf8(provenance.command_line);
  h5::write_attribute(group, "dt", scene.time.dt);
  h5::write_attribute(group, "until", scene.time.until);
  h5::write_attribute(group, "substeps", std::int64_t{scene.time.substeps});
  h5::write_attribute(group, "every", std::int64_t{scene.record.every});
  h5::write_attribute(group, "bodies", static_cast<std::int64_t>(scene.bodies.size()));
  h5::write_attribute(group, "seed", scene.seed);
  h5::write_attribute(group, "threads", std::int64_t{provenance.threads});
  h5::write_attribute(group, "checkpoint", provenance.checkpoint);
  h5::write_attribute(group, "engine", std::string_view(engine_name(scene.engine)));
  h5::write_attribute(group, "precision", std::string_view(scene.record.single ? "single" : "double"));
  h5::write_attribute(group, "version", std::string_view(version_text()));
  h5::write_attribute(group, "compiler", std::string_view(compiler_text()));
  h5::write_attribute(group, "flags", std::string_view(flags_text()));
  h5::write_attribute(group, "scenario_hash", text_hash(provenance.scenario));
  h5::write_attribute(group, "resolved_hash", text_hash(provenance.resolved));
  h5::write_attribute(group, "command_line_hash", text_hash(command_line));
  h5::write_text(group, "scenario", provenance.scenario);
  h5::write_text(group, "resolved", provenance.resolved);
  h5::write_text(group, "command_line", command_line);
}

void write_box(hid_t group, const Domain& domain) {
  const h5::Handle box = h5::create_group(group, "box");
  const std::string boundary = domain.kind == DomainKind::periodic ? "periodic" : "none";
  h5::write_attribute(box, "dimension", std::int64_t{2});
  h5::write_attribute(box, "boundary", std::vector<std::string>{boundary, boundary});
  const Vec edges = domain.max - domain.min;
  if (domain.kind != DomainKind::unbounded)
    h5::write_array(box, "edges", std::span<const double>(edges.data(), 2));
}

}  // namespace throng::recording
