#!/usr/bin/python3
"""scripts/validate rewrites exactly the section it was asked for, and none if the validation fails."""

import importlib.machinery
import importlib.util
import pathlib
import sys
import tempfile
import types
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts" / "validate"

loader = importlib.machinery.SourceFileLoader("validate", str(SCRIPT))
validate = importlib.util.module_from_spec(importlib.util.spec_from_loader("validate", loader))
sys.dont_write_bytecode = True
loader.exec_module(validate)

PAGE = "# Validation\n\nText.\n\n## One\n\nold 1\n\n## One and more\n\nold 2\n"


def failing(_build):
    raise validate.Failure("Z = 3, not 2")


class Validate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        validate.PAGE = pathlib.Path(folder.name, "validation.md")
        validate.circumstances = lambda seconds: "Measured."

    def run_validation(self, title, measure):
        module = types.ModuleType("validation.sample")
        module.TITLE, module.measure = title, measure
        sys.modules["validation.sample"] = module
        validate.validate("sample", pathlib.Path("build"))

    def test_replaces_one_section(self):
        validate.PAGE.write_text(PAGE)
        self.run_validation("One", lambda build: "new 1\n")
        new = "## One\n\nCommand: `scripts/validate sample`\n\nnew 1\n\nMeasured.\n"
        self.assertEqual(validate.PAGE.read_text(), PAGE.replace("## One\n\nold 1\n", new))
        self.run_validation("One", lambda build: "new 1\n")
        self.assertEqual(validate.PAGE.read_text(), PAGE.replace("## One\n\nold 1\n", new))

    def test_appends_a_new_section(self):
        validate.PAGE.write_text(PAGE)
        self.run_validation("Two", lambda build: "new")
        text = validate.PAGE.read_text()
        self.assertTrue(text.startswith(PAGE))
        self.assertTrue(text[len(PAGE):].startswith("\n## Two\n"))

    def test_begins_the_page(self):
        self.run_validation("One", lambda build: "new")
        self.assertTrue(validate.PAGE.read_text().startswith("# Validation\n"))

    def test_a_failure_writes_nothing(self):
        validate.PAGE.write_text(PAGE)
        with self.assertRaises(validate.Failure):
            self.run_validation("One", failing)
        self.assertEqual(validate.PAGE.read_text(), PAGE)

    def test_every_validation_has_its_parts(self):
        self.assertGreaterEqual(len(validate.names()), 3)
        for name in validate.names():
            module = importlib.import_module(f"validation.{name}")
            self.assertTrue(module.TITLE)
            self.assertTrue(callable(module.measure))


if __name__ == "__main__":
    unittest.main()
