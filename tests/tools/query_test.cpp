// SPDX-License-Identifier: MIT
// throng query, run as its users run it.
#include <gmock/gmock.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "broadphase/brute_force.h"
#include "narrowphase/crossing.h"
#include "sim/recording/recording.h"
#include "tests/tools/program.h"

namespace throng {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Query : public Program {
 protected:
  void expect_refused(const std::string& arguments, const std::string& why) const {
    const Result result = throng("query " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(why)) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }
};

// 1 and 2 are 5 apart, 2 and 3 are 1 apart, 4 is 10 from 1 in the plane, and 2 away round a period of 12.
constexpr const char* kBodies = R"(
[shapes]
ball = { disc = { radius = 0.1 } }
[[bodies]]
shape = "ball"
at = [0.5, 0.5]
velocity = [1, 0]
[[bodies]]
shape = "ball"
at = [3.5, 4.5]
[[bodies]]
shape = "ball"
at = [3.5, 5.5]
[[bodies]]
shape = "ball"
at = [10.5, 0.5]
)";
const std::string kHead = "throng = 1\nname = \"four\"\ntime = { dt = 0.25, until = 1.0, substeps = 4 }\n";
const std::string kPlane = kHead + kBodies;
const std::string kTorus = kHead + "domain = { periodic = [[0, 0], [12, 12]] }\n" + kBodies;

TEST_F(Query, AnswersForOneBody) {
  const Result result = throng("query " + write("s.toml", kPlane) + " --radius 6 --id 2");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "id,neighbour,distance\n2,3,1\n2,1,5\n");
}

TEST_F(Query, AnswersForAPlace) {
  const Result result = throng("query " + write("s.toml", kPlane) + " --radius 5 --point -2.5,0.5");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "id,neighbour,distance\n,1,3\n");
}

TEST_F(Query, AnswersForAllInOrderOfId) {
  const Result result = throng("query " + write("s.toml", kPlane) + " --radius 5 --all");
  EXPECT_EQ(result.out, "id,neighbour,distance\n1,2,5\n2,3,1\n2,1,5\n3,2,1\n");
}

TEST_F(Query, AnswersWithTheNearest) {
  const std::string scene = write("s.toml", kPlane);
  EXPECT_EQ(throng("query " + scene + " --nearest 1 --id 1").out, "id,neighbour,distance\n1,2,5\n");
  EXPECT_EQ(throng("query " + scene + " --radius inf --nearest 9 --id 4").out,
            throng("query " + scene + " --radius inf --id 4").out);
  EXPECT_EQ(throng("query " + scene + " --radius 1 --nearest 3 --id 4").out, "id,neighbour,distance\n");
}

TEST_F(Query, AnswersForAPlaceAsFarAwayAsItTakes) {
  EXPECT_EQ(throng("query " + write("s.toml", kPlane) + " --nearest 1 --point=-1e12,0").out,
            "id,neighbour,distance\n,1,1000000000000.5\n");
}

TEST_F(Query, TakesTheNearestImage) {
  const std::string scene = write("s.toml", kTorus);
  EXPECT_EQ(throng("query " + scene + " --radius 3 --id 4").out, "id,neighbour,distance\n4,1,2\n");
  EXPECT_EQ(throng("query " + scene + " --radius 3 --point 11.5,12.5").out,
            "id,neighbour,distance\n,1,1\n,4,1\n");
}

TEST_F(Query, AnswersInJson) {
  const std::string scene = write("s.toml", kPlane);
  EXPECT_EQ(json::parse(throng("query " + scene + " --radius 5 --all --format json").out), json::parse(R"([
    {"id": 1, "neighbours": [{"id": 2, "distance": 5.0}]},
    {"id": 2, "neighbours": [{"id": 3, "distance": 1.0}, {"id": 1, "distance": 5.0}]},
    {"id": 3, "neighbours": [{"id": 2, "distance": 1.0}]},
    {"id": 4, "neighbours": []}])"));
  EXPECT_EQ(json::parse(throng("query " + scene + " --radius 0 --point 0.5,0.5 --format json").out),
            json::parse(R"([{"id": null, "neighbours": [{"id": 1, "distance": 0.0}]}])"));
}

