// SPDX-License-Identifier: MIT
#include "tools/replace_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
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

/// An empty file that nobody else has, with the rights of the one that it replaces, or else of any new file.
std::string new_file(const std::string& output, const std::string& target, const struct stat* replaced) {
  std::string name = target + ".XXXXXX";
  const int fd = mkstemp(name.data());
  if (fd < 0) refuse(output, std::strerror(errno));
  const mode_t masked = umask(0);
  umask(masked);
  fchmod(fd, replaced ? replaced->st_mode & 07777 : 0666 & ~masked);
  close(fd);
  return name;
}

}  // namespace

void replace_file(const std::string& output, const std::function<void(const std::string& name)>& write) {
  struct stat found;
  const bool exists = stat(output.c_str(), &found) == 0;
  if (exists && S_ISDIR(found.st_mode)) refuse(output, "it is a folder");
  if (exists && access(output.c_str(), W_OK) != 0) refuse(output, std::strerror(errno));
  if (exists && !S_ISREG(found.st_mode)) return write(output);
  const std::string target = exists ? std::filesystem::canonical(output).string() : output;
  const std::string name = new_file(output, target, exists ? &found : nullptr);
  try {
    write(name);
    if (std::rename(name.c_str(), target.c_str()) != 0) refuse(output, std::strerror(errno));
  } catch (...) {
    std::remove(name.c_str());
    throw;
  }
}

}  // namespace throng::tools
