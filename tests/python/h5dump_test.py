# SPDX-License-Identifier: MIT
"""Recordings of every kind as HDF5's own h5dump reads them: each number as h5py gives it."""
import shutil
import subprocess
import unittest

import h5py

from program import Program

CROWD = """throng = 1
time = { dt = 0.02, until = 1 }
walkable = "POLYGON ((0 0, 6 0, 6 4, 0 4, 0 0))"
areas = { start = [[0, 0], [4, 0], [4, 4], [0, 4]], exit = [[5, 0], [6, 0], [6, 4], [5, 4]] }
record = { observables = 4 }
[[agents]]
count = 12
place = { random = { within = "start" } }
model = "social_force"
goal = "exit"
[[measure]]
name = "in between"
line = [[3, 0], [3, 4]]
[[measure]]
name = "start"
area = "start"
[[sensors]]
name = "near"
radius = 2
every = 3
record = true
"""
FULL = ("record.fields=['position', 'angle', 'velocity', 'spin', 'contacts']", "record.observables=3")


@unittest.skipUnless(shutil.which("h5dump"), "no h5dump")
class H5dump(Program):
    def dumped(self, path, name):
        subprocess.run(["h5dump", "-d", name, "-b", "LE", "-o", self.path("numbers"), path], check=True, capture_output=True)
        return (self.folder / "numbers").read_bytes()

    def check(self, path):
        """Returns how many datasets there are."""
        names, groups = [], []
        with h5py.File(path) as file:
            file.visititems(lambda name, of: (names if isinstance(of, h5py.Dataset) else groups).append(name))
            for name in names:
                values = file[name][()]
                if not values.size:
                    continue
                if values.dtype.kind in "iuf":
                    self.assertEqual(self.dumped(path, "/" + name), values.astype(values.dtype.newbyteorder("<")).tobytes(), name)
        everything = subprocess.run(["h5dump", path], capture_output=True, text=True, errors="replace")
        self.assertEqual((everything.returncode, everything.stderr), (0, ""))
        for name in groups:
            self.assertIn(f'GROUP "{name.rpartition("/")[2]}"', everything.stdout)
        return len(names)

    def test_reads_bodies_of_every_form(self):
        for options in (FULL, (*FULL, "record.precision='single'"), (*FULL, "record.quantize=1e-3"),
                        (*FULL, "record.within=[[0, 0], [2, 3]]", "record.also=[]"), (*FULL, "record.of.ids=[2, 4]"),
                        ("record.fields=['position']", "record.also=[{ every = 7, fields = ['velocity'] }]")):
            with self.subTest(options):
                path = self.record("a.h5", "--force", *(word for option in options for word in ("--set", option)))
                self.assertGreater(self.check(path), 40)

    def test_reads_crowds_with_what_they_sense_and_what_is_measured(self):
        (self.folder / "three.toml").write_text(CROWD)
        self.assertGreater(self.check(self.record()), 70)


if __name__ == "__main__":
    unittest.main()
