#!/usr/bin/python3
"""tools/plot/validation.py on rows as `throng bench validation` writes them."""
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "tools", "plot", "validation.py")


def row(case, engine, verdict, value, **more):
    return {"bench": "validation", "case": case, "engine": engine, "threads": 1, "ms": 1, "ms_min": 1, "work": 1, "check": "",
            "error": {"verdict": verdict, "value": value, "unit": "1/s", **more}}


WIDTHS = {"width": [0.8, 1.0, 1.2], "flow": [1.6, 1.9, 2.3], "seyfried_2009": [1.61, 1.93, 2.25]}
ROWS = [row("Seyfried 2009: flow through", "social_force", "pass", 0.02, series=WIDTHS),
        row("Seyfried 2009: flow through", "orca", "fail", 0.9, by_nature="keeps no distance", series=WIDTHS),
        row("IMO 4", "social_force", "fail", 1.7), row("IMO 4", "orca", "fail", None),
        row("RiMEA 14", "orca", "documented", 0.5)]


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class PlotValidation(unittest.TestCase):
    def draw(self, rows):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "rows.json")
            with open(file, "w") as out:
                json.dump(rows, out)
            plots = os.path.join(folder, "plots")
            subprocess.run([sys.executable, "-B", SCRIPT, file, plots], check=True, stdout=subprocess.DEVNULL)
            with open(os.path.join(plots, "verdicts.svg")) as svg:
                return sorted(os.listdir(plots)), svg.read()

    def test_a_plot_for_what_the_rows_hold(self):
        files, _ = self.draw(ROWS)
        self.assertEqual(files, ["bottleneck.png", "bottleneck.svg", "verdicts.png", "verdicts.svg"])

    def test_fields_have_the_colours_of_their_verdicts(self):
        _, svg = self.draw(ROWS)
        fields = [svg.count(colour) / 2 for colour in ("#4c9f70", "#d1603d", "#e0b45c", "#9aa5b1")]  # inside and edge
        self.assertEqual(fields, [2, 3, 2, 2])  # one each is the legend's


if __name__ == "__main__":
    unittest.main()
