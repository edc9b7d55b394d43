# SPDX-License-Identifier: MIT
"""What record asks for beside all of each frame, as the program, its exports and throng_read.py know it."""
import csv
import json
import os
import pathlib
import subprocess
import unittest

import h5py
import numpy as np

from program import PROGRAM, Program
import throng_read


class Selected(Program):
    def whole(self):
        """The same run with all of it in each frame."""
        return throng_read.open(self.record("whole.h5"))

    def selected(self, *record):
        path = self.record("selected.h5", *(word for part in record for word in ("--set", "record." + part)))
        code, said = self.throng("replay", "selected.h5", "--verify")
        self.assertEqual((code, said), (0, ""))
        return throng_read.open(path)

    def test_quantized_positions_are_within_half_a_quantum(self):
        with self.whole() as whole, self.selected("quantize=0.01") as recording:
            self.assertLessEqual(np.abs(recording.position[:] - whole.position[:]).max(), 0.005 * (1 + 1e-9))
            self.assertGreater(np.abs(recording.position[:] - whole.position[:]).max(), 0.002)
            for i in (17, 3, 20, 16, 15, 0, 18, 19):  # each from its key frame
                np.testing.assert_array_equal(recording.frame(i).position, recording.position[:][i])
            np.testing.assert_array_equal(recording.velocity[:], whole.velocity[:])
            with h5py.File(self.path("selected.h5")) as file:
                self.assertNotIn("position", file["particles/trajectory"])
                self.assertIn("key_every", file["throng/quantized"].attrs["how"].decode())

    def test_fields_have_rates_of_their_own(self):
        with self.whole() as whole, self.selected(
                "every=2", "fields=['position']", "also=[{ every = 3, fields = ['velocity', 'angle'] }]") as recording:
            np.testing.assert_array_equal(recording.step, sorted({*range(0, 21, 2), *range(0, 21, 3)}))
            np.testing.assert_array_equal(recording.step[recording.velocity.frames], range(0, 21, 3))
            for field, every in (("velocity", 3), ("position", 2)):
                some = getattr(recording, field)
                np.testing.assert_array_equal(some[some.frames], getattr(whole, field)[::every])
            self.assertIsNone(recording.frame(2).position)
            np.testing.assert_array_equal(recording.frame(2).angle, whole.angle[3])
            with h5py.File(self.path("selected.h5")) as file:
                for field, every in (("position", 2), ("velocity", 3), ("angle", 3)):
                    element = file["particles/trajectory"][field]
                    np.testing.assert_array_equal(element["step"][:], range(0, 21, every))
                    np.testing.assert_array_equal(element["time"][:], 0.01 * np.arange(0, 21, every))
                    self.assertEqual(len(element["value"]), len(element["step"]))

    def test_a_field_is_indexed_by_frame_whatever_its_rate(self):
        with self.whole() as whole, self.selected("every=4", "observables=10", "quantize=1e-6") as recording:
            steps = [0, 4, 8, 10, 12, 16, 20]
            np.testing.assert_array_equal(recording.step, steps)
            for field in (recording.position, recording.velocity):
                exact = whole.position if field is recording.position else whole.velocity
                self.assertEqual(field.shape, (7, 4, 2))
                self.assertEqual([field.index_at(t) for t in (0.099, 0.101, 0.12, 0.2)], [2, 4, 4, 6])
                np.testing.assert_allclose(field[recording.index_at(0.16)], exact[16], atol=1e-6)
                np.testing.assert_allclose(field[field.between(0.08, 0.16), 1:], exact[8:17:4, 1:], atol=1e-6)
                np.testing.assert_allclose(field[-1], exact[20], atol=1e-6)
                for lacks in (3, -4, np.s_[2:5], np.s_[:], [0, 3], recording.index_at(0.1), recording.between(0.08, 0.16)):
                    with self.assertRaisesRegex(throng_read.NotRecorded, "frame 3 has no (position|velocity); .*frames"):
                        field[lacks]
                self.assertRaises(IndexError, field.index_at, 0.21)

    def test_some_bodies_are_recorded(self):
        with self.whole() as whole, self.selected("of.kind='dynamic'") as recording:
            np.testing.assert_array_equal(recording.ids, [2, 3, 4])
            np.testing.assert_array_equal(recording.position[:], whole.position[:, 1:])
            self.assertEqual(list(recording.bodies.kind), 3 * ["dynamic"])

    def test_bodies_outside_the_region_are_not_numbers(self):
        with self.whole() as whole, self.selected("within=[[0.75, 0], [1.8, 3]]") as recording:
            every = whole.position[:]
            inside = (every[..., 0] >= 0.75) & (every[..., 0] <= 1.8)
            self.assertTrue(0 < inside.sum() < inside.size and (inside[0] != inside[-1]).any(), "some come or go")
            np.testing.assert_array_equal(recording.position[:], np.where(inside[..., None], every, np.nan))
            np.testing.assert_array_equal(recording.spin[20], np.where(inside[20], whole.spin[20], np.nan))
            self.assertEqual(repr(recording), "<recording 'three <b>&': 21 frames of up to 4 bodies>")
            for i in range(21):
                frame = recording.frame(i)
                np.testing.assert_array_equal(frame.present, inside[i])
                np.testing.assert_array_equal(frame.ids, [1, 2, 3, 4])
                self.assertTrue(np.isfinite(frame.position[frame.present]).all())
            said = subprocess.run([PROGRAM, "info", self.path("selected.h5")], capture_output=True, text=True, check=True)
            self.assertRegex(said.stdout, "\nbodies +4, that are recorded while they are there\n")
            with h5py.File(self.path("selected.h5")) as file:  # as H5MD has a number of bodies that changes
                ids = file["particles/trajectory/id/value"]
                self.assertEqual(ids.fillvalue, 0)
                self.assertEqual(ids.id.get_create_plist().fill_value_defined(), h5py.h5d.FILL_VALUE_USER_DEFINED)
                for row, some in zip(ids[:], inside):
                    np.testing.assert_array_equal(row[row != ids.fillvalue], np.flatnonzero(some) + 1)

    def test_quantized_positions_of_a_region_are_within_half_a_quantum(self):
        with self.whole() as whole, self.selected("within=[[0.75, 0], [1.8, 3]]", "quantize=0.01") as recording:
            every = whole.position[:]
            inside = (every[..., 0] >= 0.75) & (every[..., 0] <= 1.8)
            self.assertTrue(0 < inside.sum() < inside.size and (inside[0] != inside[-1]).any(), "some come or go")
            for i in (20, 0, 17, *range(21)):
                np.testing.assert_array_equal(np.isnan(recording.position[i]), np.repeat(~inside[i][:, None], 2, axis=1))
                np.testing.assert_allclose(recording.position[i][inside[i]], every[i][inside[i]], atol=0.00501)
            np.testing.assert_array_equal(recording.velocity[:], np.where(inside[..., None], whole.velocity[:], np.nan))
            with h5py.File(self.path("selected.h5")) as file:  # a key frame has the numbers themselves
                np.testing.assert_array_equal(file["throng/quantized/position"][16].any(axis=1), inside[16])
        self.assertEqual(self.throng("resume", "selected.h5", "--until", "0.4", "--progress", "none")[0], 0)
        self.assertEqual(self.throng("replay", "selected.h5", "--verify"), (0, ""))

    def test_frames_without_bodies_hold_no_ids(self):
        with self.whole() as whole, self.selected(
                "every=4", "observables=6", "within=[[0.75, 0], [1.8, 3]]") as recording:
            np.testing.assert_array_equal(recording.step, [0, 4, 6, 8, 12, 16, 18, 20])
            every = whole.position[::4]
            inside = (every[..., 0] >= 0.75) & (every[..., 0] <= 1.8)
            np.testing.assert_array_equal(recording.position[recording.position.frames],
                                          np.where(inside[..., None], every, np.nan))
            with h5py.File(self.path("selected.h5")) as file:
                np.testing.assert_array_equal(file["particles/trajectory/id/step"], range(0, 21, 4))
                self.assertEqual(len(file["particles/trajectory/id/value"]), 6)
            self.assertIsNone(recording.frame(2).present)
            np.testing.assert_array_equal(recording.frame(7).present, inside[5])
        self.assertEqual(self.throng("export", "selected.h5", "--format", "csv", "-o", "a.csv"),
                         (0, "throng: warning: a.csv leaves out observables, which throng_read.py reads\n"))
        with open(self.path("a.csv"), encoding="utf8") as file:
            self.assertEqual({int(row["step"]) % 4 for row in csv.DictReader(file)}, {0})
        self.assertEqual(self.throng("resume", "selected.h5", "--until", "0.4", "--progress", "none")[0], 0)
        self.assertEqual(self.throng("replay", "selected.h5", "--verify"), (0, ""))

    def test_observables_alone_make_the_frames_that_hold_them(self):
        with self.selected("fields=[]", "observables=5") as recording:  # and no word of nothing being recorded
            np.testing.assert_array_equal(recording.step, range(0, 21, 5))
            self.assertEqual(len(recording.observables["momentum"][0]), 5)

    def test_contacts_and_observables_are_read(self):
        with self.whole() as whole, self.selected(
                "fields=['position', 'contacts']", "observables=4") as recording:
            touching = [i for i in range(21) if len(recording.contacts(i).a)]
            self.assertGreater(len(touching), 0)
            first = recording.contacts(touching[0])
            self.assertTrue((first.impulse > 0).all() and (first.b == 0).all(), "the balls meet the floor first")
            np.testing.assert_allclose(first.point[:, 1], 0, atol=0.02)
            kinetic, when = recording.observables["kinetic_energy"]
            np.testing.assert_array_equal(when, 0.01 * np.arange(0, 21, 4))
            m, moving = whole.bodies.mass[1:], whole.velocity[::4, 1:]
            turning = 0.25 * m * 0.3 ** 2 * whole.spin[::4, 1:] ** 2
            np.testing.assert_allclose(kinetic, (0.5 * m * (moving ** 2).sum(2) + turning).sum(1))
            self.assertEqual(recording.observables["momentum"][0].shape, (6, 2))
            self.assertEqual([len(recording.contacts(4 * k).a) for k in range(6)],
                             list(recording.observables["contacts"][0]))

    def test_what_may_not_fit_is_recorded_with_a_warning(self):
        disk = os.statvfs(self.folder)
        steps = int(100 * disk.f_bavail * disk.f_frsize / 40 / 1e4)
        (self.folder / "three.toml").write_text(f"""throng = 1
name = "many"
time = {{ dt = 0.01, until = {0.01 * steps:.2f} }}
[shapes]
ball = {{ disc = {{ radius = 0.3 }} }}
[[bodies]]
shape = "ball"
place = {{ lattice = {{ origin = [0, 0], spacing = [1, 1], size = [100, 100] }} }}
""")
        rehearsal = ("run", "three.toml", "-o", "a.h5", "--dry-run")
        self.assertIn("needs about", self.throng(*rehearsal)[1])
        code, said = self.throng(*rehearsal, "--set", "record.within=[[0, 0], [1, 1]]")
        self.assertEqual(code, 0, said)
        self.assertRegex(said, "^throng: warning: the recording may need about .* MB left; where the disk is full")

    def test_info_tells_of_it(self):
        self.selected("every=2", "fields=['position']", "also=[{ every = 3, fields = ['contacts'] }]",
                      "observables=5", "quantize=0.001", "of.ids=[2, 4]").close()
        info = json.loads(subprocess.run([PROGRAM, "info", self.path("selected.h5"), "--json"],
                                         capture_output=True, check=True).stdout)
        self.assertEqual([info[key] for key in ("bodies", "bodies_of_run", "fields", "rates", "observables",
                                                "quantum", "within")],
                         [2, 4, ["position", "contacts"], [2, 3], 5, 0.001, None])

    def test_csv_leaves_empty_what_a_frame_lacks(self):
        self.selected("every=2", "fields=['position']", "also=[{ every = 3, fields = ['spin'] }]",
                      "within=[[0.75, 0], [1.8, 3]]").close()
        self.assertEqual(self.throng("export", "selected.h5", "--format", "csv", "-o", "a.csv"), (0, ""))
        with open(self.path("a.csv"), encoding="utf8") as file:
            rows = list(csv.DictReader(file))
        self.assertTrue(rows)
        for row in rows:
            self.assertEqual((row["x"] == "", row["spin"] == ""),
                             (int(row["step"]) % 2 != 0, int(row["step"]) % 3 != 0))

    def test_exports_know_it_or_say_why_not(self):
        self.selected("within=[[0.75, 0], [1.8, 3]]").close()
        for form in ("xdmf", "h5md3"):
            self.assertEqual(self.throng("export", "selected.h5", "--format", form, "-o", "a." + form), (0, ""))
        self.assertEqual(self.throng("export", "selected.h5", "--format", "pedpy", "-o", "a.ped.h5"), (0, ""))
        with throng_read.open(self.path("selected.h5")) as recording, h5py.File(self.path("a.ped.h5")) as file:
            self.assertEqual(len(file["trajectory"]), np.isfinite(recording.position[:, 1:, 0]).sum())
        self.record("quantized.h5", "--set", "record.quantize=0.001", "--set", "record.of.ids=[3]")
        code, said = self.throng("export", "quantized.h5", "--format", "xdmf", "-o", "b.xdmf")
        self.assertEqual(code, 2)
        self.assertIn("holds quantized positions, which ParaView can't read in place; csv, pedpy, h5md3 and lammps unpack", said)
        self.assertEqual(self.throng("export", "quantized.h5", "--format", "h5md3", "-o", "b.h5"), (0, ""))
        with h5py.File(self.path("b.h5")) as file, throng_read.open(self.path("quantized.h5")) as recording:
            np.testing.assert_array_equal(file["particles/trajectory/position/value"][..., :2], recording.position[:])
            np.testing.assert_array_equal(file["particles/trajectory/id"][:], [3])

    def test_lammps_has_the_bodies_that_a_frame_has(self):
        """It happened: the others stood there too, as nan, and were counted."""
        self.selected("within=[[0.75, 0], [1.8, 3]]").close()
        self.assertEqual(self.throng("export", "selected.h5", "--format", "lammps", "-o", "a.dump"), (0, ""))
        with throng_read.open(self.path("selected.h5")) as recording:
            present = np.isfinite(recording.position[..., 0])
        frames = pathlib.Path(self.path("a.dump")).read_text().split("ITEM: TIMESTEP\n")[1:]
        self.assertEqual(len(frames), len(present))
        for text, some in zip(frames, present):
            self.assertNotIn("nan", text)
            lines = text.splitlines()
            self.assertEqual(int(lines[2]), some.sum())
            self.assertEqual([int(line.split()[0]) for line in lines[8:]], list(np.flatnonzero(some) + 1))

    def test_pictures_and_queries_take_what_there_is(self):
        self.selected("every=2", "fields=['position']", "also=[{ every = 3, fields = ['velocity'] }]",
                      "within=[[0.75, 0], [1.8, 3]]").close()
        self.assertEqual(self.throng("replay", "selected.h5", "--png", "a.png", "--at", "0.03")[0], 0)
        code, said = self.throng("query", "selected.h5", "--all", "--radius", "9", "--at", "0.09")
        self.assertEqual(code, 0, said)
        self.assertIn("0.08", said)


