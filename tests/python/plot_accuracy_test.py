#!/usr/bin/python3
"""tools/plot/accuracy.py on rows as `throng bench accuracy` writes them."""
import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import unittest

SCRIPT = os.path.join(os.path.dirname(__file__), "..", "..", "tools", "plot", "accuracy.py")


def row(engine, dt, error, ms, **more):
    return {"bench": "accuracy", "case": "throw & spin", "engine": engine, "threads": 1, "ms": ms, "ms_min": ms, "work": 1,
            "check": "A disc is thrown.", "error": {"error": error, "dt": dt, "setting": "substeps 1",
                                                    "what": "distance, radii", **more}}


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
        subprocess.run([sys.executable, SCRIPT, file, plots], check=True, stdout=subprocess.DEVNULL)
        return plots

    def test_a_plot_a_scene_and_a_page_of_all(self):
        plots = self.draw(ROWS)
        self.assertEqual(sorted(os.listdir(plots)), ["index.html", "throw_spin.png", "throw_spin.svg"])
        with open(os.path.join(plots, "index.html")) as file:
            page = file.read()
        self.assertIn("throw &amp; spin", page)
        self.assertIn("native is 3 times as fast", page)
        self.assertIn("The best peer&#x27;s smallest errors are beyond", page)
        self.assertIn("event_driven: no error but rounding", page)
        self.assertIn("spring can&#x27;t play it: no &lt;spring&gt; here", page)
        self.assertNotIn("<spring>", page)

    def test_rounding_alone_can_be_drawn_too(self):
        self.assertIn("throw_spin.svg", os.listdir(self.draw([row("native", 0.1, 0.0, 1.0)])))


if __name__ == "__main__":
    unittest.main()
