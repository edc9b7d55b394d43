// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <string>

namespace throng::broadphase {
namespace {

std::string read(const std::string& file) {
  std::ifstream in(THRONG_SOURCE_DIR "/" + file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The example of README.md is a program that the test "outside" builds and runs.
TEST(Readme, ShowsTheProgramOfTheOutsideProject) {
  const std::string program = read("tests/outside/neighbours.cpp");
  EXPECT_GT(program.size(), 500u);
  EXPECT_THAT(read("README.md"), testing::HasSubstr("```cpp\n" + program + "```\n"));
}

}  // namespace
}  // namespace throng::broadphase
