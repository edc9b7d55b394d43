# SPDX-License-Identifier: MIT
"""throng replay --speed plays in a terminal, here one of pyte's, and leaves it as it was."""
import fcntl
import json
import os
import re
import select
import signal
import struct
import subprocess
import termios
import time
import unittest

import pyte

from program import PROGRAM, Program, terminal

ENTER, LEAVE = b"\033[?1049h\033[?25l\033[2J", b"\033[0m\033[?25h\033[?1049l"

TWO = """throng = 1
name = "two"
time = { dt = 0.01, until = 1.0, substeps = 1 }
domain = { box = [[0, 0], [9, 4]] }
[shapes]
ball = { disc = { radius = 1.0 } }
brick = { polygon = [[0, 0], [2, 0], [2, 2], [0, 2]] }
[[bodies]]
shape = "ball"
at = [1.5, 2]
velocity = [3, 0]
[[bodies]]
shape = "brick"
at = [7.5, 2.0]
kind = "static"
[[walls]]
segment = [[4.5, 0], [4.5, 0.8]]
"""

FRAME = """throng = 1
name = "frame"
time = { dt = 0.01, until = 0.1 }
domain = { box = [[0, 0], [6, 4]] }
[shapes]
frame = { polygon = [[0, 0], [5, 0], [5, 3], [0, 3]], holes = [[[1, 1], [4, 1], [4, 2], [1, 2]]] }
[[bodies]]
shape = "frame"
at = [3, 2]
kind = "static"
"""

BAR = """throng = 1
name = "bar"
time = { dt = 0.01, until = 0.1 }
domain = { box = [[0, 0], [6, 4]] }
record = { fields = ["position"] }
[shapes]
bar = { polygon = [[0, 0], [1, 0], [1, 3], [0, 3]] }
[[bodies]]
shape = "bar"
at = [3, 2]
angle = 1.5707963267948966
kind = "static"
"""

FLOOR = """throng = 1
name = "floor"
time = { dt = 0.05, until = 0.1 }
walkable = "POLYGON ((0 0, 10 0, 10 5, 0 5, 0 0))"
[shapes]
post = { disc = { radius = 0.2 } }
[[bodies]]
shape = "post"
kind = "static"
at = [7, 2]
[areas]
start = [[1, 1], [3, 1], [3, 4], [1, 4]]
narrow = [[0.2, 0.2], [0.7, 0.2], [0.7, 0.7], [0.2, 0.7]]
exit = [[8, 1], [10, 1], [10, 4], [8, 4]]
bench = [[4, 2.5], [6, 2.5], [6, 4.5], [4, 4.5]]
[queues]
till = { line = [[6, 1.5], [4, 1.5]], service = 1 }
[[agents]]
count = 2
place = { random = { within = "start" } }
model = "constant_velocity"
goal = [{ queue = "till" }, { wait = "bench", for = 1 }, "exit"]
"""


