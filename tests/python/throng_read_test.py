# SPDX-License-Identifier: MIT
"""tools/python/throng_read.py reads what the program wrote, and nothing else."""
import contextlib
import io
import pathlib
import re
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, SCENE, Program
import throng_read


class ThrongRead(Program):
    def test_tells_what_was_recorded(self):
        with throng_read.open(self.record()) as recording:
            self.assertEqual(recording.name, "three <b>&")
            self.assertEqual(recording.scenario, SCENE)
            self.assertIn("[[bodies]]", recording.resolved)
            self.assertIn("run three.toml", recording.command_line)
            self.assertTrue(recording.complete)
            self.assertEqual(recording.parameters["dt"], 0.01)
            self.assertEqual(recording.parameters["engine"], "native")
            np.testing.assert_array_equal(recording.ids, [1, 2, 3, 4])
            np.testing.assert_array_equal(recording.step, np.arange(21))
            np.testing.assert_array_equal(recording.time, 0.01 * np.arange(21))
            self.assertEqual(recording.observables, {})
            self.assertEqual(repr(recording), "<recording 'three <b>&': 21 frames of 4 bodies>")

    def test_prints_in_a_line_what_it_gives(self):
        (self.folder / "three.toml").write_text(SCENE + '[[sensors]]\nname = "eyes"\nradius = 1.5\nrecord = true\n')
        path = self.record("a.h5", "--set", 'record.fields=["position", "contacts"]', "--set", "record.observables=1")
        with throng_read.open(path) as recording:
            self.assertEqual(repr(recording.bodies),
                             "<4 bodies (3 dynamic, 1 static): shape, material, kind, radius, mass, ids>")
            self.assertEqual(repr(recording.position), "<position: 21 of 21 frames, float64 (4, 2) each>")
            self.assertEqual(repr(recording.spin), "<spin: 0 of 21 frames, float64 (4,) each>")
            self.assertEqual(repr(recording[6]), "<frame of step 6, 0.06 s, 4 of 4 bodies: position>")
            self.assertEqual(repr(recording.sensed("eyes", 6)), "<sensed by 4: 4 ids; who, count, whom, [id]>")
            self.assertEqual(repr(recording.contacts(0)), "<0 contacts: a, b, impulse, point>")
            self.assertEqual(repr(recording.shapes), "[<shape 'ball': disc>, <shape 'brick': polygon>]")
            self.assertRegex(repr(recording.observables), "^<observables: there are contacts, kinetic_energy, .*>$")

    def test_knows_the_bodies_their_shapes_and_materials(self):
        with throng_read.open(self.record()) as recording:
            bodies = recording.bodies
            np.testing.assert_array_equal(bodies.ids, [1, 2, 3, 4])
            self.assertEqual([recording.shapes[s].name for s in bodies.shape], ["brick"] + 3 * ["ball"])
            self.assertEqual([recording.materials[m].name for m in bodies.material], ["default"] + 3 * ["ice"])
            self.assertEqual(list(bodies.kind), ["static"] + 3 * ["dynamic"])
            np.testing.assert_allclose(bodies.radius, [0.13 ** 0.5, 0.3, 0.3, 0.3])
            np.testing.assert_allclose(bodies.mass[1:], np.pi * 0.09)
            brick = next(shape for shape in recording.shapes if shape.name == "brick")
            self.assertEqual(brick.kind, "polygon")
            self.assertAlmostEqual(brick.area, 0.24 - 0.04)
            np.testing.assert_allclose(brick.outline, [[-.3, -.2], [.3, -.2], [.3, .2], [-.3, .2]])
            np.testing.assert_allclose(brick.holes, [[[-.1, -.1], [-.1, .1], [.1, .1], [.1, -.1]]])
            self.assertEqual([(len(vertices), radius) for vertices, radius in brick.parts], 4 * [(4, 0.0)])
            self.assertEqual([shape.holes for shape in recording.shapes if shape.name == "ball"], [[]])
            self.assertEqual([m.friction for m in recording.materials if m.name == "ice"], [0.1])
            self.assertEqual(recording.domain.kind, "box")
            np.testing.assert_array_equal(recording.domain.max, [4, 3])
            np.testing.assert_array_equal(recording.walls[0].points, [[0, 2.9], [1, 2.9]])

    def test_gives_frames_by_index_slice_list_and_time(self):
        path = self.record()
        with h5py.File(path) as file, throng_read.open(path) as recording:
            everything = file["particles/trajectory/position/value"][:]
            position = recording.position
            self.assertEqual(position.shape, everything.shape)
            for key in (0, 7, -1, np.int64(3), np.s_[:], np.s_[2:9:3], np.s_[::-4], np.s_[5:5], np.s_[-2:],
                        np.s_[3, 1], np.s_[2:5, 1:3], np.s_[..., 0], np.s_[:, [2, 0], 1], [4, -2],
                        np.arange(21) % 5 == 0):
                np.testing.assert_array_equal(position[key], everything[key], err_msg=str(key))
            np.testing.assert_array_equal(np.asarray(position), everything)
            np.testing.assert_array_equal(list(position), everything)
            for key in (21, -22):
                self.assertRaises(IndexError, lambda: position[key])
            for time in (0.1, 2.5, np.float64(3)):  # it happened: 2.5 s was taken for frame 2
                self.assertRaises(TypeError, lambda: position[time])
                self.assertRaises(TypeError, lambda: recording[time])
            self.assertEqual([recording.index_at(t) for t in (0, 0.104, 0.106, 0.2)], [0, 10, 11, 20])
            for outside in (-0.01, 0.21, np.nan):
                self.assertRaises(IndexError, recording.index_at, outside)
            self.assertEqual(recording.between(recording.time[3], recording.time[5]), slice(3, 6))

    def test_finds_the_earlier_of_two_equally_near_frames(self):
        with throng_read.open(self.record("a.h5", "--dt", "0.25", "--until", "1", "--substeps", "100")) as recording:
            self.assertEqual([recording.index_at(t) for t in (0.125, 0.375)], [0, 1])

    def test_gives_all_of_a_frame(self):
        path = self.record()
        with h5py.File(path) as file, throng_read.open(path) as recording:
            frame = recording[6]
            self.assertEqual((frame.step, frame.time), (6, 0.06))
            self.assertEqual(frame.hash, file["throng/frames/state_hash"][6])
            for field in ("position", "angle", "velocity", "spin"):
                np.testing.assert_array_equal(getattr(frame, field),
                                              file[f"particles/trajectory/{field}/value"][6])
            np.testing.assert_array_equal(frame.ids, [1, 2, 3, 4])
            self.assertTrue(frame.present.all())
            self.assertEqual([frame.step for frame in recording], list(range(21)))

    def test_has_none_where_a_field_was_not_recorded(self):
        path = self.record("a.h5", "--set", 'record.fields=["angle"]', "--every", "5")
        with throng_read.open(path) as recording:
            self.assertEqual((len(recording.position.frames), recording[0].velocity), (0, None))
            self.assertEqual(recording.angle.shape, (5, 4))
            np.testing.assert_array_equal(recording.step, [0, 5, 10, 15, 20])

    def test_says_in_one_way_what_is_not_there(self):
        path = self.record("a.h5", "--every", "2", "--set", "record.observables=5", "--set", 'record.fields=["position"]',
                           "--set", 'record.also=[{ every = 6, fields = ["contacts", "velocity"] }]')
        with throng_read.open(path) as recording:  # steps 0 2 4 5 6 8 10 12 14 15 16 18 20
            self.assertEqual(list(recording.contact_frames), [0, 4, 7, 11])
            self.assertNotIn("agents", recording.observables)
            for said, ask in {
                "frame 3 has no contacts; the nearest that has is 4": lambda: recording.contacts(3),
                "frame 6 has no contacts; the nearest that has is 7": lambda: recording.contacts(6),
                "frame 3 has no velocity; velocity.frames are": lambda: recording.velocity[3],
                "frame 12 has no velocity; ": lambda: recording.velocity[[0, -1]],
                "no spin: it was not recorded": lambda: recording.spin[0],
                "no angle: it was not recorded": lambda: recording.angle.index_at(0.1),
                "no angle: it was not recorded ": lambda: recording.angle.between(0, 0.1),
                "no angle: it was not recorded  ": lambda: recording.angle[:],
                "no sensor 'eyes': none was recorded": lambda: recording.sensed("eyes", 0),
                "no observable 'nope': there are contacts, ": lambda: recording.observables["nope"],
                "no frame 13: they go from 0 to 12": lambda: recording.contacts(13),
                "no frame -14: ": lambda: recording.contacts(-14),
                "no frame 13: ": lambda: recording.position[13],
                "no frame 99: ": lambda: recording.position[[0, 99]],
                "no frame 14: ": lambda: recording[14],
                "0.21 s is outside of it, it goes from 0 to 0.2 s": lambda: recording.index_at(0.21),
                "0.19 s is outside of it, it goes from 0 to 0.18 s": lambda: recording.velocity.index_at(0.19),
                "1 to 2 s is outside of it": lambda: recording.between(1, 2),
                "-2 to -1 s is outside of it": lambda: recording.position.between(-2, -1),
                "nan s is outside of it": lambda: recording.index_at(np.nan),
            }.items():
                with self.subTest(said), self.assertRaises(throng_read.NotRecorded) as caught:
                    ask()
                self.assertIn(said.strip(), str(caught.exception))
                self.assertTrue(str(caught.exception).startswith(path), caught.exception)
                self.assertIsInstance(caught.exception, (IndexError, KeyError))
            self.assertEqual(list(recording.velocity.between(0.05, 0.05)), [])
            self.assertEqual(recording.between(0.03, 0.035), slice(2, 2))
            self.assertEqual(list(recording.velocity.between(-1, 9)), [0, 4, 7, 11])
            self.assertRaisesRegex(ValueError, "goes back in time", recording.between, 2, 1)

    def test_gives_observables_at_the_times_of_their_frames(self):
        path = self.record("a.h5", "--set", "record.observables=8")
        with h5py.File(path, "r+") as file:
            file["observables/momentum/time"][1] = 0.5
        with throng_read.open(path) as recording:
            value, when = recording.observables["momentum"]
            np.testing.assert_array_equal(when, [0, 0.08, 0.16])
            self.assertEqual(value.shape, (3, 2))

    @staticmethod
    def frames_so_far(part):
        try:
            with throng_read.open(part) as recording:
                return len(recording)
        except (FileNotFoundError, throng_read.NotARecording):  # not there yet, or being made
            return 0

    def test_reads_what_a_killed_run_committed_and_no_more(self):
        run = subprocess.Popen([PROGRAM, "run", "three.toml", "-o", "b.h5", "--progress", "none", "--until", "3e4"],
                               cwd=self.folder, stdout=subprocess.DEVNULL)
        part = pathlib.Path(self.path("b.h5.part"))
        while self.frames_so_far(part) < 100:
            self.assertIsNone(run.poll(), "the run ended before it was killed")
            time.sleep(0.02)
        run.send_signal(signal.SIGKILL)
        run.wait()
        with h5py.File(part, "r", libver="latest", swmr=True) as file, throng_read.open(part) as recording:
            self.assertFalse(recording.complete)
            self.assertGreaterEqual(len(recording), 100)
            self.assertEqual(len(recording), np.count_nonzero(file["throng/frames/frame_hash"]))
            self.assertEqual(recording.position.shape[0], len(recording))
            self.assertTrue((recording.position[-1] > 0).all())
        whole = self.record("c.h5", "--until", "1")
        with throng_read.open(whole) as uninterrupted, throng_read.open(part) as recording:
            np.testing.assert_array_equal(recording.position[:100], uninterrupted.position[:100])
            np.testing.assert_array_equal(recording.hash[:100], uninterrupted.hash[:100])

    def test_hides_frames_whose_hash_row_does_not_stand(self):
        path = self.record()
        with h5py.File(path, "r+") as file:
            file["throng/finished"][()] = 0
            file["throng/frames/frame_hash"][18:] = 0
        with throng_read.open(path) as recording:
            self.assertEqual((len(recording), len(recording.position), len(recording.time)), (18, 18, 18))
            self.assertRaises(IndexError, lambda: recording.position[18])


