// SPDX-License-Identifier: MIT
// X4: files of a stranger who knows the format, and whose checksums are right. Each is refused with its
// reason.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <map>

#include "tests/durability/hostile.h"

namespace throng {
namespace {

using testing::HasSubstr;

/// What `work` takes in a process of its own.
struct Cost {
  double memory, seconds;  // bytes that were resident at most, s of the processor's time
};

Cost cost_of(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  rusage usage = {};
  EXPECT_EQ(wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status)) << "a signal";
  return {1024.0 * static_cast<double>(usage.ru_maxrss),
          static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
              1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec)};
}

struct Crafted : Hostile {
  /// `crafted`: what crafted.py is asked to make; each fault has its reason.
  void expect_refused(const std::string& crafted, const std::map<std::string, std::string>& reasons) const {
    const std::string script = "/usr/bin/python3 -B " THRONG_SOURCE_DIR "/tests/durability/crafted.py ";
    ASSERT_EQ(std::system((script + crafted).c_str()), 0);
    for (const auto& [fault, reason] : reasons) {
      const std::string file = folder / (fault + ".h5");
      EXPECT_THAT(refusal(file), HasSubstr(reason)) << fault;
      const Cost cost = cost_of([&] { refusal(file); });
      EXPECT_LT(cost.memory, kSanitized ? 1e9 : 200e6) << fault;
      EXPECT_LT(cost.seconds, kSanitized ? 4.0 : 1.0) << fault;  // whose shadow memory a fork pays for, too
    }
  }
};

TEST_F(Crafted, X4CraftedFilesAreRefusedWithTheirReason) {
  const std::map<std::string, std::string> reasons{
      {"external_storage", "another file"},
      {"external_link", "link to elsewhere"},
      {"soft_link", "link to elsewhere"},
      {"virtual_dataset", "unknown way"},
      {"huge_dimensions", "more than the file can hold"},
      {"bomb", "more than the file can hold"},
      {"wrong_type", "wrong type"},
      {"wrong_rank", "wrong rank"},
      {"wrong_size", "wrong size"},
      {"not_finite", "not finite"},
      {"not_finite_position", "frame 3"},
      {"altered_position", "does not match its hash"},
      {"altered_state_hash", "does not match its hash"},
      {"altered_scenario", "scenario does not match"},
      {"time_going_back", "wrong at frame 3"},
      {"time_off_the_steps", "wrong at frame 3"},
      {"frame_missing", "does not match its hash"},
      {"value_missing", "too few frames"},
      {"index_beyond", "beyond its table"},
      {"kind_unknown", "unknown kind"},
      {"offset_beyond", "does not fit"},
      {"wall_without_points", "fewer than two points"},
      {"wall_of_one_point", "fewer than two points"},
      {"part_without_vertices", "no vertices"},
      {"disc_with_parts", "a disc has parts"},
      {"polygon_without_parts", "another shape has none"},
      {"cycle", "is missing"},
      {"deflated", "filter"},
      {"foreign_filter", "filter"},
      {"scale_offset", "filter"},
      {"variable_text", "wrong type"},
      {"no_utf8", "UTF-8"},
      {"dataset_for_a_group", "walls"},
      {"group_missing", "frames is missing"},
      {"equal_measures", "no name of its own"},
      {"many_measures", "too many measures"},
      {"observables_again_and_again", "observables claim more than the file can hold"},
      {"newer", "written by a newer throng"},
      {"foreign", "not throng's"}};
  expect_refused((folder / "good.h5 ") + folder.path.string(), reasons);
}

