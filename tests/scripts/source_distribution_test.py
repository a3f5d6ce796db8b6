#!/usr/bin/python3
"""A source distribution has the version of the sources and says the commit that it was made from."""

import pathlib
import re
import shutil
import tempfile
import tomllib
import unittest

from script_tests import ROOT, FolderTest, output_of


def commit_of(sources):
    """The commit that a build of these sources would name."""
    with tempfile.TemporaryDirectory() as build:
        header = pathlib.Path(build, "vitrel_commit.h")
        output_of("cmake", f"-DSOURCE={sources}", f"-DOUTPUT={header}", "-P", sources / "cmake/commit.cmake")
        return re.fullmatch('#define VITREL_COMMIT "(.+)"\n', header.read_text(encoding="utf-8"))[1]


class SourceDistribution(FolderTest):
    def repository(self):
        """A repository of what a source distribution asks for its commit, and that commit."""
        sources = self.folder / "repository"
        (sources / "cmake").mkdir(parents=True)
        for name in (".gitignore", "CMakeLists.txt", "cmake/commit.cmake"):
            shutil.copy(ROOT / name, sources / name)
        git = ["git", "-C", sources, "-c", "user.name=name", "-c", "user.email=address"]
        output_of(*git, "init", "--quiet")
        output_of(*git, "add", "--all")
        output_of(*git, "commit", "--quiet", "--message=All.")
        return sources, output_of(*git, "rev-parse", "HEAD")

    def test_it_says_the_commit_of_the_repository(self):
        sources, commit = self.repository()
        self.assertEqual(commit_of(sources), commit)
        output_of("cmake", "-G", "Ninja", "-S", sources, "-B", self.folder / "build", "-DSKBUILD_STATE=sdist")
        unpacked = self.folder / "unpacked"
        shutil.copytree(sources, unpacked, ignore=shutil.ignore_patterns(".git"))
        self.assertEqual(commit_of(unpacked), "unknown")  # a mere copy, perhaps changed
        (unpacked / "PKG-INFO").touch()
        self.assertEqual(commit_of(unpacked), commit)

        # One made from it says the same.
        output_of("cmake", "-G", "Ninja", "-S", unpacked, "-B", self.folder / "again", "-DSKBUILD_STATE=sdist")
        self.assertEqual(commit_of(unpacked), commit)
        # The repository itself goes on to say what it is.
        (sources / "CMakeLists.txt").write_text("changed", encoding="utf-8")
        self.assertEqual(commit_of(sources), f"{commit}-modified")

    def test_it_has_the_version_of_the_sources(self):
        project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
        version = project["tool"]["scikit-build"]["metadata"]["version"]
        found = re.search(version["regex"], (ROOT / version["input"]).read_text(encoding="utf-8"), re.MULTILINE)
        self.assertIn(f"version: {found['value']}\n", (ROOT / "CITATION.cff").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
