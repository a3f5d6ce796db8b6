"""figures_test.py <chromium> <folder with the pages of write_pages>: figures of a pair in a browser."""

import itertools
import json
import unittest

from pages import PIXELS, WIDTHS, PageTest

# How many different colours the canvas of a figure has.
COLOURS = f"(k) => {{ {PIXELS}" + """
  const { data } = pixels(document.querySelectorAll('.chart canvas')[k]);
  const colours = new Set();
  for (let at = 0; at < data.length; at += 4) colours.add(data[at] << 16 | data[at + 1] << 8 | data[at + 2]);
  return colours.size;
}"""
CHARTS = {"pair_path.html": 4, "impact_paths.html": 2, "scaled_maps.html": 25}


class Figures(PageTest):
    def ask(self, function, *arguments):
        self.browser.settle()
        return self.browser.evaluate(f"({function})({', '.join(map(json.dumps, arguments))})")

    def saved(self, number, button):
        """What this button beside a figure saves."""
        (_, text), = self.browser.saved(button, number=number)
        return text

    def test_fit_every_width_in_both_schemes(self):
        for (name, charts), width, scheme in itertools.product(CHARTS.items(), WIDTHS, ("light", "dark")):
            with self.subTest(name, width=width, scheme=scheme):
                self.open(name, width, scheme)
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)
                self.assertEqual(self.browser.evaluate("document.querySelectorAll('.chart canvas').length"), charts)

    def test_a_map_has_colours_and_a_constant_has_one(self):
        self.open("scaled_maps.html")
        letters = self.ask(COLOURS, 1)  # ε_ṙ = −1 of elastic spheres
        self.assertGreater(self.ask(COLOURS, 0), letters + 200)

    def test_what_is_saved_is_what_is_shown(self):
        self.open("scaled_maps.html")
        lines = self.saved(3, "CSV").splitlines()
        self.assertEqual(lines[0], "ln_c_phi_over_min,ln_l_over_min,duration")
        self.assertEqual(len(lines), 1 + 41**2)
        self.assertGreater(self.saved(3, "SVG").count("<path"), 1600)
        self.open("impact_paths.html")
        head, *rows = self.saved(1, "CSV").splitlines()
        self.assertEqual(head.split(",")[:3], ["time", "integrated_x_1", "integrated_y_1"])
        self.assertEqual(len(rows), 131)
        self.assertIn("soft spheres", self.saved(1, "SVG"))

    def test_first_contact_is_marked_inside_the_frame(self):
        self.open("pair_path.html")
        self.assertIn('text-anchor="start"', self.saved(0, "SVG").split("first contact")[0].split("<text")[-1])


if __name__ == "__main__":
    unittest.main()
