"""What tests of scripts share: the modules of scripts, folders of their own, trees of files."""

import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))


def module_of(script):
    """A script of this name as a module."""
    loader = importlib.machinery.SourceFileLoader(script, str(SCRIPTS / script))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(script, loader))
    loader.exec_module(module)
    return module


def write_tree(folder, files):
    """Writes files whose texts are given by their paths."""
    for path, text in files.items():
        file = pathlib.Path(folder, path)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


def checked(script, files):
    """The end of a script that checks a tree of these files."""
    with tempfile.TemporaryDirectory() as root:
        write_tree(root, files)
        return subprocess.run([SCRIPTS / script, root], capture_output=True, text=True, check=False)


def output_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


class FolderTest(unittest.TestCase):
    """Every test has an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
