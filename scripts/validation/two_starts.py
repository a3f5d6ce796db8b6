"""Dense polydisperse liquids from two sides: compressed fast, and expanded from a denser state."""

import pathlib
import shutil
import statistics
import tempfile

from validation.common import INSERT, POWER_LAW, apart, expect, preparation, series_estimate, settings, summary_of, table

TITLE = "Equilibrium from two sides"

# Of each liquid the highest density of the study of the glass (docs/glass.md) and 0.01 above it.
LIQUIDS = {"disks": (1, (0.79, 0.80)), "ellipses, κ = 2": (2, (0.855, 0.865))}
PARTICLES = 1000
EXCESS = 0.008  # of the packing fraction of the state that is expanded
APART = 3  # decorrelations between samples
MIXING, SAMPLES = 12, 32  # samples that are discarded, and taken
MAX_ERROR, MAX_DISTANCE = 0.003, 4  # of Z, relative; of two estimates, in standard errors
MAX_HEXATIC = 0.3
NEIGHBOUR = 1.2  # circumcircles of this size overlap

STAGES = {
    "compressed": '[[prepare.stage]]\nmethod = "grow"\ngrowth_rate = 0.01',
    "dense": '[[prepare.stage]]\nmethod = "hybrid"\ncollective_exchanges = 4',
    "sampled": '[[prepare.stage]]\nmethod = "sample"\ncollective_exchanges = 4\ndecorrelations = %d' % APART,
}


def parameters(folder, name, kappa, *stages):
    """A parameter file of this liquid, always with the same particles: Z depends on the sizes that were drawn."""
    file = folder / f"{name}.toml"
    file.write_text(preparation(PARTICLES, kappa, (POWER_LAW,), "[prepare]\nquality_sweeps = 0", *stages), encoding="utf-8")
    return file


def prepared(build, file, phi, state, *changes):
    """The summary of the preparation of a state at this packing fraction."""
    return summary_of(build, "prepare", file, *settings([f"system.packing_fraction={phi}"]), *changes, "-o", state)


def expand(source, target, factor):
    """Copies a state with its box and positions enlarged by this factor."""
    import h5py  # only here: a test imports all validations

    shutil.copy(source, target)
    with h5py.File(target, "r+") as file:
        for name in ("position/value", "box/edges/value"):
            file[f"particles/all/{name}"][...] *= factor


def state_of(file):
    """Positions, sizes √(a b), longest semi-axes and box lengths."""
    import h5py
    import numpy

    with h5py.File(file) as content:
        particles = content["particles/all"]
        axes = particles["semiaxes"][...]
        return (particles["position/value"][-1][:, :2], numpy.sqrt(axes[:, 0] * axes[:, 1]), axes[:, 0],
                numpy.diagonal(particles["box/edges/value"][-1])[:2])


def structure(file):
    """S(q) in the main peak and at small q, the correlation of the sizes of neighbours, and the structure factor of the
    deviations of the sizes at the smallest wave numbers, where fractionation would show.
    """
    import numpy

    position, size, extent, box = state_of(file)
    n = len(size)
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


def samples(build, folder, liquid, state):
    """Each so many decorrelations after the one before."""
    folder = folder / state.stem
    folder.mkdir()
    kappa, phi = liquid
    file = parameters(folder, "sampled", kappa, STAGES["sampled"])
    found = []
    for k in range(MIXING + SAMPLES):
        following = folder / f"sample_{k}.h5"
        # The seed of every sample is its own.
        summary = prepared(build, file, phi, following, "--from", state, *settings([f"system.seed={1000 + k}"]))
        expect(summary["overlaps"] == 0, f"{following}: overlaps")
        stage = summary["stages"][-1]
        expect(stage["decorrelations"] == APART, f"{following}: not decorrelated")
        found.append({"Z": stage["reduced_pressure"], **structure(following),
                      "ψ₆": summary["quality"]["hexatic_order"]["global"], "sweeps": stage["sweeps"],
                      "seconds": stage["wall_seconds"]})
        if k > 0:
            state.unlink()
        state = following
    return found[MIXING:]


def from_below(build, folder, kappa, phi):
    state = folder / "compressed.h5"
    prepared(build, parameters(folder, "compressed", kappa, INSERT, STAGES["compressed"]), phi, state)
    return samples(build, folder, (kappa, phi), state)


