"""packing_test.py <chromium> <folder with the pages of write_pages>: packings and runs in space in a browser."""

import itertools
import math
import unittest

from pages import PIXELS, SHIFT, WIDTHS, PageTest

# What there is in the picture: [count of different colours, checksum, pixels with a colour, pixels with the red of overlaps,
# mean x and y of those with a colour]. Background, edges of the box and letters have none.
LOOK = f"(() => {{ {PIXELS}" + """
  const { data, width } = pixels(document.getElementById('scene'));
  const colours = new Set();
  let sum = 0, coloured = 0, red = 0, x = 0, y = 0, last = -1;
  for (let at = 0; at < data.length; at += 4) {
    const r = data[at], g = data[at + 1], b = data[at + 2], colour = r << 16 | g << 8 | b;
    if (colour !== last) colours.add(last = colour);
    sum = Math.imul(sum, 31) + colour | 0;
    if (Math.max(r, g, b) - Math.min(r, g, b) > 12) { ++coloured; x += at / 4 % width; y += Math.floor(at / 4 / width); }
    red += r > 80 && g < 0.32 * r && b < 0.5 * r;
  }
  return [colours.size, sum, coloured, red, x / coloured, y / coloured];
})()"""

# Pictures that are only compared with each other are as good when small, and cost a software renderer much less.
SMALL = min(WIDTHS)

ROOT = math.sqrt


