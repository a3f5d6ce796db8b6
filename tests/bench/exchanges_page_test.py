#!/usr/bin/python3
"""The page about exchanges of places, from a quick run of the benchmark: exchanges_page_test.py program."""

import json
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

    def test_every_method_is_measured_in_every_state(self):
        for key in exchanges.LIQUIDS:
            self.assertEqual(len(self.data[key]), 2)
            for row in self.data[key]:
                self.assertEqual(len(row["methods"]), 8)
                for method in row["methods"]:
                    self.assertGreater(method["sweeps"], 0)
                    self.assertEqual("orientations" in method, key == "ellipses")

    def test_a_dilute_liquid_is_forgotten(self):
        for method in self.data["disks"][0]["methods"]:
            for quantity in ("places", "sizes"):
                self.assertGreater(method[quantity]["seconds"], 0, method["method"])

    def test_exchanges_are_accepted(self):
        accepted = [method.get("exchanges_accepted", method.get("steps_accepted"))
                    for method in self.data["choices"][0]["methods"]]
        self.assertTrue(all(0 < share < 1 for share in accepted), accepted)

    def test_page_is_well_formed(self):
        assert_well_formed(self, exchanges.page(self.data), 4)

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
