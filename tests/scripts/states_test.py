#!/usr/bin/python3
"""What the validations of prepared states compute from the program's figures."""

import math
import pathlib
import random
import tomllib
import unittest
from unittest import mock

import script_tests  # noqa: F401 (makes the scripts importable)
from validation import comparison, constant_pressure, jamming, liquid_crystal, literature, packings  # noqa: E402 (needs the path)
from validation.common import Estimate, Failure, estimate, series_estimate  # noqa: E402
from validation.comparison import Scene, Scenes, Tolerance, compared  # noqa: E402


def job(seed, value, overlaps=0, **values):
    return {"id": f"seed-{seed}", "values": {"x": 1, **values, "system.seed": seed},
            "prepare": {"overlaps": overlaps, "stages": [{"z": 0, "z_error": 0}, {"z": value, "z_error": 0.3}]}}


class Comparisons(unittest.TestCase):
    def run_scenes(self, jobs):
        with mock.patch.object(comparison, "summary_of", return_value={"jobs": jobs}):
            return Scenes(pathlib.Path("scenes.toml")).run(None)

    def test_jobs_that_differ_in_their_seeds_are_one_scene(self):
        first, second = self.run_scenes([job(1, 2), job(1, 7, y=[1, 2]), job(2, 4)])
        self.assertEqual((first["x"], second["y"]), (1, [1, 2]))
        self.assertEqual(first.every("prepare.stages.-1.z"), [2, 4])
        self.assertEqual(first.mean("prepare.stages.1.z"), (3, 1))
        self.assertAlmostEqual(first.stated_mean("prepare.stages.1.z").error, 0.3 / math.sqrt(2))

    def test_an_overlap_is_a_failure(self):
        with self.assertRaisesRegex(Failure, "seed-2: 3 overlaps"):
            self.run_scenes([job(1, 2), job(2, 4, overlaps=3)])

    def test_rows_and_seeds_are_toml(self):
        drawn = {"distribution": "uniform", "low": 0.5, "high": 2}
        rows = ({"ratios": [2, 5], "system.particles": 10}, {"ratios": [drawn, drawn], "system.particles": 20})
        *settings, together, grid = Scenes(pathlib.Path("a.toml"), ("b=1",), rows, range(1, 3)).overrides()
        self.assertEqual(settings, ["b=1"])
        self.assertEqual(tomllib.loads(together.replace("sweep.together=", "x =")),
                         {"x": {"ratios": [[2, 5], [drawn, drawn]], "system.particles": [10, 20]}})
        self.assertEqual(grid, 'sweep.grid={ "system.seed" = [1, 2] }')

    def test_a_deviation_within_all_that_is_allowed(self):
        tolerance = Tolerance(errors=3, relative=0.01, absolute=0.1)
        # 3 · 0.5 + 0.02 + 0.1, the errors of both together.
        for measured, is_good in ((3.61, True), (0.39, True), (3.63, False), (0.37, False)):
            values = Estimate(measured, 0.3), Estimate(2, 0.4), tolerance
            if is_good:
                compared("x", *values)
            else:
                with self.assertRaisesRegex(Failure, "x: 3.63|x: 0.37"):
                    compared("x", *values)

    def test_a_standard_error_that_is_too_large(self):
        compared("x", Estimate(2, 0.02), 2, Tolerance(largest_error=0.01))
        with self.assertRaisesRegex(Failure, "standard error"):
            compared("x", Estimate(2, 0.021), 2, Tolerance(largest_error=0.01))

    def test_cells(self):
        self.assertEqual(list(map(str, compared("x", Estimate(2.02, 0.013), 2).cells())),
                         ["2", "2.020 ± 0.013", "+1.000%", "+1.5"])
        self.assertEqual(str(compared("x", Estimate(0.1, 0.2), 0).cells()[2]), "+0.1")


class Literature(unittest.TestCase):
    def test_the_table_of_the_header(self):
        found = {(one.aspect_ratio, one.packing_fraction): (one.z, one.error) for one in literature.fluid_pressures()}
        self.assertEqual(found[1, 0.65], (8.408044, 0))
        self.assertEqual(found[2, 0.5], (4.492, 0.003))
        self.assertEqual(len(found), literature.HEADER.read_text(encoding="utf-8").count("},"))

    def test_ellipsoids_that_are_spheres_are_those_of_carnahan_and_starling(self):
        self.assertAlmostEqual(literature.ellipsoid_fluid((1, 1, 1), 0.3), literature.carnahan_starling(0.3), places=9)

    def test_measures_of_a_prolate_spheroid(self):
        # The semi-axes are 2, 1, 1; the closed forms have e² = 3/4.
        e = math.sqrt(3) / 2
        radius, surface, volume = literature.convex_measures((2, 1, 1))
        self.assertAlmostEqual(radius, (2 + math.atanh(e) / (2 * e)) / 2, places=9)
        self.assertAlmostEqual(surface, 2 * math.pi * (1 + 2 * math.asin(e) / e), places=9)
        self.assertAlmostEqual(volume, 8 * math.pi / 3)

    def test_dilute_fluids_follow_the_second_virial_coefficient(self):
        for z in (literature.sphere_fluid, literature.carnahan_starling):
            self.assertAlmostEqual((z(1e-6) - 1) / 1e-6, 4, delta=1e-4)