TEST_F(Query, SeesWhatIsInView) {
  const std::string scene = write("s.toml", kPlane);
  const std::string none = "id,neighbour,distance\n";
  // Body 1 heads for body 4, and body 2 is 53.1 degrees to its left.
  const std::string ask = "query " + scene + " --radius 10 --id 1 --fov ";
  EXPECT_EQ(throng(ask + "106").out, none + "1,4,10\n");
  EXPECT_EQ(throng(ask + "107").out, none + "1,2,5\n1,4,10\n");
  EXPECT_EQ(throng(ask + "107 --nearest 1").out, none + "1,2,5\n");
  EXPECT_EQ(throng(ask + "90 --heading 90").out, throng(ask + "90 --heading=-270").out);
  EXPECT_EQ(throng(ask + "90 --heading 90").out, none + "1,2,5\n1,3,5.830951894845301\n");
  EXPECT_EQ(throng(ask + "90 --heading angle").out, none + "1,4,10\n");
  EXPECT_EQ(throng(ask + "180 --heading 180").out, none);
  EXPECT_EQ(throng(ask + "360").out, throng("query " + scene + " --radius 10 --id 1").out);
  // Who rests sees all around.
  EXPECT_EQ(throng("query " + scene + " --radius 1 --all --fov 10").out, none + "2,3,1\n3,2,1\n");
  // The border of a quarter turn is a diagonal, and belongs to it: body 1 from 1 to its right and 1 below.
  const std::string point = "query " + scene + " --radius 2 --point -0.5,1.5 --fov 90 --heading ";
  EXPECT_EQ(throng(point + "0").out, none + ",1,1.4142135623730951\n");
  EXPECT_EQ(throng(point + "-90").out, none + ",1,1.4142135623730951\n");
  EXPECT_EQ(throng(point + "1").out, none);
  EXPECT_EQ(throng("query " + scene + " --radius 2 --point -0.5,1.5 --fov 360").out,
            none + ",1,1.4142135623730951\n");
}

TEST_F(Query, SeesNobodyBehindAWall) {
  const std::string walls = "[[walls]]\nsegment = [[2, -1], [2, 3]]\n[[walls]]\nsegment = [[2, 3], [2, 9]]\n";
  const std::string none = "id,neighbour,distance\n";
  const std::string scene = write("s.toml", kPlane + walls);
  EXPECT_EQ(throng("query " + scene + " --radius 12 --all --sight").out,
            none +
                "2,3,1\n2,4,8.06225774829855\n3,2,1\n3,4,8.602325267042627\n"
                "4,2,8.06225774829855\n4,3,8.602325267042627\n");
  EXPECT_EQ(throng("query " + scene + " --nearest 1 --id 4 --sight").out, none + "4,2,8.06225774829855\n");
  EXPECT_EQ(throng("query " + scene + " --nearest 1 --id 1 --sight").out, none);
  // From where the line to body 1 passes below the wall, and from where it touches its end.
  EXPECT_EQ(throng("query " + scene + " --nearest 9 --point 3.5,-2.6 --sight --radius 4.4").out,
            none + ",1,4.313930922024598\n");
  EXPECT_EQ(throng("query " + scene + " --nearest 1 --point 3.5,-2.5 --sight --radius 4.4").out, none);
  // Round the period body 4 is 2 to the left of body 1, and no wall is there.
  const std::string torus = write("t.toml", kTorus + walls);
  EXPECT_EQ(throng("query " + torus + " --radius 2 --id 1 --sight").out, none + "1,4,2\n");
  EXPECT_EQ(throng("query " + torus + " --radius 6 --id 1 --sight --fov 90 --heading 180").out,
            none + "1,4,2\n");
  const std::string seam = write("u.toml", kTorus + "[[walls]]\nsegment = [[11.5, 0], [11.5, 1]]\n");
  EXPECT_EQ(throng("query " + seam + " --radius 2 --id 1 --sight").out, none);
}

TEST_F(Query, NeedsTheHeadingToBeRecorded) {
  const std::string recording = path("bare.h5");
  const Result run =
      throng("run " + write("s.toml", kHead + "record = { fields = [\"position\"] }\n" + kBodies) + " -o " +
             recording);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  expect_refused(recording + " --radius 9 --id 1 --fov 90", "velocities were not recorded");
  expect_refused(recording + " --radius 9 --id 1 --fov 90 --heading angle", "angles were not recorded");
  EXPECT_EQ(throng("query " + recording + " --radius 9 --id 1 --fov 9 --heading 0").out,
            "id,neighbour,distance\n1,4,9\n");
}

