# SPDX-License-Identifier: MIT
"""Recordings of agents, who leave: as the program, its exports and throng_read.py know them."""
import csv
import json
import pathlib
import shutil
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

    def test_who_arrived_and_when_is_told(self):
        with throng_read.open(self.record()) as recording:
            self.assertEqual(list(recording.arrivals.id), [1, 3])
            self.assertEqual(recording.arrivals.id.dtype, np.uint32)
            np.testing.assert_allclose(recording.arrivals.time, [1.0, 3.0], atol=0.021)
            np.testing.assert_array_equal(recording.arrivals.time, recording.arrivals.step * 0.02)
            whole = recording.arrivals
            self.assertEqual(repr(whole), "<2 arrivals: id, step, time>")
        with throng_read.open(self.record("some.h5", "--every", "100", "--set", "record.of={ ids = [2] }")) as recording:
            np.testing.assert_array_equal(recording.arrivals, whole)
        with throng_read.open(self.record("none.h5", "--until", "0.5")) as recording:
            self.assertEqual(len(recording.arrivals.id), 0)
        self.record("two.h5", "--until", "2", "--checkpoint", "1000")
        self.assertEqual(self.throng("resume", "two.h5", "--until", "6", "--progress", "none")[0], 0)
        with throng_read.open(self.path("two.h5")) as recording:
            np.testing.assert_array_equal(recording.arrivals, whole)

    def info(self, name="a.h5"):
        told = json.loads(subprocess.run([PROGRAM, "info", self.path(name), "--json"], capture_output=True, check=True).stdout)
        (line,) = (line for line in subprocess.run([PROGRAM, "info", self.path(name)], capture_output=True, check=True, text=True)
                   .stdout.splitlines() if line.startswith("arrivals"))
        return told["arrivals"], line

    def test_who_arrived_is_counted_by_info(self):
        self.record("a.h5", "--set", "agents[0].at=[8.31, 1]")
        told, line = self.info()
        self.assertEqual((told["count"], told["first"]), (2, 0.7), "without what rounding leaves")
        self.assertAlmostEqual(told["last"], 3.0, delta=0.021)
        self.assertEqual(line, f"arrivals      2, from 0.7 s to {told['last']:g} s")
        self.record("b.h5", "--until", "0.5")
        self.assertEqual(self.info("b.h5"), ({"count": 0, "first": None, "last": None}, "arrivals      0"))
        (self.folder / "three.toml").write_text("throng = 1\ntime = { until = 0.1 }\n[shapes]\nball = { disc = { radius = 1 } }\n[[bodies]]\nshape = 'ball'\nat = [0, 0]\n")
        self.record("c.h5")
        self.assertEqual(self.info("c.h5"), (None, "arrivals      none"))

    def csv_rows(self, name):
        with open(self.path(name), newline="") as file:
            return list(csv.reader(file))

    def test_who_arrived_stands_beside_the_csv(self):
        with throng_read.open(self.record()) as recording:
            arrivals = recording.arrivals
        export = ("export", "a.h5", "--format", "csv", "-o")
        self.assertEqual(self.throng(*export, "a.csv"), (0, ""))
        names, *rows = self.csv_rows("a.arrivals.csv")
        self.assertEqual(names, ["id", "step", "time"])
        self.assertEqual([int(row[0]) for row in rows], list(arrivals.id))
        self.assertEqual([int(row[1]) for row in rows], list(arrivals.step))
        self.assertEqual([float(row[2]) for row in rows], list(arrivals.time), "to the last bit")
        for options, ids in ((("--to", "2"), ["1"]), (("--from", "2"), ["3"]), (("--to", str(arrivals.time[0])), ["1"]),
                             (("--from", "4", "--to", "5", "--every", "9"), [])):
            self.assertEqual(self.throng(*export, "a.csv", "--force", *options), (0, ""))
            self.assertEqual([row[0] for row in self.csv_rows("a.arrivals.csv")[1:]], ids, options)
        for name, beside in (("b", "b.arrivals"), ("x.y.txt", "x.y.arrivals.txt")):
            self.assertEqual(self.throng(*export, name), (0, ""))
            self.assertEqual(len(self.csv_rows(beside)), 3)

    def test_who_arrived_overwrites_nothing_unasked(self):
        self.record()
        (self.folder / "a.arrivals.csv").write_text("mine")
        self.assertEqual(self.throng("export", "a.h5", "--format", "csv", "-o", "a.csv"),
                         (2, "throng: cannot write a.arrivals.csv: it exists already; --force overwrites it\n"))
        self.assertEqual((self.folder / "a.arrivals.csv").read_text(), "mine")
        self.assertFalse((self.folder / "a.csv").exists())
        self.assertEqual(self.throng("export", "a.h5", "--format", "pedpy", "-o", "a.csv"), (0, ""), "which has no such file")
        shutil.move(self.path("a.h5"), self.path("b.arrivals.csv"))
        self.assertEqual(self.throng("export", "b.arrivals.csv", "--format", "csv", "-o", "b.csv", "--force"),
                         (2, "throng: cannot write b.arrivals.csv: it is the recording\n"))

    def test_who_arrived_is_no_folder(self):
        """It happened: a.csv was written, and then the export failed."""
        self.record()
        (self.folder / "a.arrivals.csv").mkdir()
        for force in ((), ("--force",)):
            self.assertEqual(self.throng("export", "a.h5", "--format", "csv", "-o", "a.csv", *force),
                             (2, "throng: cannot write a.arrivals.csv: it is a folder\n"))
            self.assertEqual(self.throng("export", "a.h5", "--format", "csv", "-o", "a.arrivals.csv", *force),
                             (2, "throng: cannot write a.arrivals.csv: it is a folder\n"))
            self.assertEqual({file.name for file in self.folder.iterdir()}, {"a.h5", "three.toml", "a.arrivals.csv"})

    def test_who_arrived_in_another_run_goes(self):
        self.record()
        export = ("export", "a.h5", "--format", "csv", "-o")
        self.assertEqual(self.throng(*export, "a.csv"), (0, ""))
        with h5py.File(self.path("a.h5"), "r+") as file:
            file["throng/finished"][()] = 0
        (self.folder / "b.arrivals.csv").write_text("mine")
        self.assertEqual(self.throng(*export, "b.csv")[0], 0)
        self.assertEqual((self.folder / "b.arrivals.csv").read_text(), "mine", "unasked, nothing goes")
        self.assertEqual(self.throng("export", "a.h5", "--format", "pedpy", "-o", "b.csv", "--force")[0], 0)
        self.assertEqual((self.folder / "b.arrivals.csv").read_text(), "mine", "of another format")
        self.assertEqual(self.throng(*export, "a.csv", "--force")[0], 0)
        self.assertFalse((self.folder / "a.arrivals.csv").exists())
        shutil.copy(self.path("a.h5"), self.path("c.arrivals.csv"))
        self.assertEqual(self.throng("export", "c.arrivals.csv", "--format", "csv", "-o", "c.csv", "--force")[0], 0)
        self.assertTrue((self.folder / "c.arrivals.csv").exists(), "it is the recording")

    def test_who_arrived_has_no_place_in_a_pipe(self):
        self.record()
        done = subprocess.run([PROGRAM, "export", "a.h5", "--format", "csv", "-o", "-"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr),
                         (0, "throng: warning: the standard output leaves out who arrived, which throng_read.py reads\n"))
        self.assertEqual(len(done.stdout.splitlines()), 502)
        done = subprocess.run([PROGRAM, "export", "a.h5", "--format", "csv", "-o", "/dev/stdout"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("leaves out who arrived", done.stderr)
        self.assertEqual({file.name for file in self.folder.iterdir()}, {"a.h5", "three.toml"})
        (self.folder / "link").symlink_to("again")
        (self.folder / "again").symlink_to("/dev/stdout")
        for name in ("/dev/stdout", "/dev/../dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "link"):  # it happened: /dev/stdout.arrivals
            with open(self.path("out.csv"), "w") as file:
                done = subprocess.run([PROGRAM, "export", "a.h5", "--format", "csv", "--force", "-o", name], cwd=self.folder,
                                      stdout=file, stderr=subprocess.PIPE, text=True)
            self.assertEqual((done.returncode, done.stderr),
                             (0, f"throng: warning: {name} leaves out who arrived, which throng_read.py reads\n"))
            self.assertEqual(len(self.csv_rows("out.csv")), 502)
            self.assertEqual({file.name for file in self.folder.iterdir()}, {"a.h5", "three.toml", "out.csv", "link", "again"})
            self.assertFalse(pathlib.Path("/dev/stdout.arrivals").exists())

    def test_who_arrived_is_verified(self):
        self.record()
        def verified(change):
            shutil.copy(self.path("a.h5"), self.path("b.h5"))
            with h5py.File(self.path("b.h5"), "r+") as file:
                change(file["throng/arrivals"])
            done = subprocess.run([PROGRAM, "replay", "b.h5", "--verify"], cwd=self.folder, capture_output=True, text=True)
            return done.returncode, done.stdout + done.stderr
        def set_step(arrivals):
            arrivals["step"][0] += 1
        def lose_one(arrivals):
            for name in ("id", "step"):
                arrivals[name].resize((1,))
        def lose_an_id(arrivals):
            arrivals["id"].resize((1,))
        def lose_all(arrivals):
            del arrivals["id"]
        self.assertEqual(verified(lambda arrivals: None), (0, "verified: 301 frames\n"))
        def late(arrivals):
            arrivals["step"][-1] = 301
        def early(arrivals):
            arrivals["step"][0] = 0
        def swap(arrivals):
            arrivals["step"][:] = arrivals["step"][:][::-1]
        def twice(arrivals):
            arrivals["id"][:] = 3
        def nobody(arrivals):
            arrivals["id"][0] = 0
        def beyond(arrivals):
            arrivals["id"][-1] = 4
        for change in (set_step, lose_one):
            self.assertEqual(verified(change), (1, "diverged: who arrived, or when, was recorded otherwise than it runs to\n"))
        for change in (lose_an_id, late, early, swap, twice, nobody, beyond):
            said = "throng: b.h5 is damaged: who arrived: no run leaves such lists\n"
            self.assertEqual(verified(change), (2, said))
            for command in (("info", "b.h5"), ("export", "b.h5", "--format", "csv", "-o", "b.csv")):
                self.assertEqual(self.throng(*command), (2, said), "and nothing is written")
            self.assertFalse((self.folder / "b.csv").exists())
            with throng_read.open(self.path("b.h5")) as recording, self.assertRaisesRegex(OSError, "b.h5 is damaged: arrivals: "):
                recording.arrivals
        self.assertEqual(verified(lose_all), (2, "throng: b.h5 is damaged: who arrived: id is missing\n"))

    def test_bodies_that_are_no_agents_never_arrive(self):
        ball = "[shapes]\nball = { disc = { radius = 0.2 } }\n[[bodies]]\nshape = 'ball'\nat = [7, 4]\nkind = 'static'\n"
        with open(self.folder / "three.toml", "a") as file:
            file.write(ball)
        with throng_read.open(self.record()) as recording:
            self.assertEqual(list(recording.arrivals.id), [2, 4])
        with h5py.File(self.path("a.h5"), "r+") as file:
            file["throng/arrivals/id"][0] = 1
        self.assertEqual(self.throng("info", "a.h5"), (2, "throng: a.h5 is damaged: who arrived: no run leaves such lists\n"))
        with throng_read.open(self.path("a.h5")) as recording, self.assertRaisesRegex(OSError, "a.h5 is damaged: arrivals: "):
            recording.arrivals

    def test_who_arrived_is_not_known_of_bodies_nor_of_a_run_that_did_not_end(self):
        self.record()
        unknown = {"count": None, "first": None, "last": None}
        with h5py.File(self.path("a.h5"), "r+") as file:
            finished = file["throng/finished"][()]
            file["throng/finished"][()] = 0
        with throng_read.open(self.path("a.h5")) as recording, self.assertRaisesRegex(throng_read.NotRecorded, "the run hasn't ended"):
            recording.arrivals
        self.assertEqual(self.info(), (unknown, "arrivals      not known: the run has not ended"))
        with h5py.File(self.path("a.h5"), "r+") as file:
            file["throng/finished"][()] = finished
            file["throng"].attrs.modify("version", np.array([1, 9], np.int32))
            del file["throng/arrivals"]
        self.assertEqual(self.info(), (unknown, "arrivals      not known: an older throng wrote the file"))
        with throng_read.open(self.path("a.h5")) as recording, self.assertRaisesRegex(throng_read.NotRecorded, "no agents are in it"):
            recording.arrivals

    def test_whose_group_is_told(self):
        ball = "[shapes]\nball = { disc = { radius = 0.2 } }\n[[bodies]]\nshape = 'ball'\nat = [7, 4]\nkind = 'static'\n"
        random = AGENT.split("\n", 2)[2] + "place.random.within = 'exit'\n"
        (self.folder / "three.toml").write_text(
            CROWD + "".join(AGENT.format(*place) for place in PLACES[:2]) +
            "[[agents]]\ncount = 3\n" + random + "[[agents]]\nappear = { times = [1, 2], together = 2 }\n" + random + ball)
        with throng_read.open(self.record()) as recording:
            self.assertEqual(list(recording.groups), [-1, 0, 1, 2, 2, 2, 3, 3, 3, 3])
        with throng_read.open(self.record("b.h5", "--set", "record.of={ ids = [2, 5, 9] }", "--set", "agents[2].count=2")) as recording:
            self.assertEqual(list(recording.ids), [2, 5, 9])
            self.assertEqual(list(recording.groups), [0, 2, 3])
        with h5py.File(self.path("a.h5"), "r+") as file:
            file["parameters"].attrs.modify("bodies", 11)
        with throng_read.open(self.path("a.h5")) as recording:
            with self.assertRaisesRegex(OSError, "a.h5 is damaged: parameters/resolved: its agents are others"):
                recording.groups

    def test_groups_of_bodies_are_none(self):
        (self.folder / "three.toml").write_text("throng = 1\ntime = { until = 0.1 }\n[shapes]\nball = { disc = { radius = 1 } }\n[[bodies]]\nshape = 'ball'\nat = [0, 0]\n")
        with throng_read.open(self.record()) as recording:
            self.assertEqual(list(recording.groups), [-1])

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

    def test_times_are_said_without_what_rounding_leaves(self):
        """35 * 0.02 is 0.7000000000000001; the frame keeps that, and people read 0.7."""
        done = subprocess.run([PROGRAM, "run", "three.toml", "-o", "a.h5", "--progress", "none", "--until", "0.7",
                               "--set", "agents[0].at=[8.31, 1]"], cwd=self.folder, capture_output=True, text=True)
        for said in ('"time": 0.7,', '"last_arrival": 0.7,'):
            self.assertIn(said, done.stdout)
        self.assertIn("frame 35 (of 0 to 35), at 0.7 s", self.throng("query", "a.h5", "--all", "--radius", "9", "--at", "0.7")[1])
        with throng_read.open(self.path("a.h5")) as recording:
            self.assertEqual(recording.time[35], 35 * 0.02)

    def test_summary_counts_who_arrives_and_lists_who_is_stuck(self):
        """One stands behind one who doesn't want to walk; the block of a third way lets the others arrive."""
        lane = "".join(f"[[walls]]\nsegment = [[0, {y}], [7, {y}]]\n" for y in (0.75, 1.25))
        agents = AGENT.format(3, 1).replace("constant_velocity", "collision_free_speed") + \
            AGENT.format(4, 1).replace("speed = 1.0", "speed = 0") + AGENT.format(8, 1)
        (self.folder / "stuck.toml").write_text(CROWD + agents + lane)
        done = subprocess.run([PROGRAM, "run", "stuck.toml", "--progress", "none", "--until", "30"],
                              cwd=self.folder, capture_output=True, text=True)
        summary = json.loads(done.stdout)
        self.assertEqual((summary["arrived"], summary["inside"], summary["waiting"], summary["wall_corrections"]), (1, 2, 0, 0))
        self.assertAlmostEqual(summary["last_arrival"], 1.0, delta=0.05)
        stuck = summary["stuck_agents"]
        self.assertEqual([one["id"] for one in stuck], [1])
        np.testing.assert_allclose(stuck[0]["position"], [3.6, 1.0], atol=0.3)

    def test_summary_says_by_when_how_many_had_arrived(self):
        for until, quantiles in (("0.5", [None] * 5), ("2", [1.0] * 5), ("8", [1.0, 1.0, 3.0, 7.0, 7.0])):
            done = subprocess.run([PROGRAM, "run", "three.toml", "--progress", "none", "--until", until],
                                  cwd=self.folder, capture_output=True, text=True)
            np.testing.assert_allclose(np.array(json.loads(done.stdout)["arrival_quantiles"], dtype=float), np.array(quantiles, dtype=float), atol=0.03)

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

    def test_pedpy_gets_no_bodies_beside_people(self):
        """It happened: a gate that moves counted as a pedestrian."""
        with open(self.folder / "three.toml", "a") as scene:
            scene.write("[shapes]\ngate = { disc = { radius = 0.3 } }\n[[bodies]]\nshape = 'gate'\nkind = 'kinematic'\n"
                        "at = [7, 4.5]\nvelocity = [0, -0.1]\n")
        self.record()
        self.assertEqual(self.throng("export", "a.h5", "--format", "pedpy", "-o", "a.ped.h5"), (0, ""))
        with throng_read.open(self.path("a.h5")) as recording, h5py.File(self.path("a.ped.h5")) as file:
            self.assertEqual(list(recording.bodies.kind), ["kinematic"] + ["agent"] * 3)
            self.assertEqual(set(file["trajectory"][:]["id"]), {2, 3, 4})

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

    def test_mass_is_that_of_the_model(self):
        """It happened: files and exports said the default of all, whatever social_force.mass was."""
        heavy = AGENT.replace("constant_velocity", "social_force")
        (self.folder / "three.toml").write_text(
            CROWD + heavy.format(2.0, 1.0) + "social_force = { preset = 'calibrated', mass = 75 }\n" + heavy.format(2.0, 4.0) +
            AGENT.format(6.0, 3.0))
        masses = [75, 80, 80]  # the model's own, its default, and of a model that has none
        with throng_read.open(self.record("a.h5", "--dt", "0.01")) as recording:
            self.assertEqual(list(recording.bodies.mass), masses)
        self.assertEqual(self.throng("replay", "a.h5", "--verify"), (0, ""))
        self.assertEqual(self.throng("export", "a.h5", "--format", "h5md3", "-o", "a.h5md"), (0, ""))
        with h5py.File(self.path("a.h5md")) as file:
            self.assertEqual(list(file["particles/trajectory/mass"]), masses)
        self.assertEqual(self.throng("export", "a.h5", "--format", "lammps", "-o", "a.dump", "--to", "0"), (0, ""))
        columns, *rows = (self.folder / "a.dump").read_text().split("ITEM: ATOMS ")[1].splitlines()
        self.assertEqual([float(row.split()[columns.split().index("mass")]) for row in rows], masses)
        with h5py.File(self.path("a.h5"), "r+") as file:
            file["throng/bodies/mass"][0] = 80
        self.assertIn("mass is not that of the scenario", self.throng("replay", "a.h5", "--verify")[1])
        with h5py.File(self.path("a.h5"), "r+") as file:
            file["throng"].attrs.modify("version", np.array([1, 7], np.int32))
        self.assertEqual(self.throng("replay", "a.h5", "--verify"), (0, ""), "as layout 1.7 had it")

    def test_xdmf_points_at_who_is_there(self):
        self.record()
        self.assertEqual(self.throng("export", "a.h5", "--format", "xdmf", "-o", "a.xdmf"), (0, ""))
        with throng_read.open(self.path("a.h5")) as recording:
            times, places, ids, radius = recording.time, recording.position[:], recording.ids, recording.bodies.radius
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
            self.assertEqual(found["radius"].get("Function"), "$0[$1 - 1]")
            all_radii, its_ids = found["radius"]
            self.assertTrue(all_radii.text.endswith(":/throng/bodies/radius"))
            np.testing.assert_array_equal(radius[self.slab(its_ids) - 1], radius[here[frame]])

    def test_xdmf_has_the_radii_of_those_whom_it_shows(self):
        self.record("a.h5", "--set", "record.of.ids=[2, 3]", "--set", "agents[1].radius=0.25", "--set", "record.every=50")
        self.assertEqual(self.throng("export", "a.h5", "--format", "xdmf", "-o", "a.xdmf"), (0, ""))
        radii = [[float(radius) for radius in attribute.find("DataItem").text.split()]
                 for attribute in xml.parse(self.path("a.xdmf")).getroot().iter("Attribute") if attribute.get("Name") == "radius"]
        self.assertEqual(radii, [[0.25, 0.2]] * 3 + [[0.25]] * 4)

    def test_xdmf_has_a_grid_of_no_cells_where_nobody_is(self):
        self.record("a.h5", "--set", "record.within=[[5, 0], [7, 5]]", "--set", "record.every=10")
        self.assertEqual(self.throng("export", "a.h5", "--format", "xdmf", "-o", "a.xdmf"), (0, ""))
        with throng_read.open(self.path("a.h5")) as recording:
            times, present = recording.time, np.isfinite(recording.position[:, :, 0]).sum(axis=1)
        self.assertTrue((present == 0).any() and (present == 1).any())
        grids = {float(grid.find("Time").get("Value")): grid for grid in xml.parse(self.path("a.xdmf")).getroot().iter("Grid")
                 if grid.get("CollectionType") is None}
        self.assertEqual(set(grids), set(times))
        for time, bodies in zip(times, present):
            self.assertEqual(int(grids[time].find("Topology").get("NumberOfElements")), bodies)
            if not bodies:
                self.assertEqual(grids[time].find("Geometry/DataItem").text, "5 0")
                self.assertIsNone(grids[time].find("Attribute"))

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


MEASURED = """
[[measure]]
name = "door"
line = [[5, 0], [5, 5]]
[[measure]]
name = "hall"
area = "hall"
from = 1.0
[[sensors]]
name = "eyes"
radius = 4.5
fov_degrees = 180
every = 50
record = true
"""


class Floor(Program):
    """Areas, queues and walls, which say where agents go."""

    def setUp(self):
        super().setUp()
        hall, cafe = '"POLYGON ((0 0, 8 0, 8 5, 0 5, 0 0), (1 1, 2 1, 2 2, 1 2, 1 1))"', "[[6, 4], [7, 4], [7, 5], [6, 5]]"
        text = CROWD.replace("areas = {", f'areas = {{ hall = {hall}, "café" = {cafe},') + "queues = { till = { line = [[7, 1], [5.5, 1], [5.5, 1.7]], service = 2.5 } }\n"
        text += AGENT.format(2.0, 4.0).replace('"exit"', '[{ queue = "till" }, { wait = "café", for = 1 }, "exit"]')
        text += '[[measure]]\nname = "door"\nline = [[8, 0], [8, 5]]\n[[measure]]\nname = "seats"\narea = "café"\n'
        text += AGENT.split("\n", 2)[0] + "\ncount = 0\nplace.random.within = 'hall'\n" + AGENT.split("\n", 2)[2]  # may come later
        (self.folder / "three.toml").write_text(text)

    def test_is_read(self):
        with throng_read.open(self.record()) as recording:
            self.assertEqual([len(ring) for ring in recording.walkable], [4, 4])
            found = {area.name: (area.use, [ring.tolist() for ring in area.rings]) for area in recording.areas}
            self.assertEqual(found, {"exit": ("goal", [[[9, 0], [10, 0], [10, 5], [9, 5]]]),
                                     "café": ("wait", [[[6, 4], [7, 4], [7, 5], [6, 5]]]),
                                     "hall": ("none", [[[0, 0], [8, 0], [8, 5], [0, 5]], [[1, 1], [2, 1], [2, 2], [1, 2]]])})
            (queue,) = recording.queues
            self.assertEqual(queue[:3], ("till", 0.6, 2.5))
            self.assertEqual(queue.line.tolist(), [[7, 1], [5.5, 1], [5.5, 1.7]])
            door, seats = recording.measures
            self.assertEqual((door.name, door.line.tolist(), door.rings), ("door", [[8, 0], [8, 5]], []))
            self.assertEqual((seats.name, seats.line, [ring.tolist() for ring in seats.rings]), ("seats", None, [[[6, 4], [7, 4], [7, 5], [6, 5]]]))
        info = json.loads(subprocess.run([PROGRAM, "info", self.path("a.h5"), "--json"], capture_output=True, check=True).stdout)
        self.assertEqual(info["areas"], [{"name": area.name, "use": area.use} for area in recording.areas])
        self.assertEqual(info["queues"], [{"name": "till", "spacing": 0.6, "service": 2.5}])
        self.assertEqual(info["walkable"], {"min": [0, 0], "max": [10, 5], "rings": 2})
        self.assertEqual(info["agents"], 1)
        said = subprocess.run([PROGRAM, "info", self.path("a.h5")], capture_output=True, check=True, text=True).stdout
        for line in ("walkable      min 0 0, max 10 5, rings 2", "queues        name till, spacing 0.6, service 2.5"):
            self.assertIn(line + "\n", said)

    def test_is_not_there_without_a_crowd(self):
        (self.folder / "three.toml").write_text("throng = 1\ntime = { until = 0.1 }\n[shapes]\nball = { disc = { radius = 1 } }\n[[bodies]]\nshape = 'ball'\nat = [0, 0]\n")
        with throng_read.open(self.record()) as recording:
            self.assertEqual((recording.walkable, recording.areas, recording.queues, recording.measures), ([], [], [], []))

    def test_is_held_against_the_scenario(self):
        """Checksums are right: somebody wrote these numbers."""
        for table, what in (("throng/walls/points", "wall"), ("throng/walkable/points", "walkable floor"), ("throng/areas/points", "area"),
                            ("throng/areas/use", "area"), ("throng/queues/points", "queue"), ("throng/queues/service", "queue"),
                            ("throng/materials/friction", "material")):
            with h5py.File(self.record("a.h5", "--force"), "r+") as file:
                values = file[table][()]
                values.flat[0] = 0 if table.endswith("use") else values.flat[0] + 0.25
                file[table][...] = values
            self.assertEqual(self.throng("replay", "a.h5", "--verify"),
                             (2, f"throng: a.h5 is damaged: {what} is not that of the scenario\n"), table)

    def test_is_named_where_it_is_unreadable(self):
        for table in ("throng/walls/points", "throng/areas/points", "throng/queues/spacing"):
            with h5py.File(self.record("a.h5", "--force")) as file:
                at = file[table].id.get_chunk_info(0).byte_offset
            content = bytearray((self.folder / "a.h5").read_bytes())
            content[at + 3] ^= 1
            (self.folder / "a.h5").write_bytes(content)
            for command in (("replay", "a.h5", "--verify"), ("info", "a.h5")):
                code, said = self.throng(*command)
                self.assertEqual(code, 2)
                self.assertIn(f"a.h5 is damaged: {table}: cannot read", said)
            with self.assertRaisesRegex(throng_read.NotARecording, table):
                throng_read.open(self.path("a.h5"))


class Measures(Program):
    """What is counted and sensed of the three: 1 is gone after 1 s, 3 after 3 s, 2 passes the door at 3 s."""

    def setUp(self):
        super().setUp()
        text = CROWD + "".join(AGENT.format(*place) for place in PLACES)
        text = text.replace("areas = {", "areas = { hall = [[0, 0], [8, 0], [8, 5], [0, 5]],")
        text = text.replace("walkable", "record = { observables = 25 }\nwalkable")
        (self.folder / "three.toml").write_text(text + MEASURED)

    def test_are_columns_over_time(self):
        with throng_read.open(self.record()) as recording:
            found = recording.observables
            time = found["agents"][1]
            np.testing.assert_array_equal(time, np.arange(13) * 0.5)
            np.testing.assert_array_equal(found["agents"][0], np.where(time < 1, 3, np.where(time < 3, 2, 1)))
            np.testing.assert_array_equal(found["arrived"][0], 3 - found["agents"][0])
            self.assertEqual({name for name in found if "/" in name},
                             {f"measure/door/{c}" for c in ("count", "forward", "back", "flow", "speed")} |
                             {f"measure/hall/{c}" for c in ("count", "density", "speed", "flow")})
            count, speed = found["measure/door/count"][0], found["measure/door/speed"][0]
            passed = recording.position[:, 1, 0] > 5
            self.assertEqual(list(count), [int(passed[25 * k]) for k in range(13)])
            self.assertEqual(list(found["measure/door/forward"][0]), list(count))
            self.assertTrue(np.isnan(speed[count == 0]).all() and np.allclose(speed[count == 1], 1.0, atol=0.2))
            self.assertTrue(np.isnan(found["measure/door/flow"][0]).all())
            # 39 m2 of the hall can be walked on; 3 is in it until it is 8 m from the left.
            x = recording.position[::25, :, 0]
            density = found["measure/hall/density"][0]
            self.assertTrue(np.isnan(density[time <= 1]).all())
            np.testing.assert_allclose(density[time > 1], (x < 8).sum(axis=1)[time > 1] / 39.0)

    def test_end_with_what_the_summary_says(self):
        done = subprocess.run([PROGRAM, "run", "three.toml", "-o", "b.h5"], cwd=self.folder, capture_output=True, text=True)
        summary = json.loads(done.stdout)
        with throng_read.open(self.path("b.h5")) as recording:
            found = recording.observables
            self.assertEqual(found["arrived"][0][-1], summary["arrived"])
            self.assertEqual(found["agents"][0][-1], summary["inside"])
            self.assertEqual(summary["inside"] + summary["arrived"] + summary["waiting"], summary["agents"])
            for column in ("count", "forward", "back", "speed"):
                self.assertEqual(found[f"measure/door/{column}"][0][-1], summary["measure"]["door"][column])
            self.assertEqual(found["measure/hall/count"][0][-1], summary["measure"]["hall"]["count"])

    def test_go_on_with_a_run(self):
        self.record("half.h5", "--until", "3.1", "--checkpoint", "1000")
        code, said = self.throng("resume", "half.h5", "--until", "6", "--progress", "none")
        self.assertEqual((code, said), (0, "throng: going on from the checkpoint at step 155\n"))
        with throng_read.open(self.record("whole.h5")) as whole, throng_read.open(self.path("half.h5")) as half:
            for name, (value, _) in whole.observables.items():
                np.testing.assert_array_equal(value, half.observables[name][0])

    def test_are_verified(self):
        self.record()
        self.assertEqual(self.throng("replay", "a.h5", "--verify"), (0, ""))

    def test_are_densities_by_voronoi_cells_where_they_are_asked_for(self):
        scene = self.folder / "three.toml"
        scene.write_text(scene.read_text().replace('area = "hall"', 'area = "hall"\nvoronoi = { cutoff = 1.0 }')
                         .replace("observables = 25", "observables = 1"))
        done = subprocess.run([PROGRAM, "run", "three.toml", "-o", "a.h5"], cwd=self.folder, capture_output=True, text=True)
        summary = json.loads(done.stdout)["measure"]["hall"]["density_voronoi"]
        with throng_read.open(self.path("a.h5")) as recording:
            density, time = recording.observables["measure/hall/density_voronoi"]
            self.assertTrue(np.isnan(density[time <= 1]).all())
            self.assertGreater(summary, 0.01)
            # What the run adds up is of those who walked, a sample of those who are there then.
            np.testing.assert_allclose(density[time > 1].mean(), summary, rtol=1e-2)
        self.assertEqual(self.throng("replay", "a.h5", "--verify"), (0, ""))
        self.record("half.h5", "--until", "3.1", "--checkpoint", "1000")
        self.assertEqual(self.throng("resume", "half.h5", "--until", "6", "--progress", "none")[0], 0)
        with throng_read.open(self.path("half.h5")) as half:
            np.testing.assert_array_equal(half.observables["measure/hall/density_voronoi"][0], density)

    def test_may_be_named_as_what_a_recording_holds(self):
        names = ("value", "step", "time", ".", "N/S", "50 %", "%2F", "a%41/")
        with open(self.folder / "three.toml", "a") as scene:
            for name in names:
                scene.write(f'[[measure]]\nname = "{name}"\nline = [[5, 0], [5, 5]]\n')
        with throng_read.open(self.record()) as recording:
            for name in names:
                for column in ("count", "forward", "back", "flow", "speed"):
                    np.testing.assert_array_equal(recording.observables[f"measure/{name}/{column}"][0],
                                                  recording.observables[f"measure/door/{column}"][0])

    def test_have_no_place_in_a_table(self):
        self.record("a.h5", "--set", "record.fields=['position', 'contacts']")
        self.assertEqual(self.throng("export", "a.h5", "--format", "csv", "-o", "a.csv"),
                         (0, "throng: warning: a.csv leaves out contacts, observables, what sensors found, which throng_read.py reads\n"))

    def test_sensors_tell_whom_they_found(self):
        with throng_read.open(self.record()) as recording:
            self.assertEqual(recording.sensors, [throng_read.Sensor("eyes", 50, 4.5, 180.0, "none")])
            start, later = recording.sensed("eyes", 0), recording.sensed("eyes", 100)
            self.assertEqual(list(start.who), [1, 2, 3])
            self.assertEqual(start.begin.dtype, np.uint64)
            # Nobody walks yet, and who stands looks all around: 2 and 3 are 4.1 m apart, 1 and 3 2.8 m.
            self.assertEqual([list(start[k]) for k in (1, 2, 3)], [[3], [3], [1, 2]])
            self.assertEqual(list(later.who), [2, 3])
            self.assertEqual((list(later), len(later), 2 in later, 1 in later), ([2, 3], 2, True, False))
            self.assertEqual([list(later[k]) for k in (2, 3)], [[3], []])
            self.assertEqual(list(recording.sensed_frames("eyes")), list(range(0, 301, 50)))
            for said, ask in {
                "frame 49 has no rows of sensor 'eyes'; the nearest that has is 50": lambda: recording.sensed("eyes", 49),
                "frame 100, rows of sensor 'eyes': body 1 was not there": lambda: later[1],
                "no sensor 'ears': there are eyes": lambda: recording.sensed("ears", 0),
                "no sensor 'nose'": lambda: recording.sensed_frames("nose"),
                "no frame 301: they go from 0 to 300": lambda: recording.sensed("eyes", 301),
            }.items():
                self.assertRaisesRegex(throng_read.NotRecorded, "a.h5.*" + said, ask)

    def test_sensors_that_are_elsewhere_or_of_another_form_are_refused(self):
        def crafted(name, change):
            with h5py.File(self.record(name + ".h5"), "r+") as file:
                change(file["throng/sensors"])
            return throng_read.open(self.path(name + ".h5"))

        def soft(sensors):
            sensors.move("0", "kept")
            sensors["0"] = h5py.SoftLink("/throng/sensors/kept")

        def other(sensors):
            who = sensors["0/who"][:].astype("f8")
            del sensors["0/who"]
            sensors["0/who"] = who

        def unsorted(sensors):
            sensors["0/who"][:2] = sensors["0/who"][:2][::-1]

        with self.assertRaisesRegex(throng_read.NotARecording, "no hard link"):
            crafted("soft", soft)
        with crafted("other", other) as recording, self.assertRaisesRegex(OSError, "other.h5 is damaged: frame 0, rows of sensor 'eyes': .*another form"):
            recording.sensed("eyes", 0)
        with crafted("unsorted", unsorted) as recording, self.assertRaisesRegex(OSError, "damaged"):
            recording.sensed("eyes", 0)

if __name__ == "__main__":
    unittest.main()
