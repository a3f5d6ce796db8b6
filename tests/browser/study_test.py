"""Pages of sweeps: what they run along, what tells curves apart, averages over seeds, and those of the published studies.

Command line: <chromium> <vitrel> <folder of params/articles>.
"""

import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import unittest

ARTICLES = pathlib.Path(sys.argv.pop(3))
VITREL = sys.argv.pop(2)
WORK = tempfile.TemporaryDirectory(prefix="vitrel-studies-")
sys.argv.insert(2, WORK.name)

from pages import FOLDER, PageTest  # noqa: E402

GRID = """
[system]
particles = 30
[prepare]
quality_sweeps = 0
[dynamics]
equilibration = 1
duration = 20
[sweep.grid]
"system.packing_fraction" = [0.2, 0.3]
"species.0.aspect_ratio" = [10, 1.5, 3]
"system.seed" = [1, 2, 3]
"""

# The published studies in short form, and the charts and abscissa that their pages must have.
NARROW = 400  # pictures in space are drawn by the processor
SEED = 'sweep.grid.system.seed=[1, 2]'
LENGTH = 'sweep.together.dynamics.duration=[20, 6, 2, 2, 1, 1]'
STUDIES = {
    **{f"ghossein_figure_{k}": ([], "Against the particles", ["Orientation ratio", "Computing time"]) for k in (2, 3, 4)},
    "ghossein_figure_5": ([], "Against the particles", ["Orientation ratio", "Computing time"]),
    "ghossein_figure_6": ([SEED, "sweep.grid.system.particles=[10, 25, 50]"], "Against the particles", ["Orientation ratio"]),
    "ghossein_figure_7": (["sweep.grid.system.particles=[10, 31, 100]"], "Against the particles", ["Computing time"]),
    "ghossein_figure_8": ([SEED, "system.particles=50"], "Against the packing fraction", ["Computing time"]),
    "ghossein_figure_9": ([SEED, "system.particles=20"], "Against the aspect ratios", ["Computing time"]),
    "ghossein_table_2": ([SEED], "Against the aspect ratios", ["Orientation ratio", "Computing time"]),
    "woetzel_figure_4_1": ([SEED, "sweep.grid.system.particles=[100, 400]", "dynamics.duration=2"], "Against the particles",
                           ["Collisions", "Computing time"]),
    "woetzel_figure_4_3": ([SEED, 'sweep.grid.species.0.aspect_ratio=[1, 3]', "dynamics.duration=5", "dynamics.equilibration=1"],
                           "Against the aspect ratio", ["Collisions"]),
    "woetzel_figure_4_5": ([], "Against the aspect ratio", ["Packing fraction", "Nematic order"]),
    "woetzel_figure_4_7": (["system.particles=50"], "Against the packing fraction", ["Compressibility factor"]),
    "woetzel_figure_4_9": (["system.particles=30", "dynamics.duration=20", "dynamics.equilibration=1",
                            "sweep.grid.system.packing_fraction=[0.3, 0.5]"], "Against the packing fraction", ["Compressibility factor"]),
    "mueller_figure_7_density": ([SEED, LENGTH, "system.particles=100"], "Against the packing fraction",
                                 ["Early releases", "Blocked rotations"]),
    "mueller_figure_7_modulus": ([SEED, "dynamics.duration=20", "system.particles=100"], "Against the youngs modulus",
                                 ["Early releases", "Blocked rotations"]),
}


def study(name, file, *settings):
    """Runs and analyses a sweep, and makes its page."""
    words = [word for setting in settings for word in ("--set", setting)]
    folder = FOLDER / name
    for command in (["sweep", file, "-o", folder, "-j", "2", *words], ["analyze", folder], ["report", folder, "-o", FOLDER / f"{name}.html"]):
        subprocess.run([VITREL, *command, "-q"], check=True)
    return folder


