# SPDX-License-Identifier: MIT
"""Recordings of agents, who leave: as the program, its exports and throng_read.py know them."""
import csv
import pathlib
import subprocess
import unittest

import h5py
import numpy as np

from program import PROGRAM, Program
import throng_read

CROWD = """throng = 1
name = "three leave"
time = { dt = 0.02, until = 6 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))"
areas = { exit = [[9, 0], [10, 0], [10, 5], [9, 5]] }
"""
AGENT = """[[agents]]
at = [{}, {}]
model = "constant_velocity"
desired_speed = 1.0
goal = "exit"
"""
PLACES = ((8.01, 1.0), (2.0, 4.0), (6.01, 3.0))  # gone after 1.0, never, 3.0 s


class Crowd(Program):
    def setUp(self):
        super().setUp()
        (self.folder / "three.toml").write_text(CROWD + "".join(AGENT.format(*place) for place in PLACES))

    def test_frames_hold_who_is_there(self):
        with throng_read.open(self.record()) as recording:
            there = ~np.isnan(recording.position[:, :, 0])
            first_gone = [int(np.argmin(there[:, k])) if not there[:, k].all() else None for k in range(3)]
            self.assertEqual(first_gone, [50, None, 150])
            self.assertEqual(list(recording.bodies.kind), ["agent"] * 3)
            np.testing.assert_allclose(recording.position[40, 2], [6.81, 3.0], atol=1e-6)
            self.assertTrue(np.isnan(recording.frame(100).velocity[0]).all())

    def test_is_verified(self):
        self.record()
        self.assertEqual(self.throng("replay", "a.h5", "--verify"), (0, ""))

    def test_who_ought_to_be_gone_is_told(self):
        spins = ("--every", "60", "--set", 'record.fields=["spin"]')
        slow = [word for i in range(3) for word in ("--set", f"agents[{i}].desired_speed=0.8")]
        with h5py.File(self.record("fast.h5", *spins)) as fast, h5py.File(self.record("slow.h5", *spins, *slow), "r+") as file:
            file["parameters"].attrs.modify("resolved_hash", fast["parameters"].attrs["resolved_hash"])
            del file["parameters/resolved"]
            fast.copy("parameters/resolved", file["parameters"])
        done = subprocess.run([PROGRAM, "replay", "slow.h5", "--verify"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("at step 60 (t = 1.2 s): presence of body 1 was recorded as 1, runs to 0", done.stdout)

    def test_pictures_show_who_is_there(self):
        self.record()
        for at in ("0", "6"):
            self.assertEqual(self.throng("replay", "a.h5", "--png", f"{at}.png", "--at", at), (0, ""))
        self.assertNotEqual((self.folder / "0.png").read_bytes(), (self.folder / "6.png").read_bytes())

    def test_pedpy_gets_people_and_their_floor(self):
        self.record()
        self.assertEqual(self.throng("export", "a.h5", "--format", "pedpy", "-o", "a.ped.h5"), (0, ""))
        with h5py.File(self.path("a.ped.h5")) as file:
            self.assertEqual(file.attrs["wkt_geometry"],
                             "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0), (4 2, 5 2, 5 3, 4 3, 4 2))")
            rows = file["trajectory"][:]
            self.assertEqual([int((rows["id"] == k).sum()) for k in (1, 2, 3)], [50, 301, 150])
            self.assertEqual(file["trajectory"].attrs["fps"], 50.0)

    def test_csv_has_a_line_for_each_who_is_there(self):
        self.record()
        self.assertEqual(self.throng("export", "a.h5", "--format", "csv", "-o", "a.csv"), (0, ""))
        with open(self.path("a.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 501)

    def test_what_needs_the_same_bodies_is_refused(self):
        self.record()
        for format in ("xdmf", "h5md3"):
            code, said = self.throng("export", "a.h5", "--format", format, "-o", "a.out")
            self.assertEqual(code, 2)
            self.assertIn("holds other bodies in each frame (agents leave), which " + format, said)
            self.assertFalse(pathlib.Path(self.path("a.out")).exists())


if __name__ == "__main__":
    unittest.main()
