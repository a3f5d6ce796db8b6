"""Granular gases: steady states of driven spheres, and the temperatures of cooling rough ones."""

import math
import pathlib
import tempfile

from validation.common import (COLOURS, PARAMS, estimate, expect, properties_of_test, pyplot, save_figure, settings, summary_of, table,
                               text_of)
from validation.self_diffusion import SIGMA, contact_value, number_density

TITLE = "Granular gases"

# Driven spheres: van Noije & Ernst, Granular Matter 1, 57 (1998).
PARTICLES, PACKING_FRACTION = 4000, 0.02
KICKS = 0.01  # interval in mean free times
RELAXATION, APART, FRAMES = 60, 4, 150  # in mean free times; between frames; their number
MAX_TEMPERATURE_ERROR, MAX_CUMULANT_ERROR = 0.02, 0.003
DRIVEN = (0.8, 0.5)

# Cooling rough spheres: the tests of tests/physics/rough_gas_test.cpp, in the order of β.
ROUGH_TEST = "Beta/CoolingRoughSpheres.HaveTheRatioOfTemperaturesOfTheBoltzmannEquation"
ROUGH = (-0.5, 0, 0.5)


def collision_frequency():
    """Of one sphere at temperature 1, by Enskog."""
    return 4 * contact_value(PACKING_FRACTION) * number_density(PACKING_FRACTION) * SIGMA**2 * math.sqrt(math.pi)


def power_for_temperature_one(e, a2):
    """Of one sphere: what it loses in collisions at temperature 1."""
    return (1 - e**2) / 2 * collision_frequency() * (1 + 3 / 16 * a2)


def predicted_cumulant(e):
    d = 3
    return 16 * (1 - e) * (1 - 2 * e**2) / (73 + 56 * d - 24 * d * e - 105 * e + 30 * (1 - e) * e**2)


def driven(build, folder, e):
    """Temperature, a₂ and a histogram of squared speeds over 2 T, from all frames."""
    import h5py  # only here: a test imports all validations
    import numpy

    a2 = predicted_cumulant(e)
    free_time = 1 / collision_frequency()
    file = folder / f"driven_{e}.h5"
    summary = summary_of(build, "run", PARAMS / "driven_gas.toml", "-o", file, *settings([
        f"system.particles={PARTICLES}", f"system.packing_fraction={PACKING_FRACTION}",
        f"prepare.stage.0.packing_fraction={PACKING_FRACTION}", f"dynamics.restitution={e}",
        f"dynamics.driving.interval={KICKS * free_time}", f"dynamics.driving.power={power_for_temperature_one(e, a2)}",
        f"dynamics.equilibration={RELAXATION * free_time}", f"dynamics.duration={APART * FRAMES * free_time}",
        f"output.samples.interval={APART * free_time}"]))
    expect(summary["overlaps"] == 0, "overlaps")
    with h5py.File(file) as content:
        squares = (content["particles/all/velocity/value"][...] ** 2).sum(axis=2)
    temperatures = squares.mean(axis=1) / 3 * PARTICLES / (PARTICLES - 1)
    cumulants = (squares**2).mean(axis=1) / (15 * temperatures**2) - 1
    scaled = squares / (2 * temperatures[:, None])
    density, edges = numpy.histogram(scaled, bins=28, range=(0, 7))
    return {
        "e": e, "temperature": estimate(temperatures.tolist()),
        "a2": estimate(cumulants.tolist()), "predicted": a2,
        "collisions": 2 * summary["collisions"] / PARTICLES, "samples": squares.size,
        "histogram": (edges, density / squares.size),
    }


def check_driven(row):
    temperature, a2 = row["temperature"][0], row["a2"][0]
    expect(abs(temperature - 1) < MAX_TEMPERATURE_ERROR, f"e = {row['e']}: temperature {temperature}")
    expect(abs(a2 - row["predicted"]) < MAX_CUMULANT_ERROR, f"e = {row['e']}: a₂ {a2}")


