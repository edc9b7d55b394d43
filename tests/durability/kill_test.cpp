// SPDX-License-Identifier: MIT
// H1 and H5: runs killed or stopped at random instants, resumed, killed again, until they reach their end.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <random>

#include "tests/durability/durable_run.h"

namespace throng {
namespace {

constexpr unsigned kSeed = 20261121;

class Kills : public DurableRun, public ::testing::WithParamInterface<Recorded> {
 protected:
  /// Starts the program, sends `signal` after so long, and waits. Returns the status that wait gives.
  static int run_and_signal(std::vector<std::string> arguments, int signal, std::chrono::microseconds after) {
    arguments.insert(arguments.begin(), THRONG_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      const int null = open("/dev/null", O_WRONLY);
      dup2(null, STDOUT_FILENO), dup2(null, STDERR_FILENO);
      execv(argv[0], argv.data());
      _exit(127);
    }
    usleep(static_cast<useconds_t>(after.count()));
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  /// The frames of the uninterrupted run, and the span of time in which signals come: some are too late for
  /// it.
  void run_whole(const std::string& scene) {
    const auto begin = std::chrono::steady_clock::now();
    whole = reference(scene, "");
    span =
        std::chrono::duration_cast<std::chrono::microseconds>(2 * (std::chrono::steady_clock::now() - begin));
  }

  std::mt19937 random{kSeed};
  std::chrono::microseconds span{};
  std::vector<std::uint64_t> whole;
  int resumed_kills = 0;

  /// One recording from its first run to its end, with a signal in each life. Returns the number of deaths.
  int one_life_after_the_other(const std::string& scene, const std::string& file, int signal, int most) {
    const std::vector<std::string> rest{"--progress", "none", "--checkpoint", "0.002"};
    std::size_t frames = 0;
    int deaths = 0;
    while (deaths < most && !HasFailure()) {
      std::vector<std::string> arguments = frames == 0
                                               ? std::vector<std::string>{"run", scene, "--force", "-o", file}
                                               : std::vector<std::string>{"resume", file};
      arguments.insert(arguments.end(), rest.begin(), rest.end());
      arguments.insert(arguments.end(), {"--threads", std::to_string(1 + random() % 2)});
      const std::chrono::microseconds after(random() % span.count());
      const int status = run_and_signal(arguments, signal, after);
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        expect_whole(whole, file);
        break;
      }
      EXPECT_TRUE(signal == SIGKILL ? WIFSIGNALED(status) : died_in_order(status)) << "status " << status;
      ++deaths;
      resumed_kills += frames > 0;
      frames = expect_sound(whole, file, frames);
    }
    for (const char* end : {"", ".part", ".part.new"}) std::filesystem::remove(file + end);
    return deaths;
  }

  /// 130, or the signal itself where it came before the program was ready for it.
  static bool died_in_order(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) == 130 : WTERMSIG(status) == SIGTERM;
  }

  /// Each kind of recording has its part of the deaths.
  static int part_of(int deaths) {
    const int parts = static_cast<int>(std::size(kRecorded)) + 1;
    return (deaths + parts - 1) / parts;
  }

  /// Lives until `wanted` deaths, and until a quarter as many came after a resume: how soon one is ready to
  /// die is the machine's.
  void live_and_die(int signal, int wanted) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    const std::string scene = write("a.toml", heap(GetParam()));
    run_whole(scene);
    int deaths = 0;
    for (int life = 0; !HasFailure() && (deaths < wanted || resumed_kills <= wanted / 4); ++life) {
      ASSERT_LT(deaths, 4 * wanted + 40) << "too few of them after a resume: " << resumed_kills;
      deaths += one_life_after_the_other(scene, path("a" + std::to_string(life) + ".h5"), signal, wanted);
    }
  }
};

TEST_P(Kills, H1NoFrameIsLostNoneIsWrongAndResumeReachesTheSameEnd) {
  live_and_die(SIGKILL, part_of(cases(1000, 100)));
}

TEST_P(Kills, H5AStoppedRunGoesOnToTheSameEnd) {
  live_and_die(SIGTERM, part_of(cases(200, 20)));
}

constexpr auto kNameOf = [](const auto& one) { return std::string(one.param.name); };
INSTANTIATE_TEST_SUITE_P(Any, Kills, ::testing::ValuesIn(kRecorded), kNameOf);
INSTANTIATE_TEST_SUITE_P(Of, Kills, ::testing::Values(kRecordedCrowd), kNameOf);

}  // namespace
}  // namespace throng
