#!/usr/bin/python3
"""The page about the engine's speed, from a quick run of the benchmark: engine_page_test.py program."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from validation import engine  # noqa: E402 (needs the path)
from validation.common import Failure  # noqa: E402
from page_format import assert_well_formed  # noqa: E402 (after the path is set)

PROGRAM = sys.argv.pop()
# Equation of state of disks: Kolafa & Rottner (2006) at φ = 0.5.
DISKS_AT_HALF = 4.106364


class EnginePage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM, "engine", "--quick"], capture_output=True, text=True, check=True)
        cls.data = json.loads(done.stdout)

    def test_counts_make_sense(self):
        for row in self.data["speed"]:
            # A collision is one event; a few more find that their partner has met another.
            self.assertGreater(row["events"], 1)
            self.assertLess(row["events"], 3)
            # Both partners test their neighbours, about seven each.
            self.assertGreater(row["predictions"], 10)
            self.assertLess(row["predictions"], 40)
            self.assertLess(row["searches"], row["predictions"])
            self.assertGreater(row["ns_per_collision"], 0)
            self.assertLessEqual(row["ns_per_collision"], row["median_ns_per_collision"])
            if row["aspect_ratio"] == 1:
                self.assertLess(row["searches"], 0.1)
            else:
                self.assertGreater(row["searches"], 0.9)

    def test_disks_have_their_pressure(self):
        row = next(r for r in self.data["speed"] if (r["aspect_ratio"], r["packing_fraction"]) == (1, 0.5))
        self.assertAlmostEqual(row["reduced_pressure"] / DISKS_AT_HALF, 1, delta=0.05)

    def test_all_pairs_ask_many_more(self):
        asked = {(r["program"], r["particles"]): r["predictions"] for r in self.data["all_pairs"]}
        self.assertGreater(asked["all_pairs", 30], 10 * asked["vitrel", 30])

    def test_devices_do_what_they_say(self):
        devices = {(r["device"], r["aspect_ratio"]): r for r in self.data["devices"]}
        screen, horizon, lists = (devices[name, 6] for name in ("contact_screen", "horizon", "shaped_lists"))
        self.assertAlmostEqual(screen["without"]["searches"], screen["without"]["predictions"])
        self.assertGreater(horizon["without"]["searches"], horizon["with"]["searches"])
        self.assertGreater(lists["without"]["predictions"], 2 * lists["with"]["predictions"])
        for row in self.data["gases"]:
            self.assertIn(row["chosen"], ("cells", "lists"))
            if row["packing_fraction"] < 0.01:
                self.assertLess(row["cells"]["events"], row["lists"]["events"])
        for row in self.data["lazy"]:
            self.assertLess(row["lazy"][0]["searches"], row["eager"]["searches"])

    def test_page_is_well_formed(self):
        assert_well_formed(self, engine.page(self.data, self.data), 8)

    def test_chart_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "engine.svg")
            engine.draw(self.data["all_pairs"], file)
            text = file.read_text(encoding="utf-8")
        for name in engine.PROGRAMS.values():
            self.assertIn(name, text)

    def test_a_cost_that_grows_fails(self):
        def row(particles, ns):
            return {"aspect_ratio": 2, "particles": particles, "ns_per_collision": ns}

        engine.check_sizes([row(1000, 100), row(100_000, 159), row(1_000_000, 249)])
        with self.assertRaises(Failure):
            engine.check_sizes([row(1000, 100), row(100_000, 161)])


if __name__ == "__main__":
    unittest.main()
