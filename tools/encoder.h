// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <span>
#include <string>

namespace throng::tools {

/// The name of ffmpeg's format for films called like `output`. Throws InputError where it is none of .mp4,
/// .mov, .mkv and .webm.
std::string film_format(const std::string& output);

/// What a film is made of: pictures as Picture::pixels has them.
struct FilmFormat {
  std::string name;   ///< as film_format says
  int width, height;  ///< pixels, both even
  int rate;           ///< pictures a second
};

/// ffmpeg at work on a film. What it says comes to the standard error when it has ended, so that nobody hears
/// it complain of a film that a signal cut short. One at a time.
class Encoder {
 public:
  /// Starts it, to replace what is in the file at `path`. Throws InputError where there is no ffmpeg or no
  /// such file.
  Encoder(const std::string& path, const FilmFormat& format);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// Adds a picture. Throws InputError where ffmpeg has ended.
  void write(std::span<const unsigned char> picture);

  /// Completes the film. Throws InputError where ffmpeg fails.
  void finish();

 private:
  void pass_on() const;

  pid_t process_ = -1;
  int said_ = -1;  // a file in memory
  int pipe_ = -1;
  void (*before_)(int);  // what SIGPIPE did
};

}  // namespace throng::tools
