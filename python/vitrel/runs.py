"""Runs of event-driven dynamics, and their analysis."""

import contextlib
import json
import os
import pathlib
import tempfile

from . import _vitrel
from .results import Results
from .settings import listener, overrides
from .states import State


@contextlib.contextmanager
def start_file(start):
    """The file of a state to start from, for as long as it is needed; None if there is none."""
    if not isinstance(start, State):
        yield None if start is None else os.fspath(start)
        return
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "state.h5")
        start.write(path)
        yield str(path)


class Run:
    """A run on file.

    Attributes
    ----------
    path : pathlib.Path
    summary : dict
        What `vitrel run --json` prints; empty if the run was only loaded.
    times : numpy.ndarray
        Of the frames.
    """

    def __init__(self, path, summary=None):
        self.path, self.summary = pathlib.Path(path), summary or {}
        self._frames = _vitrel.Frames(os.fspath(path))

    def __len__(self):
        return len(self._frames)

    def __getitem__(self, frame):
        """The state of a frame."""
        return State(self._frames[frame if frame >= 0 else len(self) + frame], self._frames.parameters)

    def __iter__(self):
        return (self[k] for k in range(len(self)))

    def __repr__(self):
        return f"<Run {self.path}: {len(self)} frames>"

    @property
    def times(self):
        return self._frames.times

    @property
    def parameters(self):
        """All values in force, TOML."""
        return self._frames.parameters

    def analyze(self, **settings):
        """All tables that the run has what they need for; settings are keys of `[analysis]`."""
        return Results(*_vitrel.analyze(str(self.path), overrides("analysis", settings)))


def run(start=None, file=None, *, output, threads=1, quiet=False, **settings):
    """Runs a state, or goes on with the run in `output`.

    Parameters
    ----------
    start : State or path, optional
        Without one the state is prepared as the parameters say.
    file : path, optional
        A parameter file; without one, all keys have their defaults.
    output : path
        The file of the run; what was interrupted continues.
    **settings
        Keys of `[dynamics]` (`kind`, `duration`, `brownian_step` …), `samples` and `correlations`, and any other key with
        two underscores for every dot. The particles are those of the state.

    Returns
    -------
    Run
    """
    say, show = listener(quiet)
    with start_file(start) as path:
        summary = _vitrel.run("" if file is None else os.fspath(file), overrides("dynamics", settings), path,
                              os.fspath(output), threads, say, show)
    return Run(output, json.loads(summary))


def load(path):
    """A run that was saved."""
    return Run(path)
