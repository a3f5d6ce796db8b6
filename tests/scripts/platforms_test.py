#!/usr/bin/python3
"""What the validation of platforms reads in logs and writes on its page."""

import unittest

import script_tests  # noqa: F401 (makes the scripts importable)
from validation import platforms, platforms_page  # noqa: E402 (needs the path)

BUILD = """-- Left out: tests that need gmsh
CMake Warning (dev) at cmake/dependencies.cmake:2 (find_package):
CMake Deprecation Warning at CMakeLists.txt:1
-- Warnings as errors: no
core/a.cpp:3:5: warning: unused variable 'x' [-Wunused-variable]
clang: warning: argument unused during compilation: '--param'
1 warning generated.
"""
TESTS = """Test project build
50% tests passed, 2 tests failed out of 4

The following tests did not run:
\t  4 - core.Skipped (Skipped)

The following tests FAILED:
\t  2 - mc.Chains (Failed)                                      unit
\t  3 - core.Check/0 (SEGFAULT)
"""
COMPARISON = """- packing state.h5 particles/all/position/value 0123456789abcdef
+ packing state.h5 particles/all/position/value fedcba9876543210
+ sweep 0_sweep.json jobs.0.name with words 0123456789abcdef
"""
RECORD = {"system": "Debian 13", "compiler": "GCC", "date": "2026-11-27", "commit": "abcdef0", "processor": "P",
          "load": 0.5, "seconds": {"packages": 40.2, "demo": 180.4, "tests": 900},
          "warnings": {"CMake": 0, "compiler": 0},
          "versions": {"compiler": "14.2.0", "CMake": "3.31.6", "HDF5": "1.14.5", "Eigen": "3.4.0", "fmt": "10.1.1",
                       "CLI11": "2.4.1", "Python": "3.13.5"},
          "results": {"number": 6190, "other bits": 3, "different": 0, "such as": []},
          "tests": {"kind": "all", "number": 1650, "failed": [], "left out": []}}


def row(record):
    lines = platforms_page.page([record]).splitlines()
    return next(line for line in lines if line.endswith(f"{platforms_page.verdict(record)} |"))


class Logs(unittest.TestCase):
    def test_warnings_are_counted(self):
        self.assertEqual(platforms.warnings(BUILD), {"CMake": 2, "compiler": 2})
        self.assertEqual(platforms.warnings("-- Configuring done\n"), {"CMake": 0, "compiler": 0})

    def test_failed_tests_are_named(self):
        outcome = {"number": 4, "failed": ["mc.Chains", "core.Check/0"], "left out": ["Left out: tests that need gmsh"]}
        self.assertEqual(platforms.outcome_of_tests(BUILD + TESTS), outcome)
        self.assertEqual(platforms.outcome_of_tests("100% tests passed, 0 tests failed out of 7\n"),
                         {"number": 7, "failed": [], "left out": []})
        self.assertIsNone(platforms.outcome_of_tests(BUILD))

    def test_results_that_differ_are_named_once(self):
        self.assertEqual(platforms.differing(COMPARISON),
                         ["packing state.h5 particles/all/position/value", "sweep 0_sweep.json jobs.0.name with words"])
        self.assertEqual(platforms.differing("the same: 6190 results\n"), [])


class Page(unittest.TestCase):
    def test_a_build_that_works(self):
        self.assertIn("| 0 | 40 | 180 | 1650 of 1650 (all) | 900 | 6190 of 6190; 3 not in all bits | works |",
                      row(RECORD))
        self.assertIn("| Debian 13 | GCC 14.2.0 | 3.31.6 | 1.14.5 | 3.4.0 | 10.1.1 | 2.4.1 | 3.13.5 |",
                      platforms_page.page([RECORD]))

    def test_every_problem_is_told(self):
        for change, problem in (({"failure": "demo: exit code 1\nx"}, "demo: exit code 1"),
                                ({"warnings": {"CMake": 1, "compiler": 0}}, "1 warnings of CMake"),
                                ({"warnings": {"CMake": 0, "compiler": 2}}, "2 warnings of the compiler"),
                                ({"tests": RECORD["tests"] | {"failed": ["core.A"]}}, "1 tests fail"),
                                ({"results": RECORD["results"] | {"different": 7}}, "7 results differ")):
            with self.subTest(problem=problem):
                self.assertEqual(platforms_page.verdict(RECORD | change), problem)

    def test_what_was_not_measured(self):
        record = {"system": "Debian 13", "compiler": "Clang"}
        self.assertIn("| Debian 13 | Clang | – | – | – | – | – | – | not measured |", row(record))
        self.assertEqual(list(platforms_page.problems(record)), [])


if __name__ == "__main__":
    unittest.main()
