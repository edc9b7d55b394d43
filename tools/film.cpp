// SPDX-License-Identifier: MIT
#include "tools/film.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include "sim/input_error.h"
#include "tools/encoder.h"
#include "tools/picture.h"
#include "tools/progress.h"
#include "tools/replace_file.h"

namespace throng::tools {

namespace {

constexpr double kMostPictures = 1e6;  // 11 hours at 25 a second: more is a mistake in --speed

/// How many after the first one, so that the last shows the end. Refuses what nobody waits for.
double intervals(const Recording& recording, const FilmOptions& options) {
  const double seconds = recording.times().back() - recording.times().front();
  const double count = std::ceil(seconds * options.rate / options.speed * (1 - 1e-9));
  if (count <= kMostPictures) return count;
  char text[160];
  std::snprintf(text, sizeof text, "a film of %.4g s at --speed %g has %.4g pictures; at most 1e6 are drawn",
                seconds, options.speed, count);
  throw InputError(text);
}

void write_pictures(const Recording& recording, Picture& picture, const FilmOptions& options,
                    Encoder& encoder) {
  const auto times = recording.times();
  const double seconds = options.speed / options.rate, first = times.front();  // s of the recording a picture
  const double last = intervals(recording, options);
  Frame frame;
  std::optional<std::size_t> drawn;
  Progress progress(Progress::style("auto"), std::llround(last) + 1, seconds, 0, "picture");
  for (double k = 0; k <= last; ++k) {
    progress.update(std::llround(k));
    const std::size_t i = k == last ? times.size() - 1 : recording.index_at(first + k * seconds);
    if (i != drawn) {
      recording.read(i, frame);
      recording.carry_angles(i, frame);
      picture.draw(frame);
    }
    drawn = i;
    encoder.write(picture.pixels());
  }
}

}  // namespace

void write_film(const Recording& recording, const std::string& output, const FilmOptions& options) {
  const std::string format = film_format(output);
  intervals(recording, options);  // before anything is written
  Picture picture(recording.geometry(), view_of(recording), options.width);
  replace_file(output, [&](const std::string& name) {
    Encoder encoder(name, {format, picture.width(), picture.height(), options.rate});
    write_pictures(recording, picture, options, encoder);
    encoder.finish();
  });
}

}  // namespace throng::tools
