// SPDX-License-Identifier: MIT
// Whatever time.dt = "auto" promises is kept, in scenes drawn at random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "sim/auto_time.h"
#include "tests/sim/trial.h"

namespace throng {
namespace {

/// Draws scenes; the same for a seed.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * (random_() * 0x1p-32); }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return all.begin()[random_() % all.size()];
  }

 private:
  std::mt19937 random_;
};

std::string asked(double error, double until) {
  std::ostringstream out;
  out.precision(17);
  out << "time = { dt = \"auto\", error = " << error << ", until = " << until << " }\n";
  return out.str();
}

std::string placed(const char* shape, const Vec& at, const Vec& velocity, double spin, double angle) {
  std::ostringstream out;
  out.precision(17);
  out << "[[bodies]]\nshape = \"" << shape << "\"\nat = [" << at.x() << ", " << at.y() << "]\nvelocity = ["
      << velocity.x() << ", " << velocity.y() << "]\nspin = " << spin << "\nangle = " << angle << "\n";
  return out.str();
}

Loaded promised(const std::string& text) {
  return load_scenario_text("throng = 1\n" + text, "drawn");
}

/// m, above the floor, of what bounces there with restitution `e`, `t` after it was thrown up at `v` from y.
double bounced(double y, double v, double e, double t) {
  for (;;) {
    const double lands = (v + std::sqrt(v * v + 2.0 * kG * y)) / kG;
    if (t <= lands) return y + v * t - 0.5 * kG * t * t;
    t -= lands, v = e * std::sqrt(v * v + 2.0 * kG * y), y = 0.0;
    if (v < 1e-8) return 0.0;
  }
}

// It happened: one of seven was off by more, up to 2.9 times, mostly soon after a bounce.
TEST(Promises, OfADiscThatBouncesAreKept) {
  Draw draw(2);
  for (int i = 0; i < 80; ++i) {
    const double e = draw.one_of({1.0, 1.0, 0.95, 0.9, 0.8, 0.7, 0.5, 0.3, 0.0});
    const double radius = draw.one_of({0.5, 0.1, 2.0}), error = draw.one_of({0.03, 0.01, 0.003});
    const double until = draw.between(0.3, 4), up = draw.one_of({0.0, 2.0, -2.0});
    const double high = up > 0.0 && i % 3 == 0 ? 0.0 : draw.between(0.05, 4);
    std::ostringstream shape;
    shape << "shapes.ball.disc.radius = " << radius << "\n";
    Trial run(asked(error, until) + "gravity = [0, -9.81]\n" + shape.str() + material(e, 0) +
              "[[walls]]\nsegment = [[-99, 0], [99, 0]]\n" +
              placed("ball", {0, radius + high}, {0.3, up}, 0, 0));
    run.steps(static_cast<int>(run.scene.time.steps()));
    const Vec exact(0.3 * until, radius + bounced(high, up, e, until));
    EXPECT_LE((run.state.position[0] - exact).norm() / radius, error)
        << "scene " << i << ": e " << e << ", r " << radius << ", from " << high << " at " << up << ", after "
        << until << " s";
  }
}

/// Some bodies on a floor or in a box, with or without gravity, most of them one.
std::string drawn(Draw& draw) {
  const int ground = draw.one_of({0, 0, 1, 2, 3});
  const double e = draw.one_of({0.0, 0.0, 0.0, 0.5, 0.8, 1.0}), friction = draw.one_of({0.0, 0.2, 0.5, 1.5});
  const char* gravity = draw.one_of({"[0, -9.81]", "[0, -9.81]", "[2, -9.6]", "[0, 0]"});
  std::ostringstream out;
  out << "gravity = " << gravity << "\n";
  if (ground == 1) out << "domain = { box = [[0, 0], [7, 4]] }\n";
  out << material(e, friction);
  out << "[shapes]\nball.disc.radius = 0.3\nbox.polygon = [[0, 0], [0.6, 0], [0.6, 0.6], [0, 0.6]]\n";
  if (ground != 1) out << "[[walls]]\nsegment = [[-30, 0], [30, 0]]\n";
  if (ground == 2) out << "[[walls]]\nsegment = [[-2, 0], [-2, 9]]\n";
  const int bodies = draw.one_of({1, 1, 1, 2, 3});
  for (int i = 0; i < bodies; ++i) {
    const bool is_disc = draw.one_of({true, true, false});
    const bool lies = draw.one_of({true, true, false}), still = draw.one_of({true, false});
    const Vec at(0.5 + 2.5 * i + draw.between(0, 1), lies ? 0.3 : 0.3 + draw.between(0.1, 2));
    const Vec velocity(still ? 0.0 : draw.between(-2, 2), lies ? 0.0 : draw.between(-1, 2));
    const double spin = is_disc && draw.one_of({true, false}) ? draw.between(-6, 6) : 0.0;
    out << placed(is_disc ? "ball" : "box", at, velocity, spin, is_disc || lies ? 0.0 : draw.between(0, 1.5));
  }
  return out.str();
}

