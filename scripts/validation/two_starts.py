"""N = 1000 particles with sizes σ distributed as σ⁻³ (23 %), a little above the highest density of the
[study of the glass](glass.md). One state is compressed from random places at φ = 0.3 by growth at the rate 0.01,
the other one expanded from a state that is {EXCESS} denser, prepared by growth that alternates with event chains and
collective exchanges. Then both are sampled by event chains with four steps of collective exchanges per particle and
sweep: everything is measured {SAMPLES} times, {APART} decorrelations of places, orientations and sizes apart
(`decorrelations` of the stage `sample`), after as many as {MIXING} samples. Z is that of the chains, between two
samples. Errors take the correlation of the samples into account. Required: Z to {LARGEST_ERROR:.1%}; all quantities of
both starts, and of both halves of each, within {ERRORS} standard errors; ψ₆ below {LARGEST_HEXATIC}. *Sizes of
neighbours*: Σ δ_i δ_j over neighbours, per particle, δ the deviation of the size from the mean in standard deviations.
*S of sizes*: ⟨|Σ δ_j exp(iq·r_j)|²⟩/N at the smallest wave numbers; a liquid that separates by size would show large
and growing values there.

{table}
"""

import pathlib
import shutil
import tempfile

from validation.common import Estimate, estimate, expect, series_estimate, settings, summary_of, table
from validation.comparison import SCENES, Compared, Tolerance, compared, toml

TITLE = "Equilibrium from two sides"
INPUTS = ["mc", "core", "edmd", "workflow/stages"]

# The highest density of each liquid in the study of the glass (docs/glass.md) and 0.01 above it.
LIQUIDS = {"disks": (1, (0.79, 0.80)), "ellipses, κ = 2": (2, (0.855, 0.865))}
EXCESS = 0.008  # of the packing fraction of the state that is expanded
APART = 3  # decorrelations between samples
MIXING, SAMPLES = 12, 32  # samples that are discarded, and taken
ERRORS, LARGEST_ERROR = 4, 0.003  # of two estimates; of Z, relative
LARGEST_HEXATIC = 0.3
NEIGHBOUR = 1.2  # circumcircles of this size overlap

INSERT = {"method": "insert", "packing_fraction": 0.3}
COMPRESSED = [INSERT, {"method": "grow", "growth_rate": 0.01}]
DENSE = [INSERT, {"method": "hybrid", "collective_exchanges": 4}]
SAMPLED = [{"method": "sample", "collective_exchanges": 4, "decorrelations": APART}]


class Liquid:
    """One density of a liquid, with its files in a folder."""

    def __init__(self, build, folder, kappa, phi):
        self.build, self.folder, self.kappa, self.phi = build, folder, kappa, phi

    def prepared(self, name, stages, *, phi=None, start=None, seed=1):
        """The file and the summary of a state after these stages."""
        state = self.folder / f"{name}.h5"
        changes = settings([f"species.0.aspect_ratio={self.kappa}", f"system.packing_fraction={phi or self.phi}",
                            f"system.seed={seed}", f"prepare.stage={toml(stages)}"])
        beginning = ["--from", start] if start else []
        return state, summary_of(self.build, "prepare", SCENES / "dense_liquid.toml", *changes, *beginning, "-o", state)

    def from_below(self):
        return self.samples(self.prepared("compressed", COMPRESSED)[0])

    def from_above(self):
        dense, _ = self.prepared("dense", DENSE, phi=self.phi + EXCESS)
        expanded = self.folder / "expanded.h5"
        expand(dense, expanded, ((self.phi + EXCESS) / self.phi) ** 0.5)
        return self.samples(expanded)

    def samples(self, state):
        """Each so many decorrelations after the one before, by quantity."""
        found, start = [], state.stem
        for k in range(MIXING + SAMPLES):
            before = state
            state, summary = self.prepared(f"{start}-{k}", SAMPLED, start=before, seed=1000 + k)
            before.unlink()
            stage = summary["stages"][-1]
            expect(summary["overlaps"] == 0, f"{state}: overlaps")
            expect(stage["decorrelations"] == APART, f"{state}: not decorrelated")
            found.append({"Z": stage["reduced_pressure"], **structure(state),
                          "ψ₆": summary["quality"]["hexatic_order"]["global"]})
        return {name: [sample[name] for sample in found[MIXING:]] for name in found[0]}


