#!/usr/bin/python3
"""scripts/check_arithmetic finds what leaves bits open: one source with and without each of them."""

import unittest

from script_tests import checked

GOOD = """
double f(Stream& random, const Vec3& u, const Mat3& m) {
  const double x = random.uniform(), y = random.uniform(0, 1);
  const Vec2 both{random.uniform(), random.normal()};
  const double one = x > y ? random.uniform() : random.normal();
  const Vec2 between = f(Vec2{random.uniform(), random.normal()}, [&] { return random.normal(); });
  if (random.uniform() < 0.5 && random.below(2) == 0) return h(random);
  for (int k = 0; k < random.below(3); ++k) values[random.below(9)] = random.normal();
  return std::sqrt(std::abs(x)) + std::floor(y) + dot(u, m * u) + here.determinant() + cosine_and_sine(x).sine;  // u.dot(u)
}
friend Simd operator*(const Simd& x, const Simd& y);
"""

REFUSED = ["std::cbrt(x)", "std::exp2(x)", "std::fma(x, y, z)", "u.dot(v)", "(u - v).norm()", "pair->slope.squaredNorm()",
           "v.template head<2>().prod()", "m.inverse()", "q.toRotationMatrix()", "Eigen::SelfAdjointEigenSolver<Mat3>(m)",
           "f(random.uniform(), random.uniform())", "random.uniform() * lengths.x() +\n random.normal()",
           "g(random, h(random))", "f(random.uniform(), Vec2{random.normal(), 0})", "f(Vec2{x, h(random)}, h(random))",
           "f(random.uniform(), x > 0 ? random.normal() : 0)", "random.uniform() * std::abs(random.normal())",
           "random.uniform() * Vec2{random.normal(), 0}.x()", "Vec3 operator*(const Mat3& m, const Vec3& v)"]


class CheckArithmetic(unittest.TestCase):
    def complaints(self, line, path="mc/move.cpp"):
        return checked("check_arithmetic", {path: f"void g(Stream& random) {{\n{line};\n}}\n"}).stdout

    def test_accepts(self):
        self.assertEqual(self.complaints(GOOD), "")

    def test_refuses(self):
        for line in REFUSED:
            with self.subTest(line):
                self.assertIn("mc/move.cpp:2: ", self.complaints(line))

    def test_analysis_is_free(self):
        self.assertEqual(self.complaints("u.dot(v)", "analysis/table.cpp"), "")

    def test_refuses_double_draws_everywhere(self):
        for folder in ("analysis", "bench/surveys", "tests/core"):
            self.assertIn("table.cpp:2: ", self.complaints("f(random.uniform(), random.uniform())", f"{folder}/table.cpp"))


if __name__ == "__main__":
    unittest.main()
