#!/usr/bin/python3
"""scripts/check_headers finds headers that do not include what they need: one tree with and without each of them."""

import unittest

from script_tests import checked

# The first two are precompiled for those that include them.
GOOD = {
    "core/geometry/vector.h": "#include <cstddef>\nusing Vector = std::byte;\n",
    "core/state/configuration.h": '#include <cstdint>\n#include "core/geometry/vector.h"\nstruct State { Vector x; };\n',
    "core/error.h": "#include <exception>\nusing Error = std::exception;\n",
    "mc/trial.h": '#include "core/geometry/vector.h"\nVector trial();\n',
    "mc/sweep.h": '#include "core/state/configuration.h"\nVector sweep(const State& state);\n',
    "mc/run.h": '#include "core/error.h"\n#include "mc/sweep.h"\nError run(const State& state, std::int64_t sweeps);\n',
}

BAD = {
    "core/geometry/vector.h": "using Vector = std::byte;\n",
    "core/state/configuration.h": "#include <cstdint>\nstruct State { Vector x; };\n",
    "core/error.h": "using Error = std::exception;\n",
    # Only a precompiled header has what these need, and they do not include it.
    "edmd/bytes.h": "std::byte bytes();\n",
    "edmd/numbers.h": '#include "core/geometry/vector.h"\nstd::int64_t numbers(Vector x);\n',
    "edmd/states.h": '#include "core/geometry/vector.h"\nvoid states(const State& state);\n',
    "edmd/debug.h": '#ifdef EDMD_DEBUG\n#include "core/state/configuration.h"\n#endif\nvoid debug(const State& state);\n',
    # These lack a header in spite of one that is precompiled.
    "edmd/limits.h": '#include "core/state/configuration.h"\nstd::numeric_limits<int> limits(const State& state);\n',
    "edmd/errors.h": '#include "core/state/configuration.h"\nError error(const State& state);\n',
    "edmd/typo.h": '#include "core/state/configuration.h"\n#include "core/state/configurations.h"\n',
}


def check(files):
    return checked("check_headers", {path: f"#pragma once\n{text}" for path, text in files.items()})


class CheckHeaders(unittest.TestCase):
    def test_accepts_headers_that_include_what_they_need(self):
        run = check(GOOD)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_names_every_header_that_does_not(self):
        bad = {path: text for path, text in BAD.items() if path not in GOOD}
        run = check(GOOD | bad)
        self.assertEqual(run.returncode, 1)
        named = [line for line in run.stdout.splitlines() if line.startswith("check_headers: ")]
        self.assertEqual(named, [f"check_headers: {path} does not compile alone" for path in sorted(bad)])

    def test_names_those_that_others_include(self):
        for path in sorted(BAD.keys() & GOOD.keys()):
            with self.subTest(path=path):
                run = check(GOOD | {path: BAD[path]})
                self.assertEqual(run.returncode, 1)
                self.assertIn(f"check_headers: {path} does not compile alone", run.stdout)


if __name__ == "__main__":
    unittest.main()
