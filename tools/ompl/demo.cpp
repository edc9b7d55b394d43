// SPDX-License-Identifier: MIT
// throng-ompl-demo: OMPL's planners with throng's exact check of motions and with OMPL's own at several
// resolutions; each path that comes out is checked exactly.
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

#include "tools/ompl/problems.h"

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using namespace throng::ompl;

constexpr double kExact = 0.0;  // in place of a resolution

struct Effort {
  int runs;
  double seconds;  ///< most that one run may take
};

ob::StateSpacePtr space_of(const Problem& problem) {
  const auto bounded = [&](unsigned dimensions) {
    ob::RealVectorBounds bounds(dimensions);
    bounds.setLow(problem.low), bounds.setHigh(problem.high);
    return bounds;
  };
  if (problem.in_se2) {
    const auto space = std::make_shared<ob::SE2StateSpace>();
    space->setBounds(bounded(2));
    return space;
  }
  const auto dimensions = static_cast<unsigned>(problem.start.size());
  const auto space = std::make_shared<ob::RealVectorStateSpace>(dimensions);
  space->setBounds(bounded(dimensions));
  return space;
}

ob::SpaceInformationPtr information(const Problem& problem, double resolution) {
  const auto space = std::make_shared<ob::SpaceInformation>(space_of(problem));
  space->setStateValidityChecker(std::make_shared<ExactStateValidity>(space, problem.scene()));
  if (resolution == kExact)
    space->setMotionValidator(std::make_shared<ExactMotionValidator>(space, problem.scene()));
  else
    space->setStateValidityCheckingResolution(resolution);
  space->setup();
  return space;
}

ob::ProblemDefinitionPtr definition(const Problem& problem, const ob::SpaceInformationPtr& space) {
  const auto result = std::make_shared<ob::ProblemDefinition>(space);
  ob::ScopedState<> start(space), goal(space);
  for (std::size_t i = 0; i < problem.start.size(); ++i)
    start[i] = problem.start[i], goal[i] = problem.goal[i];
  result->setStartAndGoalStates(start, goal);
  return result;
}

/// Whether any segment of the path collides, by proof.
bool collides(const Problem& problem, const ob::StateSpace& space, const og::PathGeometric& path) {
  throng::narrowphase::LinkageChecker checker(problem.scene());
  std::vector<double> from, to;
  for (std::size_t i = 0; i + 1 < path.getStateCount(); ++i) {
    from.clear(), to.clear();
    append_values(space, path.getState(static_cast<unsigned>(i)), from);
    append_end(space, path.getState(static_cast<unsigned>(i)), path.getState(static_cast<unsigned>(i + 1)),
               to);
    if (checker.check_motion(from, to).verdict == throng::narrowphase::Verdict::hit) return true;
  }
  return false;
}

struct Outcome {
  std::vector<double> ms;  ///< of the runs that came to an end
  int collide = 0;         ///< paths that do, by proof
  int unproven = 0;        ///< paths that do by dense samples, and by proof not
  double motions = 0.0;
};

/// Whether any of the states on the path is in contact, a ten thousandth of the space apart: what there is
/// to say about proofs by nothing that they are made of.
bool samples_collide(const ob::SpaceInformation& space, const og::PathGeometric& path) {
  constexpr double kStep = 1e-4;
  const ob::StateSpace& states = *space.getStateSpace();
  ob::State* between = space.allocState();
  bool collide = false;
  for (unsigned i = 0; i + 1 < path.getStateCount() && !collide; ++i) {
    const ob::State *from = path.getState(i), *to = path.getState(i + 1);
    const double steps = std::ceil(states.distance(from, to) / (kStep * states.getMaximumExtent())) + 1.0;
    for (double k = 0.0; k <= steps && !collide; ++k) {
      states.interpolate(from, to, k / steps, between);
      collide = !space.isValid(between);
    }
  }
  space.freeState(between);
  return collide;
}

using MakePlanner = std::function<ob::PlannerPtr(const ob::SpaceInformationPtr&)>;

Outcome plan(const Problem& problem, const MakePlanner& planner_of, double resolution, const Effort& effort) {
  Outcome outcome;
  for (int run = 0; run < effort.runs; ++run) {
    ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(run + 1));
    const ob::SpaceInformationPtr space = information(problem, resolution);
    const ob::ProblemDefinitionPtr goal = definition(problem, space);
    const ob::PlannerPtr planner = planner_of(space);
    planner->setProblemDefinition(goal);
    planner->setup();
    const auto begin = std::chrono::steady_clock::now();
    const bool solved = planner->solve(effort.seconds) == ob::PlannerStatus::EXACT_SOLUTION;
    const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - begin;
    outcome.motions += space->getMotionValidator()->getCheckedMotionCount();
    planner->clear();  // OMPL 1.5: a LazyPRM frees its states here and not as it dies; the path has its own
    if (!solved) continue;
    outcome.ms.push_back(spent.count());
    const auto* path = goal->getSolutionPath()->as<og::PathGeometric>();
    const bool proven = collides(problem, *space->getStateSpace(), *path);
    outcome.collide += proven;
    outcome.unproven += samples_collide(*space, *path) && !proven;
  }
  return outcome;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

void print_row(const Problem& problem, const char* planner, double resolution, const Effort& effort,
               const Outcome& outcome) {
  char check[32] = "exact";
  if (resolution != kExact) std::snprintf(check, sizeof check, "discrete %g", resolution);
  std::printf("%-18s %-12s %-15s %6zu/%-2d %12.4g %10.0f %10d\n", problem.name.c_str(), planner, check,
              outcome.ms.size(), effort.runs, median(outcome.ms), outcome.motions / effort.runs,
              outcome.collide);
}

/// What went wrong: paths that were taken as proven, or are free by proof, and collide; and planners that
/// find none with exact checks, so that there is nothing to see.
int compare(const Problem& problem, const Effort& effort) {
  const std::pair<const char*, MakePlanner> planners[] = {
      {"RRT-Connect", [](const auto& space) { return std::make_shared<og::RRTConnect>(space); }},
      {"lazy PRM", [](const auto& space) { return std::make_shared<og::LazyPRM>(space); }}};
  int faults = 0;
  for (const auto& [name, planner_of] : planners)
    for (const double resolution : {kExact, 0.05, 0.01, 0.003, 0.001, 0.0001}) {
      const Outcome outcome = plan(problem, planner_of, resolution, effort);
      print_row(problem, name, resolution, effort, outcome);
      faults += outcome.unproven;
      if (resolution == kExact) faults += outcome.collide + outcome.ms.empty();
    }
  return faults;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto given = [&](const char* word) { return std::ranges::find(arguments, word) != arguments.end(); };
  for (const std::string& argument : arguments)
    if (argument != "--quick" && argument != "maze" && argument != "arm") {
      std::fprintf(stderr, "usage: throng-ompl-demo [--quick] [maze | arm]\n");
      return 2;
    }
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const Effort effort = given("--quick") ? Effort{1, 10.0} : Effort{15, 2.0};
  std::printf("%-18s %-12s %-15s %9s %12s %10s %10s\n", "problem", "planner", "motions checked", "solved",
              "ms, median", "motions", "collide");
  int faults = 0;
  Problem maze, arm;
  make_maze(maze), make_arm(arm);
  if (given("maze") || !given("arm")) faults += compare(maze, effort);
  if (given("arm") || !given("maze")) faults += compare(arm, effort);
  return faults == 0 ? 0 : 1;
}
