"""The program that is the first argument of a script, and a folder to work in."""
import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def vitrel(*words):
    """The end of a command, whatever it is."""
    return subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)


def summary_of(*words):
    """What a command that succeeds prints as JSON."""
    done = vitrel(*words, "--json", "-q")
    assert done.returncode == 0, (words, done.stderr)
    return json.loads(done.stdout)


@contextlib.contextmanager
def work_in_a_new_folder():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir("/")