class Readme(Program):
    def test_example_runs_as_it_stands(self):
        text = (pathlib.Path(__file__).parents[2] / "README.md").read_text()
        (self.folder / "rain.toml").write_text(re.search(r"```toml\n(.*?)```", text, re.S)[1])
        names = self.example(text)
        self.assertEqual(names["last"].shape, (1000 + 9, 2))
        self.assertEqual(len(names["speed"]), 101)
        self.assertGreater(names["speed"].min(), 1)  # m/s: it falls
        rates = self.example(text, "--force", "--every", "4", "--set", "record.observables=10",
                             "--set", "record.fields=['position', 'angle']", "--set",
                             "record.also=[{ every = 100, fields = ['velocity'] }]")
        np.testing.assert_array_equal(rates["speed"], names["speed"][[0, -1]])

    def example(self, text, *options):
        """What it makes of a run."""
        code, said = self.throng("run", "rain.toml", "-o", "rain.h5", "--until", "3", "--progress", "none", *options)
        self.assertEqual((code, said), (0, ""))
        names = {}
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(io.StringIO()):
            exec(re.search(r"```python\n(.*?)```", text, re.S)[1], names)
        return names


class Refusals(Program):
    def refused(self, path, why):
        with self.assertRaises(throng_read.NotARecording) as caught:
            throng_read.open(path)
        self.assertIn(why, str(caught.exception))
        self.assertIn(str(path), str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_refuses_what_is_no_recording(self):
        self.refused(self.path("three.toml"), "is no HDF5 file")
        (self.folder / "empty.h5").write_bytes(b"")
        self.refused(self.path("empty.h5"), "is no HDF5 file")
        for libver, name in (("earliest", "old.h5"), ("latest", "new.h5")):
            with h5py.File(self.path(name), "w", libver=libver) as file:
                file["particles/trajectory/position/value"] = np.zeros((3, 4, 2))
            self.refused(self.path(name), "is HDF5 but not throng's")
        with self.assertRaisesRegex(FileNotFoundError, "No such file.*no.h5") as caught:
            throng_read.open(self.path("no.h5"))
        self.assertNotIn(".part", str(caught.exception))
        (self.folder / "no.h5.part").touch()
        for path in (self.path("no.h5"), self.folder / "no.h5"):
            self.assertRaisesRegex(FileNotFoundError, "no.h5.part has the frames of a run that did not end", throng_read.open, path)

    def test_refuses_a_newer_layout(self):
        path = self.record()
        with h5py.File(path, "r+") as file:
            file["throng"].attrs["version"] = np.array([2, 0], np.int32)
        self.refused(path, "written by a newer throng: its layout is 2")

    def test_refuses_half_a_file(self):
        path = self.record()
        whole = pathlib.Path(path).read_bytes()
        for size in range(12, len(whole), len(whole) // 20):
            pathlib.Path(path).write_bytes(whole[:size])
            self.refused(path, f"is cut short: {size} of {len(whole) if size >= 36 else 48} bytes are there; copy it once more")

    def test_refuses_crafted_files(self):
        def replaced(name, make):
            def edit(file):
                del file[name]
                make(file, name)
            return edit

        secret = self.path("secret")
        pathlib.Path(secret).write_bytes(bytes(4096))
        hash_, value = "throng/frames/frame_hash", "particles/trajectory/position/value"
        for why, edit in {
            "is no hard link": replaced(hash_, lambda f, n: f.__setitem__(n, h5py.SoftLink("/throng/frames/step"))),
            "is no dataset of its own": replaced(value, lambda f, n: f.create_dataset(
                n, (21, 4, 2), "f8", external=[(secret, 0, h5py.h5f.UNLIMITED)])),
            "claims more than the file can hold": replaced(hash_, lambda f, n: f.create_dataset(
                n, (10**12,), "u8", chunks=(1000,))),
            "has another form": replaced(value, lambda f, n: f.create_dataset(n, (20, 4, 2), "f8")),
            "has holes": lambda f: f[hash_].__setitem__(5, 0),
            "differ in length": lambda f: f["throng/frames/step"].resize((20,)),
            "frames is wrong": lambda f: f["throng/frames/time"].__setitem__(4, 0.5),
        }.items():
            path = self.record("a.h5", "--force")
            with h5py.File(path, "r+") as file:
                edit(file)
            self.refused(path, why)

    def test_takes_no_memory_for_what_cannot_be_there(self):
        path = self.record("a.h5", "--set", 'record.fields=["position", "contacts"]', "--set", "record.observables=1",
                           "--set", "record.quantize=0.001")
        with h5py.File(path, "r+") as file:
            file["throng/contacts/a"].resize((10**12,))
            file["throng/contacts/offset"][1] = 10**12
            file["observables/momentum/value"].resize((10**12, 2))
        with throng_read.open(path) as recording:
            for read in (lambda: recording.contacts(0), lambda: recording.observables):
                self.assertRaisesRegex(OSError, "a.h5 is damaged: .*claims more than the file can hold", read)
        with h5py.File(path, "r+") as file:
            del file["throng/quantized/position"]
            file["throng/quantized"].create_dataset("position", (21, 4, 2), "u4", chunks=(21, 4, 2), compression=1)
        self.refused(path, "has chunks of another form")

    def test_never_shows_a_damaged_frame_as_if_it_were_right(self):
        path = self.record()
        with h5py.File(path) as file:
            at = file["particles/trajectory/position/value"].id.get_chunk_info_by_coord((4, 0, 0)).byte_offset
        content = bytearray(pathlib.Path(path).read_bytes())
        content[at + 5] ^= 1
        pathlib.Path(path).write_bytes(content)
        with throng_read.open(path) as recording:
            recording.position[3], recording.position[5]
            for some in (4, np.s_[3:6]):
                with self.assertRaisesRegex(OSError, "a.h5 is damaged: frame 4, position: "):
                    recording.position[some]


if __name__ == "__main__":
    unittest.main()
