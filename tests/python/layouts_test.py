# SPDX-License-Identifier: MIT
"""Recordings that older versions wrote, as throng_read, the program and its exports know them."""
import csv
import json
import pathlib
import shutil
import subprocess
import unittest

import h5py
import numpy as np

from program import PROGRAM, Program
import throng_read

KEPT = sorted((pathlib.Path(__file__).parents[1] / "sim/recording/layouts").glob("*.h5"))


class Layouts(Program):
    def test_there_is_one_of_each_older_layout(self):
        self.assertEqual([path.stem for path in KEPT], ["1.0", "1.1", "1.2", "1.4", "1.5"])
        for path in KEPT:
            with h5py.File(path) as file:
                self.assertEqual(".".join(map(str, file["throng"].attrs["version"])), path.stem)

    def test_are_read_and_exported(self):
        for path in KEPT[:2]:
            with self.subTest(path.name), throng_read.open(path) as recording, h5py.File(path) as file:
                np.testing.assert_array_equal(recording.step, range(0, 21, 4))
                self.assertTrue(recording.complete)
                trajectory = file["particles/trajectory"]
                for field in ("position", "angle", "velocity", "spin"):
                    np.testing.assert_array_equal(getattr(recording, field)[:], trajectory[field]["value"][:])
                np.testing.assert_array_equal(recording.position[0], [[3.4, 0.25], [0.7, 0.4], [1.7, 0.4]])
                self.assertEqual([shape.holes for shape in recording.shapes], [[], []])
                self.assertRaises(throng_read.NotRecorded, recording.contacts, 3)
                self.assertEqual(recording.observables, {})
                for form in ("csv", "pedpy", "xdmf", "h5md3", "lammps"):
                    self.assertEqual(self.throng("export", str(path), "--format", form, "-o", "a." + form, "--force"), (0, ""))
                with open(self.path("a.csv"), encoding="utf8") as lines:
                    x = [float(row["x"]) for row in csv.DictReader(lines)]
                np.testing.assert_array_equal(x, recording.position[:][..., 0].ravel())
                self.assertEqual(self.throng("replay", str(path), "--png", "a.png"), (0, ""))
                info = json.loads(subprocess.run([PROGRAM, "info", path, "--json"], capture_output=True, check=True).stdout)
                self.assertEqual([info[key] for key in ("frames", "bodies", "rates")], [6, 3, [4, 4, 4, 4]])

    def test_regions_of_the_first_1_2_had_ids_in_every_frame(self):
        with throng_read.open(KEPT[2]) as recording, h5py.File(KEPT[2]) as file:
            self.assertEqual(file["particles/trajectory/id/step"], file["throng/frames/step"], "a link")
            np.testing.assert_array_equal(recording.step, [0, 4, 6, 8, 12, 16, 18, 20])
            frames = [i for i, step in enumerate(recording.step) if step % 4 == 0]
            np.testing.assert_array_equal(recording.position.frames, frames)
            present = [[row + 1 for row in np.flatnonzero(~np.isnan(some[:, 0]))] for some in recording.position[frames]]
            self.assertEqual(present, [[3], [3], [2, 3], [2], [2], [2]])
            np.testing.assert_array_equal(recording.position[0][2], [1.7, 0.4])
        self.assertEqual(self.throng("export", str(KEPT[2]), "--format", "csv", "-o", "a.csv"),
                         (0, "throng: warning: a.csv leaves out observables, which throng_read.py reads\n"))
        with open(self.path("a.csv"), encoding="utf8") as lines:
            self.assertEqual([int(row["id"]) for row in csv.DictReader(lines)], [3, 3, 2, 3, 2, 2, 2])
        self.assertEqual(self.throng("replay", str(KEPT[2]), "--png", "a.png"), (0, ""))

    def test_observables_of_1_4_knew_no_crowds(self):
        path = str(KEPT[3])
        with throng_read.open(path) as recording:
            self.assertEqual(sorted(recording.observables), ["contacts", "kinetic_energy", "max_overlap", "mean_overlap",
                                                             "momentum", "potential_energy"])
            self.assertEqual(recording.sensors, [])
        for command in (("replay", path, "--verify"), ("info", path), ("replay", path, "--png", "a.png")):
            self.assertEqual(self.throng(*command), (0, ""))
        shutil.copy(path, self.path("a.h5"))
        code, said = self.throng("resume", "a.h5", "--until", "5", "--progress", "none")
        self.assertEqual(code, 2)
        self.assertIn("cannot be gone on with: observables of a crowd were not recorded before layout 1.5", said)
        self.assertEqual((self.folder / "a.h5").read_bytes(), KEPT[3].read_bytes())

    def test_crowds_of_1_5_had_no_table_of_areas(self):
        path = str(KEPT[4])
        with throng_read.open(path) as recording:
            self.assertEqual((recording.areas, recording.queues), ([], []))
            self.assertEqual([len(ring) for ring in recording.walkable], [4, 4])
            self.assertEqual(list(recording.observables["measure/a%20b/count"][0]), [0, 0, 0, 0])
            self.assertEqual(list(recording.observables["agents"][0]), [2, 1, 1, 1])
            self.assertEqual([list(recording.sensed("eyes", i).who) for i in recording.sensed_frames("eyes")], [[1, 2], [2], [2], [2]])
        for command in (("replay", path, "--verify"), ("info", path), ("replay", path, "--png", "a.png")):
            self.assertEqual(self.throng(*command), (0, ""))
        shutil.copy(path, self.path("a.h5"))
        self.assertEqual(self.throng("resume", "a.h5", "--until", "3.5", "--progress", "none")[0], 0)
        with throng_read.open(self.path("a.h5")) as recording, h5py.File(self.path("a.h5")) as file:
            self.assertEqual(list(file["throng"].attrs["version"]), [1, 11])
            self.assertEqual([area.name for area in recording.areas], ["exit", "hall"])
        self.assertEqual(self.throng("replay", "a.h5", "--verify"), (0, ""))

    def test_contacts_before_1_11_are_not_gone_on_with(self):
        scenario = self.path("fall.toml")
        with open(scenario, "w", encoding="utf8") as file:
            file.write("throng = 1\ngravity = [0, -9.81]\ntime = { dt = 0.01, until = 0.1 }\nshapes.ball = { disc = { radius = 0.1 } }\n"
                       "bodies = [{ shape = \"ball\", at = [0, 0.1] }]\nwalls = [{ segment = [[-1, 0], [1, 0]] }]\n"
                       "record = { every = 1, fields = [\"position\", \"contacts\"] }\n")
        self.assertEqual(self.throng("run", scenario, "-o", "fall.h5", "--progress", "none")[0], 0)
        with h5py.File(self.path("fall.h5"), "r+") as file:
            file["throng"].attrs.modify("version", np.array([1, 10], np.int32))
        code, said = self.throng("resume", "fall.h5", "--until", "0.2", "--progress", "none")
        self.assertEqual(code, 2)
        self.assertIn("cannot be gone on with: contacts told less of what presses before layout 1.11", said)


if __name__ == "__main__":
    unittest.main()
