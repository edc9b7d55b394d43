// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace throng {

/// Runs the program as a user does, in a folder of the test's own that goes with it.
class Program : public ::testing::Test {
 protected:
  struct Result {
    int exit_code;  ///< -1 where a signal ended it
    std::string out, err;
  };

  Program() {
    std::string name = (std::filesystem::temp_directory_path() / "throng-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return folder_ / name; }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

  static std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// `before`: what the shell does first, such as a limit.
  Result throng(const std::string& arguments, const std::string& before = "") const {
    return run(before + THRONG_PROGRAM " " + arguments);
  }

  Result run(const std::string& command) const {
    const std::string out = path("stdout"), err = path("stderr");
    const int status = std::system((command + " >" + out + " 2>" + err).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace throng
