# SPDX-License-Identifier: MIT
"""Recordings of every kind as HDF5's own h5dump reads them: each number as h5py gives it."""
import re
import shutil
import subprocess
import unittest

import h5py
import numpy as np

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

    def texts(self, path, name):
        """A list of names."""
        said = subprocess.run(["h5dump", "-w", "0", "-d", name, path], check=True, capture_output=True, text=True).stdout
        return [text.replace("\\000", "") for text in re.findall(r'"(.*?)"', said[said.index("DATA {"):])]

    def attribute(self, path, name):
        """Its numbers or its text, as h5dump prints them."""
        said = subprocess.run(["h5dump", "-w", "0", "-m", "%.17g", "-a", name, path], check=True, capture_output=True, text=True).stdout
        inner = re.sub(r"\(\d+(,\d+)*\): ", "", re.search(r"DATA \{\n(.*)\n   \}", said, re.S)[1])
        if inner.strip().startswith('"'):
            return [text.replace("\\000", "") for text in re.findall(r'"(.*?)"', inner)]
        return [word.strip() for word in inner.split(",")]

    def check(self, path):
        """Returns how many datasets there are."""
        objects, attributes = {"group": {"/"}, "dataset": set()}, {}
        with h5py.File(path) as file:
            def look(name, of):
                objects["dataset" if isinstance(of, h5py.Dataset) else "group"].add("/" + name)
                attributes.update({f"/{name}/{key}": of.attrs[key] for key in of.attrs})
            file.visititems(look)
            for name in objects["dataset"]:
                values = np.asarray(file[name][()], file[name].dtype.newbyteorder("<"))
                if values.size and values.dtype.kind in "iuf":
                    self.assertEqual(self.dumped(path, name), values.tobytes(), name)
                elif values.ndim and values.size:
                    self.assertEqual(self.texts(path, name), [value.decode() for value in values], name)
        listed = {"group": set(), "dataset": set(), "attribute": set()}
        contents = subprocess.run(["h5dump", "-n", "1", path], check=True, capture_output=True, text=True).stdout
        for kind, name in re.findall(r"^ (group|dataset|attribute) +(/.*?)(?: ->.*)?$", contents, re.M):
            listed[kind].add(name)
        self.assertLessEqual(objects["dataset"], listed["dataset"])
        self.assertEqual((objects["group"], set(attributes)), (listed["group"], listed["attribute"]))
        for name, value in attributes.items():
            wanted = [value] if np.ndim(value) == 0 else list(value)
            for want, word in zip(wanted, self.attribute(path, name), strict=True):
                if isinstance(want, (str, bytes)):
                    self.assertEqual(want if isinstance(want, str) else want.decode(), word, name)
                else:
                    self.assertEqual(want, type(want)(word), name)
        return len(objects["dataset"])

    def test_reads_bodies_of_every_form(self):
        for options in (FULL, (*FULL, "record.precision='single'"), (*FULL, "record.quantize=1e-3"),
                        (*FULL, "record.within=[[0, 0], [2, 3]]", "record.also=[]"), (*FULL, "record.of.ids=[2, 4]"),
                        ("record.fields=['position']", "record.also=[{ every = 7, fields = ['velocity'] }]")):
            with self.subTest(options):
                path = self.record("a.h5", "--force", *(word for option in options for word in ("--set", option)))
                self.assertGreater(self.check(path), 40)

    def test_reads_crowds_with_what_they_sense_and_what_is_measured(self):
        (self.folder / "three.toml").write_text(CROWD)
        path = self.record()
        self.assertGreater(self.check(path), 70)
        for name, numbers in (("/throng/walkable/points", [[0, 0], [6, 0], [6, 4], [0, 4]]),
                              ("/throng/areas/points", [[5, 0], [6, 0], [6, 4], [5, 4], [0, 0], [4, 0], [4, 4], [0, 4]]),
                              ("/throng/measures/line", [[3, 0, 3, 4], [0, 0, 0, 0]]), ("/throng/bodies/radius", 12 * [0.2])):
            np.testing.assert_array_equal(np.frombuffer(self.dumped(path, name)), np.ravel(np.array(numbers, float)), name)
        count = np.frombuffer(self.dumped(path, "/observables/measure/in between/count/value"))
        x = np.frombuffer(self.dumped(path, "/particles/trajectory/position/value")).reshape(51, 12, 2)[..., 0]
        self.assertEqual(int(count[-1]), int(((x[0] < 3) & (x[-1] > 3)).sum()))
        self.assertGreater(count[-1], 0)


if __name__ == "__main__":
    unittest.main()
