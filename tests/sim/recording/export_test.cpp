// SPDX-License-Identifier: MIT
// What the field's readers find in exported files is tested in tests/python/export_test.py.
#include "sim/recording/export.h"

#include <gtest/gtest.h>

#include "sim/input_error.h"
#include "tests/sim/recording/scenes.h"

namespace throng {
namespace {

using namespace testing_recordings;

TEST(Export, RefusesFramesThatPedpyCouldNotTime) {
  const Folder folder;
  const Scene scene = mixed_scene(4);
  Recorder recorder(folder / "a.h5", scene, provenance());
  for (std::int64_t step : {0, 2, 4, 5}) recorder.record(state_at(scene, step));
  recorder.finish({});
  const Recording recording(folder / "a.h5");
  const std::size_t even[] = {0, 1, 2}, uneven[] = {0, 1, 2, 3};
  EXPECT_NO_THROW(export_pedpy(recording, even, {folder / "b.h5", "b.h5"}));
  EXPECT_THROW(export_pedpy(recording, uneven, {folder / "c.h5", "c.h5"}), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "c.h5"));
}

}  // namespace
}  // namespace throng
