// SPDX-License-Identifier: MIT
#include "tools/replace_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "sim/input_error.h"

namespace throng::tools {

namespace {

[[noreturn]] void refuse(const std::string& output, const char* why) {
  throw InputError("cannot write " + output + ": " + why);
}

char unfinished[PATH_MAX];  // the file's name, where the handler finds it

/// An empty file that nobody else has, with the rights of the one that it replaces, or else of any new file.
/// It goes with this, and with the program where a signal ends it; signals that are ignored stay so.
class Unfinished {
 public:
  Unfinished(const std::string& output, const std::string& target, const struct stat* replaced) {
    const std::string pattern = target + ".XXXXXX";
    if (pattern.size() >= sizeof unfinished) refuse(output, std::strerror(ENAMETOOLONG));
    pattern.copy(unfinished, pattern.size());
    unfinished[pattern.size()] = '\0';
    take_signals();
    const int fd = mkstemp(unfinished);
    const int error = errno;
    if (fd < 0) {
      leave_signals();
      refuse(output, std::strerror(error));
    }
    const mode_t masked = umask(0);
    umask(masked);
    fchmod(fd, replaced ? replaced->st_mode & 07777 : 0666 & ~masked);
    close(fd);
  }
  ~Unfinished() {
    unlink(unfinished);
    leave_signals();
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  const char* name() const { return unfinished; }

 private:
  void take_signals() {
    struct sigaction action = {};
    action.sa_handler = [](int) {
      unlink(unfinished);
      _exit(130);
    };
    for (std::size_t i = 0; i < kSignals.size(); ++i) {
      sigaction(kSignals[i], nullptr, &before_[i]);
      if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
    }
  }
  void leave_signals() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }

  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, kSignals.size()> before_;
};

}  // namespace

void replace_file(const std::string& output, const std::function<void(const std::string& name)>& write) {
  struct stat found;
  const bool exists = stat(output.c_str(), &found) == 0;
  if (exists && S_ISDIR(found.st_mode)) refuse(output, "it is a folder");
  if (exists && access(output.c_str(), W_OK) != 0) refuse(output, std::strerror(errno));
  if (exists && !S_ISREG(found.st_mode)) return write(output);
  const std::string target = exists ? std::filesystem::canonical(output).string() : output;
  const Unfinished file(output, target, exists ? &found : nullptr);
  write(file.name());
  if (std::rename(file.name(), target.c_str()) != 0) refuse(output, std::strerror(errno));
}

bool are_one_file(const std::string& a, const std::string& b) {
  namespace fs = std::filesystem;
  std::error_code neither;
  const auto place = [&](const std::string& name) {
    return fs::weakly_canonical(fs::absolute(name, neither), neither);
  };
  const fs::path first = place(a);  // empty where that can't be told
  return (!first.empty() && first == place(b)) || fs::equivalent(a, b, neither);
}

}  // namespace throng::tools
