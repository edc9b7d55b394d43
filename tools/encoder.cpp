// SPDX-License-Identifier: MIT
#include "tools/encoder.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <vector>

#include "sim/input_error.h"

extern char** environ;

namespace throng::tools {

namespace {

constexpr int kFilm = 3;  // the film's descriptor in ffmpeg, which thus makes no file of its own

std::vector<std::string> arguments(const FilmFormat& format) {
  std::vector<std::string> all{"ffmpeg",   "-hide_banner", "-loglevel", "error",
                               "-nostdin", "-y",           "-f",        "rawvideo"};
  const std::string size = std::to_string(format.width) + "x" + std::to_string(format.height);
  for (const std::string& one :
       {std::string("-pixel_format"), std::string("bgr0"), std::string("-video_size"), size,
        std::string("-framerate"), std::to_string(format.rate), std::string("-i"), std::string("pipe:0"),
        std::string("-pix_fmt"), std::string("yuv420p")})
    all.push_back(one);
  if (format.name == "mp4" || format.name == "mov") all.insert(all.end(), {"-movflags", "+faststart"});
  all.insert(all.end(), {"-f", format.name, "/dev/fd/" + std::to_string(kFilm)});
  return all;
}

/// Starts ffmpeg, reading from `input`, writing to `film`, and speaking to `said`. Returns an errno.
int spawn(pid_t& process, const FilmFormat& format, int input, int film, int said) {
  std::vector<std::string> texts = arguments(format);
  std::vector<char*> words;
  for (std::string& text : texts) words.push_back(text.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, film, kFilm);
  for (const int out : {STDOUT_FILENO, STDERR_FILENO}) posix_spawn_file_actions_adddup2(&actions, said, out);
  const int error = posix_spawnp(&process, "ffmpeg", &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

std::string film_format(const std::string& output) {
  const std::string ending = std::filesystem::path(output).extension();
  if (ending == ".mp4" || ending == ".mov" || ending == ".webm") return ending.substr(1);
  if (ending == ".mkv") return "matroska";
  throw InputError("cannot write " + output + ": a film's name ends in .mp4, .mov, .mkv or .webm");
}

Encoder::Encoder(const std::string& path, const FilmFormat& format) {
  const int film = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (film < 0) throw InputError("cannot write the film: " + std::string(std::strerror(errno)));
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    close(film);
    throw InputError("cannot start ffmpeg: " + std::string(std::strerror(errno)));
  }
  said_ = memfd_create("ffmpeg", MFD_CLOEXEC);
  const int error = said_ < 0 ? errno : spawn(process_, format, ends[0], film, said_);
  close(film);
  close(ends[0]);
  pipe_ = ends[1];
  before_ = std::signal(SIGPIPE, SIG_IGN);  // ffmpeg's end is an error like others
  if (error == 0) return;
  close(pipe_);
  close(said_);
  std::signal(SIGPIPE, before_);
  throw InputError(error == ENOENT
                       ? "films are made by ffmpeg, which is not installed (Debian: apt install ffmpeg)"
                       : "cannot start ffmpeg: " + std::string(std::strerror(error)));
}

Encoder::~Encoder() {
  if (process_ > 0) kill(process_, SIGKILL);
  if (process_ > 0) waitpid(process_, nullptr, 0);
  if (pipe_ >= 0) close(pipe_);
  close(said_);
  std::signal(SIGPIPE, before_);
}

void Encoder::write(std::span<const unsigned char> picture) {
  while (!picture.empty()) {
    const ssize_t written = ::write(pipe_, picture.data(), picture.size());
    if (written < 0 && errno != EINTR) break;
    if (written > 0) picture = picture.subspan(static_cast<std::size_t>(written));
  }
  if (picture.empty()) return;
  finish();
  throw InputError("ffmpeg ended before the film did");
}

void Encoder::pass_on() const {
  lseek(said_, 0, SEEK_SET);
  char text[4096];
  for (ssize_t count; (count = read(said_, text, sizeof text)) > 0;)
    std::fwrite(text, 1, static_cast<std::size_t>(count), stderr);
}

void Encoder::finish() {
  close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  pass_on();
  if (WIFSIGNALED(status)) throw InputError("ffmpeg was ended by signal " + std::to_string(WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0)
    throw InputError("ffmpeg failed with exit code " + std::to_string(WEXITSTATUS(status)));
}

}  // namespace throng::tools
