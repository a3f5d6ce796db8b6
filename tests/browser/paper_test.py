"""Pages on paper, and charts that go into papers: what is printed and saved, looked at.

Command line: <chromium> <folder with the pages of write_pages> <pdftoppm>.
"""

import base64
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

PDFTOPPM = sys.argv.pop(3)

from pages import PageTest  # noqa: E402

DOTS = 40  # per inch
MARGIN = 14 / 25.4 * DOTS
SVG = "{http://www.w3.org/2000/svg}"


def sheets_of(pdf):
    """The pages in greys, as rows of bytes."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([PDFTOPPM, "-gray", "-r", str(DOTS), "-", f"{folder}/page"], input=pdf, check=True)
        sheets = []
        for file in sorted(pathlib.Path(folder).iterdir()):
            kind, size, _, pixels = file.read_bytes().split(b"\n", 3)
            assert kind == b"P5"
            width, height = map(int, size.split())
            sheets.append([pixels[row * width:(row + 1) * width] for row in range(height)])
        return sheets


def ink(rows, begin=0, end=None):
    """The share of pixels that are not white."""
    pixels = b"".join(row[begin:end] for row in rows)
    return sum(value < 250 for value in pixels) / len(pixels)


class Paper(PageTest):
    def print(self):
        return base64.b64decode(self.browser.call("Page.printToPDF", printBackground=True)["data"])

    def test_sheets_are_full_and_nothing_is_cut(self):
        for name, most in (("sweep.html", 12), ("run.html", 9), ("two_runs.html", 9), ("state.html", 4), ("packing.html", 4),
                           ("pair_path.html", 2), ("impact_paths.html", 2), ("scaled_maps.html", 5)):
            with self.subTest(name):
                self.open(name)
                sheets = sheets_of(self.print())
                self.assertLessEqual(len(sheets), most)
                self.assertGreater(ink(sheets[0][len(sheets[0]) // 2:]), 0.004, "the first sheet is half empty")
                for sheet in sheets:
                    self.assertGreater(ink(sheet), 0.002, "a sheet is empty")
                    self.assertEqual(ink(sheet, -int(0.9 * MARGIN)), 0, "the right margin is written on")

    def test_printed_charts_are_vectors_that_do_not_overlap(self):
        self.open("sweep.html")
        images = len(re.findall(rb"/Subtype\s*/Image", self.print()))
        pictures = self.browser.evaluate("document.querySelectorAll('canvas').length - document.querySelectorAll('.plot canvas').length")
        self.assertLessEqual(images, 2 * pictures)  # the particles and their key, each with its transparency
        self.browser.resize(694, 1000)
        self.browser.call("Emulation.setEmulatedMedia", media="print")
        self.browser.evaluate("dispatchEvent(new Event('beforeprint'))")
        boxes = self.browser.evaluate("""[...document.querySelectorAll('.chart')].filter((chart) => chart.offsetParent)
          .map((chart) => chart.getBoundingClientRect()).map(({ left, top, right, bottom }) => [left, top, right, bottom])""")
        self.assertGreater(len(boxes), 15)
        for k, (left, top, right, bottom) in enumerate(boxes):
            self.assertLessEqual(right, 695)
            for other_left, other_top, other_right, other_bottom in boxes[:k]:
                apart = left >= other_right - 1 or other_left >= right - 1 or top >= other_bottom - 1 or other_top >= bottom - 1
                self.assertTrue(apart)
        drawn = self.browser.evaluate("""[...document.querySelectorAll('.chart')].filter((chart) => chart.offsetParent)
          .every((chart) => chart.querySelector('.printed svg').getBoundingClientRect().width > 200)""")
        self.assertTrue(drawn)
        self.browser.evaluate("dispatchEvent(new Event('afterprint'))")
        self.browser.call("Emulation.setEmulatedMedia", media="")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.printed').length"), 0)

    def test_a_dark_page_is_printed_light_and_stays_dark(self):
        self.open("run.html", scheme="dark")
        sheet = sheets_of(self.print())[0]
        self.assertLess(ink(sheet), 0.5)
        self.assertEqual(self.text("theme"), "Light page")

    def test_charts_are_saved_as_vectors(self):
        self.open("sweep.html")
        (name, text), = self.browser.saved("SVG", "#motion .chart", 0)
        self.assertEqual(name, "mean_squared_displacement.svg")
        tree = xml.fromstring(text)
        self.assertEqual(tree.tag, SVG + "svg")
        texts = [node.text for node in tree.iter(SVG + "text")]
        for wanted in ("⟨|Δr(t)|²⟩ [ab]", "t [√(m ab/kT)]", "φ = 0.50", "φ = 0.60", "φ = 0.70", "10", "100"):
            self.assertIn(wanted, texts)
        # Three curves with their bands and swatches, the mark of a slope, and the ticks.
        self.assertGreater(len(list(tree.iter(SVG + "path"))), 12)
        self.assertFalse(list(tree.iter(SVG + "image")))
        names = {node.get("id") for node in tree.iter(SVG + "clipPath")}
        used = {node.get("clip-path")[5:-1] for node in tree.iter() if node.get("clip-path")}
        self.assertLessEqual(used, names)

    def test_charts_are_saved_as_pictures(self):
        self.open("sweep.html")
        (name, content), = self.browser.saved("PNG", "#motion .chart", 0)
        self.assertEqual(name, "mean_squared_displacement.png")
        picture = base64.b64decode(content)
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        width, height = int.from_bytes(picture[16:20], "big"), int.from_bytes(picture[20:24], "big")
        plot = self.browser.evaluate("""(() => { const canvas = document.querySelector('#motion .chart canvas');
          return [canvas.width, canvas.height]; })()""")
        self.assertEqual(width, plot[0])
        self.assertGreater(height, plot[1] + 40)


if __name__ == "__main__":
    unittest.main()
