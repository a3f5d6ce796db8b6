#!/usr/bin/python3
"""scripts/validate rewrites exactly the section it was asked for, and none if the validation fails; --stale lists the
sections whose inputs have changed.
"""

import importlib
import pathlib
import sys
import types
import unittest

from script_tests import ROOT, FolderTest, module_of, output_of

validate = module_of("validate")

PAGE = "# Validation\n\nText.\n\n## One\n\nold 1\n\n## One and more\n\nold 2\n"


def failing(_build):
    raise validate.Failure("Z = 3, not 2")


class Validate(FolderTest):
    def setUp(self):
        super().setUp()
        validate.PAGE = self.folder / "validation.md"
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

    def test_the_docstring_is_the_text_around_what_was_measured(self):
        module = types.ModuleType("validation.sample", "Required: {LARGEST:.1%}.\n\n{table}\n")
        module.LARGEST = 0.02
        self.assertEqual(validate.text_of(module, {"table": "| 1 |"}), "Required: 2.0%.\n\n| 1 |\n")
        self.assertEqual(validate.text_of(module, "as it is"), "as it is")

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
            of_parts = getattr(module, "INPUTS", [])
            for inputs in of_parts.values() if isinstance(of_parts, dict) else [of_parts]:
                for name in inputs:
                    self.assertTrue((ROOT / name).exists(), name)


class Stale(FolderTest):
    """In a repository with two commits: the second one changes core, which only one of the validations depends on."""

    def setUp(self):
        super().setUp()
        for name, value in (("ROOT", self.folder), ("PAGE", self.folder / "docs/validation.md"),
                            ("STUDIES", self.folder / "docs/studies"), ("PLATFORMS", self.folder / "docs/platforms.md")):
            self.addCleanup(setattr, validate, name, getattr(validate, name))
            setattr(validate, name, value)
        self.addCleanup(setattr, validate, "names", validate.names)
        validate.names = lambda: ["first", "second", "studies", "platforms"]
        inputs = {"first": ["core"], "second": ["mc"], "studies": {"engine": ["core"], "sampling": ["mc"]}, "platforms": ["core"]}
        for name, of_module in inputs.items():
            sys.modules[f"validation.{name}"] = module = types.ModuleType(f"validation.{name}")
            self.addCleanup(sys.modules.pop, f"validation.{name}")
            module.INPUTS = of_module
        self.git("init", "--quiet")
        self.since = self.commit("core/a.h", "mc/b.h")

    def git(self, *words):
        who = ("-c", "user.name=name", "-c", "user.email=address")
        return output_of("git", "-C", self.folder, *who, *words)

    def commit(self, *files):
        for file in files:
            (self.folder / file).parent.mkdir(exist_ok=True)
            with (self.folder / file).open("a", encoding="utf-8") as out:
                out.write("line\n")
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message=All.")
        return self.git("rev-parse", "--short", "HEAD")

    def pages(self, since):
        measured = f"Measured on 2026-11-21, commit {since}, a processor, in 9 s.\n"
        (self.folder / "docs/studies").mkdir(parents=True, exist_ok=True)
        validate.PAGE.write_text("# Validation\n\n" + "\n".join(
            f"## {title}\n\nCommand: `scripts/validate {name}`\n\nText (commit 1234567).\n\n{measured}"
            for title, name in (("One", "first"), ("Two", "second"), ("Three", "removed"))))
        for name in ("engine", "sampling"):
            (self.folder / f"docs/studies/{name}.md").write_text(f"# A question?\n\n{measured}")
        validate.PLATFORMS.write_text(f"# Platforms\n\n- Debian 12, GCC: 2026-11-27, commit {since}, a processor\n")

    def test_lists_what_is_older_than_its_inputs(self):
        self.pages(self.since)
        self.assertEqual(validate.stale(), "docs/validation.md: Three: there is no such validation since " + self.since)
        self.commit("core/a.h")
        changed = f"1 file changed, 1 insertion(+) since {self.since}"
        self.assertEqual(validate.stale().splitlines(), [
            f"docs/validation.md: One: {changed}", f"docs/validation.md: Three: there is no such validation since {self.since}",
            f"docs/studies/engine.md: engine: {changed}", f"docs/platforms.md: Debian 12, GCC: {changed}"])

    def test_a_commit_that_is_not_in_the_repository(self):
        self.pages("0123456")
        self.assertIn("docs/validation.md: Two: the commit is unknown here since 0123456", validate.stale())


if __name__ == "__main__":
    unittest.main()
