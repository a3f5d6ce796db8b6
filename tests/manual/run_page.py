"""Runs the code blocks of a page of the manual, in their order, in a temporary folder: run_page.py PAGE. The programs are
those of PATH, the Python package is that of PYTHONPATH.

    sh        run by bash; the first command that fails ends the test
    python    run in one interpreter for the whole page
    toml, csv written to the file that a comment before the block names, or checked as what follows another file
    cpp       must be part of a file that other tests compile, which a comment names
    text      not run: output, and formulas

`params` is a link to the parameter files. Comments on the line before a block, which no reader sees:

    <!-- file: NAME -->                written to NAME
    <!-- after: FILE -->               written to a file after the contents of FILE, which must be valid parameters then
    <!-- part of: FILE -->             must be a part of FILE
    <!-- first: COMMAND -->            runs COMMAND before the block, to make files that the reader has already
    <!-- in the test: A → B -->        runs with A replaced by B, such as a smaller number; A must be there
    <!-- needs: PROGRAM -->            not run where this program is not built
    <!-- not run: REASON -->           run_page.py --not-run lists all of these
"""

import ast
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import time
import traceback

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMENT = re.compile(r"<!-- (file|after|part of|first|in the test|needs|not run): (.+) -->")
FENCE = re.compile(r"^( *)```(.*)$")
LANGUAGES = {"sh", "python", "toml", "csv", "cpp", "text", ""}


class Wrong(Exception):
    """A block does not do what the page says."""


class Block:
    """A fenced block: language, comments (kind, text), text, and the number of its first line."""

    def __init__(self, language, comments, text, line):
        self.language, self.comments, self.text, self.line = language, comments, text, line

    def comment(self, kind):
        return next((text for name, text in self.comments if name == kind), None)


def blocks_of(page):
    """All fenced blocks of a page."""
    blocks, comments, inside = [], [], None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        fence = FENCE.match(line)
        if inside is not None:
            if fence and not fence[2].strip():
                inside.text = textwrap.dedent(inside.text)
                blocks.append(inside)
                inside = None
            else:
                inside.text += line + "\n"
        elif fence:
            inside, comments = Block(fence[2].strip(), comments, "", number + 1), []
        elif found := COMMENT.fullmatch(line.strip()):
            comments.append(found.groups())
        elif line.strip():
            if comments:
                raise Wrong(f"{page}:{number}: a comment to the test stands before no block")
    if inside is not None:
        raise Wrong(f"{page}:{inside.line}: the block has no end")
    return blocks


def in_test(block):
    """The text of a block with the numbers of the test."""
    text = block.text
    for kind, change in block.comments:
        if kind == "in the test":
            old, new = change.split(" → ")
            if old not in text:
                raise Wrong(f"'{old}' is not there to be replaced")
            text = text.replace(old, new)
    return text


def run_shell(commands):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands], stdin=subprocess.DEVNULL, check=False)
    if done.returncode:
        raise Wrong(f"exit code {done.returncode}")


def run_python(block, page, namespace):
    # As if the lines before were empty: tracebacks name the lines of the page.
    tree = ast.parse("\n" * (block.line - 1) + in_test(block), filename=str(page))
    # As an interactive interpreter, show the value of the last expression.
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, str(page), "exec"), namespace)
    if last is not None:
        value = eval(compile(ast.Expression(last.value), str(page), "eval"), namespace)
        if value is not None:
            print(repr(value))


def write_file(block):
    if base := block.comment("after"):
        file = pathlib.Path(f"block_{block.line}.toml")
        file.write_text((ROOT / base).read_text(encoding="utf-8") + "\n" + in_test(block), encoding="utf-8")
        done = subprocess.run(["vitrel", "run", file, "-o", file.with_suffix(".h5"), "--dry-run"], check=False)
        if done.returncode:
            raise Wrong(f"not valid after {base}: exit code {done.returncode}")
        return
    name = block.comment("file")
    if name is None:
        raise Wrong("which file is this? <!-- file: NAME -->")
    path = pathlib.Path(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(in_test(block), encoding="utf-8")


def require_part(block):
    name = block.comment("part of")
    wanted = [line.strip() for line in block.text.splitlines()]
    lines = [line.strip() for line in (ROOT / name).read_text(encoding="utf-8").splitlines()]
    if not any(lines[k:k + len(wanted)] == wanted for k in range(len(lines))):
        raise Wrong(f"the block is no part of {name}")


def run_block(block, page, namespace):
    if block.comment("part of"):
        require_part(block)
    if block.comment("not run") or block.language == "text":
        return
    if (program := block.comment("needs")) and not shutil.which(program):
        print(f"-- line {block.line}: not run, there is no {program}", flush=True)
        return
    if block.language not in LANGUAGES:
        raise Wrong(f"unknown language '{block.language}'")
    if block.language == "":
        raise Wrong("the block has no language; that of output is text")
    print(f"-- line {block.line}, {block.language}", flush=True)
    for kind, command in block.comments:
        if kind == "first":
            run_shell(command)
    if block.language == "cpp":
        if not block.comment("part of"):
            raise Wrong("which file is this a part of? <!-- part of: FILE -->")
    elif block.language == "sh":
        run_shell(in_test(block))
    elif block.language == "python":
        run_python(block, page, namespace)
    else:
        write_file(block)


def run_page(page):
    blocks = blocks_of(page)
    namespace = {"__name__": "__main__"}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        pathlib.Path("params").symlink_to(ROOT / "params")
        for block in blocks:
            begin = time.monotonic()
            try:
                run_block(block, page, namespace)
            except Exception as error:
                if not isinstance(error, Wrong):
                    traceback.print_exc()
                sys.exit(f"{page}:{block.line}: {error}")
            print(f"-- {time.monotonic() - begin:.1f} s", flush=True)
        os.chdir("/")


def pages():
    """All pages of the manual that show commands."""
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md")),
            *sorted((ROOT / "bench").glob("*.md"))]


def indented_commands(page):
    """Lines of indented blocks with commands: measurements."""
    inside = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        inside ^= bool(FENCE.match(line))
        if not inside and re.match(r" {4}(scripts|build)/|    vitrel", line):
            yield number, line.strip()


def list_not_run():
    for page in pages():
        name = page.relative_to(ROOT)
        for block in blocks_of(page):
            if reason := block.comment("not run"):
                print(f"{name}:{block.line}: {reason}")
        for number, command in indented_commands(page):
            print(f"{name}:{number}: a long measurement: {command}")


def check_scripts():
    """All scripts and validations that pages name are there, whether or not they run, and every figure has one."""
    for page in pages():
        for word, name in re.findall(r"(?<![\w/])scripts/(validate )?(\w+)(?![\w.])", page.read_text(encoding="utf-8")):
            file = ROOT / "scripts" / (f"validation/{name}.py" if word else name)
            if not file.exists() and name not in ("validate", "validation"):
                sys.exit(f"{page}: there is no {file.relative_to(ROOT)}")
    drawn = (ROOT / "scripts/manual_figures").read_text(encoding="utf-8")
    for figure in (ROOT / "docs/figures/manual").iterdir():
        if f'"{figure.stem}": ' not in drawn:
            sys.exit(f"{figure}: scripts/manual_figures does not draw it")


if __name__ == "__main__":
    if sys.argv[1:] == ["--not-run"]:
        list_not_run()
    elif sys.argv[1:] == ["--scripts"]:
        check_scripts()
    elif len(sys.argv) == 2:
        run_page(pathlib.Path(sys.argv[1]).resolve())
    else:
        sys.exit(__doc__)
