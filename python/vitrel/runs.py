"""Runs of event-driven dynamics, and their analysis."""

import contextlib
import functools
import html
import json
import operator
import os
import pathlib
import time
from typing import Callable, Iterator, Mapping, Optional, Sequence, SupportsIndex, Unpack, overload

import numpy

from . import _vitrel
from .observations import Observations
from .parameters import Import
from .progress import listener
from .results import Results, plain_columns, tables_of
from .settings import AnalysisSettings, RunSettings, assignments
from .states import Path, Start, State, export_file, start_and_parameters, start_file


class Page:
    """What has a report page: one HTML file that needs nothing beside it."""

    path: pathlib.Path
    _imports: Sequence[str] = ()  # assignments of keys of [import], for files of other programs

    def report(self, path=None) -> pathlib.Path:
        """Writes the page, by default beside the run or into the folder of the sweep; returns its path.

        It replaces a page that is there, and nothing else.
        """
        default = self.path / "report.html" if self.path.is_dir() else self.path.with_suffix(".html")
        path = default if path is None else pathlib.Path(path)
        _vitrel.write_page(self.path, path, self._imports)
        return path

    def _repr_html_(self) -> str:
        page = html.escape(_vitrel.page(self.path, self._imports))
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 42em; border: 0"></iframe>'


class FrameSlice(Sequence[State]):
    """Some frames of a run, each read when it is asked for."""

    def __init__(self, run: "Run", frames: range):
        self._run, self._chosen = run, frames

    def __len__(self) -> int:
        return len(self._chosen)

    def __getitem__(self, frame):
        chosen = self._chosen[frame]
        return FrameSlice(self._run, chosen) if isinstance(frame, slice) else self._run[chosen]

    def __repr__(self) -> str:
        return f"<{len(self)} frames of {self._run!r}>"


class Run(Page):
    """A run on file: a sequence of states.

    Every table of its analysis is an attribute, and so is every column, of the first table that has it:
    ``run.msd.plot()``.

    Attributes
    ----------
    path : pathlib.Path
    summary : dict
        What `vitrel run --json` prints; empty if the run was only loaded.
    observed : Results or None
        The observables that were given to `vitrel.run`.
    imported : dict
        How a file of another program was read, or up to where that of a run in progress; else empty.
    """

    def __init__(self, path, summary: Optional[dict] = None, observed: Optional[Results] = None, imports: Sequence[str] = ()):
        self.path, self.summary, self.observed = pathlib.Path(path), summary or {}, observed
        self._imports = tuple(imports)
        self._open: Optional[_vitrel.Frames] = _vitrel.Frames(self.path, imports)
        self.imported = dict(self._frames.import_report)

    @property
    def _frames(self) -> _vitrel.Frames:
        if self._open is None:
            raise _vitrel.UserError(f"{self.path} was closed")
        return self._open

    def close(self) -> None:
        """Closes the file, as the end of a `with` block does. States that were read stay."""
        self._open = None

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __len__(self) -> int:
        return len(self._frames)

    @overload
    def __getitem__(self, frame: SupportsIndex) -> State: ...
    @overload
    def __getitem__(self, frame: slice) -> "FrameSlice": ...

    def __getitem__(self, frame):
        """A frame, or those of a slice, which are read when they are asked for."""
        if isinstance(frame, slice):
            return FrameSlice(self, range(len(self))[frame])
        return State(self._frames[range(len(self))[operator.index(frame)]], self._frames.parameters)

    def __iter__(self) -> Iterator[State]:
        return iter(self[:])

    def live(self, interval: float = 1) -> Iterator["Run"]:
        """The run while another process writes it: as it is now, again whenever it has more frames, and last when it has ended.

            for run in vitrel.load("run.h5").live():
                print(run.times[-1], run.msd[-1])

        Parameters
        ----------
        interval : float
            Seconds between two looks at the file.
        """
        frames = -1
        while True:
            now = Run(self.path, imports=self._imports)
            has_ended = "in progress" not in now.imported
            if has_ended or len(now) > frames:
                yield now
            if has_ended:
                return
            frames = len(now)
            time.sleep(interval)

    def __repr__(self) -> str:
        return f"<Run {self.path}: {f'{len(self)} frames' if self._open else 'closed'}>"

    def __eq__(self, other: object) -> bool:
        """Whether it is the same file, read in the same way."""
        return isinstance(other, Run) and (self.path.resolve(), self._imports) == (other.path.resolve(), other._imports)

    def __hash__(self) -> int:
        return hash(self.path.resolve())

    def __reduce__(self):
        return Run, (self.path.resolve(), self.summary, self.observed, self._imports)

    def __dir__(self):
        return [*super().__dir__(), *self._names()]

    def _names(self):
        """Tables and columns: those that there are if they have been computed, else those that charts show."""
        if "results" in self.__dict__:
            return [*self.results, *(name for table in self.results.values() for name in table)]
        return plain_columns(self.dimension)

    def __getattr__(self, name: str):
        if name.startswith("_") or hasattr(type(self), name):  # the name is no column; getting a property has failed
            raise AttributeError(name)
        try:
            return self.results.find(name)
        except KeyError:
            raise AttributeError(f"neither Run nor its results have '{name}'; tables are {', '.join(self.results)}") from None

    @property
    def dimension(self) -> int:
        return self._frames.dimension

    @property
    def times(self) -> numpy.ndarray:
        """Of the frames, shape (frames,)."""
        return self._frames.times

    @property
    def parameters(self) -> str:
        """All values in force, TOML."""
        return self._frames.parameters

    def export(self, path, format: Optional[str] = None, *, frames: Optional[str] = None, shrink: Optional[float] = None,
               voxels: Optional[int] = None, images: bool = False) -> pathlib.Path:
        """Writes frames as `vitrel export` does; returns the path.

        Parameters
        ----------
        path : path
            Must not exist.
        format : str, optional
            gsd, xyz, csv or xytheta, in space also geo, vti or vtp; by default the suffix of the path says it.
        frames : str, optional
            Which ones: "-1", "10:20", "::5".
        shrink, voxels, images
            Of packings (docs/exports.md).
        """
        export_file(self.path, path, self.dimension, format, frames, shrink, voxels, images, self._imports)
        return pathlib.Path(path)

    def film(self, path, colour: Optional[str] = None, *, frames: Optional[str] = None, width: int = 1000,
             rate: Optional[float] = None) -> pathlib.Path:
        """Writes a film (.mp4), or a picture of one frame (.png, in the plane .svg), as `vitrel picture` does; returns the path.

        Parameters
        ----------
        colour : str, optional
            "orientation", "species", "size", "displacement", in the plane "psi6".
        frames : str, optional
            As of `export`.
        rate : float
            Images per second of a film; 25.
        """
        _vitrel.write_film(self.path, path, frames, colour or "", width, rate, self._imports)
        return pathlib.Path(path)

    @functools.cached_property
    def results(self) -> Results:
        """The analysis with the settings that the run was made with."""
        return self.analyze()

    def analyze(self, observe: Optional[Mapping[str, Callable]] = None, **settings: Unpack[AnalysisSettings]) -> Results:
        """All tables that the run has what they need for.

        Parameters
        ----------
        observe : mapping of str to callable, optional
            Observables of one's own, as of `vitrel.run`, evaluated for all frames. Each becomes a table, and its mean and
            error stand in the summary.
        **settings
            Keys of `[analysis]` (`vitrel.parameters.Analysis`).
        """
        with assignments(Run.analyze, settings) as lines:
            text, columns, provenance = _vitrel.analyze(self.path, [*self._imports, *lines])
        summary, tables = json.loads(text), tables_of(columns, self.dimension)
        if observe is not None:
            own = Observations(observe).results(self)
            summary.update(own.summary)
            tables += own.values()
        return Results(summary, tables, provenance)


