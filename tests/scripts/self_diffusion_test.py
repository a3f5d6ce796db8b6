#!/usr/bin/python3
"""What the validation of self-diffusion computes from displacements and currents."""

import math
import types
import unittest

import script_tests  # noqa: F401 (makes the scripts importable)
from validation import literature, self_diffusion  # noqa: E402 (needs the path)


def point(length, value, error):
    return types.SimpleNamespace(length=length, value=value, error=error)


class SelfDiffusion(unittest.TestCase):
    def test_line_through_exact_values(self):
        line = self_diffusion.Line([point(size, 2 - 3 / size, size / 10) for size in (1, 2, 5)])
        self.assertAlmostEqual(line.limit, 2)
        self.assertAlmostEqual(line.slope, -3)
        self.assertAlmostEqual(line.chi_square, 0)

    def test_errors_of_a_line_through_two_values(self):
        # At 1/L = 1 and 1/2: slope = 2 (D_1 − D_2), limit = 2 D_2 − D_1.
        line = self_diffusion.Line([point(1, 0.7, 0.3), point(2, 0.9, 0.4)])
        self.assertAlmostEqual(line.slope_error, 2 * math.hypot(0.3, 0.4))
        self.assertAlmostEqual(line.limit_error, math.hypot(0.3, 2 * 0.4))

    def test_sizes_with_another_pressure_are_left_out(self):
        points = [types.SimpleNamespace(compressibility=z) for z in (9.94, 9.96, 10.04, 10)]
        self.assertEqual(self_diffusion.bulk_like(points), points[1:])

    def test_enskog_and_speedy_of_a_dilute_gas(self):
        # The first Sonine approximation of D, and Chapman and Enskog's factor for the higher ones.
        dilute = 3 / 8 / (literature.number_density(1e-6) * 4 * math.sqrt(math.pi))
        self.assertAlmostEqual(literature.speedy_diffusion(1e-6) / dilute, 1, delta=1e-5)
        self.assertAlmostEqual(literature.enskog_diffusion(1e-6) / dilute, 1.01896, delta=1e-5)


if __name__ == "__main__":
    unittest.main()
