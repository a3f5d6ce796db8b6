"""A study with types, for mypy --strict: it also complains of a comment that excuses a mistake which is none."""

from typing import Any, List

import vitrel

STAGES: List[Any] = [vitrel.Insert(packing_fraction=0.3), vitrel.Grow(growth_rate=1e-2)]


def study(folder: str) -> vitrel.Results:
    """Prepares, runs and analyses a mixture."""
    state: vitrel.State = vitrel.prepare(
        particles=100, packing_fraction=0.5, seed=1, quality_sweeps=0, stage=STAGES, dynamics={"duration": 10},
        species=[vitrel.Species(name="A", fraction=0.5, aspect_ratio=2), {"name": "B", "fraction": 0.5, "aspect_ratio": 1}])
    run: vitrel.Run = vitrel.run(
        state, output=folder + "/run.h5", kind="brownian", duration=10, samples=vitrel.Linear(interval=0.5),
        restitution=vitrel.Viscoelastic(value=0.9), velocities=False)
    return run.analyze(longest_lag=0.25, structure=vitrel.Structure(frames=10))


def mistakes() -> None:
    """What mypy refuses."""
    vitrel.prepare(particle=100)  # type: ignore[call-arg]
    vitrel.prepare(particles="many")  # type: ignore[arg-type]
    vitrel.run(output="run.h5", kind="brownien")  # type: ignore[arg-type]
    vitrel.load("run.gsd", unwrap=True)  # type: ignore[arg-type]
    vitrel.Grow(rate=1e-3)  # type: ignore[call-arg]
    vitrel.Species(size=vitrel.Insert())  # type: ignore[arg-type]
