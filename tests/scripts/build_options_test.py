#!/usr/bin/python3
"""Who builds vitrel itself gets the instructions of the own processor; parts of other builds and builds for other
machines do not, and neither do the presets for packages."""

import json
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
OPTIONS = f"project(options LANGUAGES CXX)\ninclude({ROOT}/cmake/options.cmake)\n"


def processor(files, *arguments):
    """The default of VITREL_PROCESSOR in a project of these CMakeLists.txt, by folder."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name, "CMakeLists.txt")
            path.parent.mkdir(exist_ok=True)
            path.write_text("cmake_minimum_required(VERSION 3.25)\n" + text, encoding="utf-8")
        build = pathlib.Path(folder, "build")
        subprocess.run(["cmake", "-G", "Ninja", "-S", folder, "-B", build, *arguments], check=True, capture_output=True)
        cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    return next(line.split("=")[1] for line in cache.splitlines() if line.startswith("VITREL_PROCESSOR:"))


class BuildOptions(unittest.TestCase):
    def test_native_where_the_project_is_built_itself(self):
        self.assertEqual(processor({".": OPTIONS}), "native")

    def test_portable_as_part_of_another_project(self):
        outer = "project(outer LANGUAGES CXX)\nadd_subdirectory(inner)\n"
        self.assertEqual(processor({".": outer, "inner": OPTIONS}), "")

    def test_portable_for_another_machine(self):
        self.assertEqual(processor({".": OPTIONS}, "-DCMAKE_SYSTEM_NAME=Linux"), "")

    def test_the_program_of_packages_finds_its_headers(self):
        with tempfile.TemporaryDirectory() as build:
            subprocess.run(["cmake", "-G", "Ninja", "-S", ROOT, "-B", build, "-DVITREL_PROCESSOR=",
                            "-DVITREL_BUILD_TESTS=OFF", "-DVITREL_BUILD_BENCH=OFF"], check=True, capture_output=True)
            commands = json.loads(pathlib.Path(build, "compile_commands.json").read_text(encoding="utf-8"))
            command = next(c["command"] for c in commands if c["file"] == str(ROOT / "app/main.cpp"))
            compiled = subprocess.run(command + " -fsyntax-only", shell=True, cwd=build, capture_output=True, text=True)
            self.assertEqual(compiled.returncode, 0, compiled.stderr)

    def test_presets_leave_the_default_but_for_packages(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
        setting = {p["name"]: p.get("cacheVariables", {}).get("VITREL_PROCESSOR") for p in presets}
        self.assertEqual({name: value for name, value in setting.items() if value is not None},
                         {"portable": "", "x86-64-v3": "x86-64-v3"})


if __name__ == "__main__":
    unittest.main()
