#!/usr/bin/python3
"""The page about exchanges of places, from a quick run of the benchmark: exchanges_page_test.py program."""

import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from validation import exchanges  # noqa: E402 (needs the path)
from validation.common import Failure  # noqa: E402
from page_format import assert_well_formed  # noqa: E402 (after the path is set)

PROGRAM = sys.argv.pop()


def state(motion, collective):
    times = {exchanges.MOTION: motion, exchanges.COLLECTIVE: collective}
    return {"packing_fraction": 0.5, "methods": [{"method": name, "sizes": time and {"seconds": time}}
                                                 for name, time in times.items()]}


class ExchangesPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM, "exchanges", "--quick"], capture_output=True, text=True, check=True)
        cls.data = json.loads(done.stdout)

    def test_every_method_is_measured_until_it_is_too_slow(self):
        for key in exchanges.LIQUIDS:
            first, second = self.data[key]
            self.assertEqual(len(first["methods"]), 8)
            left = {method["method"] for method in second["methods"]}
            for method in first["methods"]:
                self.assertGreater(method["sweeps"], 0)
                self.assertEqual("orientations" in method, key == "ellipses")
                if method["sizes"] and method["places"] and method.get("orientations", True):
                    self.assertIn(method["method"], left)

    def test_speed_up_follows_from_the_law_of_motion(self):
        def law(phi):
            return math.exp(0.55 * phi / (0.85 - phi))

        densities = [0.6, 0.7, 0.75, 0.78, 0.79, 0.8]
        rows = [state(law(phi), 0.1) | {"packing_fraction": phi} for phi in densities]
        rows.append(state(None, 0.1) | {"packing_fraction": 0.82})
        for row in rows:
            for method in row["methods"]:
                if method["sizes"]:
                    method["places"] = {"seconds": method["sizes"]["seconds"], "error": 0.01 * method["sizes"]["seconds"],
                                        "times": 9}
        motion = exchanges.curves(rows, "places")[exchanges.MOTION]
        value, lower = exchanges.extrapolated(motion, 0.82)
        self.assertLess(abs(math.log(value / law(0.82))), 0.1)
        self.assertLess(lower, value)
        self.assertGreater(lower, 0.3 * value)
        growth, gains = exchanges.speed_ups(rows)
        self.assertIn("by the law", gains)
        self.assertEqual(float(growth), float(f"{law(0.8) / law(0.6):.3g}"))
        self.assertNotIn("by the law", exchanges.speed_ups([*rows[:5], rows[6]])[1])

    def test_without_a_law_motion_is_no_faster_than_before(self):
        rows = [state(2, 0.1) | {"packing_fraction": 0.7}, state(None, 0.1) | {"packing_fraction": 0.8}]
        for row in rows:
            for method in row["methods"]:
                if method["sizes"]:
                    method["places"] = method["sizes"] | {"error": 0.001, "times": 9}
        self.assertIn("| 0.8 | – |", exchanges.speed_ups(rows)[1])

    def test_a_law_that_diverges_before_gives_no_time(self):
        motion = [(phi, seconds, 0.01 * seconds) for phi, seconds in
                  ((phi, math.exp(0.05 * phi / (0.801 - phi))) for phi in (0.6, 0.7, 0.75, 0.78, 0.79, 0.799, 0.8))]
        self.assertIsNone(exchanges.extrapolated(motion, 0.82))

    def test_a_dilute_liquid_is_forgotten(self):
        for method in self.data["disks"][0]["methods"]:
            for quantity in ("places", "sizes"):
                self.assertGreater(method[quantity]["seconds"], 0, method["method"])

    def test_exchanges_are_accepted(self):
        accepted = [method.get("exchanges_accepted", method.get("steps_accepted"))
                    for method in self.data["choices"][0]["methods"]]
        self.assertTrue(all(0 < share < 1 for share in accepted), accepted)

    def test_page_is_well_formed(self):
        assert_well_formed(self, exchanges.page(self.data), 5)

    def test_chart_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "chart.svg")
            exchanges.draw(self.data, file)
            self.assertIn("chains, collective exchanges", file.read_text(encoding="utf-8"))

    def test_exchanges_that_gain_nothing_fail(self):
        exchanges.check([state(1, 0.1), state(10, 0.1), state(None, 0.2)])
        for rows in ([state(1, 1)], [state(1, 0.1), state(1, 0.9)], [state(None, 1)]):
            with self.assertRaises(Failure):
                exchanges.check(rows)


if __name__ == "__main__":
    unittest.main()