def from_above(build, folder, kappa, phi):
    dense, state = folder / "dense.h5", folder / "expanded.h5"
    prepared(build, parameters(folder, "dense", kappa, INSERT, STAGES["dense"]), phi + EXCESS, dense)
    expand(dense, state, ((phi + EXCESS) / phi) ** 0.5)
    return samples(build, folder, (kappa, phi), state)


QUANTITIES = ("Z", "S(q), main peak", "S(q), small q", "sizes of neighbours", "S of sizes, smallest q", "ψ₆")


def estimates(found):
    return {name: series_estimate([sample[name] for sample in found]) for name in QUANTITIES}


def drift(found, name):
    """The second half against the first, in standard errors."""
    values = [sample[name] for sample in found]
    half = len(values) // 2
    _, error = series_estimate(values)
    return abs(statistics.mean(values[:half]) - statistics.mean(values[half:])) / (2 * error)


def compared(name, phi, below, above):
    """A row for each quantity, after the check."""
    one, other = estimates(below), estimates(above)
    rows = []
    for quantity in QUANTITIES:
        distance = apart(one[quantity], other[quantity])
        drifts = [drift(found, quantity) for found in (below, above)]
        rows.append([phi, quantity, *(f"{value:.4g} ± {error:.2g}" for value, error in (one[quantity], other[quantity])),
                     f"{distance:.1f}", " and ".join(f"{value:.1f}" for value in drifts)])
        expect(distance < MAX_DISTANCE, f"{name}, φ = {phi}: {quantity} differs: {one[quantity]}, {other[quantity]}")
        expect(max(drifts) < MAX_DISTANCE, f"{name}, φ = {phi}: {quantity} drifts")
    for found in (one, other):
        value, error = found["Z"]
        expect(error <= MAX_ERROR * value, f"{name}, φ = {phi}: the error of Z, {error:.3g}, is too large")
        expect(found["ψ₆"][0] < MAX_HEXATIC, f"{name}, φ = {phi}: hexatic order")
    return rows


def measure(build):
    text = []
    for name, (kappa, densities) in LIQUIDS.items():
        rows = []
        for phi in densities:
            with tempfile.TemporaryDirectory() as folder:
                folder = pathlib.Path(folder)
                below, above = (side(build, folder, kappa, phi) for side in (from_below, from_above))
            rows += compared(name, phi, below, above)
            sweeps = sum(sample["sweeps"] for sample in below + above) / (2 * SAMPLES * APART)
            seconds = sum(sample["seconds"] for sample in below + above) / (2 * SAMPLES * APART)
            print(f"{name}, φ = {phi}: {sweeps:.0f} sweeps, {seconds:.2g} s per decorrelation", flush=True)
        text.append(f"### {name[0].upper() + name[1:]}\n\n" + table(
            ["φ", "quantity", "compressed fast", "expanded", "apart / standard errors", "drift / standard errors"], rows))
    return f"""\
N = {PARTICLES} particles with sizes σ distributed as σ⁻³ (23 %), at the highest density of the [study of the glass](glass.md)
and 0.01 above it. One state is compressed from random places at φ = 0.3 by growth at the rate 0.01, the other one expanded
from a state that is {EXCESS} denser, prepared by growth that alternates with event chains and collective exchanges. Then
both are sampled by event chains with four steps of collective exchanges per particle and sweep: everything is measured {SAMPLES}
times, {APART} decorrelations of places, orientations and sizes apart (`decorrelations` of the stage `sample`), after {MIXING * APART} of them. Z is that of
the chains, between two samples. Errors take the correlation of the samples into account. Required: Z to {MAX_ERROR:.1%}; all quantities of both starts, and of both halves of
each, within {MAX_DISTANCE} standard errors; ψ₆ below {MAX_HEXATIC}. *Sizes of neighbours*: Σ δ_i δ_j over neighbours, per particle, δ the
deviation of the size from the mean in standard deviations. *S of sizes*: ⟨|Σ δ_j exp(iq·r_j)|²⟩/N at the smallest wave
numbers; a liquid that separates by size would show large and growing values there.

""" + "\n\n".join(text)