TEST_F(Query, SaysWhenAFieldIsRecordedThatTheFrameLacks) {
  const std::string recording = path("rates.h5");
  const Result run = throng("run " +
                            write("s.toml", kHead +
                                                "record = { fields = [\"position\"], observables = 3, "
                                                "also = [{ every = 2, fields = [\"velocity\"] }, "
                                                "{ every = 9, fields = [\"angle\"] }] }\n" +
                                                kBodies) +
                            " --set time.dt=0.125 --set record.every=1 -o " + recording);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string ask = recording + " --radius 9 --id 1 --fov 90 --at ";
  expect_refused(ask + "0.125",
                 "velocities are not in this frame; recorded each 2 steps, next at 0.25 s; choose another "
                 "--at or --heading");
  expect_refused(ask + "0.5 --heading angle",
                 "angles are not in this frame; recorded each 9 steps, last at 0 s");
  EXPECT_EQ(throng("query " + ask + "0.25").exit_code, 0);
}

/// Observables alone make frames that no question is about: their numbers count all the same.
TEST_F(Query, NumbersFramesAsTheRecordingDoes) {
  const std::string recording = path("sparse.h5");
  const Result run =
      throng("run " + write("s.toml", kHead + "record = { every = 2, observables = 1 }\n" + kBodies) +
             " -o " + recording);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(throng("query " + recording + " --radius 1 --id 1").err,
            "throng: " + recording + ": frame 4 (of 0 to 4), at 1 s\n");
  EXPECT_EQ(throng("query " + recording + " --radius 1 --id 1 --at 0.5").err,
            "throng: " + recording + ": frame 2 (of 0 to 4), at 0.5 s\n");
}

TEST_F(Query, SaysWhyABodyIsNotInAFrame) {
  const std::string recording = path("some.h5");
  const Result run = throng("run " +
                            write("s.toml", kHead +
                                                "record = { of = { ids = [1, 3] }, "
                                                "within = [[-5, -5], [1.2, 9]] }\n" +
                                                kBodies) +
                            " -o " + recording);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(throng("query " + recording + " --radius 1 --id 1 --at 0.5").exit_code, 0);
  expect_refused(recording + " --radius 1 --id 1 --at 1", "body 1 is not there at 1 s");
  expect_refused(recording + " --radius 1 --id 2 --at 1", "body 2 is not recorded (record.of)");
  for (const char* id : {"0", "5", "-1", "4294967297"})
    expect_refused(recording + " --radius 1 --at 1 --id=" + id,
                   std::string("no body has the id ") + id + "; ids go from 1 to 4");
}

TEST_F(Query, AnswersForAFrameOfARecording) {
  const std::string recording = path("r.h5");
  const Result run = throng("run " + write("s.toml", kTorus) + " -o " + recording);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  // Body 1 moves from x = 0.5 at 1 m/s: at time 1 it is 3 from body 4, round the seam.
  const std::string ask = "query " + recording + " --radius 3.5 --id 4";
  EXPECT_EQ(throng(ask + " --at 0").out, "id,neighbour,distance\n4,1,2\n");
  EXPECT_EQ(throng(ask + " --at 0.5").out, "id,neighbour,distance\n4,1,2.5\n");
  const Result nearest_frame = throng(ask + " --at 0.6");
  EXPECT_EQ(nearest_frame.out, "id,neighbour,distance\n4,1,2.5\n");
  EXPECT_EQ(nearest_frame.err, "throng: " + recording + ": frame 2 (of 0 to 4), at 0.5 s\n");
  EXPECT_EQ(throng(ask).out, "id,neighbour,distance\n4,1,3\n");
  EXPECT_EQ(throng("query " + write("unnamed", read(recording)) + " --radius 3.5 --id 4").out,
            "id,neighbour,distance\n4,1,3\n");
  expect_refused(recording + " --radius 1 --id 4 --at 1.5", "outside the recording");
  expect_refused(recording + " --radius 1 --id 4 --at -1", "outside the recording");
  expect_refused(recording + " --radius 1 --id 4 --at 1.0000001",
                 "--at 1.0000001 is outside the recording, which goes from 0 s to 1 s");
}

