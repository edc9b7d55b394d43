# SPDX-License-Identifier: MIT
"""Recordings of agents, who leave: as the program, its exports and throng_read.py know them."""
import csv
import subprocess
import unittest
import xml.etree.ElementTree as xml

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

    def test_h5md_keeps_the_rows_of_who_left(self):
        self.record()
        self.assertEqual(self.throng("export", "a.h5", "--format", "h5md3", "-o", "a.h5md"), (0, ""))
        with throng_read.open(self.path("a.h5")) as recording, h5py.File(self.path("a.h5md")) as file:
            trajectory, places = file["particles/trajectory"], recording.position[:]
            here = np.isfinite(places[..., 0])
            self.assertTrue(0 < here.sum() < here.size, "some leave")
            np.testing.assert_array_equal(trajectory["position/value"][..., :2], places)
            np.testing.assert_array_equal(trajectory["velocity/value"][..., :2], recording.velocity[:])
            np.testing.assert_array_equal(trajectory["position/value"][..., 2], np.where(here, 0.0, np.nan))
            np.testing.assert_array_equal(trajectory["id/value"][:], np.where(here, recording.ids, 0))
            self.assertEqual(trajectory["id/value"].fillvalue, 0)
            self.assertEqual(trajectory["id/step"], trajectory["position/step"])
            self.assertEqual(len(trajectory["mass"]), len(recording.ids))

    def test_xdmf_points_at_who_is_there(self):
        self.record()
        self.assertEqual(self.throng("export", "a.h5", "--format", "xdmf", "-o", "a.xdmf"), (0, ""))
        with throng_read.open(self.path("a.h5")) as recording:
            times, places, ids = recording.time, recording.position[:], recording.ids
        here = np.isfinite(places[..., 0])
        grids = {float(grid.find("Time").get("Value")): grid for grid in xml.parse(self.path("a.xdmf")).getroot().iter("Grid")
                 if grid.get("CollectionType") is None}
        self.assertEqual(set(grids), set(times[here.any(axis=1)]))
        for frame in np.flatnonzero(here.any(axis=1))[::7]:
            grid = grids[times[frame]]
            self.assertEqual(int(grid.find("Topology").get("NumberOfElements")), here[frame].sum())
            np.testing.assert_array_equal(self.slab(grid.find("Geometry/DataItem")), places[frame][here[frame]])
            found = {attribute.get("Name"): attribute.find("DataItem") for attribute in grid.findall("Attribute")}
            np.testing.assert_array_equal(self.slab(found["id"]), ids[here[frame]])
            self.assertNotIn("radius", found, "it stands in another order")

    def slab(self, item):
        """What a selection gives: start, stride and count of each dimension."""
        selection, whole = item.findall("DataItem")
        start, stride, count = np.array(selection.text.split(), int).reshape(3, -1)
        path, place = whole.text.split(":")
        with h5py.File(self.path(path)) as file:
            self.assertEqual(tuple(map(int, whole.get("Dimensions").split())), file[place].shape)
            self.assertEqual(int(whole.get("Precision")), file[place].dtype.itemsize)
            values = file[place][tuple(slice(s, s + k * n, k) for s, k, n in zip(start, stride, count))]
        return values.reshape(tuple(map(int, item.get("Dimensions").split())))


if __name__ == "__main__":
    unittest.main()
