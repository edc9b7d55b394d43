# SPDX-License-Identifier: MIT
"""throng export writes what the field's tools read, with the numbers of the recording."""
import csv
import os
import pathlib
import re
import subprocess
import time
import unittest
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from program import PROGRAM, Program

FIELDS = 'record.fields=["position","angle","velocity","spin"]'


class Export(Program):
    def export(self, format, output, *options, recording="a.h5"):
        self.assertEqual(self.throng("export", recording, "--format", format, "-o", output, *options), (0, ""))
        return self.path(output)

    def refused(self, *arguments):
        """What it said, having written nothing."""
        before = self.contents()
        code, error = self.throng("export", *arguments)
        self.assertEqual(code, 2, error)
        self.assertEqual(self.contents(), before)
        return error

    def record_until_killed(self):
        """Leaves a.h5.part with a second or more of what it shows."""
        run = subprocess.Popen([PROGRAM, "run", "three.toml", "-o", "a.h5", "--until", "3e4", "--progress", "none"],
                               cwd=self.folder, stdout=subprocess.DEVNULL)
        part = self.folder / "a.h5.part"
        while not part.exists() or part.stat().st_size < 1 << 20 or self.throng("replay", part.name, "--png", "/dev/null", "--at", "1")[0] != 0:
            self.assertIsNone(run.poll(), "it came to its end")
        run.kill()
        run.wait()

    def contents(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}