class Session:
    """The program in a terminal of its own."""

    def __init__(self, folder, *arguments, columns=80, rows=24, kind="xterm-256color", ignored=None):
        self.columns, self.rows, self.ignored = columns, rows, ignored
        self.master, self.slave = terminal()
        self.resize(columns, rows)
        self.before = termios.tcgetattr(self.slave)
        self.process = subprocess.Popen([PROGRAM, *arguments], cwd=folder, stdin=self.slave, stdout=self.slave, stderr=self.slave,
                                        preexec_fn=self.take_terminal, env={**os.environ, "TERM": kind})
        self.said = b""

    def take_terminal(self):
        os.setsid()
        fcntl.ioctl(self.slave, termios.TIOCSCTTY, 0)
        if self.ignored:
            signal.signal(self.ignored, signal.SIG_IGN)

    def resize(self, columns, rows):
        fcntl.ioctl(self.slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def listen(self, until=lambda said: False):
        """Takes what it says until that is enough or it has ended."""
        while not until(self.said):
            ended = self.process.poll() is not None
            if select.select([self.master], [], [], 0 if ended else 0.02)[0]:
                self.said += os.read(self.master, 1 << 16)
            elif ended:
                break
        return self.said

    def end(self):
        """Its exit code, the screen that it played on as it was last, and that which it left behind."""
        played, left = self.listen().split(LEAVE)
        restored = termios.tcgetattr(self.slave) == self.before
        os.close(self.master)
        os.close(self.slave)
        assert restored, "echo is back"
        return self.process.returncode, self.screen(played), self.screen(left, 1)

    def screen(self, said, more=0):
        screen = pyte.Screen(self.columns, self.rows + more)
        pyte.ByteStream(screen).feed(said)
        return screen


def lines(screen):
    return [line.rstrip() for line in screen.display]


class Terminal(Program):
    def play(self, recording, speed, **terminal):
        return Session(self.folder, "replay", recording, "--speed", speed, **terminal)

    def two(self, *options):
        (self.folder / "two.toml").write_text(TWO)
        self.assertEqual(self.throng("run", "two.toml", "-o", "two.h5", "--progress", "none", *options), (0, ""))

    def test_shows_the_last_picture_and_leaves_it_behind(self):
        """28 dots for 4 m and margins of 0.18 m: 12.8 dots for the ball of 2 m, half of one less all around."""
        self.two()
        code, played, left = self.play("two.h5", "1e6", columns=70, rows=9).end()
        self.assertEqual(code, 0)
        self.assertEqual(lines(played), [
            "two                                     t = 1.000 s of 1.000 s  x1e+06",
            "                    ⡏⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⢹",
            "                    ⡇                            ⢸",
            "                    ⡇           ⢠⣶⣿⣿⣶⡄   ⢸⣿⣿⣿⣿⣿⡇ ⢸",
            "                    ⡇           ⣿⣿⣿⣿⣿⣿   ⢸⣿⣿⣿⣿⣿⡇ ⢸",
            "                    ⡇           ⠘⠿⣿⣿⠿⠃   ⢸⣿⣿⣿⣿⣿⡇ ⢸",
            "                    ⡇              ⡆             ⢸",
            "                    ⣇⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣇⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣸",
            "2 bodies   kinetic 14.14 J without spin   deepest overlap 0 m   ======",
        ])
        self.assertEqual(lines(left), lines(played) + [""])
        self.assertFalse(left.cursor.hidden)

    def test_shows_a_polygon_without_its_seams_and_with_its_holes(self):
        (self.folder / "frame.toml").write_text(FRAME)
        self.assertEqual(self.throng("run", "frame.toml", "-o", "frame.h5", "--progress", "none"), (0, ""))
        _, played, _ = self.play("frame.h5", "1e6", columns=40, rows=9).end()
        self.assertEqual(lines(played)[1:8], [
            "         ⢸⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⠉⡇",
            "         ⢸  ⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶⣶  ⡇",
            "         ⢸  ⣿⣿⣿⠛⠛⠛⠛⠛⠛⠛⠛⠛⠛⣿⣿⣿  ⡇",
            "         ⢸  ⣿⣿⣿          ⣿⣿⣿  ⡇",
            "         ⢸  ⣿⣿⣿⣤⣤⣤⣤⣤⣤⣤⣤⣤⣤⣿⣿⣿  ⡇",
            "         ⢸  ⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿⠿  ⡇",
            "         ⢸⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⣀⡇",
        ])

    def test_shows_who_has_no_angle_in_this_frame_as_it_stood_last(self):
        """A picture and a terminal: a bar that stands upright without its angle, from which it never turns."""
        (self.folder / "bar.toml").write_text(BAR)
        pictures = []
        for name, record in (("all.h5", "record.fields=['position', 'angle']"),
                             ("some.h5", "record.also=[{ every = 20, fields = ['angle'] }]")):
            self.assertEqual(self.throng("run", "bar.toml", "-o", name, "--progress", "none", "--set", record), (0, ""))
            self.assertEqual(self.throng("replay", name, "--png", "bar.png", "--at", "0.1"), (0, ""))
            pictures.append((lines(self.play(name, "1e6", columns=40, rows=9).end()[1])[1:8], (self.folder / "bar.png").read_bytes()))
        self.assertEqual(*pictures)
        self.assertTrue(any("⣿⣿⣿⣿⣿⣿" in line for line in pictures[0][0]), "it lies")

    def test_shows_the_floor_of_a_crowd(self):
        (self.folder / "floor.toml").write_text(FLOOR)
        self.assertEqual(self.throng("run", "floor.toml", "-o", "floor.h5", "--progress", "none"),
                         (0, "floor.toml:13:10: warning: areas.narrow: is nobody's goal, nobody's place, and not measured: it is only drawn\n"))
        _, played, _ = self.play("floor.h5", "1e6", columns=64, rows=14).end()
        shown = lines(played)
        self.assertEqual(shown[-1].split("   ")[0], "1 body, 2 agents")
        for name, colour in (("exit", "d78700"), ("bench", "5faf87"), ("start", "5f87af"), ("till", "5faf87")):
            row = next(k for k, line in enumerate(shown) if name in line)
            self.assertEqual(played.buffer[row][shown[row].index(name)].fg, colour, name)
        self.assertFalse(any("narrow" in line for line in shown), "there is no room for its name")
        dots = sum("\u2800" < cell.data <= "\u28ff" and cell.fg == "d78700" for row in played.buffer.values() for cell in row.values())
        self.assertGreater(dots, 10)

    def test_hides_the_cursor_meanwhile(self):
        self.two()
        session = self.play("two.h5", "1e6")
        self.assertTrue(session.screen(session.listen().split(LEAVE)[0]).cursor.hidden)
        self.assertEqual(session.said.count(ENTER), 1)
        session.end()

    def places(self, screen):
        """Where coloured dots are: their columns."""
        return [column for row in range(1, screen.lines - 1) for column in range(screen.columns)
                if screen.buffer[row][column].data >= "\u2801" and len(set(screen.buffer[row][column].fg)) > 2]

    def test_moves_what_moved(self):
        self.two()
        for at, share in (("0", 1.5 / 9), ("0.5", 3.0 / 9), ("1", 4.5 / 9)):
            self.two("--until", at, "--force")
            _, played, _ = self.play("two.h5", "1e6").end()
            found = self.places(played)
            self.assertGreater(len(found), 20)
            # 22 lines of 4 dots hold 4 m and margins: the picture is as wide as the terminal or its share of it
            border = [column for column in range(80) if played.buffer[12][column].data != " "]
            left, right = border[0], border[-1]
            self.assertAlmostEqual((sum(found) / len(found) - left) / (right - left), share, delta=0.03)

    def times(self, said):
        """The times in the title, as they were drawn."""
        screen, found = pyte.Screen(80, 24), []
        stream = pyte.ByteStream(screen)
        for piece in re.split(rb"(?=\033\[1;)", said.split(LEAVE)[0]):
            stream.feed(piece)
            time = re.search(r"t = ([0-9.]+) s of", screen.display[0])
            if time and float(time[1]) not in found:
                found.append(float(time[1]))
        return found

    def test_keeps_time(self):
        self.two()
        begin = time.monotonic()
        session = self.play("two.h5", "0.5")
        session.listen()
        took = time.monotonic() - begin
        self.assertGreater(took, 2.0)
        self.assertLess(took, 6.0)  # on a machine that does other things
        times = self.times(session.said)
        self.assertEqual(times[-1], 1.0)
        self.assertGreater(len(times), 5)
        session.end()

    def test_sends_what_changed_alone(self):
        self.two()
        session = self.play("two.h5", "1")
        pictures = len(self.times(session.listen()))
        self.assertGreater(pictures, 3)
        self.assertLess(len(session.said) / pictures, 1500)  # 22 lines of 80 cells are 5 kB
        session.end()

    def test_ends_by_ctrl_c_with_the_terminal_as_it_was(self):
        self.two()
        session = self.play("two.h5", "0.001")
        session.listen(lambda said: b"t = 0.000" in said)
        os.write(session.master, b"typed\x03")
        code, played, left = session.end()
        self.assertEqual(code, 130)
        self.assertFalse(left.cursor.hidden)
        self.assertEqual(lines(left), lines(played) + [""])
        self.assertNotIn(b"typed", session.said)

    def test_follows_the_size_of_the_terminal(self):
        self.two()
        session = self.play("two.h5", "0.5")
        session.listen(lambda said: said.count(b"\033[1;") > 9)  # titles
        session.columns, session.rows = 60, 20
        session.resize(60, 20)
        session.listen(lambda said: said.count(b"\033[2J") == 2)
        session.said = session.said[session.said.rindex(b"\033[2J"):]
        _, played, left = session.end()
        self.assertEqual(lines(left), lines(played) + [""])
        self.assertTrue(lines(played)[0].startswith("two ") and len(lines(played)[0]) == 60)
        self.assertIn("2 bodies", lines(played)[19])

    def test_gives_the_terminal_back_while_it_is_stopped(self):
        self.two()
        session = self.play("two.h5", "0.5")
        session.listen(lambda said: said.count(b"\033[1;") > 9)  # titles
        playing = termios.tcgetattr(session.slave)
        self.assertNotEqual(playing, session.before)
        os.write(session.master, b"\x1a")  # Ctrl-Z
        os.waitid(os.P_PID, session.process.pid, os.WSTOPPED | os.WEXITED | os.WNOWAIT)
        session.listen(lambda said: LEAVE in said)
        self.assertTrue(session.said.endswith(LEAVE))
        self.assertEqual(termios.tcgetattr(session.slave), session.before, "echo is back")
        session.said = b""
        session.process.send_signal(signal.SIGCONT)
        session.listen(lambda said: ENTER in said)
        self.assertEqual(termios.tcgetattr(session.slave), playing)
        code, played, left = session.end()
        self.assertEqual(code, 0)
        self.assertEqual(lines(left), lines(played) + [""])
        self.assertIn("t = 1.000 s of 1.000 s", lines(played)[0])

    def test_is_not_stopped_where_that_is_ignored(self):
        self.two()
        session = self.play("two.h5", "2", ignored=signal.SIGTSTP)
        session.listen(lambda said: ENTER in said)
        os.write(session.master, b"\x1a")
        self.assertEqual(session.end()[0], 0)
        self.assertEqual(session.said.count(ENTER), 1)

    def test_measures_what_the_run_did(self):
        scene = (self.folder / "three.toml").read_text()
        (self.folder / "three.toml").write_text(scene + "[[bodies]]\nshape = \"brick\"\nat = [2, 1.2]\nspin = 3\n")
        done = subprocess.run([PROGRAM, "run", "three.toml", "-o", "a.h5", "--until", "1", "--progress", "none"],
                              cwd=self.folder, stdout=subprocess.PIPE, check=True)
        summary = json.loads(done.stdout)
        self.assertGreater(summary["max_overlap"], 0)
        _, played, _ = self.play("a.h5", "1e9", columns=100).end()
        line = lines(played)[-1]
        self.assertIn("5 bodies   kinetic %.4g J   deepest overlap %.3g m   " % (summary["kinetic_energy"], summary["max_overlap"]), line)
        self.assertRegex(line, r" {3}={30}$")
        self.record("b.h5", "--force", "--set", 'record.fields=["position"]')
        self.assertRegex(lines(self.play("b.h5", "1e9").end()[1])[-1], "^5 bodies   ===")

    def test_is_not_steered_by_names(self):
        self.two("--set", r'name="ev\u001b[31mil\u009b31m é 京 \u0007"')
        session = self.play("two.h5", "1e6")
        _, played, left = session.end()
        self.assertTrue(lines(played)[0].startswith("ev?[31mil?31m é ? ?  "), lines(played)[0])
        self.assertNotIn(b"\033[31m", session.said)
        self.assertEqual(lines(left), lines(played) + [""])

    def test_fits_into_any_terminal(self):
        self.two()
        for columns, rows in ((1, 1), (3, 2), (20, 3), (300, 5), (10, 100)):
            code, played, left = self.play("two.h5", "1e6", columns=columns, rows=rows).end()
            self.assertEqual(code, 0, (columns, rows))
            self.assertEqual(lines(left)[:-1], lines(played), (columns, rows))

    def shown(self, session):
        return lines(session.screen(session.said.split(LEAVE)[0]))[0]

    def type(self, session, keys, until):
        """Types, and waits for the title that follows."""
        os.write(session.master, keys)
        session.listen(lambda _: re.search(until, self.shown(session)))
        self.assertRegex(self.shown(session), until)

    def test_obeys_keys(self):
        self.two()
        session = self.play("two.h5", "0.0001")
        session.listen(lambda said: b"t = 0.000" in said)
        self.type(session, b" ", "paused   t = 0.000 s of 1.000 s  x0.0001$")
        self.type(session, b"\033[C", "t = 0.010 s")
        self.type(session, b"\033OC\033[C", "t = 0.030 s")
        self.type(session, b"\033[D", "t = 0.020 s")
        self.type(session, b"x\033[1;5P\033[D\033[D\033[D\033[D", "paused   t = 0.000 s")
        self.type(session, b"+++", "x0.0008$")
        self.type(session, b"-", "x0.0004$")
        self.type(session, b" ", "two {9,}t = 0.000 s of 1.000 s  x0.0004$")
        self.type(session, b"\033[C", "t = 0.050 s")
        self.type(session, b"\033[C\033[C\033[D", "t = 0.100 s")
        os.write(session.master, b"q")
        code, played, left = session.end()
        self.assertEqual(code, 0)
        self.assertEqual(lines(left), lines(played) + [""])

    def test_stays_at_the_end_where_it_is_paused_and_else_ends_there(self):
        self.two()
        session = self.play("two.h5", "0.0001")
        session.listen(lambda said: b"t = 0.000" in said)
        self.type(session, b" ", "paused")
        self.type(session, b"\033[C" * 150, "paused   t = 1.000 s")
        time.sleep(0.3)
        self.assertIsNone(session.process.poll())
        os.write(session.master, b" ")
        self.assertEqual(session.end()[0], 0)

    def test_gives_the_terminal_back_whatever_signal_ends_it(self):
        self.two()
        for number in (signal.SIGTERM, signal.SIGQUIT, signal.SIGSEGV, signal.SIGABRT, signal.SIGHUP):
            session = self.play("two.h5", "0.001")
            session.listen(lambda said: b"t = 0.000" in said)
            self.assertNotEqual(termios.tcgetattr(session.slave), session.before)
            session.process.send_signal(number)
            code, _, left = session.end()  # which looks at the echo
            self.assertEqual(code, 130 if number == signal.SIGTERM else -number)
            self.assertFalse(left.cursor.hidden, number)

    def test_rests_where_the_terminal_that_it_listens_to_is_hung_up(self):
        """It happened: such a terminal has always something to read, which is nothing, and a processor was busy with it."""
        self.two()
        shown, screen = terminal()
        typed, keys = terminal()
        process = subprocess.Popen([PROGRAM, "replay", "two.h5", "--speed", "0.0001"], cwd=self.folder, stdin=keys, stdout=screen,
                                   start_new_session=True, env={**os.environ, "TERM": "xterm"})
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        os.close(keys)
        said = b""
        while b"t = 0.000" not in said:
            said += os.read(shown, 1 << 16)
        os.close(typed)
        before = self.seconds_busy(process)
        time.sleep(2)
        self.assertIsNone(process.poll())
        self.assertLess(self.seconds_busy(process) - before, 0.3)
        os.close(screen)
        os.close(shown)

    def seconds_busy(self, process):
        with open(f"/proc/{process.pid}/stat", encoding="utf8") as stat:
            return sum(map(int, stat.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")

    def test_needs_a_terminal(self):
        self.two()
        code, error = self.throng("replay", "two.h5", "--speed", "1")
        self.assertEqual((code, error), (2, "throng: --speed shows a picture in a terminal, which the standard output is not\n"))
        session = self.play("two.h5", "1", kind="dumb")
        self.assertIn(b"this one can't (TERM is dumb)", session.listen())
        self.assertEqual(session.process.returncode, 2)

    def test_refuses_what_it_cannot_play(self):
        self.two("--set", 'record.fields=["angle"]')
        session = self.play("two.h5", "1")
        self.assertEqual(session.listen(), b"throng: two.h5 holds no positions: there is nothing to draw\r\n")
        self.assertEqual(session.process.returncode, 2)
        for speed in ("0", "-1", "nan", "inf", "fast"):
            self.assertEqual(self.throng("replay", "two.h5", f"--speed={speed}")[0], 2, speed)
        self.assertIn("give one of them", self.throng("replay", "two.h5", "--speed", "1", "--verify")[1])


if __name__ == "__main__":
    unittest.main()