// A gas of 1000 in a periodic box, some frames on, against the definition read from the same file.
TEST_F(Query, AgreesWithBruteForceOnRecordedFrames) {
  const std::string file = path("gas.h5");
  const Result run = throng("run " THRONG_SOURCE_DIR "/scenarios/gas.toml --set time.until=0.05 -o " + file);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Recording recording(file);
  const Domain domain = recording.geometry().domain;
  ASSERT_EQ(domain.kind, DomainKind::periodic);
  const broadphase::Period period{domain.min, domain.max - domain.min};
  ASSERT_GT(recording.frames(), 2u);
  for (const std::size_t frame : {std::size_t{0}, recording.frames() / 2, recording.frames() - 1}) {
    const Frame f = recording.frame(frame);
    std::ostringstream expected;
    expected << "id,neighbour,distance\n";
    const double radius = 0.05 * period.size.x();
    for (std::uint32_t row = 0; row < f.id.size(); ++row)
      for (const auto& n :
           broadphase::brute_force::near(f.position, broadphase::Place{f.position[row], f.velocity[row], row},
                                         {.radius = radius, .most = 5, .view = {0.0, 1.0}}, &period)) {
        char digits[32];
        *std::to_chars(digits, digits + 31, n.distance).ptr = 0;
        expected << f.id[row] << ',' << f.id[n.row] << ',' << digits << '\n';
      }
    char at[64];
    std::snprintf(at, sizeof at, " --at %.17g --radius %.17g", recording.times()[frame], radius);
    EXPECT_EQ(throng("query " + file + " --all --nearest 5 --fov 180" + at).out, expected.str());
    EXPECT_GT(expected.str().size(), 10000u);
  }
}

// 300 between walls in a periodic box, some of which reach beyond it: whom none of a wall's images hides.
TEST_F(Query, AgreesWithBruteForceOnWhoIsInSight) {
  const std::string scene = kHead + R"(
domain = { periodic = [[-5, -5], [5, 5]] }
walls = [ { polyline = [[-4, -4], [-1, -3], [-1, 2]] }, { polygon = [[1, 1], [2, 1], [2, 2]] },
          { segment = [[4, -2], [7, -1]] }, { segment = [[-2, 4.5], [3, 5.25]] } ]
[shapes]
ball = { disc = { radius = 0.02 } }
[[bodies]]
shape = "ball"
count = 300
place = { random = { within = [[-5, -5], [5, 5]] } }
velocity = { maxwell = 1.0 }
)";
  const std::string file = path("walls.h5");
  const Result run = throng("run " + write("walls.toml", scene) + " --until 0.5 -o " + file);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Recording recording(file);
  const Scene geometry = recording.geometry();
  const Vec size(10.0, 10.0);
  const broadphase::Period period{{-5, -5}, size};
  const auto hidden = [&](const Vec& p, const Vec& q) {
    for (const Wall& wall : geometry.walls)
      for (std::size_t i = 0; i + (wall.closed ? 0 : 1) < wall.points.size(); ++i)
        for (int x = -1; x <= 1; ++x)
          for (int y = -1; y <= 1; ++y) {
            const Vec shift(x * size.x(), y * size.y());
            if (narrowphase::segments_meet(p, q, wall.points[i] + shift,
                                           wall.points[(i + 1) % wall.points.size()] + shift))
              return true;
          }
    return false;
  };
  for (const std::size_t frame : {std::size_t{0}, recording.frames() - 1}) {
    const Frame f = recording.frame(frame);
    std::ostringstream expected;
    expected << "id,neighbour,distance\n";
    std::size_t near = 0, seen = 0;
    for (std::uint32_t row = 0; row < f.id.size(); ++row) {
      std::size_t wanted = 20;
      for (const auto& n : broadphase::brute_force::near(
               f.position, broadphase::Place{f.position[row], {0, 0}, row}, {.radius = 4.0}, &period)) {
        const Vec d = f.position[n.row] - f.position[row];
        const Vec to = f.position[n.row] - (d - broadphase::brute_force::displacement(
                                                    f.position[row], f.position[n.row], &period));
        if (wanted == 0) break;
        ++near;
        if (hidden(f.position[row], to)) continue;
        ++seen;
        --wanted;
        char digits[32];
        *std::to_chars(digits, digits + 31, n.distance).ptr = 0;
        expected << f.id[row] << ',' << f.id[n.row] << ',' << digits << '\n';
      }
    }
    EXPECT_GT(seen, near / 2);
    EXPECT_LT(seen, near - near / 20);
    char at[64];
    std::snprintf(at, sizeof at, " --at %.17g", recording.times()[frame]);
    EXPECT_EQ(throng("query " + file + " --all --radius 4 --nearest 20 --sight" + at).out, expected.str());
  }
}

