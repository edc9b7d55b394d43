// SPDX-License-Identifier: MIT
#include "tools/terminal.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include "sim/input_error.h"

namespace throng::tools {

namespace {

constexpr std::string_view kEnter = "\033[?1049h\033[?25l\033[2J", kLeave = "\033[0m\033[?25h\033[?1049l";

volatile std::sig_atomic_t cleared = 0;

/// False where the terminal takes no more.
bool write_all(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(STDOUT_FILENO, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool echoes = false;   // where the standard input is a terminal too
bool listens = false;  // and as long as something can be typed there
termios loud, silent;

void enter() {
  if (echoes) tcsetattr(STDIN_FILENO, TCSANOW, &silent);
  write_all(kEnter);
}

void leave() {
  write_all(kLeave);
  if (echoes) tcsetattr(STDIN_FILENO, TCSAFLUSH, &loud);  // what was typed blindly is not meant for the shell
}

/// Ctrl-Z: the terminal is the shell's for as long as it lasts.
void pause(int) {
  const int error = errno;
  leave();
  raise(SIGSTOP);
  enter();
  cleared = 1;
  errno = error;
}

/// A signal that ends the program does so with the terminal as it was.
void leave_and_end(int signal) {
  leave();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

Terminal::Terminal(const char* what) {
  const char* kind = std::getenv("TERM");
  if (!isatty(STDOUT_FILENO))
    throw InputError(std::string(what) + " shows a picture in a terminal, which the standard output is not");
  if (!kind || std::strcmp(kind, "dumb") == 0)
    throw InputError(std::string(what) + " shows a picture in a terminal, and this one can't (TERM is " +
                     (kind ? kind : "not set") + ")");
  echoes = tcgetattr(STDIN_FILENO, &loud) == 0;
  listens = echoes;
  silent = loud;
  silent.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
  struct sigaction action = {};
  action.sa_handler = pause;
  action.sa_flags = SA_RESTART;
  sigaction(SIGTSTP, nullptr, &before_);
  if (before_.sa_handler != SIG_IGN) sigaction(SIGTSTP, &action, nullptr);
  action.sa_handler = leave_and_end;
  for (std::size_t i = 0; i < kEnding.size(); ++i) {
    sigaction(kEnding[i], nullptr, &endings_[i]);
    if (endings_[i].sa_handler != SIG_IGN) sigaction(kEnding[i], &action, nullptr);
  }
  enter();
}

Terminal::~Terminal() {
  sigaction(SIGTSTP, &before_, nullptr);
  for (std::size_t i = 0; i < kEnding.size(); ++i) sigaction(kEnding[i], &endings_[i], nullptr);
  leave();
}

Terminal::Size Terminal::size() const {
  winsize size = {};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return {80, 24};
  return {size.ws_col, size.ws_row};
}

bool Terminal::was_cleared() {
  const bool was = cleared != 0;
  cleared = 0;
  return was;
}

std::string Terminal::typed(double seconds) {
  pollfd input{listens ? STDIN_FILENO : -1, POLLIN, 0};  // poll waits for nothing at a descriptor below 0
  const auto most = static_cast<int>(std::ceil(1e3 * std::max(0.0, seconds)));
  if (poll(&input, 1, most) <= 0 || (input.revents & POLLIN) == 0) {
    if ((input.revents & (POLLHUP | POLLERR)) != 0) listens = false;  // else the poll would wait no more
    return {};
  }
  char bytes[64];
  const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
  if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) listens = false;  // it was hung up
  return {bytes, static_cast<std::size_t>(std::max<ssize_t>(0, count))};
}

void Terminal::write(std::string_view text) const {
  if (!write_all(text))
    throw std::runtime_error(std::string("cannot write to the terminal: ") + std::strerror(errno));
}

}  // namespace throng::tools