def expand(source, target, factor):
    """Copies a state with its box and positions enlarged by this factor."""
    import h5py  # only here: a test imports all validations

    shutil.copy(source, target)
    with h5py.File(target, "r+") as file:
        for name in ("position/value", "box/edges/value"):
            file[f"particles/all/{name}"][...] *= factor


def structure(file):
    """S(q) in the main peak and at small q, the correlation of the sizes of neighbours, and the structure factor of the
    deviations of the sizes at the smallest wave numbers, where fractionation would show.
    """
    import h5py
    import numpy

    with h5py.File(file) as content:
        particles = content["particles/all"]
        position, axes = particles["position/value"][-1][:, :2], particles["semiaxes"][...]
        box = numpy.diagonal(particles["box/edges/value"][-1])[:2]
    n, size, extent = len(axes), numpy.sqrt(axes[:, 0] * axes[:, 1]), axes[:, 0]
    deviation = (size - size.mean()) / size.std()
    waves = numpy.array([(i, j) for i in range(-40, 41) for j in range(41) if j > 0 or i > 0]) * 2 * numpy.pi / box
    length = numpy.hypot(*waves.T)
    peak = 2 * numpy.pi * numpy.sqrt(2 * n / numpy.prod(box) / numpy.sqrt(3))
    smallest = 2 * numpy.pi / box.max()

    def mean_square(of, chosen):
        amplitude = numpy.exp(1j * waves[chosen] @ position.T) @ of
        return float(numpy.mean(numpy.abs(amplitude) ** 2) / n)

    ones = numpy.ones(n)
    separation = position[:, None] - position[None]
    separation -= box * numpy.round(separation / box)
    near = numpy.hypot(separation[..., 0], separation[..., 1]) < NEIGHBOUR * (extent[:, None] + extent[None])
    numpy.fill_diagonal(near, False)
    return {
        "S(q), main peak": mean_square(ones, abs(length / peak - 1) < 0.03),
        "S(q), small q": mean_square(ones, (length > 2 * smallest) & (length < 5 * smallest)),
        "sizes of neighbours": float((near * numpy.outer(deviation, deviation)).sum() / n),
        "S of sizes, smallest q": mean_square(deviation, length < 2.1 * smallest),
    }


def drift(name, values):
    """The second half against the first, in standard errors; of each half that is √2 times that of the series."""
    half, error = len(values) // 2, 2**0.5 * series_estimate(values).error
    halves = (Estimate(estimate(part).mean, error) for part in (values[:half], values[half:]))
    return compared(f"{name}: both halves", *halves, Tolerance(ERRORS)).cells()[-1]


def rows(name, below, above):
    """A row for each quantity, after the check."""
    for quantity in below:
        sides = [series_estimate(values[quantity]) for values in (below, above)]
        drifts = " and ".join(drift(f"{name}: {quantity}", values[quantity]) for values in (below, above))
        tolerance = Tolerance(ERRORS, largest_error=LARGEST_ERROR if quantity == "Z" else None)
        yield [name, quantity, *compared(f"{name}: {quantity}", *sides, tolerance).cells(), drifts]
    hexatic = max(series_estimate(values["ψ₆"]).mean for values in (below, above))
    expect(hexatic < LARGEST_HEXATIC, f"{name}: hexatic order {hexatic}")


def measure(build):
    found = []
    for name, (kappa, densities) in LIQUIDS.items():
        for phi in densities:
            with tempfile.TemporaryDirectory() as folder:
                liquid = Liquid(build, pathlib.Path(folder), kappa, phi)
                found += rows(f"{name}, φ = {phi}", liquid.from_below(), liquid.from_above())
    head = ["liquid", "quantity", "expanded", "compressed fast", *Compared.HEAD[2:], "drift in standard errors"]
    return {"table": table(head, found)}