def times(p, q):
    return [[sum(p[i][k] * q[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def rotation(axis, angle):
    """By Rodrigues; `axis` has length 1."""
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = axis
    cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return [[(i == j) * c + s * cross[i][j] + (1 - c) * axis[i] * axis[j] for j in range(3)] for i in range(3)]


class Packing(PageTest):
    def look(self):
        self.browser.settle()
        return self.browser.evaluate(LOOK)

    def slide(self, value, axis="x"):
        self.browser.evaluate(f"""(() => {{ document.getElementById('slice-axis').value = '{axis}';
          const input = document.getElementById('slice');
          input.value = {value}; input.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()""")

    def test_fits_every_width_in_both_schemes(self):
        for width, scheme in itertools.product(WIDTHS, ("light", "dark")):
            with self.subTest(width=width, scheme=scheme):
                self.open("packing.html", width, scheme)
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)
                colours, _, coloured, *_ = self.look()
                side = self.browser.evaluate("document.getElementById('scene').width")
                self.assertGreater(colours, 1000)
                self.assertGreater(coloured, 0.1 * side**2)

    def test_dark_and_light(self):
        self.open("packing.html")
        light = self.look()[1]
        self.click("#theme")
        self.assertNotEqual(self.look()[1], light)
        self.click("#theme")
        self.assertEqual(self.look()[1], light)

    def test_controls_have_names_and_are_reached_by_tab(self):
        self.open("packing.html")
        nameless = self.browser.evaluate("""[...document.querySelectorAll('button, select, input, [tabindex]')]
          .filter((node) => node.checkVisibility() && !node.textContent.trim() && !node.getAttribute('aria-label') &&
            !node.labels?.length).map((node) => node.outerHTML)""")
        self.assertEqual(nameless, [])
        met = set()
        for _ in range(40):
            self.browser.press("Tab", 9)
            met.add(self.browser.evaluate("document.activeElement.id"))
        self.assertLessEqual({"scene", "zoom-in", "slice-axis", "slice", "images", "cut", "theme"}, met)

    def test_says_what_is_shown(self):
        self.open("packing.html")
        self.assertIn("N = 60 in a periodic box of", self.text("movie-note"))
        self.assertEqual(self.text("overlaps"), "✓ No overlap (exact check of the stored numbers).")
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.chart:not([hidden]) canvas').length"), 3)

    # The box of 8 has a diagonal of 13.86; 0.515 of it are half of the picture. The first view has z upwards, then turned by
    # -0.6 about the vertical and by 0.42 about the horizontal. A body of the shape matrix S casts π √det of the block S_xy.
    VIEW = times(rotation((1, 0, 0), 0.42), times(rotation((0, 1, 0), -0.6), [[1, 0, 0], [0, 0, 1], [0, -1, 0]]))

    def side_and_scale(self):
        side = self.browser.evaluate("document.getElementById('scene').width")
        return side, side / (2 * 0.515 * ROOT(3) * 8)

    def shadow(self, degrees):
        _, scale = self.side_and_scale()
        turned = times(self.VIEW, rotation((1 / 3, 2 / 3, 2 / 3), math.radians(degrees)))
        squares = (9, 2.25, 0.5625)
        xx, xy, yy = (sum(turned[i][k] * turned[j][k] * squares[k] for k in range(3)) for i, j in ((0, 0), (0, 1), (1, 1)))
        return math.pi * ROOT(xx * yy - xy * xy) * scale**2

    def test_a_body_casts_its_shadow(self):
        self.open("one_body.html")
        shadow = self.shadow(40)
        self.assertAlmostEqual(self.look()[2] / shadow, 1, delta=0.02)
        self.focus("#scene")
        self.browser.press("-", 189, "-")
        self.assertAlmostEqual(self.look()[2] * 1.5**2 / shadow, 1, delta=0.03)

    def test_a_run_in_space_shows_the_body_of_every_frame(self):
        self.open("space_run.html")
        for frame in (0, 2, 4, 1):
            with self.subTest(frame=frame):
                self.scrub(frame)
                self.assertIn(f"frame {frame + 1} of 5", self.text("clock"))
                self.assertAlmostEqual(self.look()[2] / self.shadow(20 * frame), 1, delta=0.02)
        self.slide(0, "x")
        self.assertLess(self.look()[2], 0.7 * self.shadow(20))

    def test_a_run_in_space_has_the_curves_of_a_run(self):
        self.open("space_run.html")
        for section in ("motion", "relaxation", "structure"):
            self.assertGreater(self.browser.evaluate(f"document.querySelectorAll('#{section} canvas').length"), 0)

    def test_spheres_are_drawn_where_they_are_in_every_frame(self):
        self.open("spheres_run.html")
        side, scale = self.side_and_scale()
        for frame in (0, 3, 1):
            self.scrub(frame)
            *_, x, y = self.look()
            middle = ((1.5 * frame - 2 + 1) / 2, 1.9 / 2, 0)  # of two equal discs
            right, up = (sum(self.VIEW[axis][k] * middle[k] for k in range(3)) for axis in (0, 1))
            # A tenth of a radius: their highlights may count as white.
            self.assertAlmostEqual(x, side / 2 + right * scale, delta=0.1 * scale)
            self.assertAlmostEqual(y, side / 2 - up * scale, delta=0.1 * scale)
        inside = self.look()[2]
        self.click("#images")
        self.assertEqual(self.look()[2], inside)
        self.scrub(4)
        one_half = self.look()[2]
        self.click("#images")
        self.assertGreater(self.look()[2], 1.2 * one_half)

    def test_overlaps_of_a_run_are_red_in_their_frames(self):
        self.open("spheres_run.html")
        self.assertIn("Overlaps in 1 of 5 frames", self.text("overlaps"))
        self.assertEqual(self.look()[3], 0)
        self.click("#overlaps button")
        self.assertIn("frame 3 of 5", self.text("clock"))
        self.assertGreater(self.look()[3], 500)
        self.scrub(3)
        self.assertEqual(self.look()[3], 0)

    def test_a_run_in_space_plays_steps_and_turns(self):
        self.open("spheres_run.html")
        self.focus("#scene")
        self.browser.press("ArrowRight", 39)
        self.assertIn("frame 1 of 5", self.text("clock"))
        turned = self.look()[1]
        self.browser.press(".", 190, ".")
        self.assertIn("frame 2 of 5", self.text("clock"))
        self.browser.press(",", 188, ",")
        self.assertEqual(self.look()[1], turned)
        self.browser.press("0", 48, "0")
        self.assertNotEqual(self.look()[1], turned)
        self.click("#play")
        self.browser.evaluate("""new Promise((done) => { const wait = () =>
          document.getElementById('play').textContent === 'Play' ? done() : setTimeout(wait, 20); wait(); })""")
        self.assertIn("frame 5 of 5", self.text("clock"))

    def test_the_cooling_curve_is_that_of_the_table(self):
        self.open("space_run.html")
        csv = self.browser.evaluate("""(() => { let address;
          HTMLAnchorElement.prototype.click = function () { address = this.href; };
          document.querySelector('#cooling .tools button').click();
          return decodeURIComponent(address.split(',').slice(1).join(',')); })()""")
        rows = [[float(value) for value in line.split(",")] for line in csv.splitlines()[1:]]
        # Samples at 1, 2 … 49, as 0 is not on a logarithmic axis, of T = 1/(1 + t/3)²; the page has six digits.
        self.assertEqual([row[0] for row in rows], list(range(1, 50)))
        for time, run, law in rows:
            temperature = (1 + time / 3) ** -2
            self.assertAlmostEqual(run / temperature, 1, delta=1e-5)
            self.assertAlmostEqual(law / temperature, 1, delta=1e-5)

    def test_a_cooling_gas_shows_its_temperature_and_the_law(self):
        self.open("space_run.html")
        law = self.data()["runs"][0]["cooling"]
        self.assertAlmostEqual(law["initial"], 1, places=9)
        self.assertAlmostEqual(law["time"], 3, places=6)
        self.assertEqual(law["exponent"], 2)
        self.assertIn("the coefficient of restitution is constant", self.browser.evaluate(
            "document.getElementById('cooling-heading').closest('section').textContent"))
        # Behind the picture, before all other sections.
        sections = self.browser.evaluate("[...document.querySelectorAll('section h2')].map((heading) => heading.id)")
        self.assertEqual(sections[:2], ["particles", "cooling-heading"])

    def test_turns_by_keys_and_comes_back(self):
        self.open("packing.html", SMALL)
        first = self.look()[1]
        self.focus("#scene")
        pictures = {first}
        for key, code in (("ArrowLeft", 37), ("ArrowUp", 38), ("ArrowRight", 39), ("ArrowDown", 40)):
            self.browser.press(key, code)
            pictures.add(self.look()[1])
        self.assertGreaterEqual(len(pictures), 4)
        self.browser.press("0", 48, "0")
        self.assertEqual(self.look()[1], first)
        self.browser.press("ArrowRight", 39, modifiers=SHIFT)
        self.assertNotIn(self.look()[1], pictures)
        self.browser.press("ArrowLeft", 37, modifiers=SHIFT)
        self.assertEqual(self.look()[1], first)
        self.browser.press("+", 187, "+")
        self.assertGreater(self.look()[2], 0)
        self.click("#zoom-reset")
        self.assertEqual(self.look()[1], first)

    def drag(self, from_x, to_x):
        for kind, x in (("mousePressed", from_x), ("mouseMoved", (from_x + to_x) / 2), ("mouseMoved", to_x), ("mouseReleased", to_x)):
            self.browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=500, button="left", buttons=1, clickCount=1)

    def test_turns_by_the_mouse(self):
        self.open("packing.html")
        first = self.look()[1]
        self.drag(300, 420)
        self.assertNotEqual(self.look()[1], first)

    def touch(self, *gestures):
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        for k, points in enumerate(gestures):
            self.browser.call("Input.dispatchTouchEvent", type="touchMove" if k else "touchStart",
                              touchPoints=[{"x": x, "y": 400, "id": n} for n, x in enumerate(points)])
        self.browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=False)

    def test_one_finger_turns_and_two_zoom(self):
        self.open("one_body.html", 390)
        _, first, area, *_ = self.look()
        self.touch([180], [200], [240])
        turned = self.look()[1]
        self.assertNotEqual(turned, first)
        self.click("#zoom-reset")
        self.touch([165, 225], [160, 230], [150, 240])
        # The fingers are 90 apart instead of 60, about the middle.
        self.assertAlmostEqual(self.look()[2] / area, 2.25, delta=0.15)

    def test_wheel_zooms_only_a_picture_in_focus(self):
        self.open("one_body.html")
        area = self.look()[2]
        self.focus("#scene")
        self.browser.evaluate("window.scrollTo(0, 0)")
        self.browser.wheel(430, 500, -200)
        self.browser.evaluate("new Promise((done) => setTimeout(done, 200))")
        self.assertGreater(self.look()[2], 1.5 * area)

    def test_slices_take_away_more_and_more(self):
        self.open("packing.html", SMALL)
        whole = self.look()[2]
        for axis in ("x", "y", "z", "view"):
            with self.subTest(axis=axis):
                seen = []
                for place in (1, 0.5, 0.1, 0):
                    self.slide(place, axis)
                    seen.append(self.look()[2])
                self.assertEqual(seen[0], whole)
                self.assertGreater(seen[1], seen[2])
                self.assertGreater(seen[2], 0)
                # What the last face of the box cuts, if it is a face.
                self.assertLess(seen[3], 0.12 * whole if axis != "view" else 25)
        self.slide(1, "x")
        self.assertEqual(self.look()[2], whole)

    def test_images_and_cuts(self):
        self.open("packing.html", SMALL)
        cut = self.look()[2]
        self.click("#images")
        without_images = self.look()[2]
        self.assertLess(without_images, 0.95 * cut)
        self.click("#cut")
        whole_bodies = self.look()[2]
        self.assertGreater(whole_bodies, without_images)
        self.click("#images")
        self.assertGreater(self.look()[2], 1.1 * whole_bodies)
        self.click("#cut")
        self.assertEqual(self.look()[2], cut)

    def test_colours(self):
        self.open("packing.html")
        orientation = self.look()[1]
        self.assertIn("axis of symmetry", self.text("key-text"))
        self.click("#colour input[value=species]")
        self.assertNotEqual(self.look()[1], orientation)
        self.assertEqual(self.text("key-text"), "species")
        self.click("#colour input[value=orientation]")
        self.assertEqual(self.look()[1], orientation)
        self.open("one_body.html")
        self.assertTrue(self.browser.evaluate("document.getElementById('colour').hidden"))

    def test_overlaps_are_red_where_the_flags_say_so(self):
        self.open("packing.html")
        self.assertEqual(self.look()[3], 0)
        self.open("overlapping.html")
        self.assertGreater(self.look()[3], 500)
        self.assertIn("✗ 1 overlapping pair(s), in red", self.text("overlaps"))

    def test_without_webgl_the_rest_is_there(self):
        script = self.browser.call("Page.addScriptToEvaluateOnNewDocument", source="""
          const original = HTMLCanvasElement.prototype.getContext;
          HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
            return kind === 'webgl2' ? null : original.call(this, kind, ...rest);
          };""")
        self.open("packing.html")
        self.browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script["identifier"])
        self.assertIn("needs WebGL 2", self.text("movie-note"))
        self.assertFalse(self.browser.evaluate("document.getElementById('scene').checkVisibility()"))
        self.assertEqual(self.browser.evaluate("document.querySelectorAll('.chart:not([hidden]) canvas').length"), 3)


if __name__ == "__main__":
    unittest.main()
