"""picture_test.py <chromium> <folder with the pages of write_pages>: the moving pictures of the report pages in a browser."""

import base64
import math
import struct
import sys
import unittest

from pages import FOLDER, PIXELS, SHIFT, PageTest


class Picture(PageTest):
    def test_scrubbing_changes_the_picture_and_comes_back(self):
        self.open("run.html")
        colours, first, *_ = self.look()
        self.assertGreater(colours, 50)
        self.scrub(5)
        self.assertNotEqual(self.look()[1], first)
        self.assertEqual(self.text("clock"), "t = 2.5 √(m ab/kT), frame 6 of 20")
        self.scrub(0)
        self.assertEqual(self.look()[1], first)

    def test_overlaps_are_red_where_the_flags_say_so(self):
        self.open("run.html")
        self.assertIn("Overlaps in 1 of 20 frames", self.text("overlaps"))
        self.assertEqual(self.look()[2], 0)
        self.click("#overlaps button")
        self.assertIn("frame 3 of 20", self.text("clock"))
        self.assertIn("1 overlapping pair(s) in this frame", self.text("overlaps"))
        # Particles 0 and 1 lie half a unit apart at (-14 + 2, -14 + 1) in a box of 32, which with its margins
        # of 3 % fills the canvas.
        _, _, red, x, y = self.look()
        width = self.browser.evaluate("document.getElementById('scene').width")
        scale = width / (32 * 1.06)
        self.assertAlmostEqual(x, width / 2 + (-12 + 0.25) * scale, delta=3)
        self.assertAlmostEqual(y, width / 2 - (-13) * scale, delta=3)
        # Between the area of one ellipse, π, less its outline, and that of two.
        self.assertGreater(red, 0.7 * math.pi * scale**2)
        self.assertLess(red, 2 * math.pi * scale**2)
        self.scrub(3)
        self.assertEqual(self.look()[2], 0)

    def test_colours(self):
        self.open("run.html")
        self.scrub(8)
        pictures, keys = [], []
        for kind in ("orientation", "displacement", "species"):
            self.click(f"#colour input[value={kind}]")
            pictures.append(self.look()[1])
            keys.append(self.text("key-text"))
        self.assertEqual(len(set(pictures)), 3)
        self.assertEqual(len(set(keys)), 3)

    def test_displacement_is_followed_over_the_edges(self):
        # In frame 19 every particle has gone (19, 9.5); the colours end there, and every particle has the last one.
        self.open("run.html")
        self.click("#colour input[value=displacement]")
        self.scrub(19)
        yellow = self.browser.evaluate(f"(() => {{ {PIXELS}" + """
          const { data, width } = pixels(document.getElementById('scene'));
          let count = 0;
          for (let at = 0; at < data.length; at += 4) if (data[at] === 253 && data[at + 1] === 231 && data[at + 2] === 37) ++count;
          return count / width ** 2 * (32 * 1.06) ** 2;
        })()""")
        # 64 ellipses of area π less their outlines.
        self.assertGreater(yellow, 0.75 * 64 * math.pi)
        self.assertLess(yellow, 64 * math.pi)

    def test_poses_are_drawn_where_they_are(self):
        self.open("run.html")
        movie = self.data()["runs"][0]["movie"]
        poses = struct.unpack(f"<{3 * 64 * 20}H", base64.b64decode(movie["poses"]))
        self.assertAlmostEqual(poses[0] / 65536, 2 / 32, delta=1e-5)
        colours = self.browser.evaluate(f"(() => {{ {PIXELS}" + """
          const { data, width } = pixels(document.getElementById('scene')), scale = width / (32 * 1.06);
          const at = (x, y) => [...data.subarray(...[0, 4].map((part) => part +
            4 * (Math.floor(width / 2 + x * scale) + width * Math.floor(width / 2 - y * scale))))].join();
          return [at(-14, -14), at(-12, -14), at(14, 14), at(12, 12)]; })()""")
        self.assertEqual(colours[0], colours[2])  # two particles
        self.assertEqual(colours[1], colours[3])  # between particles
        self.assertNotEqual(colours[0], colours[1])

    def test_keyboard(self):
        self.open("run.html")
        self.focus("#scene")
        whole = self.look()[1]
        self.browser.press("ArrowRight", 39)
        self.assertIn("frame 2 of 20", self.text("clock"))
        self.browser.press("End", 35)
        self.assertIn("frame 20 of 20", self.text("clock"))
        self.browser.press("ArrowLeft", 37)
        self.assertIn("frame 19 of 20", self.text("clock"))
        self.browser.press("Home", 36)
        self.assertEqual(self.look()[1], whole)
        self.browser.press("+", 187, "+")
        zoomed = self.look()[1]
        self.assertNotEqual(zoomed, whole)
        self.browser.press("ArrowRight", 39, modifiers=SHIFT)
        self.assertNotEqual(self.look()[1], zoomed)
        self.browser.press("0", 48, "0")
        self.assertEqual(self.look()[1], whole)
        self.browser.press(" ", 32, " ")
        self.assertEqual(self.text("play"), "Pause")
        self.browser.evaluate("""new Promise((done) => { const wait = () =>
          document.getElementById('scrub').value > 2 ? done() : setTimeout(wait, 20); wait(); })""")
        self.browser.press(" ", 32, " ")
        self.assertEqual(self.text("play"), "Play")
        stopped = self.text("clock")
        self.browser.evaluate("new Promise((done) => setTimeout(done, 300))")
        self.assertEqual(self.text("clock"), stopped)

    def test_range_input_scrubs_by_arrows(self):
        self.open("run.html")
        self.focus("#scrub")
        self.browser.press("ArrowRight", 39)
        self.assertIn("frame 2 of 20", self.text("clock"))

    def test_plays_to_the_end_and_from_the_start_again(self):
        self.open("run.html")
        self.browser.evaluate("""(() => { const speed = document.getElementById('speed');
          speed.value = 60; speed.dispatchEvent(new Event('change')); })()""")
        self.click("#play")
        self.browser.evaluate("""new Promise((done) => { const wait = () =>
          document.getElementById('play').textContent === 'Play' ? done() : setTimeout(wait, 20); wait(); })""")
        self.assertIn("frame 20 of 20", self.text("clock"))
        self.browser.evaluate("document.getElementById('speed').value = 1")
        self.browser.evaluate("document.getElementById('speed').dispatchEvent(new Event('change'))")
        self.click("#play")
        self.browser.evaluate("""new Promise((done) => { const wait = () =>
          document.getElementById('scrub').value === '1' ? done() : setTimeout(wait, 20); wait(); })""")
        self.assertIn("frame 2 of 20", self.text("clock"))

    def test_nothing_moves_by_itself_and_play_is_slow_where_motion_is_unwanted(self):
        self.open("run.html", reduced_motion=True)
        before = self.look()[1]
        self.assertEqual(self.browser.evaluate("document.getElementById('speed').value"), "1")
        self.browser.evaluate("new Promise((done) => setTimeout(done, 300))")
        self.assertEqual(self.look()[1], before)

    def test_wheel_zooms_only_a_picture_in_focus(self):
        self.open("run.html")
        whole = self.look()[1]
        self.browser.wheel(400, 400, -200)
        self.browser.evaluate("new Promise((done) => setTimeout(done, 200))")
        self.assertEqual(self.look()[1], whole)
        self.browser.evaluate("window.scrollTo(0, 0)")
        self.focus("#scene")
        self.browser.wheel(400, 400, -200)
        self.browser.evaluate("new Promise((done) => setTimeout(done, 200))")
        self.assertNotEqual(self.look()[1], whole)

    def test_two_fingers_zoom(self):
        self.open("run.html")
        whole = self.look()[1]
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
        for kind, reach in (("touchStart", 30), ("touchMove", 60), ("touchMove", 120)):
            points = [{"x": 400 + side * reach, "y": 500, "id": k} for k, side in enumerate((-1, 1))]
            self.browser.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        self.browser.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=False)
        self.assertNotEqual(self.look()[1], whole)

    def test_a_sweep_shows_the_run_that_is_chosen(self):
        self.open("sweep.html")
        self.assertIn("frame 1 of 12", self.text("clock"))
        self.browser.evaluate("""(() => { const select = document.querySelector('#movie-run select');
          select.value = 1; select.dispatchEvent(new Event('change')); })()""")
        self.assertEqual(self.text("course-run"), "at φ = 0.60")
        self.assertEqual(self.text("clock"), "t = 0 √(m ab/kT)")
        self.assertIn("Only the final state of this run is in the page", self.text("movie-note"))
        self.assertFalse(self.browser.evaluate("document.getElementById('player').checkVisibility()"))
        self.assertGreater(self.look()[0], 50)

    def test_large_page_is_small_enough_and_plays(self):
        self.assertLess((FOLDER / "large.html").stat().st_size, 2_000_000)
        self.open("large.html")
        self.assertIn("The page holds 195 of 200 frames, evenly thinned", self.text("movie-note"))
        milliseconds = self.browser.evaluate("""(() => { const from = performance.now(); const input = document.getElementById('scrub');
          for (let k = 0; k < 20; ++k) { input.value = k; input.dispatchEvent(new Event('input')); }
          return (performance.now() - from) / 20; })()""")
        print(f"a frame of 1024 particles takes {milliseconds:.1f} ms", file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
