"""The observables of `vitrel analyze` for states and arrays in memory.

>>> vitrel.analysis.structure_factor(states, structure__wave_number_max=20).plot()
>>> vitrel.analysis.msd(positions, times, box=[30, 30])["msd"].value

States are in the order of time, and of the same particles. Keyword arguments are keys of `[analysis]`.
"""

import json
import pathlib
import tempfile
from typing import Iterable, Optional, Unpack

import numpy

from . import _vitrel
from .arrays import real
from .results import Results, Table, tables_of
from .settings import AnalysisSettings, assignments
from .states import State


def analyze(states: Iterable[State], **settings: Unpack[AnalysisSettings]) -> Results:
    """All tables that the states have what they need for; `only="structure_factor,order"` chooses some."""
    return _analyze(states, True, settings)


def _analyze(states, velocities, settings) -> Results:
    states = [states] if isinstance(states, State) else list(states)
    if not states:
        raise _vitrel.UserError("there are no states")
    for state in states:
        if not isinstance(state, State):
            raise _vitrel.UserError(f"states must be objects of vitrel.State, not {type(state).__name__}")
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "states.h5")
        _vitrel.write_run(file, [state._state for state in states], velocities)
        with assignments(analyze, settings) as lines:
            text, columns, provenance = _vitrel.analyze(file, lines)
    return Results(json.loads(text), tables_of(columns, states[0].dimension), provenance)


def _table(states, name, settings) -> Table:
    results = _analyze(states, False, dict(only=name, **settings))
    return results[name if name in results else f"{name}_all"]


def structure_factor(states, **settings: Unpack[AnalysisSettings]) -> Table:
    """S(q), its parts of species, and that of the orientations, averaged over the states."""
    return _table(states, "structure_factor", settings)


def pair_correlation(states, **settings: Unpack[AnalysisSettings]) -> Table:
    """g(r), its parts of species, and the orientational correlation g₂(r) or its like in space."""
    return _table(states, "pair_correlation", settings)


def order(states, **settings: Unpack[AnalysisSettings]) -> Table:
    """Nematic and, in the plane, hexatic order, a row for each state."""
    return _table(states, "order", settings)


def displacements(states, **settings: Unpack[AnalysisSettings]) -> Table:
    """Mean squared displacements and rotations of all particles, with errors."""
    return _table(states, "displacements", settings)


def self_scattering(states, **settings: Unpack[AnalysisSettings]) -> Table:
    """F_s(q, t) at `wave_numbers`."""
    return _table(states, "self_scattering", settings)


def msd(positions, times, box: Optional[Iterable[float]] = None, *, angle=None, semi_axes=None,
        **settings: Unpack[AnalysisSettings]) -> Table:
    """The mean squared displacement of points, or of bodies and their rotation, from arrays.

    Parameters
    ----------
    positions : array_like, shape (T, N, D)
        Unwrapped; in a periodic box they may be anywhere if no point moves by half a side between two times.
    times : array_like, shape (T,)
    box : array_like, shape (D,), optional
        Without one, positions are unwrapped.
    angle : array_like, shape (T, N), optional
        Of bodies in the plane with these `semi_axes`, shape (2,) or (N, 2).
    """
    positions, times = real("positions", positions), real("times", times)
    if positions.ndim != 3 or times.shape != positions.shape[:1]:
        raise _vitrel.UserError(f"positions have the shape {positions.shape} and times {times.shape}, but must have (T, N, D) "
                                "and (T,)")
    if box is None:
        if not positions.size:
            raise _vitrel.UserError(f"positions are empty: their shape is {positions.shape}")
        box = 2 * numpy.ptp(positions, axis=(0, 1)) + 1
        positions = positions - positions.mean(axis=(0, 1))
    else:
        steps = numpy.diff(positions, axis=0)
        positions = positions[0] + numpy.concatenate(
            [numpy.zeros_like(positions[:1]), numpy.cumsum(steps - numpy.rint(steps / box) * box, axis=0)])
    point = 1e-3 * numpy.min(box) / positions.shape[1]
    shape = point if semi_axes is None else semi_axes
    return displacements([State.from_arrays(place, shape, box, time=time, angle=None if angle is None else angle[k])
                          for k, (place, time) in enumerate(zip(positions, times))], **settings)
