"""Many runs from one set of parameters."""

import contextlib
import functools
import json
import os
import pathlib
import shutil
import sysconfig
from typing import List, Literal, Optional, Unpack

from . import _vitrel
from .progress import listener
from .results import Results, tables_of
from .runs import Page, Run
from .settings import AnalysisSettings, SweepSettings, assignments
from .states import Path


class Sweep(Page):
    """The finished jobs of a sweep.

    Attributes
    ----------
    path : pathlib.Path
        Its folder.
    """

    def __init__(self, path):
        self.path = pathlib.Path(path)

    def __repr__(self) -> str:
        return f"<Sweep {self.path}>"

    def analyze(self, **settings: Unpack[AnalysisSettings]) -> Results:
        """What the runs say together.

        Table `runs` has a row for each, with all averages; `relaxation` and `glass_fit` are relaxation times, verdicts and
        fits of the laws of the glass transition, which the summary gives in words.
        """
        return self._analyze(settings)[0]

    def _analyze(self, settings):
        with assignments(Sweep.analyze, settings) as lines:
            summary, tables, provenance, files, unfinished = _vitrel.analyze_sweep(self.path, lines)
        results = Results(json.loads(summary), tables_of(tables, Run(files[0]).dimension), provenance)
        return results, files, unfinished

    @functools.cached_property
    def _analysis(self):
        return self._analyze({})

    @property
    def results(self) -> Results:
        """The analysis with the settings of the sweep."""
        return self._analysis[0]

    @property
    def runs(self) -> List[Run]:
        """By packing fraction, then by seed."""
        return [Run(file) for file in self._analysis[1]]

    @property
    def unfinished(self) -> List[str]:
        """Names of the jobs that are not done."""
        return self._analysis[2]


def sweep(file: Optional[Path] = None, *, output: Path, parallel: Optional[int] = None, program: Optional[Path] = None,
          quiet: bool = False, export: Optional[Literal["slurm", "snakemake"]] = None,
          **settings: Unpack[SweepSettings]) -> Sweep:
    """Prepares, runs and analyses all jobs of a sweep; what is complete is left alone, and what was cut off continues.

    Or writes a folder whose jobs a cluster runs: `load_sweep` then reads what is there.

    Parameters
    ----------
    file : path, optional
        A parameter file; without one, all keys have their defaults.
    output : path
        The folder, with a folder in it for each job.
    parallel : int, optional
        Jobs at a time; by default as many as there are processors, or as the cluster lets run.
    program : path, optional
        The program `vitrel`, which works on the jobs; by default the one that was installed with the package, or
        that the shell would find.
    export : str, optional
        Runs nothing, and writes `job_array.sh` for Slurm's `sbatch`, or a `Snakefile` instead.
    **settings
        Keys of the parameter file (`vitrel.settings.SweepSettings`): those of `[sweep]` (`vitrel.parameters.Sweep`), and
        all of `vitrel.run`. The keys of `grid` and `together` are keyword arguments of `run`, or keys with dots:
        ``grid={"packing_fraction": [0.5, 0.6], "species.0.aspect_ratio": [2, 3]}``.
    """
    # The folder of programs of a virtual environment need not be in the path.
    program = program or shutil.which("vitrel", path=sysconfig.get_path("scripts")) or shutil.which("vitrel")
    if program is None:
        raise _vitrel.FileError("the program vitrel, which works on the jobs of a sweep, is not in the path; give its place as "
                                "program=")
    say, show, end = listener(quiet)
    with contextlib.closing(end), assignments(sweep, settings) as lines:
        request = ("" if file is None else os.fspath(file), lines, os.fspath(output), os.fspath(program))
        if export is not None:
            use = _vitrel.export_sweep(*request, parallel or 0, export)
            if not quiet:
                print(f"{output}: in this folder, {use}")
            return Sweep(output)
        done, failed = _vitrel.sweep(*request, parallel or os.cpu_count() or 1, say, show)
    if failed:
        raise RuntimeError(f"{failed} of {done + failed} jobs failed; log.txt in their folders of {output} says why, and the "
                           "same call tries them again")
    return Sweep(output)


def load_sweep(path) -> Sweep:
    """A sweep that was run, here or by `vitrel sweep`, or is running."""
    return Sweep(path)
