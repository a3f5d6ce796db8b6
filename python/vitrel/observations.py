"""Observables written in Python."""

from typing import Callable, Dict, Mapping

import numpy

from . import _vitrel
from .arrays import real
from .results import Column, Results, Table
from .states import State


class Observations:
    """Evaluates functions of states, frame by frame.

    Parameters
    ----------
    functions : mapping of str to callable
        Each takes a State and returns a number or an array of one dimension, of the same length for every frame.
    """

    def __init__(self, functions: Mapping[str, Callable]):
        self._functions = dict(functions)
        self._values: Dict[str, Dict[float, numpy.ndarray]] = {name: {} for name in self._functions}

    def observe(self, state: State) -> None:
        """Adds the values of a frame."""
        for name, function in self._functions.items():
            value = real(f"observable '{name}'", function(state))
            if value.ndim > 1:
                raise _vitrel.UserError(f"observable '{name}' has {value.ndim} dimensions; a number or a list is possible")
            known = next(iter(self._values[name].values()), value)
            if value.shape != known.shape:
                raise _vitrel.UserError(f"observable '{name}' has {value.size} values at time {state.time:g}, but "
                                        f"{known.size} in other frames")
            self._values[name][state.time] = value

    def results(self, run) -> Results:
        """A table for each function, and in the summary means over all frames with errors by blocking.

        Frames that were not observed are read from the file of the run.
        """
        times = run.times
        for k, time in enumerate(times):
            if any(time not in values for values in self._values.values()):
                self.observe(run[k])
        summary, tables = {}, []
        for name, function in self._functions.items():
            rows = numpy.array([self._values[name][time] for time in times])
            columns = [Column("time", "time", times)]
            series = {name: rows} if rows.ndim == 1 else {f"{name}_{k}": rows[:, k] for k in range(rows.shape[1])}
            for key, values in series.items():
                columns.append(Column(key, "", values))
                summary[key], summary[f"{key}_error"] = _vitrel.average(times, numpy.ascontiguousarray(values))
            description = (function.__doc__ or name).strip().splitlines()[0]
            tables.append(Table(name, description, columns, run.dimension))
        return Results(summary, tables)