class Forged(Program):
    def test_ids_behind_the_last_are_refused(self):
        path = self.recorded("a.h5", "within=[[0.75, 0], [1.8, 3]]")
        with h5py.File(path, "r+") as file:
            ids = file["particles/trajectory/id/value"]
            self.assertEqual(list(ids[20, -2:]), [0, 0], "who is away")
            ids[20, -1] = 4
        code, said = self.throng("export", "a.h5", "--format", "csv", "-o", "a.csv")
        self.assertEqual((code, said), (2, "throng: a.h5 is damaged: frame 20: id is not in order\n"))
        with throng_read.open(path) as recording:
            recording.position[19]
            with self.assertRaisesRegex(OSError, "frame 20"):
                recording.position[20]

    def test_times_that_are_not_those_of_the_frames_are_refused(self):
        """A reader that goes by the element's own step and time, as any of H5MD does, would be misled."""
        path = self.recorded("a.h5", "fields=['position', 'contacts']", "also=[{ every = 3, fields = ['velocity'] }]",
                             "observables=4", "within=[[0.75, 0], [1.8, 3]]")
        self.refuses(path, *(f"{element}/{name}" for name in ("step", "time") for element in (
            "particles/trajectory/velocity", "throng/contacts", "particles/trajectory/id", "observables/momentum")))
        self.refuses(self.recorded("b.h5", "every=2", "quantize=0.01"), "throng/quantized/step", "throng/quantized/time")

    def test_rows_that_are_right_for_one_rate_are_refused_for_another(self):
        """Rows to which several elements link are looked at once for each rate."""
        path = self.recorded("a.h5", "also=[{ every = 3, fields = ['angle'] }]", "fields=['position', 'velocity']")
        with h5py.File(path, "r+", libver="latest") as file:
            for name in ("step", "time"):
                del file["particles/trajectory/angle"][name]
                file["particles/trajectory/angle"][name] = file["particles/trajectory/position"][name]
        code, error = self.throng("info", path)
        self.assertEqual((code, error), (2, f"throng: {path} is damaged: the steps and times of samples are not those of their frames\n"))

    def refuses(self, path, *datasets):
        sound = pathlib.Path(path).read_bytes()
        self.assertEqual(self.throng("info", path)[0], 0)
        for wrong in (lambda rows: rows[:], lambda rows: rows[:-1]):
            for name in datasets:
                pathlib.Path(path).write_bytes(sound)
                with h5py.File(path, "r+", libver="latest") as file:
                    own = file[name][:]
                    own[-2] += 1
                    del file[name]
                    file.create_dataset(name, data=wrong(own), chunks=(512,), maxshape=(None,))
                code, error = self.throng("info", path)
                self.assertEqual(code, 2, name)
                self.assertRegex(error, f"^throng: {path} is damaged: (the steps and times of samples are not those of their frames"
                                        r"|(step|time|id) has too few frames)\n$")

    def test_fields_and_ids_of_another_form_are_refused(self):
        """A row of a region may have places that were never written: readers make room for what they know of it."""
        position, angle, ids = (f"particles/trajectory/{element}/value" for element in ("position", "angle", "id"))
        forms = ((position, "f8", (21, 4, 10 ** 9)), (position, "f8", (21, 4, 3)), (position, "f8", (21, 4)),
                 (position, "f8", (21, 5, 2)), (position, "f8", (20, 4, 2)), (position, "i8", (21, 4, 2)),
                 (angle, "f8", (21, 4, 2)), (angle, "f8", (21, 10 ** 9)), (angle, "f8", ()))
        of_ids = ((ids, "u4", (21, 10 ** 9)), (ids, "u4", (21, 4, 2)), (ids, "u4", (20, 4)), (ids, "i8", (21, 4)))
        for path, forged in ((self.recorded("whole.h5"), forms),
                             (self.recorded("region.h5", "within=[[0.75, 0], [1.8, 3]]"), forms + of_ids)):
            sound = pathlib.Path(path).read_bytes()
            self.assertEqual(self.throng("info", path)[0], 0)
            throng_read.open(path).close()
            for name, number, shape in forged:
                with self.subTest(path, name=name, number=number, shape=shape):
                    pathlib.Path(path).write_bytes(sound)
                    with h5py.File(path, "r+", libver="latest") as file:
                        del file[name]
                        chunks = (1, 4, 2)[:len(shape)] if shape else None
                        file.create_dataset(name, shape, number, chunks=chunks, fletcher32=True if shape else None)
                    code, error = self.throng("info", path)
                    self.assertEqual(code, 2, error)
                    said = "claims more than the file can hold" if 10 ** 9 in shape else "has another form"
                    with self.assertRaisesRegex(throng_read.NotARecording, said):
                        throng_read.open(path).close()

    def test_sizes_beyond_those_of_the_file_are_refused(self):
        """A megabyte of zeros, deflated, or nothing at all may claim any number of rows, and any size of chunk."""
        options = ("fields=['position', 'contacts']", "observables=4")
        whole = self.recorded("whole.h5", *options), "f8", {"fletcher32": True}
        quantized = self.recorded("quantized.h5", *options, "quantize=0.01"), "u4", {
            "fletcher32": True, "shuffle": True, "compression": "gzip"}
        for (path, number, filters), name, more in (
                (whole, "particles/trajectory/position/value", (4, 2)), (quantized, "throng/quantized/position", (4, 2)),
                (whole, "throng/contacts/point", (2,)), (whole, "observables/momentum/value", (2,))):
            sound = pathlib.Path(path).read_bytes()
            for rows, chunk, said in ((10 ** 10, (1, *more), "claims more than the file can hold"),
                                      (21, (1 << 22, *more), "chunks (that are too large|of another form)|not stored frame by frame")):
                pathlib.Path(path).write_bytes(sound)
                with h5py.File(path, "r+", libver="latest") as file:
                    del file[name]
                    file.create_dataset(name, (rows, *more), number, chunks=chunk, maxshape=(None, *more), **filters)
                code, error = self.throng("info", path)
                self.assertEqual(code, 2, (name, rows))
                self.assertRegex(error, said)
                with self.assertRaisesRegex((ValueError, OSError), said), throng_read.open(path) as recording:
                    recording.contacts(0), recording.observables
            pathlib.Path(path).write_bytes(sound)

    def recorded(self, name, *record):
        return self.record(name, *(word for part in record for word in ("--set", "record." + part)))

    def check(self, held, wanted, what):
        """A recording of `held` whose scenario says `wanted`, hashes made to fit."""
        for name in self.folder.glob("*.h5"):
            name.unlink()
        with h5py.File(self.recorded("a.h5", *held), "r+") as file, h5py.File(self.recorded("b.h5", *wanted)) as other:
            file["parameters"].attrs.modify("resolved_hash", other["parameters"].attrs["resolved_hash"])
            del file["parameters/resolved"]
            other.copy("parameters/resolved", file["parameters"])
        for command in (("replay", "a.h5", "--verify"), ("resume", "a.h5", "--until", "0.3", "--progress", "none")):
            code, said = self.throng(*command)
            self.assertEqual(code, 2, (command, said))
            self.assertIn(f"a.h5 is inconsistent: its scenario records {what} that its frames do not have", said)

    def test_scenarios_that_want_something_else_recorded_are_refused(self):
        self.check(["of.ids=[1, 2, 3]"], [], "bodies")
        self.check([], ["observables=1"], "observables")
        self.check(["within=[[0, 0], [1, 1]]"], ["within=[[0, 0], [1, 2]]"], "a region")
        self.check(["within=[[0, 0], [1, 1]]"], [], "a region")
        self.check(["quantize=0.001"], ["quantize=0.002"], "a quantum")
        self.check([], ["precision='single'"], "a precision")
        self.check(["fields=['position', 'spin']"], [], "a rate of angle")
        self.check(["also=[{ every = 2, fields = ['contacts'] }]"], ["also=[{ every = 3, fields = ['contacts'] }]"],
                   "a rate of contacts")
        self.check(["every=2"], ["every=4"], "frames")


if __name__ == "__main__":
    unittest.main()
