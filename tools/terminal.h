// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <csignal>
#include <string>
#include <string_view>

namespace throng::tools {

/// The terminal on the standard output, as a place for moving pictures: on a screen of its own, without a
/// cursor and without echo. What was there comes back when this goes, when a signal ends the program that can
/// be caught, and while it is stopped by Ctrl-Z. One at a time.
class Terminal {
 public:
  /// Throws InputError, saying that `what` needs a terminal, where there is none that can do this.
  explicit Terminal(const char* what);
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  struct Size {
    int columns, rows;
    bool operator==(const Size&) const = default;
  };
  Size size() const;  ///< 80 by 24 where it doesn't tell

  /// Whether the terminal came back empty since this was last asked.
  bool was_cleared();

  /// What was typed since this was last asked; waits for it, a signal or the end of `seconds`. Nothing comes
  /// where the standard input is no terminal.
  std::string typed(double seconds);

  /// In one write where the terminal takes it. Throws std::runtime_error where it is gone.
  void write(std::string_view text) const;

 private:
  static constexpr std::array kEnding{SIGHUP, SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

  struct sigaction before_;  // what SIGTSTP did; where it is ignored, it stays so
  std::array<struct sigaction, kEnding.size()> endings_;
};

}  // namespace throng::tools
