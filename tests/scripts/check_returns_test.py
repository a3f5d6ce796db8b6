#!/usr/bin/python3
"""scripts/check_returns finds an ignored result of every library: one source with and without each of them."""

import subprocess
import tempfile
import unittest

from script_tests import SCRIPTS

HEADERS = ["hdf5.h", "fftw3.h", "gsl/gsl_multifit_nlinear.h", "png.h", "udunits2.h", "unistd.h", "cstdio", "csignal"]
CALLS = [
    "H5Pset_driver(1, 1, nullptr)",
    "fftw_alloc_real(1)",
    "gsl_multifit_nlinear_init(nullptr, nullptr, nullptr)",
    "png_image_write_to_memory(nullptr, nullptr, nullptr, 0, nullptr, 0, nullptr)",
    "ut_parse(nullptr, nullptr, UT_UTF8)",
    "::dup2(1, 2)",
    "std::fflush(stdout)",
    "std::signal(SIGINT, SIG_DFL)",
]


def check(statements):
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as source:
        source.writelines(f"#include <{header}>\n" for header in HEADERS)
        source.write("void calls() {\n" + "".join(f"  {statement};\n" for statement in statements) + "}\n")
        source.flush()
        return subprocess.run([SCRIPTS / "check_returns", source.name], capture_output=True, text=True, check=False)


class CheckReturns(unittest.TestCase):
    def test_accepts_results_that_are_used_or_say_nothing(self):
        run = check(f"static_cast<void>({call})" for call in CALLS)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_names_every_ignored_result(self):
        run = check(CALLS)
        self.assertNotEqual(run.returncode, 0)
        for number, _ in enumerate(CALLS, len(HEADERS) + 2):
            self.assertIn(f".cpp:{number}:3: error: the value returned by this function should", run.stdout)


if __name__ == "__main__":
    unittest.main()
