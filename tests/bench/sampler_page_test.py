#!/usr/bin/python3
"""The page about the speed of Monte Carlo, from a quick run of the benchmark: sampler_page_test.py program."""

import json
import pathlib
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from validation import sampler  # noqa: E402 (needs the path)
from validation.common import Failure  # noqa: E402
from page_format import assert_well_formed  # noqa: E402 (after the path is set)

PROGRAM = sys.argv.pop()


class SamplerPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        done = subprocess.run([PROGRAM, "sampler", "--quick"], capture_output=True, text=True, check=True)
        cls.data = json.loads(done.stdout)

    def test_counts_make_sense(self):
        self.assertEqual(len(self.data["speed"]), 6)
        for row in self.data["speed"]:
            self.assertGreater(row["translations_accepted"], 0.1)
            self.assertLess(row["translations_accepted"], 0.6)
            # One group at least, and no more than all particles fill, in every image.
            self.assertGreater(row["groups"], 1)
            self.assertLess(row["groups"], 40)
            self.assertLessEqual(row["ns_per_trial"], row["median_ns_per_trial"])
            # The batches decide all but pairs that touch to nine digits.
            self.assertLess(1000 * row["single"], row["plain"]["decisions"])
            if row["aspect_ratio"] > 1:
                self.assertGreater(row["plain"]["decisions"], 1)

    def test_baseline_accepts_the_same(self):
        # 64 particles are in one domain, disks in a few: hardly a move ends at a border.
        for row in self.data["speed"]:
            self.assertAlmostEqual(row["translations_accepted"], row["plain"]["translations_accepted"], delta=0.15)

    def test_page_is_well_formed(self):
        assert_well_formed(self, sampler.page(self.data, self.data), 3)

    def test_threads_that_gain_too_little_fail(self):
        def row(one, two):
            return {"aspect_ratio": 2, "particles": 100_000, "one": {"ns_per_trial": one}, "two": {"ns_per_trial": two}}

        sampler.check_threads([row(160, 100)])
        with self.assertRaises(Failure):
            sampler.check_threads([row(159, 100)])


if __name__ == "__main__":
    unittest.main()
