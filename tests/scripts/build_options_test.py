#!/usr/bin/python3
"""Builds run on every processor of the family, unless the preset or the user asks for others."""

import json
import pathlib
import re
import subprocess
import tempfile
import unittest

from script_tests import ROOT


class BuildOptions(unittest.TestCase):
    def test_presets(self):
        wanted = {"release": "native", "portable": "", "x86-64-v3": "x86-64-v3", "debug": "native"}
        for preset, processor in wanted.items():
            with tempfile.TemporaryDirectory() as build:
                subprocess.run(["cmake", "--preset", preset, "-B", build, "-DVITREL_BUILD_BENCH=OFF"], check=True,
                               capture_output=True, cwd=ROOT)
                cache = pathlib.Path(build, "CMakeCache.txt").read_text(encoding="utf-8")
            self.assertTrue(f"VITREL_PROCESSOR:STRING={processor}\n" in cache, preset)

    def test_portable_unless_asked(self):
        with tempfile.TemporaryDirectory() as build:
            done = subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, "-DVITREL_BUILD_BENCH=OFF"],
                                  check=True, capture_output=True, text=True)
            self.assertNotIn("Warning", done.stderr)
            cache = pathlib.Path(build, "CMakeCache.txt").read_text(encoding="utf-8")
            self.assertIn("VITREL_PROCESSOR:STRING=\n", cache)
            commands = json.loads(pathlib.Path(build, "compile_commands.json").read_text(encoding="utf-8"))
            self.assertFalse([c["file"] for c in commands if "-march" in c["command"]])
            # Neither the program nor the Python module seeks its library in the current folder.
            rules = pathlib.Path(build, "build.ninja").read_text(encoding="utf-8")
            folders = [f for found in re.findall(r'-rpath,"?([^" ]*)', rules) for f in found.split(":")]
            self.assertGreaterEqual(sum(r"\$$ORIGIN" in folder for folder in folders), 2)
            self.assertFalse([f for f in folders if not f.startswith(("/", r"\$$ORIGIN"))], folders)
            # The thin program finds its headers.
            command = next(c["command"] for c in commands if c["file"] == str(ROOT / "app/main.cpp"))
            compiled = subprocess.run(command + " -fsyntax-only", shell=True, cwd=build, capture_output=True, text=True)
            self.assertEqual(compiled.returncode, 0, compiled.stderr)


if __name__ == "__main__":
    unittest.main()