def cooling(build):
    """The temperatures of both kinds of motion of params/rough_spheres.toml, by time."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "rough.h5")
        summary_of(build, "run", PARAMS / "rough_spheres.toml", "-o", file, "--set", "system.particles=10000")
        import h5py  # only here: a test imports all validations

        with h5py.File(file) as content:
            energies = content["observables"]
            time = energies["translational_energy/time"][...]
            return time, *(energies[f"{kind}_energy/value"][...] for kind in ("translational", "rotational"))


def maxwell(low, high):
    """The share of squared speeds over 2 T of a Maxwell distribution in this range."""
    def below(c):
        return math.erf(math.sqrt(c)) - 2 * math.sqrt(c / math.pi) * math.exp(-c)

    return below(high) - below(low)


def sonine(c):
    return c * c / 2 - 5 * c / 2 + 15 / 8


def draw(rows, temperatures, ratio):
    figure, (left, right) = pyplot().subplots(1, 2, figsize=(10, 4), layout="constrained")
    time, translation, rotation = temperatures
    left.loglog(time[1:], translation[1:], color=COLOURS[0], label="translation")
    left.loglog(time[1:], rotation[1:], color=COLOURS[1], label="rotation")
    left.loglog(time[1:], ratio * translation[1:], "--", color="black", linewidth=0.8, label=f"{ratio:.3f} × translation")
    left.set(title="Rough spheres that cool (e = 0.9, β = 0, no slip)", xlabel="time", ylabel="energy / kT")
    for k, row in enumerate(rows):
        edges, density = row["histogram"]
        middle = [(a + b) / 2 for a, b in zip(edges, edges[1:])]
        deviation = [d / maxwell(a, b) - 1 for d, a, b in zip(density, edges, edges[1:])]
        right.plot(middle, deviation, "o", markersize=4, color=COLOURS[k], label=f"e = {row['e']}")
        right.plot(middle, [row["predicted"] * sonine(c) for c in middle], color=COLOURS[k], linewidth=0.9)
    right.set(title="Driven spheres: speeds against a Maxwell distribution", xlabel="m v² / 2 kT", ylabel="relative deviation")
    for axes in (left, right):
        axes.title.set_fontsize("medium")
        axes.grid(alpha=0.25)
        axes.legend(frameon=False, fontsize="small")
    save_figure(figure, "figures", "granular_gases")


def measure(build):
    with tempfile.TemporaryDirectory() as folder:
        rows = [driven(build, pathlib.Path(folder), e) for e in DRIVEN]
    ratios = [{name: float(value) for name, value in properties_of_test(
        build / "tests/physics/test_physics", f"{ROUGH_TEST}/{k}").items() if name in ("measured", "boltzmann", "closed_form")}
        for k in range(len(ROUGH))]
    draw(rows, cooling(build), ratios[ROUGH.index(0)]["boltzmann"])
    for row in rows:
        check_driven(row)
    steady = table(["e", "T", "a₂", "a₂, van Noije & Ernst", "collisions of a sphere", "samples"], [
        [row["e"], text_of(*row["temperature"], 4), text_of(*row["a2"], 4), f"{row['predicted']:.4f}",
         f"{row['collisions']:.0f}", row["samples"]] for row in rows])
    cooled = table(["β", "measured", "Boltzmann equation", "Huthmann & Zippelius", "measured over Huthmann & Zippelius"], [
        [beta, *(f"{row[name]:.4f}" for name in ("measured", "boltzmann", "closed_form")),
         f"{row['measured'] / row['closed_form']:.3f}"] for beta, row in zip(ROUGH, ratios)])
    return f"""\
**Driven smooth spheres.** N = {PARTICLES}, φ = {PACKING_FRACTION}, kicks every {KICKS} mean free times, with the power that
makes the temperature 1 by van Noije and Ernst (Granular Matter 1, 57 (1998)) with Enskog's collision frequency. Required: T
within {MAX_TEMPERATURE_ERROR:.0%} of it, and the fourth cumulant a₂ of the velocities within {MAX_CUMULANT_ERROR} of theirs.
Errors are standard errors.

{steady}

**Cooling rough spheres** (e = 0.9, no slip, φ = 0.01): the ratio of the rotational to the translational temperature, before
clusters form. Beside the dynamics the Boltzmann equation itself, solved by direct simulation Monte Carlo, and the closed form
of Huthmann and Zippelius (Phys. Rev. E 56, R6275 (1997)), which takes both velocities as Gaussian. They are not, and the
closed form is too large by up to five per cent. Required (`tests/physics/rough_gas_test.cpp`): within 3 % of the Boltzmann equation.

{cooled}

![Both temperatures of cooling rough spheres, and the speeds of driven spheres](figures/granular_gases.svg)
"""
