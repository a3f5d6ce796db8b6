"""bench_test.py <chromium> <vitrel-bench>: the pages of the studies in a browser."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from browser import Browser

PROGRAM, CHROMIUM = sys.argv.pop(), sys.argv.pop()


class StudyPage(unittest.TestCase):
    def count(self, selector):
        return self.browser.evaluate(f"document.querySelectorAll('{selector}').length")

    def page(self, *command):
        """What a test sees, in the light and the dark, on a wide and on a narrow screen."""
        with tempfile.TemporaryDirectory() as folder, Browser(CHROMIUM) as self.browser:
            page = pathlib.Path(folder, "page.html")
            subprocess.run([PROGRAM, *command, "-q", "-o", page], check=True, stderr=subprocess.DEVNULL)
            for width, scheme in ((1300, "light"), (420, "dark")):
                self.browser.resize(width, 900, scheme)
                self.browser.open(f"file://{page}")
                self.assertEqual(self.browser.complaints, [])
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)
                self.assertEqual(self.count("#provenance + dl"), 1)
                yield

    def test_contact_time(self):
        for _ in self.page("contact-time", "--class", "generic", "--pairs", "30", "--seconds", "0.2"):
            self.assertEqual(self.count("#parts section"), 6)
            self.assertEqual(self.count(".chart canvas"), 3)
            self.assertGreater(self.count("#failures pre"), 3)
            first = "document.querySelector('#plane tbody tr').textContent"
            self.assertIn("generic, κ = 2", self.browser.evaluate(first))

    def test_whole_run(self):
        for _ in self.page("whole-run", "--duration", "1", "--method", "psi_root"):
            self.assertEqual(self.count("#thesis tbody tr"), 6)
            # A marker is read by the keyboard: its method, its place and its tolerance.
            self.browser.evaluate("document.querySelector('#thesis .plot').focus()")
            self.browser.press("ArrowRight", 39)
            self.assertIn("tolerance", self.browser.evaluate("document.querySelector('#thesis .readout').textContent"))


if __name__ == "__main__":
    unittest.main()
