#!/usr/bin/python3
"""Who builds vitrel itself gets the instructions of the own processor; parts of other builds and builds for other
machines do not, and neither does the preset for packages."""

import json
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).parents[2]
OPTIONS = f"project(options LANGUAGES CXX)\ninclude({ROOT}/cmake/options.cmake)\n"


def native(files, *arguments):
    """The default of VITREL_NATIVE in a project of these CMakeLists.txt, by folder."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name, "CMakeLists.txt")
            path.parent.mkdir(exist_ok=True)
            path.write_text("cmake_minimum_required(VERSION 3.25)\n" + text, encoding="utf-8")
        build = pathlib.Path(folder, "build")
        subprocess.run(["cmake", "-G", "Ninja", "-S", folder, "-B", build, *arguments], check=True, capture_output=True)
        cache = (build / "CMakeCache.txt").read_text(encoding="utf-8")
    return next(line.split("=")[1] for line in cache.splitlines() if line.startswith("VITREL_NATIVE:"))


class BuildOptions(unittest.TestCase):
    def test_native_where_the_project_is_built_itself(self):
        self.assertEqual(native({".": OPTIONS}), "ON")

    def test_portable_as_part_of_another_project(self):
        outer = "project(outer LANGUAGES CXX)\nadd_subdirectory(inner)\n"
        self.assertEqual(native({".": outer, "inner": OPTIONS}), "OFF")

    def test_portable_for_another_machine(self):
        self.assertEqual(native({".": OPTIONS}, "-DCMAKE_SYSTEM_NAME=Linux"), "OFF")

    def test_presets_leave_the_default_but_for_packages(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
        setting = {p["name"]: p.get("cacheVariables", {}).get("VITREL_NATIVE") for p in presets}
        self.assertEqual({name: value for name, value in setting.items() if value}, {"portable": "OFF"})


if __name__ == "__main__":
    unittest.main()