class Studies(PageTest):
    def headings(self, section):
        return self.browser.evaluate(f"[...document.querySelectorAll('#{section} h3')].map((heading) => heading.textContent)")

    def chart(self, heading):
        return f"[...document.querySelectorAll('#study .chart')].find((chart) => chart.querySelector('h3').textContent === '{heading}')"

    def read_points(self, heading):
        """All that the arrow keys read in a chart, from the left, curve by curve."""
        chart = self.chart(heading)
        self.browser.evaluate(f"{chart}.querySelector('.plot').focus()")
        curves = self.browser.evaluate(f"{chart}.querySelectorAll('.legend button').length")
        points = []
        for _ in range(max(curves, 1)):
            for _ in range(20):
                self.browser.press("ArrowLeft", 37, settle=False)
            for _ in range(20):
                points.append(self.browser.evaluate(f"{chart}.querySelector('.readout').textContent"))
                self.browser.press("ArrowRight", 39, settle=False)
            self.browser.press("ArrowDown", 40)
        return list(dict.fromkeys(points))

    def test_a_sweep_over_shapes_densities_and_seeds(self):
        file = FOLDER / "grid.toml"
        file.write_text(GRID, encoding="utf-8")
        folder = study("grid", file)
        with open(folder / "results/runs.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        keys = [(float(row["system_packing_fraction"]), float(row["species_0_aspect_ratio"]), int(row["seed"])) for row in rows]
        self.assertEqual(keys, [(phi, kappa, seed) for phi in (0.2, 0.3) for kappa in (1.5, 3, 10) for seed in (1, 2, 3)])
        self.open("grid.html")
        self.assertEqual(self.text("study-heading"), "Against the aspect ratio")
        self.assertEqual(self.browser.evaluate("document.querySelector('header p').textContent"), "18 jobs: Newtonian")
        heading = "Compressibility factor"
        legend = f"[...{self.chart(heading)}.querySelectorAll('.legend button')].map((button) => button.textContent)"
        self.assertEqual(self.browser.evaluate(legend), ["φ = 0.2", "φ = 0.3"])
        self.assertEqual(self.browser.evaluate(f"{self.chart(heading)}.querySelector('.axis-title.x').textContent"), "κ")
        points = self.read_points(heading)
        self.assertEqual(len(points), 6, points)
        for phi in ("0.2", "0.3"):
            for kappa in ("1.5", "3", "10"):
                values = [float(row["compressibility_factor"]) for row, key in zip(rows, keys) if key[:2] == (float(phi), float(kappa))]
                read = next(point for point in points if point.startswith(f"φ = {phi}:  κ = {kappa},  "))
                value, error = map(float, read.split(",  ")[1].split(" ± "))
                self.assertAlmostEqual(value, statistics.fmean(values), delta=0.51 * 10 ** -len(str(value).split(".")[1]))
                self.assertGreater(error, 0)
        labels = self.browser.evaluate("[...document.querySelectorAll('#movie-run option')].map((option) => option.textContent)")
        self.assertEqual(labels[0].split(" (")[0], "φ = 0.2, κ = 1.5, seed 1")
        first = self.browser.evaluate("""[...document.querySelector('table:has(tr.units)').querySelectorAll('tbody tr')]
          .map((row) => [...row.children].slice(0, 3).map((cell) => cell.textContent).join(' '))""")
        self.assertEqual(first, [f"{phi:g} {kappa:g} {seed}" for phi, kappa, seed in keys])

    def test_words_are_categories(self):
        file = FOLDER / "kinds.toml"
        file.write_text(GRID.split("[sweep.grid]")[0] + '[sweep]\naxis = "dynamics.kind"\n[sweep.grid]\n'
                        '"dynamics.kind" = ["newtonian", "brownian"]\n"system.packing_fraction" = [0.1, 0.2, 0.3]\n', encoding="utf-8")
        study("kinds", file)
        self.open("kinds.html")
        self.assertEqual(self.text("study-heading"), "Against the kind")
        points = self.read_points("Compressibility factor")
        self.assertEqual(len(points), 6, points)
        self.assertTrue(any(point.startswith("φ = 0.1:  kind = brownian,  ") for point in points), points)

    def test_published_results_stand_beside_those_of_the_sweep(self):
        file = FOLDER / "published.toml"
        grid = '[sweep.grid]\n"system.particles" = [10, 20, 40]\n"system.seed" = [1, 2]\n'
        published = '[[sweep.published]]\nsource = "A (2000)"\nquantity = "collisions"\nvalues = [500, 1000, 3000]\n' \
                    '[[sweep.published]]\nsource = "B (2001)"\nquantity = "collisions"\nexponent = 1\nto = 20\n'
        file.write_text(GRID.split("[sweep.grid]")[0].replace("particles = 30", "packing_fraction = 0.3") + grid + published, encoding="utf-8")
        folder = study("published", file)
        with open(folder / "results/published.csv", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        self.assertEqual([(float(row["system_particles"]), row["source"], float(row["published"])) for row in rows],
                         [(10, "A (2000)", 500), (20, "A (2000)", 1000), (40, "A (2000)", 3000)])
        with open(folder / "results/published_exponents.csv", encoding="utf-8") as table:
            power = float(next(csv.DictReader(table))["measured"])
        self.open("published.html")
        cells = self.browser.evaluate("[...document.querySelectorAll('#published-rows tr')].map((row) => [...row.children].map((cell) => cell.textContent))")
        self.assertEqual([row[:3] for row in cells], [["N = 10", "Collisions", "500"], ["N = 20", "Collisions", "1000"], ["N = 40", "Collisions", "3000"],
                                                      ["N = 10 … 20", "Collisions: power of N", "1"]])
        self.assertAlmostEqual(float(cells[3][3]), power, delta=0.001 * power)
        points = self.read_points("Collisions")
        self.assertTrue(any(point.startswith("A (2000):  N = 20,  1000") for point in points), points)
        self.assertTrue(any(point.startswith("∝ N^1: B (2001):  N = 10,  ") for point in points), points)
        # An axis that was logarithmic becomes linear and back.
        chart = self.chart("Collisions")
        switch = f"[...{chart}.querySelectorAll('.tools button')].find((button) => button.textContent === 'log y')"
        states = []
        for _ in range(3):
            states.append(self.browser.evaluate(f"{switch}.getAttribute('aria-pressed')"))
            self.browser.evaluate(f"{switch}.click()")
        self.assertEqual(states, ["true", "false", "true"])
        self.assertEqual(self.browser.complaints, [])

    def test_curves_are_also_shown_over_the_first(self):
        file = FOLDER / "ratios.toml"
        file.write_text(GRID.replace("[10, 1.5, 3]", "[1.5, 3]").replace("[1, 2, 3]", "[1, 2]"), encoding="utf-8")
        folder = study("ratios", file)
        with open(folder / "results/seeds.csv", encoding="utf-8") as table:
            of = {(float(row["system_packing_fraction"]), float(row["species_0_aspect_ratio"])): float(row["collisions"]) for row in csv.DictReader(table)}
        self.open("ratios.html")
        chart = self.chart("Collisions")
        self.browser.evaluate(f"""(() => {{ const select = {chart}.querySelector('select');
          select.selectedIndex = 1; select.dispatchEvent(new Event('change')); }})()""")
        points = self.read_points("Collisions")
        read = {point.split("φ = ")[1].split(",")[0]: float(point.split(",  ")[1].split(" ± ")[0]) for point in points}
        self.assertEqual(sorted(read), ["0.2", "0.3"], points)
        for phi, value in read.items():
            wanted = of[float(phi), 3.0] / of[float(phi), 1.5]
            self.assertAlmostEqual(value, wanted, delta=0.05 * wanted)

    def test_published_studies_have_their_charts(self):
        self.assertEqual(sorted(STUDIES), sorted(file.stem for file in ARTICLES.glob("*.toml")))
        for name, (settings, heading, charts) in STUDIES.items():
            with self.subTest(name):
                study(name, ARTICLES / f"{name}.toml", *settings)
                self.open(f"{name}.html", NARROW)
                self.assertEqual(self.text("study-heading"), heading)
                self.assertLessEqual(set(charts), set(self.headings("study")))
                jobs = self.data()["study"]["jobs"]["columns"]
                self.assertTrue(any(value is not None for value in jobs["wall_seconds"]["value"]), json.dumps(jobs))
                self.assertEqual(self.browser.complaints, [])


if __name__ == "__main__":
    unittest.main()
