"""report_test.py <chromium> <folder with the pages of write_pages>: the report pages in a browser."""

import base64
import itertools
import math
import re
import struct
import unittest
import zlib

from pages import PIXELS, WIDTHS, PageTest


class Page(PageTest):
    # The page

    def test_fits_every_width_in_both_schemes(self):
        for name, width, scheme in itertools.product(("sweep.html", "run.html", "two_runs.html", "state.html"), WIDTHS, ("light", "dark")):
            with self.subTest(name=name, width=width, scheme=scheme):
                self.open(name, width, scheme)
                self.assertLessEqual(self.browser.evaluate("document.documentElement.scrollWidth"), width)
                self.assertGreater(self.look()[0], 50)

    def test_dark_and_light(self):
        background = "getComputedStyle(document.body).backgroundColor"
        self.open("sweep.html", scheme="light")
        light, picture = self.browser.evaluate(background), self.look()[1]
        self.click("#theme")
        dark = self.browser.evaluate(background)
        self.assertNotEqual(dark, light)
        self.assertNotEqual(self.look()[1], picture)
        self.click("#theme")
        self.assertEqual(self.browser.evaluate(background), light)
        self.assertEqual(self.look()[1], picture)
        self.browser.resize(1440, 900, "dark")
        self.open("sweep.html", scheme="dark")
        self.assertEqual(self.browser.evaluate(background), dark)

    def test_headings_descend_and_controls_have_names(self):
        for name in ("sweep.html", "state.html"):
            self.open(name)
            levels = self.browser.evaluate("""[...document.querySelectorAll('h1, h2, h3')]
              .filter((heading) => heading.checkVisibility()).map((heading) => Number(heading.tagName[1]))""")
            self.assertEqual(levels[0], 1)
            self.assertEqual(levels.count(1), 1)
            self.assertLessEqual(max(b - a for a, b in zip(levels, levels[1:])), 1)
            nameless = self.browser.evaluate("""[...document.querySelectorAll('button, select, input, [tabindex]')]
              .filter((node) => node.checkVisibility() && !node.textContent.trim() && !node.getAttribute('aria-label') &&
                !node.labels?.length).map((node) => node.outerHTML)""")
            self.assertEqual(nameless, [])

    def test_every_control_is_reached_by_tab_and_shows_the_focus(self):
        self.open("sweep.html")
        met = set()
        for _ in range(200):
            self.browser.call("Input.dispatchKeyEvent", type="keyDown", key="Tab", windowsVirtualKeyCode=9)
            self.browser.call("Input.dispatchKeyEvent", type="keyUp", key="Tab", windowsVirtualKeyCode=9)
            where, width = self.browser.evaluate("""(() => { const node = document.activeElement;
              const styled = node.matches('.picker input') ? node.parentElement : node;
              return [node.id || node.className || node.tagName, getComputedStyle(styled).outlineStyle]; })()""")
            if where == "BODY":
                break
            self.assertNotEqual(width, "none", where)
            met.add(where)
        self.assertLessEqual({"scene", "play", "scrub", "speed", "zoom-in", "zoom-out", "zoom-reset", "theme", "plot"}, met)

    def test_what_is_not_known_is_not_shown(self):
        self.open("bare.html")
        shown = self.browser.evaluate("""[...document.querySelectorAll('h2')].filter((heading) => heading.checkVisibility())
          .map((heading) => heading.textContent)""")
        self.assertEqual(shown, ["Particles", "Table of runs", "Parameters and provenance"])
        self.assertEqual(self.text("movie-note"), "The run holds no frame.")

    # The charts

    def chart(self, heading):
        return f"""[...document.querySelectorAll('.chart')].find((chart) =>
          chart.querySelector('h3').textContent === '{heading}')"""

    def headings(self):
        return self.browser.evaluate("[...document.querySelectorAll('.chart h3')].map((heading) => heading.textContent)")

    def test_a_chart_for_every_table(self):
        curves = ["Mean squared displacement", "Mean squared rotation", "Non-Gaussian parameter",
                  "Self-intermediate scattering", "Orientational correlation", "Collective scattering",
                  "Four-point susceptibility", "Overlap", "Structure factor", "Pair correlation",
                  "Orientations about the director", "Energy per particle", "Compressibility factor", "Order", "Director"]
        self.open("run.html")
        self.assertEqual(self.headings(), curves)
        self.open("state.html")
        self.assertEqual(self.headings(), ["Pair correlation", "Structure factor", "Nematic correlation; dashed: S²",
                                           "Orientations kept; dashed: 1/e", "Displacement in widths 2b; dashed: 1"])
        self.open("sweep.html")
        self.assertEqual(self.headings(), ["Relaxation times", "Diffusion", "Compressibility factor", "Nematic order",
                                           "Collisions", "Speed of the simulation"] + curves)
        blank = self.browser.evaluate(f"(() => {{ {PIXELS}" + """
          return [...document.querySelectorAll('.chart')].filter((chart) =>
            new Set(new Uint32Array(pixels(chart.querySelector('canvas')).data.buffer)).size < 20)
            .map((chart) => chart.textContent); })()""")
        self.assertEqual(blank, [])

    def test_the_legend_hides_a_run_in_all_charts(self):
        self.open("sweep.html")
        ink = """[...document.querySelectorAll('#motion canvas, #structure canvas')].map((canvas) => canvas.toDataURL())"""
        before = self.browser.evaluate(ink)
        self.click(".densities button")
        self.browser.settle()
        after = self.browser.evaluate(ink)
        self.assertTrue(all(a != b for a, b in zip(before, after)))
        self.assertEqual(self.browser.evaluate("""[...document.querySelectorAll('.densities')].map((legend) =>
          legend.firstChild.getAttribute('aria-pressed'))"""), ["false"] * 3)
        self.click(".densities button")
        self.browser.settle()
        self.assertEqual(self.browser.evaluate(ink), before)

    def test_a_chart_of_several_runs_shows_the_column_that_is_chosen(self):
        self.open("sweep.html")
        labels = self.browser.evaluate("[...document.querySelectorAll('#relaxation .chart:first-child option')].map((o) => o.textContent)")
        self.assertEqual(labels[:3], ["q = 2.4, all particles", "q = 5, all particles", "q = 2.4, species A"])
        picture = "document.querySelector('#relaxation canvas').toDataURL()"
        before = self.browser.evaluate(picture)
        self.browser.evaluate("""(() => { const select = document.querySelector('#relaxation select');
          select.value = 1; select.dispatchEvent(new Event('change')); })()""")
        self.browser.settle()
        self.assertNotEqual(self.browser.evaluate(picture), before)

    def test_correlations_measured_on_the_fly_are_shown(self):
        self.open("run.html")
        charts = self.browser.evaluate("""[...document.querySelectorAll('.chart')].map((chart) =>
          [chart.querySelector('h3').textContent, ...[...chart.querySelectorAll('option')].map((o) => o.textContent)])""")
        measured = [chart[0] for chart in charts if "all particles, on the fly" in chart]
        self.assertEqual(measured, ["Mean squared displacement", "Self-intermediate scattering"])
        self.browser.evaluate("""(() => { const select = document.querySelector('#relaxation select');
          select.value = select.options.length - 1; select.dispatchEvent(new Event('change')); })()""")
        self.browser.settle()
        legend = self.browser.evaluate("document.querySelector('#relaxation .chart').textContent")
        self.assertIn("q = 3.1", legend)

    def test_arrow_keys_read_values(self):
        self.open("run.html")
        self.focus("#relaxation .plot")
        self.browser.press("ArrowLeft", 37)
        readout = "document.querySelector('#relaxation .readout').textContent"
        first = self.browser.evaluate(readout)
        self.assertRegex(first, r"^q = 2\.4:  t = [\d.]+,  0\.\d+ ± 0\.\d+")
        self.browser.press("ArrowDown", 40)
        self.assertRegex(self.browser.evaluate(readout), r"^q = 5:  t = [\d.]+,  ")

    def test_a_time_of_zero_is_not_on_a_logarithmic_axis(self):
        self.open("run.html")
        chart = self.chart("Collective scattering")
        self.browser.evaluate(f"{chart}.querySelector('.plot').focus()")
        for _ in range(60):  # to the left end
            self.browser.press("ArrowLeft", 37)
        readout = self.browser.evaluate(f"{chart}.querySelector('.readout').textContent")
        self.assertRegex(readout, r"^q = 2\.4:  t = 0\.5,")

    def glass_legend(self, chart):
        return self.browser.evaluate(f"""[...document.querySelectorAll('#study .chart:nth-child({chart}) .legend button')]
          .map((button) => [button.textContent, button.querySelector('i').className])""")

    def choose_law(self, law):
        self.browser.evaluate(f"""(() => {{ const select = document.querySelector('#study select');
          select.value = {law}; select.dispatchEvent(new Event('change')); }})()""")
        self.browser.settle()

    def canvas_texts(self, chart):
        """What the canvas of a chart is given to write when the page changes its colours: [text, x, y]."""
        return self.browser.evaluate(f"""(async () => {{
          const texts = [], fill = CanvasRenderingContext2D.prototype.fillText;
          const canvas = () => document.querySelector('{chart} canvas');
          CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {{
            texts.push([this.canvas, text, x, y]);
            fill.call(this, text, x, y); }};
          document.getElementById('theme').click();
          await new Promise(requestAnimationFrame);
          CanvasRenderingContext2D.prototype.fillText = fill;
          return texts.filter(([where, text]) => where === canvas() && text).map(([, ...text]) => text); }})()""")

    def test_points_that_did_not_equilibrate_are_hollow_and_out_of_the_fit(self):
        self.open("sweep.html")
        points = [["translation", "full"], ["translation, not equilibrated", "hollow"], ["rotation", "full"],
                  ["rotation in the nematic", "full"], ["rotation in the nematic, not equilibrated", "hollow"]]
        self.assertEqual(self.glass_legend(1), points + [["translation, power law", "line"], ["rotation, power law", "line"],
                                                         ["rotation in the nematic, power law", "line"]])
        # Vogel-Fulcher is refused for rotation: no curve, and no φ_c.
        self.choose_law(1)
        self.assertEqual(self.glass_legend(1), points + [["translation, Vogel–Fulcher", "line"]])
        self.assertEqual([text for text, *_ in self.canvas_texts("#study .chart") if "φc" in text], ["φc translation = 0.850"])

    def test_transition_densities_stand_where_they_are(self):
        self.open("sweep.html")
        texts = self.canvas_texts("#study .chart")
        marks = [text for text in texts if "φc" in text[0]]
        self.assertEqual([text for text, *_ in marks],
                         ["φc translation = 0.800", "φc rotation > 0.795", "φc rotation in the nematic > 0.785"])
        # Labels end left of their lines, 0.8, 0.795 and 0.785 on an axis from 0.6 − m to 0.805 + m, m = 6 % of 0.205.
        width = self.browser.evaluate("document.querySelector('#study .u-over').clientWidth")
        for (_, x, _), density in zip(marks[1:], (0.795, 0.785)):
            self.assertAlmostEqual((marks[0][1] - x) / width, (0.8 - density) / (1.12 * 0.205), delta=1.5 / width)

    def glass_readings(self, curve):
        """All (φ, τ) of a curve of the chart, read by arrow keys."""
        self.focus("#study .plot")
        self.browser.press("ArrowRight", 39, settle=False)
        readout = "document.querySelector('#study .readout').textContent"
        for _ in range(12):
            if self.browser.evaluate(readout).startswith(curve + ":"):
                break
            self.browser.press("ArrowDown", 40, settle=False)
        readings = {}
        for key, code in (("ArrowLeft", 37), ("ArrowRight", 39)):
            text = ""
            while text != self.browser.evaluate(readout):
                text = self.browser.evaluate(readout)
                name, density, time = re.match(r"(.*):  φ = ([\d.]+),  ([\d.]+)", text).groups()
                self.assertEqual(name, curve)
                readings[float(density)] = float(time)
                self.browser.press(key, code, settle=False)
        return sorted(readings.items())

    def test_fits_are_drawn_over_their_window_and_a_little_beyond(self):
        # τ = 0.1 (0.8 − φ)^−2, fitted from 0.62 to 0.72, and drawn from the lowest density to a quarter of that further.
        self.open("sweep.html")
        for name, low, high in (("translation, power law", 0.62, 0.72), ("translation, power law, below its window", 0.6, 0.62),
                                ("translation, power law, above its window", 0.72, 0.745)):
            readings = self.glass_readings(name)
            self.assertEqual(len(readings), 41)
            self.assertAlmostEqual(readings[0][0], low, delta=1e-4)
            self.assertAlmostEqual(readings[-1][0], high, delta=1e-4)
            for density, time in readings:  # read with four digits
                self.assertAlmostEqual(math.log(time), math.log(0.1 * (0.8 - density) ** -2), delta=0.003)
        # Vogel and Fulcher agree with that at φ = 0.66: τ = 5.102 exp(0.6 φ/(0.85 − φ) − 0.6 · 0.66/0.19).
        self.choose_law(1)
        for density, time in self.glass_readings("translation, Vogel–Fulcher"):
            self.assertAlmostEqual(math.log(time), math.log(0.1 * 0.14 ** -2) + 0.6 * (density / (0.85 - density) - 0.66 / 0.19),
                                   delta=0.005)

    def test_order_is_told_from_glass(self):
        self.open("sweep.html")
        self.assertEqual(self.glass_legend(4), [["orientations relax", "full"], ["kept by nematic order", "full"],
                                                ["kept by nematic order, not equilibrated", "hollow"],
                                                ["orientations do not relax within the run, not equilibrated", "hollow"], ["by chance", "line"]])

    def test_notes_of_the_study_are_below_its_tables(self):
        self.open("sweep.html")
        self.assertEqual(self.browser.evaluate("""[...document.querySelectorAll('#glass + ul li')].map((item) => item.textContent)"""),
                         ["phi-0.74 (density 0.74, seed 1) stays out of the fits, ageing: S drifts",
                          "rotation, tau_2, Vogel-Fulcher: no phi_c, chi^2 <is> too large"])

    def test_logarithmic_axes_have_three_labels_or_more(self):
        self.open("sweep.html")
        motion, times, diffusion = [[(text, y) for text, _, y in self.canvas_texts(chart)]
                                    for chart in ("#motion", "#study .chart", "#study .chart:nth-child(2)")]
        # Times from 0.5 to 237 and mean squared displacements from 0.08 to 214 …
        self.assertEqual(sorted(text for text, _ in motion), sorted(["1", "10", "100", "0.1", "1", "10", "100", "∝ t"]))
        # … and relaxation times from 2.5 to 617, on an axis that begins at 2.
        self.assertLessEqual({"2", "5", "10", "20", "50", "100"}, {text for text, _ in times})
        # Diffusion coefficients from 0.002 to 0.006, with errors of 0.0002, on an axis from 0.8 to 1.25 times that.
        labels = diffusion[-6:]
        self.assertEqual([text for text, _ in labels], ["0.002", "0.003", "0.004", "0.005", "0.006", "0.007"])
        height = self.browser.evaluate("document.querySelector('#study .chart:nth-child(2) .u-over').clientHeight")
        decades = math.log10(1.25 * 0.0062 / (0.8 * 0.0018))
        self.assertAlmostEqual((labels[0][1] - labels[-1][1]) / height, math.log10(3.5) / decades, delta=2 / height)

    # What leads

    def section_headings(self):
        return self.browser.evaluate("""[...document.querySelectorAll('h2')].filter((heading) => heading.checkVisibility())
          .map((heading) => heading.textContent.trim())""")

    def test_a_sweep_begins_with_what_depends_on_the_density_and_folds_single_runs(self):
        self.open("sweep.html")
        self.assertEqual(self.section_headings(), ["Against the packing fraction", "Motion", "Relaxation", "Structure", "Particles",
                                                   "In the course of the run at φ = 0.70", "Table of runs", "Parameters and provenance"])
        # The first chart is on the first screen.
        bottom = self.browser.evaluate("document.querySelector('.chart .plot').getBoundingClientRect().bottom")
        self.assertLess(bottom, 900)
        shown = "document.querySelector('#course .plot').checkVisibility()"
        self.assertFalse(self.browser.evaluate(shown))
        self.click("#course-heading")
        self.browser.settle()
        self.assertTrue(self.browser.evaluate(shown))
        widths = self.browser.evaluate("""['#course', '#motion'].map((charts) =>
          document.querySelector(charts + ' canvas').clientWidth)""")
        self.assertEqual(widths[0], widths[1])

    def test_a_run_begins_with_its_verdict_and_its_relaxation_times(self):
        self.open("run.html")
        self.assertEqual(self.section_headings()[:2], ["Particles", "Result"])
        rows = self.browser.evaluate("""[...document.querySelectorAll('section:nth-of-type(2) tr')].map((row) =>
          [...row.children].map((cell) => cell.textContent))""")
        # Relaxation times are of all particles, not of the species.
        self.assertEqual(rows, [["equilibrium", "not enough time: it lasts 4 times tau_2; 16 are needed", ""],
                                ["of translation alone", "equilibrated", ""],
                                ["compressibility factor Z = βP/ρ", "4.492 ± 0.031", ""],
                                ["diffusion coefficient D", "0.00200 ± 0.00020",
                                 "slope of the mean squared displacement from t = 10 to 100"],
                                ["relaxation time τα", "10.00 ± 0.50 √(m ab/kT)", "Fs(q, t) = 1/e at q = 2.4/√(ab)"],
                                ["rotational relaxation time τ2", "not within this run: > 250 √(m ab/kT)", "L2(t) = 1/e"]])
        self.assertTrue(self.browser.evaluate("document.querySelector('#course .plot').checkVisibility()"))

    def axis_titles(self, section):
        return self.browser.evaluate(f"""[...document.querySelectorAll('#{section} .axis-title:not(.x)')]
          .map((title) => title.textContent)""")

    def test_the_wave_numbers_stand_in_the_charts(self):
        self.open("run.html")
        self.assertIn("F(q, t), q = 2.4", self.axis_titles("relaxation"))
        self.open("sweep.html")
        self.assertEqual(self.axis_titles("relaxation")[::2][:2], ["Fₛ(q, t), q = 2.4", "F(q, t), q = 2.4"])
        # 5 √φ from 0.6 to 0.76.
        self.assertIn("at q = 3.87 … 4.36, varying between runs. As q varies, these times do not show", self.text("wave-numbers"))
        self.open("two_runs.html")
        self.assertEqual(self.axis_titles("relaxation")[0], "Fₛ(q, t), q = 2.4 … 3.1, varying between runs")

    def test_all_rows_of_charts_are_full(self):
        for name in ("sweep.html", "run.html", "two_runs.html", "state.html"):
            self.open(name)
            ends = self.browser.evaluate("""[...document.querySelectorAll('.charts')].filter((grid) => grid.checkVisibility())
              .map((grid) => [grid.getBoundingClientRect().right, grid.lastElementChild.getBoundingClientRect().right])""")
            self.assertGreater(len(ends), 0)
            for grid, last in ends:
                self.assertAlmostEqual(grid, last, delta=1)

    def test_every_run_of_a_sweep_has_its_provenance(self):
        self.open("two_runs.html")
        rows = self.browser.evaluate("""[...document.querySelectorAll('#job-provenance tr')].map((row) =>
          [...row.children].map((cell) => cell.textContent))""")
        self.assertEqual(rows, [["run", "seed", "host"], ["run <1>", "7", "a"], ["run <1>", "12", "b"]])
        self.assertIn("commitc0ffee", self.browser.evaluate("document.querySelector('dl').textContent"))

    def lightness_at(self, x, y):
        """The green of a pixel of the page, from 0 to 255."""
        image = base64.b64decode(self.browser.call("Page.captureScreenshot", format="png", captureBeyondViewport=True,
                                                   clip={"x": x, "y": y, "width": 1, "height": 1, "scale": 1})["data"])
        begin = image.index(b"IDAT") + 4
        size, = struct.unpack(">I", image[begin - 8:begin - 4])
        # A byte that names the filter, which leaves a single pixel alone, then red, green and blue.
        return zlib.decompressobj().decompress(image[begin:begin + size])[2]

    def test_a_table_that_goes_on_has_a_shadow_at_that_end(self):
        self.open("sweep.html", width=820)
        host = "[...document.querySelectorAll('.scroll')].find((host) => host.scrollWidth > host.clientWidth + 100 && host.checkVisibility())"
        for place, shadows in ((0, (False, True)), (1e6, (True, False))):
            left, right, y = self.browser.evaluate(f"""(() => {{ const host = {host};
              host.scrollLeft = {place};
              host.scrollIntoView({{ block: 'center' }});
              const {{ left, right, bottom }} = host.getBoundingClientRect();
              return [left, right, bottom - 2]; }})()""")
            self.browser.settle()
            y += self.browser.evaluate("window.scrollY")
            for x, shadow in zip((left + 1, right - 2), shadows):
                self.assertEqual(self.lightness_at(x, y) < 230, shadow)

    # Errors

    def column_of_band(self, heading, share):
        """How many pixels of a shaded band, one part in five, there are at this share of the width of a chart."""
        return self.browser.evaluate(f"""(() => {{ {PIXELS}
          const chart = {self.chart(heading)}, frame = chart.querySelector('.u-over');
          const {{ data, width, height }} = pixels(chart.querySelector('canvas'));
          const x = Math.round(frame.offsetLeft + {share} * frame.clientWidth);
          return Array.from({{ length: height }}, (_, y) => data[4 * (y * width + x) + 3]).filter((alpha) => alpha > 30 && alpha < 120).length; }})()""")

    def test_bands_stop_where_there_are_no_errors(self):
        self.open("two_runs.html")

        # χ₄ from t = 0.5 to 100, on an axis from 0.4 to 125.
        def share(t):
            return math.log(t / 0.4) / math.log(125 / 0.4)

        self.assertGreater(self.column_of_band("Four-point susceptibility", share(60)), 20)
        self.assertEqual(self.column_of_band("Four-point susceptibility", share(12)), 0)

    def remark(self, heading):
        return self.browser.evaluate(f"{self.chart(heading)}.querySelector('.remark').textContent")

    def test_charts_say_why_errors_are_missing(self):
        self.open("two_runs.html")
        self.assertEqual(self.remark("Four-point susceptibility"),
                         "Curves end early, no errors for some points: too few independent blocks; samples unevenly spaced in time.")
        self.assertEqual(self.remark("Overlap"), "No errors: too few independent blocks; samples unevenly spaced in time.")
        self.assertEqual(self.remark("Mean squared displacement"), "")
        self.assertEqual(self.remark("Director"), "No errors: single samples.")
        self.open("state.html")
        self.assertEqual(self.remark("Orientations kept; dashed: 1/e"), "No errors: a single sampling.")
        self.assertEqual(self.remark("Nematic correlation; dashed: S²"), "")

    # Axes and references

    def chart_texts(self, heading):
        """What a chart is given to write: [text, x, y]."""
        self.browser.evaluate(f"document.getElementById('asked')?.removeAttribute('id'), {self.chart(heading)}.id = 'asked'")
        return self.canvas_texts("#asked")

    def readings(self, heading, curve, keys):
        """The value of this curve of a chart, and those after each of so many arrows to the right."""
        self.browser.evaluate(f"{self.chart(heading)}.querySelector('.plot').focus()")
        readout = f"{self.chart(heading)}.querySelector('.readout').textContent"
        self.browser.press("ArrowRight", 39)
        for _ in range(8):
            if self.browser.evaluate(readout).startswith(curve + ":"):
                break
            self.browser.press("ArrowDown", 40)
        found = []
        for _ in range(keys + 1):
            name, x, y = re.match(r"(.*):  .* = ([−\-\d.]+),  ([\-\d.]+)", self.browser.evaluate(readout)).groups()
            self.assertEqual(name, curve)
            found.append((float(x), float(y)))
            self.browser.press("ArrowRight", 39)
        return found

    def test_the_axis_of_a_curve_ends_with_its_values(self):
        self.open("two_runs.html")
        place = {text: x for text, x, _ in self.chart_texts("Four-point susceptibility") if text in ("10", "100")}
        width = self.browser.evaluate("document.querySelector('#asked .u-over').clientWidth")
        # From 0.8 · 0.5 to 1.25 · 93, the last time up to 100 that the page holds.
        self.assertAlmostEqual((place["100"] - place["10"]) / width, 1 / math.log10(1.25 * 93 / 0.4), delta=2 / width)

    def test_constants_are_flat_lines_on_a_readable_axis(self):
        self.open("two_runs.html")
        self.click("#course-heading")
        self.browser.settle()
        texts = self.chart_texts("Compressibility factor")
        left = min(x for _, x, _ in texts)
        labels = [text for text, x, _ in texts if x < left + 30]
        self.assertGreater(len(labels), 2)
        self.assertEqual(len(set(labels)), len(labels))
        # 4.5 and 4.50001 on an axis that spans a thousandth of that: a hundredth of the height at most, and the pen.
        rows, height = self.browser.evaluate(f"""(() => {{ {PIXELS}
          const {{ data, width, height }} = pixels(document.querySelector('#asked canvas'));
          const hit = (x, y) => {{ const at = 4 * (y * width + x); return data[at + 2] > data[at] + 60 && data[at + 3] > 200; }};
          const rows = Array.from({{ length: height }}, (_, y) => y).filter((y) => Array.from({{ length: width }}, (_, x) => x).some((x) => hit(x, y)));
          return [rows.at(-1) - rows[0], height]; }})()""")
        self.assertLess(rows, 0.01 * height + 4)
        # An order of 0 has an axis, too.
        self.assertIn("0.2", [text for text, *_ in self.chart_texts("Order")])

    def test_the_director_goes_on_beyond_a_quarter_turn(self):
        # By turns π/2 − 0.05 and its opposite, which are 0.1 apart.
        self.open("two_runs.html")
        self.click("#course-heading")
        angles = [angle for _, angle in self.readings("Director", "director", 5)]
        for one, next_one in itertools.pairwise(angles):
            self.assertAlmostEqual(abs(next_one - one), 0.1, delta=0.002)

    def test_orientations_are_compared_with_those_by_chance(self):
        # S = √(π/(4 · 1000)).
        order = math.sqrt(math.pi / 4000)
        for name in ("run.html", "sweep.html"):
            self.open(name)
            for angle, density in self.readings("Orientations about the director", "by chance", 12):
                self.assertAlmostEqual(density, (1 + 2 * order * math.cos(2 * angle)) / math.pi, delta=2e-4)


if __name__ == "__main__":
    unittest.main()