class ConstantPressure(unittest.TestCase):
    def test_an_ideal_gas_has_the_density_of_its_pressure(self):
        # One particle of area π on an area of π.
        self.assertEqual(constant_pressure.pressure(1, 1), 1 / math.pi)

    def test_no_two_measurements_share_a_seed(self):
        drawn = [row["system.seed"] for row in constant_pressure.rows()]
        self.assertEqual(len(drawn), len(set(drawn)))
        self.assertGreater(len(drawn), 24 * constant_pressure.SEEDS)

    def test_mean_deviation(self):
        found = [compared("", Estimate(0.5 * (1 + deviation), 0.5 * error), 0.5, Tolerance(9))
                 for deviation, error in ((0.001, 0.003), (0.003, 0.004))]
        mean, error = constant_pressure.mean_deviation(found)
        self.assertAlmostEqual(mean, 0.002)
        self.assertAlmostEqual(error, 0.0025)


class Jamming(unittest.TestCase):
    def test_extrapolation_is_exact_for_free_volumes(self):
        stages = [{}] + [{"reduced_pressure": z, "packing_fraction": 0.85 * (1 - 2.5 / z)} for z in (1e5, 1e6)]
        found = jamming.extrapolated(Scene({}, [{"prepare": {"stages": stages}}]))
        self.assertAlmostEqual(found[0], 0.85, places=12)
        self.assertAlmostEqual(found[1], 2.5, places=5)


class Series(unittest.TestCase):
    def setUp(self):
        draw = random.Random(1)
        self.independent = [draw.gauss(0, 1) for _ in range(4000)]

    def test_independent_values_have_their_standard_error(self):
        self.assertAlmostEqual(series_estimate(self.independent)[1] / estimate(self.independent)[1], 1, delta=0.2)

    def test_correlated_values_have_a_larger_error(self):
        # x' = a x + noise: the variance of the mean is (1 + a)/(1 - a) times that of independent values.
        values, x = [], 0
        for noise in self.independent:
            x = 0.8 * x + noise
            values.append(x)
        self.assertAlmostEqual(series_estimate(values)[1] / (3 * estimate(values)[1]), 1, delta=0.2)


class LiquidCrystal(unittest.TestCase):
    def test_estimate(self):
        mean, error = liquid_crystal.estimate([1, 2, 3])
        self.assertAlmostEqual(mean, 2)
        self.assertAlmostEqual(error, 1 / math.sqrt(3))

    def test_exponent_of_a_power(self):
        power, error = liquid_crystal.exponent({2000: (0.05, 0.001), 500: (0.1, 0.002)})
        self.assertAlmostEqual(power, -0.5)
        self.assertAlmostEqual(error, math.hypot(0.02, 0.02) / math.log(4))

    def test_a_liquid_is_told_apart_from_a_nematic(self):
        liquid_crystal.check_exponent("liquid", {500: (0.1, 0.005), 2000: (0.055, 0.003)})
        for falls_slowly in (0.1 * 4 ** (-1 / 16), 0.1):
            with self.assertRaises(Failure):
                liquid_crystal.check_exponent("nematic", {500: (0.1, 0.003), 2000: (falls_slowly, 0.003)})
        with self.assertRaises(Failure):
            liquid_crystal.check_exponent("noise", {500: (0.1, 0.05), 2000: (0.05, 0.03)})

    def test_correlated_sums(self):
        # The mean falls below 0 in the third bin: what comes later does not count.
        correlations = [{"pairs": [10, 20, 30, 40], "value": [0.5, None, -0.2, 0.9]},
                        {"pairs": [10, 20, 30, 40], "value": [0.3, 0.1, 0.1, 0.9]}]
        first, second = liquid_crystal.correlated_sums(correlations, 10)
        self.assertAlmostEqual(first, 1 + 2 / 10 * 5)
        self.assertAlmostEqual(second, 1 + 2 / 10 * 5)

    def test_least_order_of_a_nematic_hardly_depends_on_the_size(self):
        self.assertAlmostEqual(liquid_crystal.min_order(2000) / liquid_crystal.min_order(500), 2 ** (-1 / 8))


class Packings(unittest.TestCase):
    def test_every_row_of_the_article_has_its_time(self):
        study = packings.parameters_of(packings.TABLE_2)["sweep"]
        for values in study["together"].values():
            self.assertEqual(len(values), len(study["published"][0]["values"]))

    def test_the_volume_fraction_is_that_of_the_parameters(self):
        for reached, is_good in ((0.6 * (1 + 1e-12), True), (0.6 * (1 - 1e-10), False)):
            scene = Scene({packings.PHI: 0.6}, [{"prepare": {"packing_fraction": reached}}])
            if is_good:
                packings.check_fraction(scene)
            else:
                self.assertRaises(Failure, packings.check_fraction, scene)


if __name__ == "__main__":
    unittest.main()
