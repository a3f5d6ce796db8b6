#!/usr/bin/python3
"""The page about event chains, from a quick run of the benchmark: event_chain_page_test.py program."""

import json
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from validation import event_chain  # noqa: E402 (needs the path)
from validation.common import Failure  # noqa: E402
from page_format import assert_well_formed  # noqa: E402 (after the path is set)

PROGRAM = sys.argv.pop()


def state(local, chains):
    def method(seconds):
        return {"density": {"seconds": seconds, "error": 0.01 * seconds, "is_long_enough": True}}

    return {"aspect_ratio": 1, "size_ratio": 1, "packing_fraction": 0.5, "methods": [method(local), method(chains)]}


class EventChainPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM, "event-chain", "--quick"], capture_output=True, text=True, check=True)
        cls.data = json.loads(done.stdout)

    def test_counts_make_sense(self):
        self.assertEqual(len(self.data["states"]), 9)
        for row in self.data["states"]:
            local, chains = row["methods"]
            self.assertGreater(local["translations_accepted"], 0.1)
            self.assertGreater(chains["searches_per_contact"], 1)
            self.assertLess(chains["searches_per_contact"], 3)
            self.assertGreater(chains["compressibility_of_chains"], 1.5)
            for method in row["methods"]:
                self.assertGreater(method["density"]["seconds"], 0)

    def test_page_is_well_formed(self):
        assert_well_formed(self, event_chain.page(self.data), 4)

    def test_chains_that_gain_nothing_fail(self):
        event_chain.check([state(10, 1)])
        with self.assertRaises(Failure):
            event_chain.check([state(1, 1)])

    def test_errors_have_two_digits(self):
        self.assertEqual(event_chain.with_error(12.345, 1.23), "12.3 ± 1.2")
        self.assertEqual(event_chain.with_error(123.4, 23), "123 ± 23")


if __name__ == "__main__":
    unittest.main()
