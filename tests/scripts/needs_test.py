#!/usr/bin/python3
"""Every test has one label; tests whose needs are missing are left out and named, or refused: needs_test.py <build>."""

import json
import os
import pathlib
import subprocess
import sys
import unittest

from script_tests import FolderTest, output_of

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
NEEDS = pathlib.Path(__file__).parents[1] / "needs.cmake"
LABELS = {"unit", "physics", "clients", "browser", "manual"}
PROJECT = f"""cmake_minimum_required(VERSION 3.25)
project(sample LANGUAGES NONE)
enable_testing()
set(VITREL_TEST_TIMEOUT 60)
include({NEEDS})
vitrel_python_test(no_needs COMMAND -c "import sys; print(sys.prefix)")
vitrel_python_test(with_needs COMMAND -c "import h5py" NEEDS h5py)
"""


def tests_of(build):
    return json.loads(output_of("ctest", "--test-dir", build, "--show-only=json-v1"))["tests"]


def labels(test):
    return next((p["value"] for p in test["properties"] if p["name"] == "LABELS"), [])


class Needs(FolderTest):
    def setUp(self):
        super().setUp()
        (self.folder / "CMakeLists.txt").write_text(PROJECT, encoding="utf-8")
        # An interpreter without any modules.
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", self.folder / "empty"], check=True)

    def configure(self, *options, **environment):
        return subprocess.run(["cmake", "-G", "Ninja", "-S", self.folder, "-B", self.folder / "build", *options],
                              env={**os.environ, **environment}, capture_output=True, text=True, check=False)

    def names(self):
        return {test["name"] for test in tests_of(self.folder / "build")}

    def test_labels(self):
        # ctest writes a log, which the one that runs this test has in its own folder.
        (self.folder / "CTestTestfile.cmake").write_text(f'subdirs("{BUILD}")\n', encoding="utf-8")
        tests = tests_of(self.folder)
        self.assertIn("scripts.needs", [test["name"] for test in tests])
        self.assertEqual({t["name"]: labels(t) for t in tests if len(LABELS.intersection(labels(t))) != 1}, {})

    def test_left_out_and_named(self):
        interpreter = self.folder / "empty/bin/python3"
        done = self.configure(f"-DPython3_EXECUTABLE={interpreter}")
        self.assertEqual(done.returncode, 0, done.stderr)
        line = next(line for line in done.stdout.splitlines() if line.startswith("-- Left out"))
        self.assertIn("h5py", line)
        self.assertIn(str(interpreter), line)
        self.assertEqual(self.names(), {"no_needs"})

    def test_refused_if_all_are_required(self):
        done = self.configure(f"-DPython3_EXECUTABLE={self.folder}/empty/bin/python3", "-DVITREL_REQUIRE_ALL_TESTS=ON")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("h5py", done.stderr)

    def test_the_environment_chooses_the_interpreter(self):
        done = self.configure(VIRTUAL_ENV=str(self.folder / "empty"))
        self.assertIn(f"{self.folder}/empty/bin/python3", done.stdout)


if __name__ == "__main__":
    unittest.main()
