"""run_page.py fails where a page is wrong: run_page_test.py."""

import pathlib
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(__file__).with_name("run_page.py")

RIGHT = """
# A page

<!-- file: right.toml -->
<!-- in the test: 1000 → 10 -->
```toml
[system]
particles = 1000
```

```sh
grep -q 'particles = 10$' right.toml
```

```python
n = 2
```

Text.

```python
assert n == 2
```

<!-- not run: takes hours -->
```sh
exit 1
```

<!-- needs: no-such-program -->
```sh
exit 1
```

```text
Output.
```

<!-- part of: tests/manual/two_species.toml -->
```text
[system]
particles = 20
```
"""

WRONG = {
    "a command fails": "```sh\nfalse\ntrue\n```\n",
    "a file is missing": "```sh\nvitrel check missing.h5\n```\n",
    "an unknown option": "```sh\nvitrel check --frobnicate x.h5\n```\n",
    "a key is misspelt": "<!-- file: a.toml -->\n```toml\n[system]\nparticels = 1\n```\n"
                         "```sh\nvitrel run a.toml -o a.h5 --dry-run\n```\n",
    "Python raises": "```python\nimport vitrel\nvitrel.no_such_name\n```\n",
    "no language": "```\nvitrel version\n```\n",
    "unknown language": "```shell\ntrue\n```\n",
    "no file": "```toml\na = 1\n```\n",
    "no part": "<!-- part of: tests/manual/two_species.toml -->\n```cpp\nint x;\n```\n",
    "no part given": "```cpp\nint x;\n```\n",
    "nothing to replace": "<!-- in the test: 7 → 8 -->\n```sh\ntrue\n```\n",
    "a comment before no block": "<!-- file: a -->\n\nText.\n",
    "a block without end": "```sh\ntrue\n",
    "not valid after": "<!-- after: tests/manual/two_species.toml -->\n```toml\n[dynamics]\nrestitutoin = 1\n```\n",
}


def outcome(folder, text):
    page = pathlib.Path(folder, "page.md")
    page.write_text(text, encoding="utf-8")
    return subprocess.run([sys.executable, PROGRAM, page], capture_output=True, text=True, check=False)


with tempfile.TemporaryDirectory() as folder:
    done = outcome(folder, RIGHT)
    assert done.returncode == 0, done.stdout + done.stderr
    for what, text in WRONG.items():
        done = outcome(folder, text)
        assert done.returncode == 1 and "page.md" in done.stderr, (what, done.returncode, done.stdout, done.stderr)
