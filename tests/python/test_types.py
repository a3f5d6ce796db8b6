"""Types as mypy sees them."""

import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = pathlib.Path(os.environ["PYTHONPATH"], "vitrel")


def check(folder, module, *arguments):
    done = subprocess.run([sys.executable, "-m", module, *arguments], capture_output=True, text=True, check=False, cwd=folder,
                          env={**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]})
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stub_is_that_of_the_compiled_module(tmp_path):
    check(tmp_path, "mypy.stubtest", "--mypy-config-file", HERE / "mypy.ini", "--allowlist", HERE / "stubtest.allowlist",
          "vitrel._vitrel")


def test_an_example_and_the_settings_have_types(tmp_path):
    check(tmp_path, "mypy", "--strict", "--config-file", HERE / "mypy.ini", HERE / "typed_example.py",
          *(PACKAGE / f"{name}.py" for name in ("parameters", "settings", "toml")))
