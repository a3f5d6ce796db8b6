"""What the tests of pages share. Command line: <chromium> <folder with the pages of write_pages>."""

import json
import pathlib
import sys
import unittest

from browser import Browser

PROGRAM, FOLDER = sys.argv.pop(1), pathlib.Path(sys.argv.pop(1)).resolve()
WIDTHS = (390, 820, 1440)
SHIFT = 8

# The pixels of a canvas, read from a copy: reading from the canvas itself would make the browser complain.
PIXELS = """const pixels = (canvas) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height);
  };"""

# The picture of the movie as [count of different colours, checksum, pixels of the red of overlaps, their mean x and y].
LOOK = f"(() => {{ {PIXELS}" + """
  const { data, width } = pixels(document.getElementById('scene'));
  const colours = new Set();
  let sum = 0, red = 0, x = 0, y = 0, last = -1;
  for (let at = 0; at < data.length; at += 4) {
    const r = data[at], g = data[at + 1], b = data[at + 2], colour = r << 16 | g << 8 | b;
    if (colour !== last) colours.add(last = colour);
    sum = Math.imul(sum, 31) + colour | 0;
    if (r === 242 && g === 0 && b === 60) { ++red; x += at / 4 % width; y += Math.floor(at / 4 / width); }
  }
  return [colours.size, sum, red, red ? x / red : null, red ? y / red : null];
})()"""


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(PROGRAM)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, name, width=1440, scheme="light", reduced_motion=False):
        self.browser.complaints.clear(), self.browser.requests.clear()
        self.browser.resize(width, 900, scheme, reduced_motion)
        self.address = (FOLDER / name).as_uri()
        self.browser.open(self.address)

    def tearDown(self):
        self.browser.settle()
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual(self.browser.requests, [self.address])

    def look(self):
        self.browser.settle()
        return self.browser.evaluate(LOOK)

    def text(self, name):
        return self.browser.evaluate(f"document.getElementById('{name}').textContent")

    def scrub(self, frame):
        self.browser.evaluate(f"""(() => {{ const input = document.getElementById('scrub');
          input.value = {frame}; input.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()""")

    def click(self, selector):
        self.browser.evaluate(f"document.querySelector({json.dumps(selector)}).click()")

    def focus(self, selector):
        self.browser.evaluate(f"document.querySelector({json.dumps(selector)}).focus()")

    def data(self):
        return json.loads(self.browser.evaluate("document.getElementById('data').textContent"))
