// SPDX-License-Identifier: MIT
#include "tools/terminal.h"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
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

bool echoes = false;  // where the standard input is the terminal too
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

}  // namespace

Terminal::Terminal(const char* what) {
  const char* kind = std::getenv("TERM");
  if (!isatty(STDOUT_FILENO))
    throw InputError(std::string(what) + " shows a picture in a terminal, which the standard output is not");
  if (!kind || std::strcmp(kind, "dumb") == 0)
    throw InputError(std::string(what) + " shows a picture in a terminal, and this one can't (TERM is " +
                     (kind ? kind : "not set") + ")");
  echoes = tcgetattr(STDIN_FILENO, &loud) == 0;
  silent = loud;
  silent.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
  struct sigaction action = {};
  action.sa_handler = pause;
  action.sa_flags = SA_RESTART;
  sigaction(SIGTSTP, nullptr, &before_);
  if (before_.sa_handler != SIG_IGN) sigaction(SIGTSTP, &action, nullptr);
  enter();
}

Terminal::~Terminal() {
  sigaction(SIGTSTP, &before_, nullptr);
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

void Terminal::write(std::string_view text) const {
  if (!write_all(text))
    throw std::runtime_error(std::string("cannot write to the terminal: ") + std::strerror(errno));
}

}  // namespace throng::tools
