"""Hard anisotropic particles, from the liquid to the glass.

A state is prepared from parameters, or made from arrays or a file; a run follows it; an analysis gives tables:

>>> import vitrel
>>> state = vitrel.prepare(aspect_ratio=2, particles=1000, packing_fraction=0.78, seed=1)
>>> run = vitrel.run(state, kind="brownian", duration=100, output="run.h5")
>>> run.analyze()["displacements_all"]["msd"]

Lengths are in units of √(a b) (in space ∛(a b c)) of a particle of size 1, times in √(m ℓ²/kT) of that length ℓ.
An unknown argument is a `TypeError`. Other mistakes raise `UserError`, files that cannot be read or written `FileError`,
overlaps in a hard run `InvariantError`.
"""

from ._vitrel import FileError, InvariantError, UserError, commit, version
from . import analysis, parameters, settings
from .pairs import Bodies, Contact, Gap, Restitution, first_contact, gap, overlap, restitution
from .parameters import *
from .results import Chart, Column, Results, Table
from .runs import Run, load, run
from .settings import from_toml, to_toml
from .states import State, prepare, read
from .sweeps import Sweep, load_sweep, sweep

__version__ = version
__all__ = [
    "Bodies", "Chart", "Column", "Contact", "FileError", "Gap", "InvariantError", "Restitution", "Results", "Run", "State",
    "Sweep", "Table", "UserError", "analysis", "commit", "first_contact", "from_toml", "gap", "load", "load_sweep", "overlap",
    "prepare", "read", "restitution", "run", "sweep", "to_toml", "version",
]
__all__ += parameters.__all__
