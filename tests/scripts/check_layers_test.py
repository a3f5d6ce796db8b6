#!/usr/bin/python3
"""scripts/check_layers finds forbidden includes: one tree with and without each of them."""

import unittest

from script_tests import checked

GOOD = {
    "core/geometry/disk.h": '#include "core/tolerances.h"\n#include <vector>\n',
    "core/contact/gap.h": '#include "core/geometry/disk.h"\n',
    "core/state/state.h": '#include "core/contact/gap.h"\n#include "core/random/stream.h"\n',
    "core/neighbors/cells.h": '#include "core/state/state.h"\n',
    "core/io/file.cpp": '#include "core/state/state.h"\n#include "vitrel_commit.h"\n',
    "edmd/engine.cpp": '#include "edmd/engine.h"\n#include "core/neighbors/cells.h"\n',
    "workflow/storage/check.h": '#include "core/state/state.h"\n#include "workflow/log.h"\n',
    "workflow/stages/stage.h": '#include "workflow/rules.h"\n#include "mc/insert.h"\n',
    "workflow/configuration/parameters.h": '#include "workflow/stages/stage.h"\n#include "edmd/engine.h"\n',
    "workflow/run/run.h": '#include "workflow/prepare/prepare.h"\n#include "workflow/storage/check.h"\n',
    "workflow/analyze/analyze.h": '#include "analysis/results.h"\n#include "workflow/run/run.h"\n',
    "workflow/report/page.h": '#include "workflow/sweep/results.h"\n#include "workflow/analyze/analyze.h"\n',
    "app/main.cpp": '#include "mc/insert.h"\n#include "workflow/run/run.h"\n',
    "python/bindings/work.cpp": '#include "core/io/file.h"\n#include "python/bindings/arrays.h"\n#include "workflow/run/run.h"\n',
    "bench/methods/slsqp.h": '#include "edmd/engine.h"\n#include "bench/reference/truth.h"\n',
    "bench/main.cpp": '#include "app/main.h"\n#include "workflow/report/page.h"\n',
    "bench/reference/truth.h": '#include "core/geometry/disk.h"\n',
    "tests/app/main_test.cpp": '#include "app/main.h"\n#include "bench/reference/truth.h"\n',
}

FORBIDDEN = [
    ("core/geometry/disk.h", '#include "core/contact/gap.h"'),
    ("core/contact/gap.h", '#include "core/state/state.h"'),
    ("core/state/state.h", '#include "core/neighbors/cells.h"'),
    ("core/state/state.h", '#include "core/io/file.h"'),
    ("core/neighbors/cells.h", '#include "core/io/file.h"'),
    ("core/io/file.h", '#include "core/neighbors/cells.h"'),
    ("core/random/stream.h", '#include "core/error.h"'),
    ("core/tolerances.h", '#include "core/geometry/disk.h"'),
    ("core/io/file.h", '#include "mc/insert.h"'),
    ("mc/insert.h", '#include "edmd/engine.h"'),
    ("edmd/engine.h", '#include "analysis/dynamics/energy.h"'),
    ("analysis/dynamics/energy.h", '#include "mc/insert.h"'),
    ("edmd/engine.h", '#include "app/main.h"'),
    ("edmd/engine.h", '  #  include <mc/insert.h>'),
    ("edmd/engine.h", '#include "tests/support/scenes.h"'),
    ("app/main.h", '#include "tests/support/scenes.h"'),
    ("edmd/engine.h", '#include "engine_details.h"'),
    ("edmd/engine.h", '#include "bench/reference/truth.h"'),
    ("app/main.h", '#include "bench/survey.h"'),
    ("app/main.h", '#include "python/bindings/arrays.h"'),
    ("python/bindings/arrays.h", '#include "app/main.h"'),
    ("mc/insert.h", '#include "analysis/results.h"'),
    ("analysis/results.h", '#include "workflow/report/page.h"'),
    ("workflow/storage/check.h", '#include "workflow/run/run.h"'),
    ("workflow/storage/check.h", '#include "workflow/configuration/parameters.h"'),
    ("workflow/stages/stage.h", '#include "workflow/configuration/parameters.h"'),
    ("workflow/configuration/parameters.h", '#include "workflow/analyze/analyze.h"'),
    ("workflow/analyze/analyze.h", '#include "workflow/report/page.h"'),
    ("workflow/run/run.h", '#include "workflow/sweep/sweep.h"'),
    ("workflow/report/page.h", '#include "app/terminal/progress.h"'),
    ("workflow/sweep/sweep.h", '#include "bench/survey.h"'),
    ("bench/reference/truth.h", '#include "core/contact/gap.h"'),
    ("bench/reference/truth.h", '#include "bench/survey.h"'),
    ("core/stray.h", ""),
]


class CheckLayers(unittest.TestCase):
    def test_accepts_includes_that_go_down(self):
        run = checked("check_layers", GOOD)
        self.assertEqual((run.returncode, run.stdout, run.stderr), (0, "", ""))

    def test_names_every_forbidden_include(self):
        for path, line in FORBIDDEN:
            with self.subTest(path=path, line=line):
                run = checked("check_layers", {**GOOD, path: f"// comment\n{line}\n"})
                self.assertEqual(run.returncode, 1)
                self.assertTrue(run.stdout.startswith(f"{path}:2:" if line else f"{path}:"), run.stdout)
                self.assertEqual(run.stdout.count("\n"), 1, run.stdout)


if __name__ == "__main__":
    unittest.main()
