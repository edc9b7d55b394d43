// SPDX-License-Identifier: MIT
#include "tools/replay_page.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "sim/input_error.h"
#include "tools/base64.h"
#include "tools/embeddable.h"
#include "tools/replace_file.h"
#include "tools/view.h"

namespace throng::tools {

namespace {

constexpr std::string_view kRecording = "@RECORDING@";
constexpr std::size_t kPiece = std::size_t{3} << 18;  // bytes; a multiple of 3, so that pieces of base64 join

void write_base64(std::ostream& out, const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::uint8_t> piece(kPiece);
  while (in) {
    in.read(reinterpret_cast<char*>(piece.data()), kPiece);
    out << base64(std::span(piece.data(), static_cast<std::size_t>(in.gcount())));
  }
  if (!in.eof()) throw InputError("cannot read " + file + ": " + std::strerror(errno));
}

/// Those of observables alone are checked, too.
void expect_undamaged(const std::string& file) {
  const Recording recording(file);
  Frame frame;
  for (std::size_t i = 0; i < recording.frames(); ++i) recording.read(i, frame);
}

std::string template_page() {
  std::string page;
  for (const char* const* piece = kReplayHtml; *piece; ++piece) page += *piece;
  if (page.empty())
    throw InputError(
        "this throng was built without its replay page: install nodejs and npm, run 'npm ci' in "
        "tools/viewer, "
        "and configure and build again");
  return page;
}

}  // namespace

bool write_replay_page(const Recording& recording, const std::string& file, const std::string& output) {
  const std::string page = template_page();
  expect_drawable(recording, file);
  const bool embedded = recording.bytes() <= kLargestEmbedded && !recording.running();
  if (embedded) expect_undamaged(file);
  const nlohmann::json given{{"name", std::filesystem::path(file).filename().string()},
                             {"embedded", embedded}};
  const std::size_t a = page.find(kGiven), b = page.find(kRecording);
  const std::string_view whole = page;
  replace_file(output, [&](const std::string& name) {
    std::ofstream out(name, std::ios::binary);
    out << whole.substr(0, a) << embeddable(given) << whole.substr(a + kGiven.size(), b - a - kGiven.size());
    if (embedded) write_base64(out, file);
    out << whole.substr(b + kRecording.size());
    out.close();
    if (!out) throw InputError("cannot write " + output + ": " + std::strerror(errno));
  });
  return embedded;
}

}  // namespace throng::tools
