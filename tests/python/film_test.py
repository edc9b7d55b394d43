# SPDX-License-Identifier: MIT
"""throng replay --video hands ffmpeg the pictures that --png draws, and ffmpeg makes a film of them."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from program import PROGRAM, Program, terminal

# Takes the pictures like ffmpeg; what it was told, and how many bytes came, it writes down beside them.
FAKE = """#!/usr/bin/python3
import json, os, sys, time
raw = sys.stdin.buffer.read()
open("pictures", "wb").write(raw)
json.dump(sys.argv[1:], open("told", "w"))
open(sys.argv[-1], "wb").write(b"film of %d bytes" % len(raw))
"""


def all_of(terminal_):
    """What it shows until nobody writes to it any more."""
    said = b""
    while True:
        try:
            said += os.read(terminal_, 1 << 16)
        except OSError:
            return said


class Film(Program):
    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()

    def install(self, text):
        (self.folder / "bin/ffmpeg").write_text(text)
        (self.folder / "bin/ffmpeg").chmod(0o755)

    def film(self, *options, path=None):
        """Its exit code and what it said, with this ffmpeg alone on its path."""
        done = subprocess.run([PROGRAM, "replay", "a.h5", *options], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "PATH": path or self.path("bin")})
        self.assertEqual(done.stdout, "")
        return done.returncode, done.stderr

    def files(self):
        return {path.name for path in self.folder.iterdir() if path.is_file()}

    def told(self):
        """The options that ffmpeg was given, and the pictures: picture, row, column, (red, green, blue)."""
        words = json.loads((self.folder / "told").read_text())
        options = dict(zip(words, words[1:]))
        width, height = map(int, options["-video_size"].split("x"))
        raw = np.fromfile(self.folder / "pictures", np.uint8).reshape(-1, height, width, 4)
        return options, raw[..., 2::-1]

    def colours(self, pixels):
        """How many pixels have each colour of their own, no grey: what moves, and the scale of speeds."""
        spread = pixels.astype(int).max(axis=-1) - pixels.astype(int).min(axis=-1)
        return int((spread > 40).sum())

    def test_is_told_what_the_bytes_are(self):
        self.record()
        self.install(FAKE)
        self.assertEqual(self.film("--video", "a.mp4", "--width", "401", "--fps", "50"), (0, ""))
        options, pictures = self.told()
        self.assertEqual({key: options[key] for key in ("-pixel_format", "-framerate", "-i", "-pix_fmt")},
                         {"-pixel_format": "bgr0", "-framerate": "50", "-i": "pipe:0", "-pix_fmt": "yuv420p"})
        self.assertEqual(pictures.shape[0], 11)  # 0.2 s
        self.assertLessEqual(max(pictures.shape[1:3]), 401)
        self.assertTrue(all(size % 2 == 0 for size in pictures.shape[1:3]), "yuv420p takes no odd sizes")
        self.assertEqual((self.folder / "a.mp4").read_bytes(), b"film of %d bytes" % (self.folder / "pictures").stat().st_size)
        self.assertEqual(self.files(), {"three.toml", "a.h5", "a.mp4", "told", "pictures"})

    def test_shows_how_far_it_is_on_a_terminal_and_clears_that_away(self):
        self.record()
        self.install(FAKE)
        master, slave = terminal()
        film = subprocess.Popen([PROGRAM, "replay", "a.h5", "--video", "a.mp4", "--width", "400", "--speed", "0.004"], cwd=self.folder,
                                stderr=slave, env={**os.environ, "PATH": self.path("bin")})
        os.close(slave)
        said = all_of(master).decode()
        self.assertEqual(film.wait(), 0, said)
        bars = said.split("\r\033[K")
        self.assertEqual((bars[0], bars[-1]), ("", ""))
        self.assertRegex(bars[-2], "^█+░* [ 0-9]{3} %  t = 0.[0-9]+ s  [0-9]+ pictures/s  [0-9]+ s left$")
        times = [float(re.search("t = ([0-9.]+)", bar)[1]) for bar in bars[1:-1]]
        self.assertEqual(times, sorted(times))
        self.assertLessEqual(times[-1], 0.2)

    def test_has_the_frames_of_its_times(self):
        """The ball flies: what differs from one picture to the next is where it was and where it is."""
        self.record()
        self.install(FAKE)
        for options, count in (([], 6), (["--fps", "100"], 21), (["--speed", "0.5"], 11), (["--speed", "1e6"], 2)):
            self.assertEqual(self.film("--video", "a.mp4", "--width", "300", *options), (0, ""))
            _, pictures = self.told()
            self.assertEqual(len(pictures), count, options)
            self.assertTrue(all((a != b).any() for a, b in zip(pictures, pictures[1:])), options)
        _, all_of_them = self.film("--video", "a.mp4", "--width", "300", "--fps", "100"), self.told()[1]
        self.film("--video", "a.mp4", "--width", "300", "--fps", "25")
        self.assertTrue((self.told()[1] == all_of_them[::4]).all())
        self.film("--video", "a.mp4", "--width", "300", "--fps", "200")
        self.assertTrue((self.told()[1][::2] == all_of_them).all())

    def test_looks_like_the_picture(self):
        """A recording of one frame: the film's view is that of the picture."""
        self.record("a.h5", "--until", "0")
        self.install(FAKE)
        self.assertEqual(self.film("--video", "a.mkv", "--width", "400", "--png", "a.png"), (0, ""))
        _, [film] = self.told()
        size = f"{film.shape[1]}x{film.shape[0]}"
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", "a.png", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-"],
                             cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
        self.assertTrue((np.frombuffer(raw, np.uint8).reshape(film.shape) == film).all())
        self.assertGreater(self.colours(film), 1000)

    def test_keeps_its_view(self):
        self.record("a.h5", "--until", "1")
        self.install(FAKE)
        self.assertEqual(self.film("--video", "a.mp4", "--width", "400"), (0, ""))
        _, pictures = self.told()
        legend = pictures[:, -40:]
        self.assertTrue((legend == legend[0]).all())
        self.assertGreater(self.colours(legend[0]), 500)

    def test_is_one_that_players_play(self):
        self.assertTrue(shutil.which("ffmpeg"), "ffmpeg is missing: tools/prepare installs it")
        self.record("a.h5", "--until", "1")
        for name, codec in (("a.mp4", "h264"), ("a.mov", "h264"), ("a.mkv", "h264"), ("a.webm", "vp9")):
            self.assertEqual(self.film("--video", name, "--width", "320", path=os.environ["PATH"]), (0, ""))
            probed = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", name],
                                    cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
            [stream] = json.loads(probed)["streams"]
            self.assertEqual((stream["codec_name"], stream["pix_fmt"], stream["r_frame_rate"], stream["nb_read_frames"]),
                             (codec, "yuv420p", "25/1", "26"), name)
            self.assertEqual(stream["width"], 320)
        frames = subprocess.run(["ffmpeg", "-v", "error", "-i", "a.mp4", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                                cwd=self.folder, stdout=subprocess.PIPE, check=True).stdout
        played = np.frombuffer(frames, np.uint8).reshape(26, stream["height"], stream["width"], 3)
        self.install(FAKE)
        self.film("--video", "b.mp4", "--width", "320")
        drawn = self.told()[1]
        difference = np.abs(played.astype(int) - drawn.astype(int)).mean(axis=(1, 2, 3))
        self.assertLess(difference.max(), 3)  # of 255: what the codec loses
        self.assertGreater(np.abs(played[0].astype(int) - drawn[-1].astype(int)).mean(), 1.5 * difference.max())

    def test_needs_ffmpeg(self):
        self.record()
        before = self.files()
        self.assertEqual(self.film("--video", "a.mp4"), (2, "throng: films are made by ffmpeg, which is not installed (Debian: apt install ffmpeg)\n"))
        self.assertEqual(self.files(), before)

    def test_that_ffmpeg_cannot_make_leaves_what_was_there(self):
        self.record()
        (self.folder / "a.mp4").write_text("precious")
        before = self.files()
        for fake, message in (("#!/bin/sh\n/bin/cat >/dev/null; echo no such codec >&2; exit 3\n", "no such codec\nthrong: ffmpeg failed with exit code 3\n"),
                              ("#!/bin/sh\nexit 0\n", "throng: ffmpeg ended before the film did\n"),
                              ("#!/bin/sh\nexit 1\n", "throng: ffmpeg failed with exit code 1\n"),
                              ("#!/bin/sh\nkill -9 $$\n", "throng: ffmpeg was ended by signal 9\n")):
            self.install(fake)
            self.assertEqual(self.film("--video", "a.mp4"), (2, message))
            self.assertEqual(self.files(), before)
            self.assertEqual((self.folder / "a.mp4").read_text(), "precious")

    def test_that_is_interrupted_leaves_nothing(self):
        self.record("a.h5", "--until", "20")
        before = self.files()
        for number in (signal.SIGINT, signal.SIGTERM):
            film = subprocess.Popen([PROGRAM, "replay", "a.h5", "--video", "new.mp4", "--fps", "200"], cwd=self.folder,
                                    stderr=subprocess.PIPE, start_new_session=True)
            while self.files() == before:
                self.assertIsNone(film.poll(), "it came too late")
            time.sleep(0.2)
            os.killpg(film.pid, number) if number == signal.SIGINT else film.send_signal(number)
            self.assertEqual(film.wait(), 130)
            time.sleep(0.5)  # for an ffmpeg that goes on
            with film.stderr as said:
                self.assertNotRegex(said.read(), b"rawvideo|Error|nvalid", "ffmpeg's words of a picture cut short")
            self.assertEqual(self.files(), before)

    def test_of_a_damaged_recording_is_refused(self):
        with h5py.File(self.record(), "r+") as file:
            file["particles/trajectory/position/value"][7, 1, 0] += 1e-9
        before = self.files()
        self.install(FAKE)
        code, error = self.film("--video", "a.mp4")
        self.assertEqual(code, 2)
        self.assertIn("a.h5 is damaged: frame 7", error)
        self.assertEqual(self.files() - {"pictures", "told"}, before)

    def test_refuses_what_makes_no_film(self):
        self.record()
        self.install(FAKE)
        for options, message in (("--video a.gif", "cannot write a.gif: a film's name ends in .mp4, .mov, .mkv or .webm"),
                                 ("--video a.mp4 --png ./a.mp4", "ends in .png"), ("--png a --html ./a", "name the same file"),
                                 ("--fps 25", "give both"),
                                 ("--video a.mp4 --fps 0", "must be a whole number from 1 to 240, not '0'"),
                                 ("--video a.mp4 --speed 0", "must be a number from 1e-09 to 1000000000, not '0'"),
                                 ("--video a.mp4 --speed 1e-9", "at most 1e6 are drawn"),
                                 ("--video no/a.mp4", "cannot write no/a.mp4")):
            code, error = self.film(*options.split())
            self.assertEqual(code, 2, options)
            self.assertIn(message, error)
        self.record("a.h5", "--force", "--set", 'record.fields=["angle"]')
        self.assertEqual(self.film("--video", "a.mp4"), (2, "throng: a.h5 holds no positions: there is nothing to draw\n"))
        self.assertFalse((self.folder / "a.mp4").exists())


if __name__ == "__main__":
    unittest.main()
