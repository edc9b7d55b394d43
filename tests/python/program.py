# SPDX-License-Identifier: MIT
"""The program as its users run it, in a folder of the test's own that goes with it."""
import os
import pathlib
import pty
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["THRONG_PROGRAM"]
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "tools/python"))

SCENE = """throng = 1
name = "three <b>&"
gravity = [0.0, -9.81]
time = { dt = 0.01, until = 0.2, substeps = 2 }
domain = { box = [[0, 0], [4, 3]] }
record = { fields = ["position", "angle", "velocity", "spin"] }
[materials.ice]
friction = 0.1
[shapes]
ball = { disc = { radius = 0.3 } }
brick = { polygon = [[0, 0], [0.6, 0], [0.6, 0.4], [0, 0.4]], holes = [[[0.2, 0.1], [0.4, 0.1], [0.4, 0.3], [0.2, 0.3]]] }
[[bodies]]
shape = "brick"
at = [3.5, 2.5]
kind = "static"
[[bodies]]
shape = "ball"
material = "ice"
place = { lattice = { origin = [0.7, 0.4], spacing = [1.0, 1.0], size = [3, 1] } }
velocity = [1.0, 0.4]
spin = 2.0
[[walls]]
segment = [[0, 2.9], [1, 2.9]]
"""


def terminal():
    """Both ends of a terminal. A machine that has none to give, as a bare chroot, skips the test and says so."""
    try:
        return pty.openpty()
    except OSError as error:
        raise unittest.SkipTest(f"this machine gives no pseudo-terminal: {error}") from error


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="throng-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "three.toml").write_text(SCENE)

    def path(self, name):
        return str(self.folder / name)

    def throng(self, *arguments):
        """Its exit code and what it said on stderr."""
        done = subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)
        return done.returncode, done.stderr

    def record(self, name="a.h5", *options):
        self.assertEqual(self.throng("run", "three.toml", "-o", name, "--progress", "none", *options), (0, ""))
        return self.path(name)