TEST_F(Crafted, X4CraftedCrowdsAreRefusedWithTheirReason) {
  record_simulation(folder / "crowd.h5", measured_crowd());
  EXPECT_EQ(refusal(folder / "crowd.h5"), "accepted");
  expect_refused((folder / "crowd.h5 ") + folder.path.string() + " crowd",
                 {{"area_of_unknown_use", "unknown use"},
                  {"area_of_two_points", "fewer than three points"},
                  {"area_beyond_its_rings", "area_offset does not fit"},
                  {"area_nowhere", "not finite"},
                  {"fewer_uses_than_areas", "use has the wrong size"},
                  {"areas_elsewhere", "link to elsewhere"},
                  {"areas_of_a_bomb", "more than the file can hold"},
                  {"queue_of_one_point", "fewer than two points"},
                  {"queue_without_spacing", "spacing is out of range"},
                  {"floor_of_two_points", "fewer than three points"},
                  {"measure_of_nothing", "line has the wrong size"},
                  {"measure_without_columns", "is missing"},
                  {"column_of_few_rows", "too few"},
                  {"column_too_large", "more than the file can hold"},
                  {"column_elsewhere", "link to elsewhere"},
                  {"altered_density", "does not match its hash"},
                  {"sensor_without_a_rate", "out of range"},
                  {"sensor_of_no_width", "out of range"},
                  {"sensor_without_end", "are missing"},
                  {"sensor_running_backwards", "runs backwards"},
                  {"altered_sensed", "does not match its hash"},
                  {"altered_count", "frame 0"},
                  {"contacts_too_many", "contacts are missing"},
                  {"contacts_never_written", "contacts are of bodies that there are not"},
                  {"contacts_of_a_bomb", "more than the file can hold"},
                  {"contacts_without_a_column", "b is missing"},
                  {"contacts_without_offsets", "contacts has too few frames"},
                  {"presence_of_another", "id is not in order"}});
}

/// Of five bodies, with contacts, packed positions, a rate of their own for velocities.
TEST_F(Crafted, X4CraftedFilesOfSomeBodiesAreRefusedWithTheirReason) {
  EXPECT_GT(full(false).told.frames.size(), 5u);
  expect_refused((folder / "full.h5 ") + folder.path.string() + " selected",
                 {{"contacts_emptied", "contacts are missing"},
                  {"contact_of_nobody", "frame 1: contacts are of bodies that there are not"},
                  {"contact_with_nobody", "frame 1: contacts are of bodies that there are not"},
                  {"altered_impulse", "frame 1: it does not match its hash"},
                  {"impulse_not_finite", "frame 1: contacts are not finite"},
                  {"contact_nowhere", "frame 1: contacts are not finite"},
                  {"contacts_running_backwards", "offsets of contacts run backwards"},
                  {"contacts_of_another_frame", "frame 0: it does not match its hash"},
                  {"contacts_of_another_rate", "not those of their frames"},
                  {"rate_of_nothing", "every is out of range"},
                  {"steps_of_another_rate", "not those of their frames"},
                  {"velocity_missing", "velocity has too few frames"},
                  {"ids_twice", "id is not in order"},
                  {"id_beyond", "id is not in order"},
                  {"fewer_bodies_than_rows", "bodies is out of range"},
                  {"quantum_of_nothing", "quantum is out of range"},
                  {"quantum_not_finite", "quantum is out of range"},
                  {"other_key_frames", "key_every is unknown"},
                  {"positions_in_two_ways", "positions are stored in two ways"},
                  {"positions_side_by_side", "position is not stored frame by frame"},
                  {"altered_place", "does not match its hash"},
                  {"garbled_chunk", "a chunk cannot be unpacked"},
                  {"chunk_as_it_is", "a chunk cannot be unpacked"},
                  {"chunk_of_much", "a chunk cannot be unpacked"},
                  {"chunk_of_little", "a chunk cannot be unpacked"},
                  {"large_chunk", "a chunk has a size that throng never makes"}});
}

TEST_F(Crafted, X4CraftedFilesOfARegionAreRefusedWithTheirReason) {
  EXPECT_GT(full(true).told.frames.size(), 5u);
  expect_refused((folder / "full.h5 ") + folder.path.string() + " region",
                 {{"region_turned_round", "the region is turned round"},
                  {"region_without_end", "the region is turned round"},
                  {"ids_that_descend", "frame 1: id is not in order"},
                  {"ids_with_a_gap", "frame 1: id is not in order"},
                  {"id_of_nobody", "frame 1: id is not in order"},
                  {"id_that_came", "frame 1: it does not match its hash"},
                  {"id_that_went", "frame 1: it does not match its hash"},
                  {"ids_of_few_frames", "id has too few frames"},
                  {"ids_of_other_steps", "not those of their frames"},
                  {"ids_at_other_times", "not those of their frames"},
                  {"region_without_ids", "is damaged: id"}});
}

TEST_F(Crafted, OtherPeoplesHdf5IsNotThrongs) {
  const std::string write_other =
      "/usr/bin/python3 -c \"import h5py; h5py.File('" + (folder / "o.h5") + "', 'w')['x'] = 1\"";
  ASSERT_EQ(std::system(write_other.c_str()), 0);
  EXPECT_THAT(refusal(folder / "o.h5"), HasSubstr("is HDF5 but not throng's"));
}

}  // namespace
}  // namespace throng
