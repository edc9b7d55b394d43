# SPDX-License-Identifier: MIT
"""What scenarios ask to be observed: in the summary, in the file, in info, and as throng_read.py gives it."""
import json
import subprocess
import unittest

import h5py
import numpy as np

from program import PROGRAM, Program
import throng_read

GAS = """
throng = 1
seed = 3
time = { dt = 0.05, until = 2 }
domain = { periodic = [[0, 0], [20, 20]] }
materials.default = { restitution = 1.0, friction = 0.0 }
shapes.ball.disc.radius = 0.5
record = { every = 10, observables = 5 }
[observe]
quantities = ["temperature", "packing_fraction", "collisions", "compressibility_factor"]
speeds = { up_to = 5, bins = 10 }
pair_correlation = { up_to = 3, bins = 12 }
[[bodies]]
shape = "ball"
count = 150
place = { random = { within = [[0, 0], [20, 20]] } }
velocity = { maxwell = 1.0 }
"""
NAMES = ["temperature", "packing_fraction", "collisions", "wall_collisions", "compressibility_factor",
         "compressibility_factor_by_rate", "speeds", "pair_correlation"]


class Observe(Program):
    def run_gas(self, *options, name="gas.h5"):
        with open(self.path("gas.toml"), "w") as file:
            file.write(GAS)
        code, said = self.throng("run", "gas.toml", "-o", name, "--progress", "none", "--force", *options)
        self.assertEqual(code, 0, said)
        return self.path(name)

    def test_is_in_the_summary_and_in_the_file(self):
        for engine in ("native", "event_driven"):
            path = self.run_gas("--engine", engine)
            said = subprocess.run([PROGRAM, "run", "gas.toml", "--engine", engine, "--progress", "none"], cwd=self.path(""),
                                  capture_output=True, check=True).stdout
            summary = json.loads(said)["observables"]
            with throng_read.open(path) as gas:
                self.assertLessEqual(set(NAMES), set(gas.observables))
                for name in NAMES:
                    value, when = gas.observables[name]
                    np.testing.assert_allclose(when, np.arange(0, 2.01, 0.25))
                    last = summary[name]["values"] if name in ("speeds", "pair_correlation") else summary[name]
                    np.testing.assert_array_equal(value[-1], last)
                self.assertEqual(list(gas.bins("speeds")), list(np.linspace(0, 5, 11)))
                for name in ("speeds", "pair_correlation"):
                    np.testing.assert_allclose(gas.bins(name), summary[name]["edges"], rtol=1e-15)
                self.assertEqual(gas.bins("pair_correlation")[-1], 3)
                self.assertRaisesRegex(throng_read.NotRecorded, "is no histogram", gas.bins, "temperature")
                self.assertRaisesRegex(throng_read.NotRecorded, "has no observable 'nope'", gas.bins, "nope")
                # The definition, once more, of what positions and velocities of frame 4 say (step 20).
                i = int(np.flatnonzero(gas.step == 20)[0])
                speed = np.linalg.norm(gas.velocity[i], axis=1)
                density = np.histogram(speed, gas.bins("speeds"))[0] / 150 / 0.5
                np.testing.assert_allclose(gas.observables["speeds"][0][4], density)
                gaps = gas.position[i][:, None] - gas.position[i][None]
                gaps -= 20 * np.round(gaps / 20)
                edges = gas.bins("pair_correlation")
                count = np.histogram(np.linalg.norm(gaps, axis=2)[np.triu_indices(150, 1)], edges)[0]
                expected = 150 * 149 / 2 * np.pi * np.diff(edges ** 2) / 400
                np.testing.assert_allclose(gas.observables["pair_correlation"][0][4], count / expected)
            self.assertEqual(self.throng("replay", "--verify", "gas.h5")[0], 0)

    def test_goes_on_from_a_checkpoint(self):
        whole = self.run_gas(name="whole.h5")
        self.run_gas("--until", "1", "--checkpoint", "0.001", name="part.h5")
        self.assertEqual(self.throng("resume", "part.h5", "--until", "2")[0], 0)
        with throng_read.open(whole) as a, throng_read.open(self.path("part.h5")) as b:
            for name in NAMES:
                np.testing.assert_array_equal(a.observables[name][0], b.observables[name][0])

    def test_is_told_by_info(self):
        self.run_gas()
        told = json.loads(subprocess.run([PROGRAM, "info", self.path("gas.h5"), "--json"], capture_output=True, check=True).stdout)
        self.assertEqual(told["observed"][6:], NAMES)

    def test_damage_is_seen(self):
        for change, said in ((lambda file: file["observables/speeds/value"].__setitem__((3, 2), 7.0), "frame"),
                             (lambda file: file["observables/speeds"].attrs.__setitem__("up_to", -1.0), "bins that can't be"),
                             (lambda file: file["observables/speeds"].attrs.__setitem__("up_to", np.inf), "bins that can't be"),
                             (lambda file: file["observables/speeds"].attrs.__setitem__("up_to", 6.0), "end of a histogram"),
                             (lambda file: file.__delitem__("observables/speeds"), "damaged|observables")):
            path = self.run_gas()
            with h5py.File(path, "r+") as file:
                change(file)
            done = subprocess.run([PROGRAM, "replay", "--verify", path], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertRegex(done.stdout + done.stderr, said)

    def test_costs_nothing_where_it_is_not_asked_for(self):
        with open(self.path("a.toml"), "w") as file:
            file.write(GAS.split("[observe]")[0] + "[[bodies]]\nshape = 'ball'\nat = [3, 3]\nvelocity = [1, 0]\n")
        said = subprocess.run([PROGRAM, "run", "a.toml", "-o", "a.h5", "--progress", "none"], cwd=self.path(""), capture_output=True,
                              check=True).stdout
        self.assertNotIn("observables", json.loads(said))
        with throng_read.open(self.path("a.h5")) as recording:
            self.assertFalse(set(NAMES) & set(recording.observables))


if __name__ == "__main__":
    unittest.main()