std::vector<Vec> ends(const Scene& scene) {
  Trial run(scene);
  run.steps(static_cast<int>(scene.time.steps()));
  return run.state.position;
}

/// Steps sixteen times shorter are as good as exact.
TEST(Promises, OfExactWaysAreKept) {
  Draw draw(5);
  int kept = 0, refused = 0, other = 0;
  for (int i = 0; i < 240; ++i) {
    const double error = draw.one_of({0.01, 0.003}), until = draw.between(0.2, 1.2);
    const std::string text = asked(error, until) + drawn(draw);
    Loaded loaded = promised(text);
    if (loaded.errors() > 0) {
      ++refused;
      continue;
    }
    const std::string promise = auto_time(loaded.scene).promise;
    if (!promise.starts_with("how far off its exact way") || promise.find(';') != std::string::npos) {
      ++other;
      continue;
    }
    const std::vector<Vec> found = ends(loaded.scene);
    loaded.scene.time.substeps *= 16;
    const std::vector<Vec> exact = ends(loaded.scene);
    const double radius = std::ranges::min(loaded.scene.bodies.radius);
    for (std::size_t row = 0; row < found.size(); ++row)
      EXPECT_LE((found[row] - exact[row]).norm() / radius, error) << "body " << row + 1 << " of\n" << text;
    ++kept;
  }
  EXPECT_GT(kept, 70);
  EXPECT_GT(refused, 30);
  EXPECT_GT(other, 3);
}

TEST(Promises, OfSquaresThatJamArentMade) {
  const Loaded loaded = promised(
      "seed = 1\n" + asked(0.01, 5) + "gravity = [0, -9.81]\ndomain = { box = [[0, 0], [0.5, 40]] }\n" +
      "[shapes]\nbox.polygon = [[0, 0], [0.25, 0], [0.25, 0.2], [0, 0.2]]\n[[bodies]]\nshape = \"box\"\n"
      "count = 20\nplace.random.within = [[0, 0], [0.5, 40]]\n");
  EXPECT_NE(to_string(loaded.diagnostics, "a").find("may jam"), std::string::npos);
}

// It happened: of heaps the overlap was promised while they still fall, and was up to 5.5 times as much.
TEST(Promises, OfHeapsAreKeptOnceAllLie) {
  Draw draw(3);
  int lie = 0;
  for (int i = 0; i < 48; ++i) {
    const double error = draw.one_of({0.1, 0.01, 0.003});
    const int wide = draw.one_of({1, 2, 3, 4}), count = draw.one_of({20, 60});
    std::ostringstream out;
    out << "seed = " << i + 1 << "\n"
        << asked(error, 5) << "gravity = [0, -9.81]\ndomain = { box = [[0, 0], [" << wide << ", 12]] }\n"
        << material(0, draw.one_of({0.0, 0.1, 0.5}))
        << "[shapes]\nball.disc.radius = { uniform = [0.1, 0.15] }\n"
           "box.polygon = [[0, 0], [0.22, 0], [0.22, 0.2], [0, 0.2]]\n";
    const bool discs = wide == 1 || draw.one_of({true, false});
    for (const char* shape : {"ball", discs ? "ball" : "box"})
      out << "[[bodies]]\nshape = \"" << shape << "\"\ncount = " << count / 2
          << "\nplace.random.within = [[0, 0], [" << wide << ", 12]]\n";
    Trial run(out.str());
    EXPECT_NE(auto_time(run.scene).promise.find("once all lie"), std::string::npos);
    run.steps(static_cast<int>(run.scene.time.steps()));
    double fastest = 0.0;
    for (const Vec& velocity : run.state.velocity) fastest = std::max(fastest, velocity.norm());
    if (fastest > 0.02) continue;
    ++lie;
    EXPECT_LE(overlap(run.scene, run.state).mean / 0.1, error) << "scene " << i << ": " << out.str();
  }
  EXPECT_GT(lie, 24);
}

}  // namespace
}  // namespace throng
