#!/usr/bin/python3
"""tools/plot/stability.py on rows as `throng bench stability` writes them."""
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "tools", "plot", "stability.py")


def row(case, verdict, x, **more):
    return {"bench": "stability", "case": case, "engine": "native", "threads": 1, "ms": 1, "ms_min": 1, "work": 1, "check": "",
            "error": {"verdict": verdict, "energy": 0.0, "overlap": 0.02, "speed": None, "scene": "stack", "x": "dt (s)",
                      "x_value": x, **more}}


ROWS = [row("stack: dt (s)", "stable", 1 / 60), row("stack: dt (s)", "exploded", 0.1, overlap=None, end="it flew away"),
        row("stack: dt (s), substeps", "drifting", 0.1, y="substeps", y_value=4.0, moved=0.3),
        row("stack: dt (s), substeps", "stable", 0.1, y="substeps", y_value=16.0)]


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class PlotStability(unittest.TestCase):
    def draw(self, rows):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "rows.json")
            with open(file, "w") as out:
                json.dump(rows, out)
            plots = os.path.join(folder, "plots")
            subprocess.run([sys.executable, "-B", SCRIPT, file, plots], check=True, stdout=subprocess.DEVNULL)
            with open(os.path.join(plots, "stability_stack.svg")) as svg:
                return sorted(os.listdir(plots)), svg.read()

    def test_a_page_a_scene(self):
        files, svg = self.draw(ROWS)
        self.assertEqual(files, ["stability_stack.png", "stability_stack.svg"])
        for colour in ("#8fcf9f", "#f2d479", "#e07b6a"):
            self.assertIn(colour, svg)

    def test_cells_have_the_colours_of_their_verdicts(self):
        _, svg = self.draw([one for one in ROWS if one["error"]["verdict"] != "drifting"])
        self.assertEqual(svg.count("#f2d479"), 1)  # the legend's


if __name__ == "__main__":
    unittest.main()
