#!/usr/bin/python3
"""tools/plot/accuracy.py on rows as `throng bench accuracy` writes them."""
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "tools", "plot", "accuracy.py")


def row(engine, dt, error, ms, **more):
    return {"bench": "accuracy", "case": "throw & spin", "engine": engine, "threads": 1, "ms": ms, "ms_min": ms, "work": 1,
            "check": "A disc is thrown.", "error": {"error": error, "dt": dt, "setting": "substeps 1",
                                                    "what": "distance, radii", "order": None, **more}}


ROWS = [row("native", 0.1, 0.1, 1.0, order=1.0), row("native", 0.05, 0.05, 2.0, order=1.0),
        row("native", 0.05, 0.2, 4.0, order=1.0),
        row("box2d", 0.1, 0.1, 3.0, order=1.0, peer=True, native_ms=1.0),
        row("box2d", 0.01, 0.01, 9.0, order=1.0, peer=True, native_ms=None),
        row("event_driven", 0.1, 1e-15, 2.0, order=None, exact=True, native_ms=None),
        row("spring", 0.1, None, 0.0, note="no <spring> here")]


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class PlotAccuracy(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def draw(self, rows):
        file = os.path.join(self.folder.name, "rows.json")
        with open(file, "w") as out:
            json.dump(rows, out)
        plots = os.path.join(self.folder.name, "plots")
        subprocess.run([sys.executable, "-B", SCRIPT, file, plots], check=True, stdout=subprocess.DEVNULL)
        return plots

    def text(self, rows, name):
        with open(os.path.join(self.draw(rows), name)) as file:
            return file.read()

    def compared(self, rows):
        """The first cell of the overview, and that of the last engine."""
        line = re.search("<tr><td>.*?</tr>", self.text(rows, "index.html")).group()
        cells = re.findall("<td>([^<]*)</td>", line)
        return cells[0], cells[-1]

    def test_a_plot_a_scene_and_a_page_of_all(self):
        plots = self.draw(ROWS)
        self.assertEqual(sorted(os.listdir(plots)), ["index.html", "throw_spin.png", "throw_spin.svg"])
        with open(os.path.join(plots, "index.html")) as file:
            page = file.read()
        self.assertIn("throw &amp; spin", page)
        self.assertIn("native is 3.0 times as fast", page)
        self.assertIn("The best peer&#x27;s smallest errors are beyond", page)
        self.assertIn("event_driven: no error but rounding", page)
        self.assertIn("spring can&#x27;t play it: no &lt;spring&gt; here", page)
        self.assertNotIn("<spring>", page)

    def test_rounding_alone_can_be_drawn_too(self):
        self.assertIn("throw_spin.svg", os.listdir(self.draw([row("native", 0.1, 0.0, 1.0)])))

    def test_an_engine_that_is_off_by_more_than_1_stays_in_sight(self):
        lost = self.text(ROWS + [row("chipmunk", 0.1, 9.0, 1.0, peer=True)], "throw_spin.svg")
        self.assertIn("<!-- above 1 -->", lost)
        self.assertIn("<!-- chipmunk: all errors above 1 -->", lost)
        self.assertNotIn("<!-- above 1 -->", self.text(ROWS, "throw_spin.svg"))

    def test_the_axis_has_no_number_in_its_bands(self):
        drawn = self.text(ROWS + [row("chipmunk", 0.1, 9.0, 1.0)], "throw_spin.svg")
        ticks = re.findall(r'id="xtick_\d+">.*?<!-- ([^ ]*) -->', drawn, re.DOTALL)
        self.assertEqual(ticks, ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"])
        self.assertIn("<!-- rounding -->", drawn)
        self.assertEqual(drawn.count("<!-- // -->"), 4)

    def test_faint_points_are_explained_where_there_are_some(self):
        self.assertIn("<!-- faint: another setting", self.text(ROWS, "throw_spin.svg"))
        self.assertNotIn("<!-- faint", self.text(ROWS[:2], "throw_spin.svg"))

    def test_the_table_says_why_there_is_no_factor(self):
        native = ROWS[:1]
        self.assertEqual(self.compared(native + [row("box2d", 0.1, 0.1, 3.14, peer=True)]), ("3.1", "0.10"))
        self.assertEqual(self.compared(native + [row("box2d", 0.1, 0.1, 123.0, peer=True),
                                                 row("box2d", 0.1, 0.5, 2.0, peer=True)])[0], "2.0 to 120")
        self.assertEqual(self.compared(native + [row("box2d", 0.1, 0.01, 3.0, peer=True)])[0], "native is never as exact")
        self.assertEqual(self.compared(native + [row("box2d", 0.1, 2.0, 3.0, peer=True)])[0], "no peer is off by less than 1")
        self.assertEqual(self.compared(native)[0], "no peer can play it")

    def test_the_table_says_why_there_is_no_error(self):
        other = [dict(row("box2d", 0.1, 0.1, 1.0), case="other"), dict(row("chipmunk", 0.1, 0.1, 1.0), case="other")]
        page = self.text(ROWS[:1] + [row("box2d", 0.1, None, 0.0, note="no")] + other, "index.html")
        self.assertIn("<td>no peer can play it</td><td>0.10</td><td>can&#x27;t play it</td><td>not run</td>", page)

    def test_among_errors_of_rounding_alone_the_faster_is_ahead(self):
        self.assertEqual(self.compared([row("native", 0.1, 4e-14, 1.0), row("box2d", 0.1, 2e-14, 2.0, peer=True)])[0], "2.0")


if __name__ == "__main__":
    unittest.main()
