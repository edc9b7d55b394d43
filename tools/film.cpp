// SPDX-License-Identifier: MIT
#include "tools/film.h"

#include <cmath>
#include <optional>

#include "tools/encoder.h"
#include "tools/picture.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

void write_pictures(const Recording& recording, Picture& picture, const FilmOptions& options,
                    Encoder& encoder) {
  const auto times = recording.times();
  const double seconds = options.speed / options.rate, first = times.front();  // s of the recording a picture
  const double intervals = std::ceil((times.back() - first) / seconds * (1 - 1e-9));
  Frame frame;
  std::optional<std::size_t> drawn;
  for (double k = 0; k <= intervals; ++k) {
    const std::size_t i = k == intervals ? times.size() - 1 : recording.index_at(first + k * seconds);
    if (i != drawn) {
      recording.read(i, frame);
      picture.draw(frame);
    }
    drawn = i;
    encoder.write(picture.pixels());
  }
}

}  // namespace

void write_film(const Recording& recording, const std::string& output, const FilmOptions& options) {
  const std::string format = film_format(output);
  Picture picture(recording.geometry(), view_of(recording), options.width);
  replace_file(output, [&](const std::string& name) {
    Encoder encoder(name, {format, picture.width(), picture.height(), options.rate});
    write_pictures(recording, picture, options, encoder);
    encoder.finish();
  });
}

}  // namespace throng::tools