TEST_F(Query, RefusesWhatMakesNoSense) {
  const std::string scene = write("s.toml", kPlane);
  expect_refused(scene + " --radius -1 --id 1", "--radius must be 0 or more metres, or inf, not -1");
  expect_refused(scene + " --radius nan --id 1", "--radius: 'nan' is no number");
  expect_refused(scene + " --radius 1 --nearest 0 --id 1", "--nearest must be 1 or more, not 0");
  expect_refused(scene + " --radius 1 --id 5", "no body has the id 5; ids go from 1 to 4");
  expect_refused(scene + " --radius 1 --id 4294967297", "no body has the id 4294967297");
  expect_refused(scene + " --radius 1", "give one of");
  expect_refused(scene + " --radius 1 --id 1 --all", "give one of");
  expect_refused(scene + " --id 1", "give --radius");
  for (const char* point : {"1", "1,", "1,2,3", "nan,0", "1,inf", "x,y", "1;2"})
    expect_refused(scene + " --radius 1 --point '" + point + "'", "--point must be two finite numbers");
  for (const char* point : {"1e200,0", "0,-1.1e12"})
    expect_refused(scene + " --nearest 1 --point=" + point, "--point must be at most 1e12 m from the origin");
  expect_refused(scene + " --radius 1 --point ''", "--point: a value is missing");
  for (const char* option : {"--point", "--radius", "--at"})
    expect_refused(scene + " --nearest 1 --id 1 " + option + " ''",
                   option + std::string(": a value is missing"));
  for (const char* option : {"--radius", "--at", "--fov"}) {
    for (const char* number : {"abc", "1x", "' 1'", "0x10", "1,5", "+-1", "+"})
      expect_refused(scene + " --nearest 1 --id 1 " + option + "=" + number, "is no number");
    expect_refused(scene + " --nearest 1 --id 1 " + option + "=1e400",
                   option + std::string(": 1e400 is out of range"));
  }
  for (const char* option : {"--nearest", "--id"})
    for (const char* number : {"99999999999999999999", "-99999999999999999999", "1.5", "1x"})
      expect_refused(scene + " --radius 1 --all " + option + "=" + number, option + std::string(": "));
  expect_refused(scene + " --nearest 99999999999999999999 --id 1", "out of range");
  expect_refused(scene + " --radius 1 --id 010", "no body has the id 10");
  expect_refused(scene + " --radius 1 --id 1 --at 2", "record a run");
  expect_refused(scene + " --radius 1 --id 1 --at nan", "--at: 'nan' is no number");
  expect_refused(scene + " --radius 1 --id 1 --fov nan", "--fov: 'nan' is no number");
  for (const char* fov : {"0", "-90", "360.1", "inf"})
    expect_refused(scene + " --radius 1 --id 1 --fov=" + fov,
                   std::string("--fov must be above 0 and at most 360 degrees, not ") + fov);
  for (const char* heading : {"left", "nan", "90x", "inf"})
    expect_refused(scene + " --radius 1 --id 1 --fov 90 --heading " + heading,
                   "--heading must be velocity, angle");
  expect_refused(scene + " --radius 1 --id 1 --heading 90", "--heading needs --fov");
  expect_refused(scene + " --radius 1 --point 0,0 --fov 90", "--point with --fov needs --heading DEG");
  expect_refused(scene + " --radius 1 --point 0,0 --fov 90 --heading angle", "--point with --fov needs");
  expect_refused(scene + " --radius 1 --id 1 --format xml", "xml");
}

TEST_F(Query, RefusesFilesThatAreNone) {
  expect_refused(path("absent.toml") + " --radius 1 --all", "absent.toml");
  expect_refused(path("absent.h5") + " --radius 1 --all", "absent.h5");
  expect_refused(write("lie.h5", "not HDF5") + " --radius 1 --all", "lie.h5");
  expect_refused(write("empty.toml", "") + " --radius 1 --all", "empty.toml");
  expect_refused(write("cut.h5", "\x89HDF\r\n\x1a\n") + " --radius 1 --all", "cut.h5");
}

}  // namespace
}  // namespace throng
