"""bench_test.py <chromium> <vitrel-bench>: the pages of the comparisons in a browser."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from browser import Browser

PROGRAM, CHROMIUM = sys.argv.pop(), sys.argv.pop()
SHORT = ["--class", "generic", "--pairs", "30", "--seconds", "0.2", "-q"]


class BenchPage(unittest.TestCase):
    def count(self, selector):
        return self.browser.evaluate(f"document.querySelectorAll('{selector}').length")

    def page(self, name, *command):
        """What `check` sees, in the light and the dark, on a wide and on a narrow screen."""
        with tempfile.TemporaryDirectory() as folder, Browser(CHROMIUM) as self.browser:
            subprocess.run([PROGRAM, *command, "-o", folder], check=True, stderr=subprocess.DEVNULL)
            for width, scheme in ((1300, "light"), (420, "dark")):
                self.browser.resize(width, 900, scheme)
                self.browser.open(f"file://{folder}/{name}.html")
                self.assertEqual(self.browser.complaints, [])
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)
                self.assertEqual(self.count("noscript + section h2"), 1)
                yield

    def test_collision_time(self):
        for _ in self.page("collision-time", "collision-time", *SHORT, "--duration", "0.1"):
            self.assertEqual(self.count("section"), 8)
            self.assertEqual(self.count(".chart canvas"), 4)
            self.assertGreater(self.count("#failures svg ellipse"), 3)
            self.assertEqual(self.count("#scene tbody tr"), 12)
            first = "document.querySelector('#stability tbody tr').textContent"
            self.assertIn("generic, κ = 2", self.browser.evaluate(first))
            methods = self.browser.evaluate("[...document.querySelectorAll('#stability thead')][0].textContent")
            self.assertIn("separating_axis", methods)

    def test_ellipsoids(self):
        for _ in self.page("collision-time", "collision-time-of-ellipsoids", *SHORT):
            self.assertEqual(self.count("section"), 5)
            self.assertEqual(self.count(".chart canvas"), 3)

    def test_whole_run(self):
        for _ in self.page("whole-run", "whole-run", "--duration", "1", "--method", "psi_root", "-q"):
            self.assertEqual(self.count("section"), 2)
            self.assertEqual(self.count("#runs tbody tr"), 6)
            # A marker is read by the keyboard: its method, its place and its tolerance.
            self.browser.evaluate("document.querySelector('#runs-chart .plot').focus()")
            self.browser.press("ArrowRight", 39)
            self.assertIn("tolerance", self.browser.evaluate("document.querySelector('#runs-chart .readout').textContent"))


if __name__ == "__main__":
    unittest.main()