def run(start: Start = None, file: Optional[Path] = None, *, output: Path, observe: Optional[Mapping[str, Callable]] = None,
        on_frame: Optional[Callable[[State], None]] = None, threads: int = 1, quiet: bool = False,
        **settings: Unpack[RunSettings]) -> Run:
    """Runs a state, or goes on with the run in `output`.

    The run is stored with a checkpoint beside it. What was interrupted, by Ctrl-C or an error of a callback, continues with
    the same call; with a longer duration, a complete run does.

    Parameters
    ----------
    start : State or path, optional
        Without one the state is prepared as the parameters say. Or a parameter file, whose name ends with .toml.
    file : path, optional
        A parameter file; without one, all keys have their defaults.
    output : path
        The file of the run.
    observe : mapping of str to callable, optional
        Functions of a State that return a number or an array of one dimension, evaluated at every frame. `Run.observed`
        has a table for each, and means with errors by blocking.
    on_frame : callable, optional
        Called with the State of every frame.
    threads : int
        Results do not depend on it.
    quiet : bool
        No progress, which otherwise a terminal or a notebook shows (as a bar where tqdm is installed).
    **settings
        Keys of the parameter file (`vitrel.settings.RunSettings`): those of `[dynamics]` (`kind`, `duration`,
        `brownian_step` …), `[system]`, `[output]` (`samples`, `correlations` …) and `[prepare]`
        (`vitrel.parameters.Dynamics`, …), and others as of `prepare`. The particles are those of the state.
    """
    observations = Observations(observe or {})

    def see(state):
        state = State(state)
        observations.observe(state)
        if on_frame is not None:
            on_frame(state)

    say, show, end = listener(quiet)
    start, file = start_and_parameters(start, file)
    with start_file(start) as path, contextlib.closing(end), assignments(run, settings) as lines:
        summary = _vitrel.run(file, lines, path, os.fspath(output), threads, say, show, see if observe or on_frame else None)
    found = Run(output, json.loads(summary))
    if observe:
        found.observed = observations.results(found)
    return found


def load(path: Path, **settings: Unpack[Import]) -> Run:
    """A run that was saved, by vitrel or in any format that `vitrel analyze` reads.

    Parameters
    ----------
    **settings
        Keys of `[import]` (`vitrel.parameters.Import`), for files of other programs:
        ``load("run.gsd", unwrap="nearest")``.
    """
    with assignments(load, settings) as lines:
        return Run(path, imports=lines)
