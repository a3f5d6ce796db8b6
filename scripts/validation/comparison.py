"""Comparisons in one form: scenes that a sweep simulates, a measured quantity, its reference and a tolerance."""

import dataclasses
import json
import math
import pathlib
import statistics
import tempfile
import typing

from validation.common import HERE, Estimate, estimate, expect, settings, summary_of, table

SCENES = HERE / "scenes"
SEED = "system.seed"


def value_at(entry, path):
    """An entry of nested objects and lists: "prepare.stages.-1.sweeps"."""
    for key in path.split("."):
        entry = entry[int(key)] if isinstance(entry, list) else entry[key]
    return entry


def toml(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(map(toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def tables_of(file, names):
    """These tables of a file of results, as lists by column."""
    import h5py  # only here: a test imports all validations

    with h5py.File(file) as content:
        return {name: {column: values[...].tolist() for column, values in content[name].items()} for name in names}


class Scene:
    """The jobs of a sweep that differ in their seeds only; its entries are the swept values."""

    def __init__(self, values, jobs):
        self.values, self.jobs = values, jobs

    def __getitem__(self, key):
        return self.values[key]

    def __str__(self):
        return ", ".join(f"{key} = {value}" for key, value in self.values.items())

    def every(self, path):
        """What each job says at this path."""
        return [value_at(job, path) for job in self.jobs]

    def mean(self, path):
        """Mean over the seeds, with the error from their scatter."""
        return estimate(self.every(path))

    def stated_mean(self, path):
        """Mean over the seeds, with the error from those that the jobs state."""
        return Estimate(statistics.mean(self.every(path)), math.hypot(*self.every(f"{path}_error")) / len(self.jobs))


@dataclasses.dataclass(frozen=True)
class Scenes:
    """A parameter file of `vitrel sweep`, settings instead of its own, and, if they are not in the file, rows of values
    that go together and seeds. `tables` of the analysis become entries of the jobs.
    """

    file: pathlib.Path
    settings: tuple = ()
    rows: tuple = ()
    seeds: typing.Sequence = ()
    tables: tuple = ()
    parallel: int = 2

    def overrides(self):
        columns = {key: [row[key] for row in self.rows] for key in (self.rows[0] if self.rows else ())}
        tables = {"sweep.together": columns, "sweep.grid": {SEED: self.seeds} if self.seeds else {}}
        return [*self.settings, *(f"{key}={toml(value)}" for key, value in tables.items() if value)]

    def run(self, build):
        """The scenes in the order of their jobs, all of which end in a state without overlaps by the exact check."""
        with tempfile.TemporaryDirectory() as folder:
            jobs = summary_of(build, "sweep", self.file, "-o", folder, "-j", str(self.parallel), "-q",
                              *settings(self.overrides()))["jobs"]
            for job in jobs if self.tables else ():
                job["tables"] = tables_of(job["analyze"]["output"], self.tables)
        scenes = {}
        for job in jobs:
            overlaps = job["run" if "run" in job else "prepare"]["overlaps"]
            expect(overlaps == 0, f"{self.file.stem}: {job['id']}: {overlaps} overlaps")
            values = {key: value for key, value in job["values"].items() if key != SEED}
            scenes.setdefault(toml(values), Scene(values, [])).jobs.append(job)
        return list(scenes.values())


@dataclasses.dataclass(frozen=True)
class Tolerance:
    """How far a measured value may be from its reference: so many standard errors of both and, in addition, a share of
    the reference or a number. The standard error itself may be limited, relative to the reference.
    """

    errors: float = 3
    relative: float = 0
    absolute: float = 0
    largest_error: float | None = None

    def allowed(self, error, reference):
        return self.errors * error + self.relative * abs(reference) + self.absolute


@dataclasses.dataclass(frozen=True)
class Compared:
    """A measured value beside its reference."""

    name: str
    measured: Estimate
    reference: Estimate
    tolerance: Tolerance

    HEAD = ("reference", "measured", "deviation", "in standard errors")

    @property
    def deviation(self):
        return self.measured.mean - self.reference.mean

    @property
    def error(self):
        return math.hypot(self.measured.error, self.reference.error)

    def check(self):
        reference, largest = self.reference.mean, self.tolerance.largest_error
        expect(largest is None or self.measured.error <= largest * abs(reference),
               f"{self.name}: the standard error of {self.measured} is too large")
        expect(abs(self.deviation) <= self.tolerance.allowed(self.error, reference),
               f"{self.name}: {self.measured}, not {self.reference}")

    def cells(self):
        relative = self.deviation / self.reference.mean if self.reference.mean else math.inf
        share = f"{relative:+.3%}" if abs(relative) < 0.1 else f"{self.deviation:+.2g}"
        return [self.reference, self.measured, share, f"{self.deviation / self.error:+.1f}" if self.error else "–"]


def compared(name, measured, reference, tolerance=Tolerance()):
    """Both after the check; a number has no error."""
    both = (value if isinstance(value, Estimate) else Estimate(value, 0) for value in (measured, reference))
    found = Compared(name, *both, tolerance)
    found.check()
    return found


@dataclasses.dataclass(frozen=True)
class Comparison:
    """One quantity of all scenes. Columns, reference and tolerance are functions of a scene."""

    scenes: Scenes
    quantity: str
    reference: typing.Callable
    tolerance: typing.Callable
    columns: dict

    def measure(self, build):
        """Each scene with its comparison."""
        return [(scene, compared(str(scene), scene.mean(self.quantity), self.reference(scene), self.tolerance(scene)))
                for scene in self.scenes.run(build)]

    def tables(self, build):
        """The table of a page."""
        return {"table": self.table(self.measure(build))}

    def table(self, measured):
        rows = [[*(cell(scene) for cell in self.columns.values()), *one.cells()] for scene, one in measured]
        return table([*self.columns, *Compared.HEAD], rows)
