#!/usr/bin/python3
"""Builds for packages have Debian's protections, and scripts/check_elf tells programs and libraries that lack them."""

import json
import platform
import subprocess
import tempfile
import unittest

from script_tests import ROOT, SCRIPTS, FolderTest, output_of, write_tree

PROJECT = f"""cmake_minimum_required(VERSION 3.25)
project(sample LANGUAGES CXX)
include({ROOT}/cmake/options.cmake)
add_library(sample SHARED sample.cpp)
add_executable(program program.cpp)
target_link_libraries(program PRIVATE sample)
foreach(target sample program)
  vitrel_private_options(${{target}})
endforeach()
"""
# Text that may be too long for its place on the stack, a stack of several pages, and much code.
SAMPLE = """#include <cstring>
asm(".text; .fill 32768");
double sum(const char* text, const double* values) {
  char copy[16];
  std::strcpy(copy, text);
  double kept[4096];
  std::memcpy(kept, values, sizeof kept);
  asm volatile("" : : "r"(copy), "r"(kept) : "memory");
  return kept[0];
}
"""
PROGRAM = """double sum(const char* text, const double* values);
int main(int, char** words) {
  static double values[4096];
  return sum(words[0], values) > 0;
}
"""


def complaints(*words):
    """What scripts/check_elf finds wrong."""
    return subprocess.run([SCRIPTS / "check_elf", *words], capture_output=True, text=True, check=False).stderr


class Hardening(FolderTest):
    def build(self, *options):
        """The folder of a small program and its library with the options of the project."""
        write_tree(self.folder, {"CMakeLists.txt": PROJECT, "sample.cpp": SAMPLE, "program.cpp": PROGRAM})
        build = self.folder / "build"
        output_of("cmake", "-G", "Ninja", "-S", self.folder, "-B", build, *options)
        self.assertNotIn("warning", output_of("cmake", "--build", build))
        return build

    def test_builds_for_packages_are_protected(self):
        build = self.build("-DVITREL_HARDENED=ON")
        self.assertEqual(complaints("--hardened", build / "libsample.so", build / "program"), "")
        if platform.machine() == "x86_64":
            code = output_of("objdump", "--disassemble", "--no-show-raw-insn", build / "libsample.so")
            self.assertRegex(code.split("<_Z3sumPKcPKd>:\n")[1], r"^.*endbr64", "the target of a call is not marked")
            touched = r"(or|mov)[bql]? +\$0x0,(0x\w+)?\(%rsp"
            self.assertRegex(code, touched, "the pages of a large stack are not touched one by one")

    def test_other_builds_are_told(self):
        build = self.build("-DCMAKE_EXE_LINKER_FLAGS=-no-pie", "-DCMAKE_CXX_FLAGS_RELEASE=-fno-stack-protector")
        found = complaints("--hardened", build / "libsample.so", build / "program")
        for lack in ("libsample.so: names are bound while it runs", "libsample.so: the stack is not guarded",
                     "libsample.so: the C library checks no sizes", "program: its address is fixed"):
            self.assertIn(lack, found)

    def test_folders_of_libraries(self):
        for folders, wrong in (("/usr/lib:", "''"), (":/usr/lib", "''"), ("lib:/usr/lib", "'lib'"),
                               ("$ORIGINAL", "'$ORIGINAL'"), ("$ORIGIN/../lib:/usr/lib", None)):
            with self.subTest(folders), tempfile.NamedTemporaryFile(suffix=".so") as library:
                output_of("c++", "-shared", "-x", "c++", "/dev/null", "-o", library.name, f"-Wl,-rpath,{folders}")
                expected = f"{library.name}: libraries are sought in {wrong}, which depends on the current folder\n"
                self.assertEqual(complaints(library.name), expected if wrong else "")

    def test_presets(self):
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))["configurePresets"]
        hardened = {p["name"] for p in presets if p.get("cacheVariables", {}).get("VITREL_HARDENED") == "ON"}
        self.assertEqual(hardened, {"portable"})
        self.assertEqual(next(p["inherits"] for p in presets if p["name"] == "x86-64-v3"), "portable")


if __name__ == "__main__":
    unittest.main()
