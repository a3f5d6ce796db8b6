"""Types as mypy sees them."""

import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def mypy(tmp_path, module, *arguments):
    done = subprocess.run([sys.executable, "-m", module, *arguments], capture_output=True, text=True, check=False, cwd=tmp_path,
                          env={**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]})
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stub_is_that_of_the_compiled_module(tmp_path):
    mypy(tmp_path, "mypy.stubtest", "--mypy-config-file", HERE / "mypy.ini",
         "--allowlist", HERE / "stubtest.allowlist", "vitrel._vitrel")


def test_an_example_has_types(tmp_path):
    mypy(tmp_path, "mypy", "--strict", "--config-file", HERE / "mypy.ini", HERE / "typed_example.py")


def test_settings_have_types(tmp_path):
    package = pathlib.Path(os.environ["PYTHONPATH"], "vitrel")
    mypy(tmp_path, "mypy", "--strict", "--config-file", HERE / "mypy.ini",
         *(package / f"{name}.py" for name in ("parameters", "settings", "toml")))