class Csv(Export):
    def rows(self, path):
        with open(path, newline="") as file:
            return list(csv.DictReader(file))

    def test_has_every_number_of_the_recording(self):
        recording = h5py.File(self.record())["particles/trajectory"]
        rows = self.rows(self.export("csv", "a.csv"))
        steps, times = recording["position/step"][:], recording["position/time"][:]
        self.assertEqual(len(rows), 21 * 4)
        self.assertEqual(list(rows[0]), ["step", "time", "id", "x", "y", "vx", "vy", "angle", "spin"])
        columns = {"x": ("position", 0), "y": ("position", 1), "vx": ("velocity", 0), "vy": ("velocity", 1)}
        for number, row in enumerate(rows):
            frame, body = divmod(number, 4)
            self.assertEqual(int(row["step"]), steps[frame])
            self.assertEqual(float(row["time"]), times[frame])
            self.assertEqual(int(row["id"]), body + 1)
            for column, (field, axis) in columns.items():
                self.assertEqual(float(row[column]), recording[field]["value"][frame, body, axis], column)
            for field in ("angle", "spin"):
                self.assertEqual(float(row[field]), recording[field]["value"][frame, body], field)
        self.assertGreater(len({row["vy"] for row in rows}), 20, "the sample moves")

    def test_has_the_columns_that_were_recorded(self):
        self.record("a.h5", "--set", 'record.fields=["angle"]', "--set", 'record.precision="single"')
        rows = self.rows(self.export("csv", "a.csv"))
        self.assertEqual(list(rows[0]), ["step", "time", "id", "angle"])
        angles = h5py.File(self.path("a.h5"))["particles/trajectory/angle/value"][:]
        self.assertEqual([np.float32(row["angle"]) for row in rows], list(angles.ravel()))

    def steps(self, *options):
        return [int(row["step"]) for row in self.rows(self.export("csv", "a.csv", "--force", *options))[::4]]

    def test_takes_a_span_and_a_rate(self):
        self.record()
        self.assertEqual(self.steps("--every", "6"), [0, 6, 12, 18])
        self.assertEqual(self.steps("--from", "0.07", "--to", "0.1"), [7, 8, 9, 10])
        self.assertEqual(self.steps("--from", "0.061", "--every", "5"), [7, 12, 17])
        self.assertEqual(self.steps("--to", "0.03"), [0, 1, 2, 3])
        self.assertEqual(self.steps("--from", "0.2"), [20])
        self.assertEqual(self.steps("--to", "0"), [0])

    def test_counts_the_frames_that_have_rows(self):
        self.record("a.h5", "--every", "4", "--set", "record.observables=10")
        for steps, options in (([0, 8, 16], "--every 2"), ([12, 20], "--from 0.1 --every 2")):
            self.assertEqual(self.throng("export", "a.h5", "--format", "csv", "-o", "b.csv", "--force", *options.split())[0], 0)
            self.assertEqual([int(row["step"]) for row in self.rows(self.path("b.csv"))[::4]], steps)
        self.assertIn("a.h5 has no frame of bodies from 0.09 s to 0.11 s",
                      self.refused("a.h5", "--format", "csv", "-o", "c.csv", "--from", "0.09", "--to", "0.11"))

    def test_writes_into_a_pipe(self):
        self.record()
        printed = subprocess.run([PROGRAM, "export", self.path("a.h5"), "--format", "csv", "-o", "/dev/stdout"],
                                 stdout=subprocess.PIPE, check=True).stdout
        self.assertEqual(printed, pathlib.Path(self.export("csv", "a.csv")).read_bytes())

    def test_writes_to_the_standard_output_behind_what_is_there(self):
        self.record()
        expected = pathlib.Path(self.export("csv", "a.csv")).read_bytes()
        command = f"(echo before; {PROGRAM} export a.h5 --format csv -o -; echo after) "
        for redirected in ("| cat", "> out; cat out", ">> out2; cat out2"):
            printed = subprocess.run(command + redirected, shell=True, cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
            self.assertEqual(printed, b"before\n" + expected + b"after\n", redirected)
        self.assertFalse((self.folder / "-").exists())
        for format in ("pedpy", "xdmf", "h5md3"):
            self.assertIn(f"{format} needs a file", self.refused("a.h5", "--format", format, "-o", "-"))
        done = subprocess.run(f"{PROGRAM} export a.h5 --format csv -o - >/dev/full", shell=True, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (2, "throng: cannot write -: No space left on device\n"))

    def test_exports_what_a_stopped_run_committed(self):
        self.record_until_killed()
        code, error = self.throng("export", "a.h5.part", "--format", "csv", "-o", "a.csv", "--to", "0.5")
        self.assertEqual((code, error), (0, "throng: a.h5.part is of a run that did not end: these are the frames it committed\n"))
        self.assertEqual(len(self.rows(self.path("a.csv"))), 51 * 4)


class Pedpy(Export):
    """The checks are those of pedpy.io.ped_data_archive_loader."""

    def load(self, path):
        file = h5py.File(path)
        self.assertIn("trajectory", file)
        table = file["trajectory"]
        self.assertLessEqual({"id", "frame", "x", "y"}, set(table.dtype.names))
        self.assertIn("fps", table.attrs)
        self.assertEqual(np.shape(table.attrs["fps"]), ())
        self.assertGreater(table.attrs["fps"], 0)
        self.assertIn("wkt_geometry", file.attrs)
        self.assertIs(type(file.attrs["wkt_geometry"]), str)
        return table[:], table.attrs["fps"], file.attrs["wkt_geometry"]

    def corners(self, wkt):
        """Of a WKT rectangle, which is closed and counter-clockwise: x and y of the least and of the greatest."""
        points = [tuple(map(float, point.split())) for point in re.fullmatch(r"POLYGON \(\((.*)\)\)", wkt)[1].split(",")]
        (x0, y0), _, (x1, y1), _, _ = points
        self.assertEqual(points, [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])
        self.assertTrue(x0 < x1 and y0 < y1)
        return x0, y0, x1, y1

    def test_has_every_position_of_who_moves(self):
        recording = h5py.File(self.record())["particles/trajectory/position/value"][:]
        table, rate, wkt = self.load(self.export("pedpy", "a.ped.h5"))
        self.assertEqual(rate, 100.0)
        self.assertEqual(wkt, "POLYGON ((0 0, 4 0, 4 3, 0 3, 0 0))")
        self.assertEqual(list(table["frame"]), list(np.repeat(np.arange(21), 3)))
        self.assertEqual(list(table["id"]), [2, 3, 4] * 21)  # body 1 is static
        self.assertTrue(np.array_equal(table["x"].reshape(21, 3), recording[:, 1:, 0]))
        self.assertTrue(np.array_equal(table["y"].reshape(21, 3), recording[:, 1:, 1]))

    def test_counts_the_frames_that_it_has(self):
        recording = h5py.File(self.record("a.h5", "--every", "2"))["particles/trajectory/position/value"][:]
        table, rate, _ = self.load(self.export("pedpy", "a.ped.h5", "--from", "0.04", "--every", "4"))
        self.assertAlmostEqual(rate, 12.5, 12)
        self.assertEqual(sorted(set(table["frame"])), [0, 1, 2])
        self.assertTrue(np.array_equal(table["x"].reshape(3, 3), recording[2::4, 1:, 0]))
        self.assertEqual(self.load(self.export("pedpy", "b.ped.h5", "--to", "0"))[1], 50.0)

    def test_has_a_walkable_area_around_the_walls_and_all_that_moves_in_the_unbounded_plane(self):
        text = (self.folder / "three.toml").read_text().replace("domain = { box = [[0, 0], [4, 3]] }", "")
        (self.folder / "three.toml").write_text(text)
        positions = h5py.File(self.record())["particles/trajectory/position/value"][:, 1:]
        x0, y0, x1, y1 = self.corners(self.load(self.export("pedpy", "a.ped.h5"))[2])
        self.assertEqual((x0, y1), (0, 2.9))  # the wall
        self.assertEqual((x1, y0), (positions[..., 0].max() + 0.3, positions[..., 1].min() - 0.3))

    def test_refuses_what_has_no_trajectory(self):
        self.record("a.h5", "--set", 'record.fields=["velocity"]')
        self.assertIn("a.h5 holds no positions, which pedpy can't do without", self.refused("a.h5", "--format", "pedpy", "-o", "p"))
        scene = (self.folder / "three.toml").read_text()
        (self.folder / "three.toml").write_text(scene.replace('material = "ice"', 'material = "ice"\nkind = "static"').replace("spin = 2.0", ""))
        self.record("b.h5", "--set", "bodies.1.velocity=[0.0,0.0]")
        self.assertIn("all bodies are static", self.refused("b.h5", "--format", "pedpy", "-o", "p"))

    def test_refuses_a_span_without_frames(self):
        self.record()
        for options, said in (("--from 1", "a.h5 has no frame from 1 s: its frames go from 0 s to 0.2 s"),
                              ("--to=-1", "a.h5 has no frame to -1 s: its"), ("--from 0.001 --to 0.009", "no frame from 0.001 s to 0.009 s: its"),
                              ("--from 0.1 --to 0.05", "--from 0.1 s is after --to 0.05 s"), ("--from late", "'late' is no number")):
            self.assertIn(said, self.refused("a.h5", "--format", "pedpy", "-o", "p", *options.split()), options)


class Xdmf(Export):
    def data(self, item):
        """What a DataItem stands for, as XDMF defines it; every reference must fit."""
        size = [int(n) for n in item.get("Dimensions").split()]
        if item.get("Format") == "HDF":
            path, name = item.text.split(":")
            values = h5py.File(self.folder / "xml" / path)[name]
            self.assertEqual(list(values.shape), size)
            self.assertEqual(values.dtype.kind, {"Float": "f", "Int": "i"}[item.get("NumberType")])
            self.assertEqual(values.dtype.itemsize, int(item.get("Precision")))
            return values[()]
        self.assertEqual(item.get("ItemType"), "HyperSlab")
        selection, source = item
        start, stride, count = np.array(selection.text.split(), int).reshape([int(n) for n in selection.get("Dimensions").split()])
        slab = self.data(source)[tuple(slice(a, a + s * n, s) for a, s, n in zip(start, stride, count))]
        self.assertEqual(list(slab.shape), list(count), "the selection lies within")
        return slab.reshape(size)

    def grids(self, *options):
        (self.folder / "xml").mkdir(exist_ok=True)
        root = xml.parse(self.export("xdmf", "xml/a.xdmf", *options)).getroot()
        self.assertEqual(root.tag, "Xdmf")
        [series] = root.findall("Domain/Grid")
        self.assertEqual((series.get("GridType"), series.get("CollectionType")), ("Collection", "Temporal"))
        self.assertEqual(series.get("Name"), "three <b>&")
        return series.findall("Grid")

    def check(self, grid, frame, fields):
        recording = h5py.File(self.path("a.h5"))
        trajectory = recording["particles/trajectory"]
        self.assertEqual(float(grid.find("Time").get("Value")), trajectory["position/time"][frame])
        self.assertEqual(grid.find("Topology").get("NumberOfElements"), "4")
        self.assertEqual(grid.find("Geometry").get("GeometryType"), "XY")
        self.assertTrue(np.array_equal(self.data(grid.find("Geometry/DataItem")), trajectory["position/value"][frame]))
        found = {a.get("Name"): self.data(a.find("DataItem")) for a in grid.findall("Attribute")}
        expected = {"id": trajectory["id"][:], "radius": recording["throng/bodies/radius"][:]}
        for axis, name in enumerate(("vx", "vy")):
            expected[name] = trajectory["velocity/value"][frame, :, axis]
        for name in fields:
            expected[name] = trajectory[name]["value"][frame]
        self.assertEqual(set(found), set(expected))
        for name, values in expected.items():
            self.assertTrue(np.array_equal(found[name], values), name)

    def test_points_at_the_numbers_of_the_recording(self):
        self.record()
        grids = self.grids()
        self.assertEqual(len(grids), 21)
        for frame, grid in enumerate(grids):
            self.check(grid, frame, ("angle", "spin"))

    def test_knows_the_precision_and_the_fields(self):
        self.record("a.h5", "--set", 'record.precision="single"', "--set", 'record.fields=["position","velocity"]')
        grids = self.grids("--from", "0.05", "--every", "10")
        self.assertEqual(len(grids), 2)
        for frame, grid in zip((5, 15), grids):
            self.check(grid, frame, ())

    def test_knows_how_many_samples_a_field_has(self):
        path = self.record("a.h5", "--set", 'record.fields=["position"]', "--set", "record.every=3",
                           "--set", 'record.also=[{ every = 2, fields = ["velocity"] }]')
        grids, recording = self.grids(), h5py.File(path)["particles/trajectory"]
        self.assertEqual(len(grids), 7)
        for frame, grid in enumerate(grids):
            self.assertTrue(np.array_equal(self.data(grid.find("Geometry/DataItem")), recording["position/value"][frame]))
            found = {a.get("Name"): self.data(a.find("DataItem")) for a in grid.findall("Attribute")}
            self.assertEqual("vx" in found, frame % 2 == 0)
            if "vx" in found:
                self.assertTrue(np.array_equal(found["vy"], recording["velocity/value"][3 * frame // 2, :, 1]))

    def test_points_by_the_root_out_of_a_pipe(self):
        self.record("a<&.h5")
        printed = subprocess.run([PROGRAM, "export", "a<&.h5", "--format", "xdmf", "-o", "/dev/stdout"], cwd=self.folder,
                                 stdout=subprocess.PIPE, check=True).stdout
        path = next(xml.fromstring(printed).iter("Geometry")).find("DataItem/DataItem[2]").text
        self.assertEqual(path, os.path.realpath(self.path("a<&.h5")) + ":/particles/trajectory/position/value")

    def test_refuses_a_path_that_xml_cannot_say(self):
        self.record()
        for name in (b"a\nb.h5", b"a\x7f.h5", b"\xff.h5"):
            os.rename(os.path.join(os.fsencode(self.folder), b"a.h5"), os.path.join(os.fsencode(self.folder), name))
            self.assertIn("XML names no file whose path", self.refused(os.fsdecode(name), "--format", "xdmf", "-o", "a.xdmf"))
            os.rename(os.path.join(os.fsencode(self.folder), name), os.path.join(os.fsencode(self.folder), b"a.h5"))
        self.record("é.h5")
        self.export("xdmf", "a.xdmf", recording="é.h5")

    def test_refuses_a_recording_that_paraview_would_not_open(self):
        self.record_until_killed()
        with self.assertRaises(OSError):
            h5py.File(self.path("a.h5.part"))
        self.assertIn("a.h5.part was not closed by its run", self.refused("a.h5.part", "--format", "xdmf", "-o", "a.xdmf"))


class H5md3(Export):
    def universe(self, path, bodies):
        try:
            import MDAnalysis
        except ImportError:
            self.fail("python3-mdanalysis is missing: tools/prepare installs it")
        return MDAnalysis.Universe.empty(bodies, trajectory=True).load_new(path, format="H5MD", convert_units=False)

    def check(self, universe, recording, frames, precision):
        trajectory = h5py.File(recording)["particles/trajectory"]
        self.assertEqual(len(universe.trajectory), len(frames))
        for frame, now in zip(frames, universe.trajectory):
            self.assertEqual(now.data["step"], trajectory["position/step"][frame])
            self.assertEqual(now.time, trajectory["position/time"][frame])
            for values, field in ((now.positions, "position"), (now.velocities, "velocity")):
                self.assertTrue(np.array_equal(values[:, :2], trajectory[field]["value"][frame].astype(precision)), field)
                self.assertTrue((values[:, 2] == 0).all())

    def test_is_what_mdanalysis_opens(self):
        recording = self.record()
        universe = self.universe(self.export("h5md3", "a.h5md"), 4)
        self.check(universe, recording, range(21), np.float32)  # MDAnalysis keeps no more
        self.assertIsNone(universe.dimensions)

    def test_says_where_velocities_are_missing(self):
        self.record("a.h5", "--set", "record.every=2", "--set", "record.fields=['position']",
                    "--set", "record.also=[{ every = 3, fields = ['velocity'] }]")
        self.assertEqual(self.throng("export", "a.h5", "--format", "h5md3", "-o", "a.h5md"), (
            0, "throng: warning: a.h5md leaves out velocities, which MDAnalysis wants in every frame: "
               "a.h5 has them each 3 steps, positions each 2\n"))
        self.assertNotIn("velocity", h5py.File(self.path("a.h5md"))["particles/trajectory"])
        steps = h5py.File(self.export("h5md3", "b.h5md", "--every", "3"))["particles/trajectory/velocity/step"]
        self.assertEqual(list(steps), [0, 6, 12, 18], "which have both")

    def test_has_a_box_where_the_domain_is_periodic(self):
        scene = (self.folder / "three.toml").read_text().replace("box =", "periodic =")
        (self.folder / "three.toml").write_text(scene)
        recording = self.record("a.h5", "--set", 'record.precision="single"')
        universe = self.universe(self.export("h5md3", "a.h5md", "--every", "3"), 4)
        self.check(universe, recording, range(0, 21, 3), np.float32)
        for now in universe.trajectory:
            self.assertEqual(list(now.dimensions), [4, 3, 1, 90, 90, 90])

    def test_holds_the_numbers_of_the_recording(self):
        recording = h5py.File(self.record())
        exported = h5py.File(self.export("h5md3", "a.h5md"))
        before, after = recording["particles/trajectory"], exported["particles/trajectory"]
        for field in ("position", "velocity"):
            self.assertTrue(np.array_equal(after[field]["value"][..., :2], before[field]["value"][:]))
            self.assertTrue((after[field]["value"][..., 2] == 0).all())
            self.assertEqual(after[field]["step"], after["position/step"], "a hard link")
            self.assertEqual(after[field]["time"], after["position/time"], "a hard link")
        self.assertEqual(list(after["id"]), [1, 2, 3, 4])
        for name in ("mass", "radius"):
            self.assertTrue(np.array_equal(after[name], recording["throng/bodies"][name]))
        self.assertEqual(list(exported["h5md"].attrs["version"]), [1, 1])
        for who in ("author", "creator"):
            self.assertEqual(exported["h5md"][who].attrs["name"], recording["h5md"][who].attrs["name"])
        self.assertEqual(after["box"].attrs["dimension"], 3)
        self.assertEqual(list(after["box"].attrs["boundary"]), [b"none"] * 3)
        self.assertNotIn("edges", after["box"])


class Lammps(Export):
    def frames(self, path):
        """Of a text dump: step, kinds of borders, bounds, and the table by column."""
        found, lines = [], iter(pathlib.Path(path).read_text().splitlines())
        for line in lines:
            self.assertEqual(line, "ITEM: TIMESTEP")
            step = int(next(lines))
            self.assertEqual(next(lines), "ITEM: NUMBER OF ATOMS")
            bodies = int(next(lines))
            borders = next(lines).removeprefix("ITEM: BOX BOUNDS ")
            bounds = [tuple(map(float, next(lines).split())) for _ in range(3)]
            columns = next(lines).removeprefix("ITEM: ATOMS ").split()
            rows = [next(lines).split() for _ in range(bodies)]
            self.assertEqual({len(row) for row in rows}, {len(columns)})
            found.append((step, borders, bounds, dict(zip(columns, np.array(rows, float).T))))
        return found

    def test_has_every_number_of_the_recording(self):
        file = h5py.File(self.record())
        recording, bodies = file["particles/trajectory"], file["throng/bodies"]
        frames = self.frames(self.export("lammps", "a.dump"))
        self.assertEqual([step for step, *_ in frames], list(recording["position/step"]))
        for frame, (_, borders, bounds, table) in enumerate(frames):
            self.assertEqual((borders, bounds), ("ff ff pp", [(0, 4), (0, 3), (-0.5, 0.5)]))
            self.assertEqual(list(table["id"]), [1, 2, 3, 4])
            self.assertEqual(list(table["type"]), list(bodies["shape"][:] + 1))
            exact = {"x": recording["position/value"][frame, :, 0], "y": recording["position/value"][frame, :, 1],
                     "vx": recording["velocity/value"][frame, :, 0], "vy": recording["velocity/value"][frame, :, 1],
                     "angle": recording["angle/value"][frame], "omegaz": recording["spin/value"][frame],
                     "radius": bodies["radius"], "mass": bodies["mass"]}
            for column, values in exact.items():
                self.assertTrue(np.array_equal(table[column], values), column)
            for column in ("z", "vz", "omegax", "omegay", "quati", "quatj"):
                self.assertTrue((table[column] == 0).all(), column)
            turned = (table["quatw"] + 1j * table["quatk"]) ** 2  # by twice the quaternion's angle
            self.assertLess(abs(turned - np.exp(1j * table["angle"])).max(), 1e-15)
        self.assertGreater(np.ptp(table["angle"]), 0.1, "the sample turns")

    def test_has_the_columns_that_were_recorded(self):
        self.record("a.h5", "--set", 'record.fields=["position"]')
        columns = list(self.frames(self.export("lammps", "a.dump", "--from", "0.2"))[0][3])
        self.assertEqual(columns, ["id", "type", "x", "y", "z", "radius", "mass"])

    def test_has_a_box_in_any_domain(self):
        scene = (self.folder / "three.toml").read_text()
        (self.folder / "three.toml").write_text(scene.replace("box =", "periodic ="))
        self.record()
        self.assertEqual(self.frames(self.export("lammps", "a.dump"))[0][1:3], ("pp pp pp", [(0, 4), (0, 3), (-0.5, 0.5)]))
        (self.folder / "three.toml").write_text(scene.replace("domain = { box = [[0, 0], [4, 3]] }", ""))
        self.record("b.h5")
        _, borders, (x, y, _), table = self.frames(self.export("lammps", "b.dump", recording="b.h5"))[0]
        self.assertEqual(borders, "ss ss pp")
        for bounds, places in ((x, table["x"]), (y, table["y"])):
            self.assertEqual(bounds, ((places - table["radius"]).min(), (places + table["radius"]).max()))

    def test_is_what_mdanalysis_opens(self):
        import MDAnalysis
        recording = h5py.File(self.record())["particles/trajectory"]
        path = self.export("lammps", "a.dump", "--every", "5")
        universe = MDAnalysis.Universe(path, topology_format="LAMMPSDUMP", format="LAMMPSDUMP", convert_units=False)
        self.assertEqual(list(universe.atoms.types), ["2", "1", "1", "1"])
        self.assertEqual(len(universe.trajectory), 5)
        for frame, now in enumerate(universe.trajectory):
            self.assertEqual(now.data["step"], recording["position/step"][5 * frame])
            self.assertTrue(np.array_equal(now.positions[:, :2], recording["position/value"][5 * frame].astype(np.float32)))


class Files(Export):
    FORMATS = ("csv", "pedpy", "xdmf", "h5md3", "lammps")

    def test_that_exist_are_overwritten_by_force_alone(self):
        self.record()
        for format in self.FORMATS:
            (self.folder / "old").write_text("precious")
            text = self.refused("a.h5", "--format", format, "-o", "old")
            self.assertEqual(text, "throng: cannot write old: it exists already; --force overwrites it\n")
            self.export(format, "old", "--force")
            if format in ("pedpy", "h5md3"):
                time.sleep(1.1)  # HDF5 would write the second into the file
            self.assertEqual(self.contents()["old"], pathlib.Path(self.export(format, "new", "--force")).read_bytes())

    def test_that_are_the_recording_are_never_overwritten(self):
        self.record()
        os.link(self.path("a.h5"), self.path("b.h5"))
        for name in ("a.h5", "./a.h5", "b.h5"):
            self.assertIn("it is the recording", self.refused("a.h5", "--format", "csv", "-o", name, "--force"))

    def test_that_the_disk_has_no_room_for_leave_nothing(self):
        self.record("a.h5", "--until", "20")
        limit = f"trap '' XFSZ; ulimit -f 8; exec {PROGRAM} export a.h5 -o old --force --format "
        (self.folder / "old").write_text("precious")
        before = self.contents()
        for format in self.FORMATS:
            done = subprocess.run(["bash", "-c", limit + format], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, (format, done.stderr))
            self.assertRegex(done.stderr, "^throng: cannot write old: .*File too large\n$", format)
            self.assertEqual(self.contents(), before, format)

    def test_that_are_damaged_are_refused_and_leave_nothing(self):
        with h5py.File(self.record(), "r+") as file:
            file["particles/trajectory/position/value"][20, 1, 0] += 1e-9
        for format in self.FORMATS:
            text = self.refused("a.h5", "--format", format, "-o", "new")
            self.assertIn("a.h5 is damaged: frame 20: it does not match its hash", text)

    def test_that_cannot_be_made_are_named(self):
        self.record()
        for format in self.FORMATS:
            self.assertIn("cannot write no/new: No such file", self.refused("a.h5", "--format", format, "-o", "no/new"))
        self.assertIn("not in {csv,pedpy,xdmf,h5md3,lammps}", self.refused("a.h5", "--format", "gsd", "-o", "new"))


if __name__ == "__main__":
    unittest.main()
