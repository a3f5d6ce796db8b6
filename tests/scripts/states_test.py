#!/usr/bin/python3
"""What the validations of prepared states compute from the program's figures."""

import math
import pathlib
import random
import sys
import tomllib
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))

from validation import constant_pressure, liquid_crystal, packings  # noqa: E402 (needs the path)
from validation.common import Failure, estimate, series_estimate  # noqa: E402


def found(deviation, relative_error, packing_fraction=0.5):
    one = object.__new__(constant_pressure.Found)
    one.aspect_ratio, one.reference, one.box, one.particles = 1, packing_fraction, "isotropic", 100
    one.deviation, one.relative_error = deviation, relative_error
    one.mean, one.error = packing_fraction * (1 + deviation), packing_fraction * relative_error
    return one


class ConstantPressure(unittest.TestCase):
    def test_an_ideal_gas_has_the_density_of_its_pressure(self):
        # One particle of area π on an area of π.
        self.assertEqual(constant_pressure.pressure(1, 1), 1 / math.pi)

    def test_derivative_of_a_cubic_is_exact(self):
        points = [(x, 2 - x + 3 * x**2 - x**3) for x in (0, 0.2, 0.5, 0.6)]
        for x in (0, 0.3, 0.6):
            self.assertAlmostEqual(constant_pressure.derivative(points, x), -1 + 6 * x - 3 * x**2, places=12)

    def test_spread_falls_with_the_root_of_the_number(self):
        ratio = constant_pressure.spread(1, 0.5, 100) / constant_pressure.spread(1, 0.5, 400)
        self.assertAlmostEqual(ratio, 2)

    def test_spread_of_disks(self):
        # Virial series to B_7 (Clisby & McCoy 2006) at φ = 0.3, where the rest is below 1 %.
        virials = (1, 2, 4 * 0.782004, 8 * 0.532232, 16 * 0.333556, 32 * 0.198843, 64 * 0.114873)
        slope = sum((k + 1) * b * 0.3**k for k, b in enumerate(virials))
        self.assertAlmostEqual(constant_pressure.spread(1, 0.3, 100) * math.sqrt(100 * slope), 1, delta=0.01)

    def test_no_two_measurements_share_a_seed(self):
        drawn = [seed for number in range(30) for seed in constant_pressure.seeds(number)]
        self.assertEqual(len(drawn), len(set(drawn)))

    def test_deviation_of_the_wanted_size(self):
        found(0.0039, 0.001).check()
        found(-0.0059, 0.001, 0.6).check()
        for one in (found(0.0041, 0.001), found(-0.0061, 0.001, 0.6), found(0, 0.0031)):
            with self.assertRaises(Failure):
                one.check()

    def test_mean_deviation(self):
        mean, error = constant_pressure.mean_deviation([found(0.001, 0.003), found(0.003, 0.004)])
        self.assertAlmostEqual(mean, 0.002)
        self.assertAlmostEqual(error, 0.0025)


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
        for values in packings.parameters_of(packings.TABLE_2)["sweep"]["together"].values():
            self.assertEqual(len(values), len(packings.PUBLISHED))

    def test_other_rows_are_toml(self):
        drawn = '{ distribution = "uniform", low = 0.5, high = 2 }'
        columns = {"species.0.aspect_ratios": ["[2, 5]", f"[{drawn}, {drawn}]"], "system.particles": [10, 20]}
        key, table = packings.together(columns).split("=", 1)
        uniform = {"distribution": "uniform", "low": 0.5, "high": 2}
        self.assertEqual(key, "sweep.together")
        self.assertEqual(tomllib.loads(f"rows ={table}")["rows"],
                         {"species.0.aspect_ratios": [[2, 5], [uniform, uniform]], "system.particles": [10, 20]})

    def test_the_volume_fraction_is_that_of_the_parameters(self):
        for name, values, wanted in (("ghossein_figure_7", {}, 0.3), ("ghossein_table_2", {packings.FRACTION: 0.6}, 0.6)):
            for reached, is_good in ((wanted * (1 + 1e-12), True), (wanted * (1 - 1e-10), False)):
                job = {"id": "job", "values": values, "prepare": {"packing_fraction": reached}}
                with mock.patch.object(packings, "article_sweep", return_value={"jobs": [job], "seeds": []}):
                    if is_good:
                        packings.sweep(None, name)
                    else:
                        self.assertRaises(Failure, packings.sweep, None, name)


if __name__ == "__main__":
    unittest.main()
