"""Dynamics of soft spheres: exceptions, accuracy against computing time, cooling, collision rates, conservation."""

import functools
import math

from validation.common import article_sweep, commit_of, expect, measured, processor, pyplot, save_figure, table

TITLE = "Dynamics of soft spheres"
PROGRAM = "soft-spheres"
FIGURES = "figures/soft_spheres"

USUAL_MODULUS, DILUTE = 1e9, 1e-3
MAX_EXCEPTIONS = 2e-3  # at the usual modulus, dilute
DILUTE_LIMIT = 0.01  # the largest packing fraction at which exceptions are compared with theory
VANISHED = 2e-4  # at the lowest packing fraction and for the hardest particles
MAX_SIGMAS = 4
MIN_FACTOR = 100
MIN_SPEED = 0.4
LATE = 1.5  # decades of time
SLOPES = {"viscoelastic": -5 / 3, "linear_dashpot": -2}
SLOPE_ERROR = 0.03
MAX_DRIFT, MAX_ANGULAR_DRIFT = 1e-11, 1e-12

NAMES = {"viscoelastic": "viscoelastic", "linear_dashpot": "linear dashpot"}
EXCEPTIONS = {"early_releases": "early releases", "blocked_rotations": "blocked rotations"}
WAYS = {"tables": "event-driven, tables", "integration": "event-driven, integration",
        "classical": "classical rule", "force-based": "force-based", "clusterwise": "force-based, adaptive"}


# Exceptions

@functools.cache
def refused_after_hit(samples=1_000_000):
    """A particle moves with its partner, is hit by a third one at k, and is released. Returns the probability that the
    two then approach and that the rotation of their line of centres brings the particle closer to its former partner,
    at n. The average is over the velocities of a gas with kT = m = 1 and over all k not shadowed by the partner,
    weighted with the flux."""
    import numpy

    draw = numpy.random.default_rng(1)
    n = numpy.array([1.0, 0, 0])
    k = draw.normal(size=(samples, 3))
    k /= numpy.linalg.norm(k, axis=1, keepdims=True)
    k = k[k @ n < 0.5]
    third = math.sqrt(3 / 2) * draw.normal(size=k.shape)  # relative to the centre of mass of the pair
    apart = math.sqrt(2) * draw.normal(size=k.shape)  # velocity of the partner after contact, relative to the particle
    apart[:, 0] = math.sqrt(2) * draw.rayleigh(size=len(k))
    flux = numpy.maximum(0, -(third * k).sum(axis=1))
    relative = third + apart / 2
    along = (relative * k).sum(axis=1, keepdims=True)
    refused = (along[:, 0] < 0) & ((relative - along * k) @ n < 0)
    return float((flux * refused).sum() / flux.sum())


def expected_exceptions(packing_fraction, modulus):
    """Per collision, from the kinetic theory of a dilute gas of nearly hard particles."""
    radius, density, poisson, speed = 0.1, 1140, 0.4, 2
    mass = density * 4 * math.pi / 3 * radius**3
    stiffness = 2 * modulus * math.sqrt(radius / 2) / (3 * (1 - poisson**2)) / (mass / 2)
    contact = 3.2180654597 * stiffness**-0.4 * (math.sqrt(2) * speed) ** -0.2 * math.gamma(0.9)
    number_density = packing_fraction / (4 * math.pi / 3 * radius**3)
    free = 1 / (number_density * math.pi * (2 * radius) ** 2 * 4 * speed / math.sqrt(2 * math.pi))
    hit, in_the_way = 3 * math.sqrt(3) / 4, math.pi / 6 + math.sqrt(3) / 16
    return {"early_releases": hit * contact / free,
            "blocked_rotations": (in_the_way + refused_after_hit() * hit) * contact / free}


def measured_exceptions(build):
    """Per collision, against both quantities of the figure; they share the row of the usual modulus in the dilute gas."""
    rows = {}
    for quantity in ("density", "modulus"):
        for average in article_sweep(build, f"mueller_figure_7_{quantity}", parallel=2)["seeds"]:
            values, figures = average["values"], average["figures"]
            packing_fraction = values.get("system.packing_fraction", DILUTE)
            modulus = 1e9 * float(values.get("dynamics.contact.youngs_modulus", "1 GPa").removesuffix("GPa"))
            rows[packing_fraction, modulus] = {
                "packing_fraction": packing_fraction, "modulus": modulus, "seeds": average["seeds"],
                "particles": round(figures["particles"]["mean"]),
                "collisions": round(average["seeds"] * figures["collisions"]["mean"]),
                **{name: figures[f"{name}_per_collision"] for name in EXCEPTIONS}}
    return list(rows.values())


def exceptions_of(rows, key, fixed, value):
    return sorted((row for row in rows if row[fixed] == value), key=lambda row: row[key])


def check_exceptions(rows):
    for row in rows:
        where = f"η = {row['packing_fraction']:g}, Y = {row['modulus']:g} Pa"
        expected = expected_exceptions(row["packing_fraction"], row["modulus"])
        for name in EXCEPTIONS:
            found = row[name]["mean"]
            if row["packing_fraction"] <= DILUTE and row["modulus"] >= USUAL_MODULUS:
                expect(found <= MAX_EXCEPTIONS, f"{where}: {name} is {found}")
            if row["packing_fraction"] <= DILUTE_LIMIT:
                error = math.sqrt(expected[name] / row["collisions"])
                expect(abs(found - expected[name]) <= MAX_SIGMAS * error + 0.1 * expected[name],
                       f"{where}: {name} is {found}, expected {expected[name]}")
    for key, fixed, value, last in (("packing_fraction", "modulus", USUAL_MODULUS, 0),
                                    ("modulus", "packing_fraction", DILUTE, -1)):
        for name in EXCEPTIONS:
            found = exceptions_of(rows, key, fixed, value)[last][name]["mean"]
            expect(found <= VANISHED, f"at the end of {key}, {name} is {found}")


def draw_exceptions(rows):
    plots = pyplot()
    figure, panels = plots.subplots(1, 2, figsize=(9, 4), sharey=True)
    for axes, key, fixed, value, label, scale in (
            (panels[0], "packing_fraction", "modulus", USUAL_MODULUS, "packing fraction η at Y = 1 GPa", 1),
            (panels[1], "modulus", "packing_fraction", DILUTE, "Y (GPa) at η = 0.001", 1e-9)):
        chosen = exceptions_of(rows, key, fixed, value)
        x = [row[key] * scale for row in chosen]
        for (name, legend), colour, marker in zip(EXCEPTIONS.items(), ("C0", "C3"), "os"):
            axes.errorbar(x, [1e3 * row[name]["mean"] for row in chosen],
                          [1e3 * row[name]["error"] for row in chosen], fmt=marker, color=colour, capsize=3,
                          markersize=5, label=legend)
            axes.plot(x, [1e3 * expected_exceptions(row["packing_fraction"], row["modulus"])[name] for row in chosen],
                      "--", color=colour, linewidth=1)
        axes.set(xscale="log", yscale="log", xlabel=label)
        axes.axhline(1, color="gray", linewidth=0.8)
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("exceptions per 1000 collisions")
    panels[0].legend(frameon=False)
    figure.tight_layout()
    save_figure(figure, FIGURES, "exceptions")


def per_thousand(of):
    return f"{1e3 * of['mean']:.3f} ± {1e3 * of['error']:.3f}"


def exception_rows(rows):
    for row in sorted(rows, key=lambda row: (row["packing_fraction"], row["modulus"])):
        expected = expected_exceptions(row["packing_fraction"], row["modulus"])
        yield [f"{row['packing_fraction']:g}", f"{row['modulus'] / 1e9:g}", row["collisions"],
               *(cell for name in EXCEPTIONS for cell in (per_thousand(row[name]), f"{1e3 * expected[name]:.3f}"))]


# Accuracy and time

def ways_of(of, way):
    return [row for row in of["rows"] if row["way"] == way]


def draw_accuracy(of):
    plots = pyplot()
    figure, axes = plots.subplots(figsize=(6.4, 4.4))
    for (way, legend), marker, colour in zip(WAYS.items(), "osX^D", ("C2", "C0", "C3", "k", "gray")):
        rows = ways_of(of, way)
        x = [row["seconds"] / of["duration"] for row in rows]
        axes.plot(x, [row["median"] for row in rows], marker + "-", color=colour, label=legend)
        axes.plot(x, [row["ninth_decile"] for row in rows], marker + ":", color=colour, markerfacecolor="white")
        if way == "force-based":
            for time, row in zip(x, rows):
                axes.annotate(f"{row['steps_per_contact']:g}", (time, row["median"]), xytext=(5, 4),
                              textcoords="offset points")
    axes.set(xscale="log", yscale="log", xlabel="time per simulated second (s)", ylabel="error of positions (radii)")
    axes.margins(x=0.1)
    axes.legend(frameon=False, loc="lower right")
    axes.grid(alpha=0.3)
    figure.tight_layout()
    save_figure(figure, FIGURES, "accuracy")


def accuracy_rows(of):
    fastest = ways_of(of, "tables")[0]["seconds"]
    for row in of["rows"]:
        steps = f", {row['steps_per_contact']:g} steps per contact" if "steps_per_contact" in row else ""
        yield [WAYS[row["way"]] + steps, f"{row['seconds'] / of['duration']:.2g} s", f"{row['seconds'] / fastest:.3g}",
               f"{row['median']:.1e}", f"{row['ninth_decile']:.1e}", f"{row['largest']:.1e}"]


def check_accuracy(of):
    """Relative to tables: the time and the error of the finest force-based run, and the time of the adaptive one."""
    tables, = ways_of(of, "tables")
    finest, adaptive = ways_of(of, "force-based")[-1], ways_of(of, "clusterwise")[0]
    factor, inexact = finest["seconds"] / tables["seconds"], finest["median"] / tables["median"]
    expect(inexact >= 1, "a force-based run is more accurate than tables: there is none of equal accuracy")
    expect(factor >= MIN_FACTOR, f"the force-based run takes only {factor} times as long")
    expect(ways_of(of, "integration")[0]["median"] <= tables["median"] * 2, "integration is less accurate than tables")
    return factor, inexact, adaptive["seconds"] / tables["seconds"]


# Cooling

def mean_and_error(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) * (len(values) - 1)))


def late_slope(times, temperatures):
    """The slope of ln T against ln t, by least squares over the last decades."""
    points = [(math.log(t), math.log(value)) for t, value in zip(times, temperatures)
              if t >= times[-1] / 10**LATE]
    x0, y0 = (sum(values) / len(points) for values in zip(*points))
    return sum((x - x0) * (y - y0) for x, y in points) / sum((x - x0) ** 2 for x, _ in points)


def slope_of(of):
    slope, error = mean_and_error([late_slope(of["times"], run) for run in of["temperatures"]])
    wanted = SLOPES[of["force"]]
    expect(abs(slope - wanted) <= SLOPE_ERROR, f"{of['force']}: late slope {slope} ± {error}, by Haff's law {wanted}")
    return slope, error


def draw_cooling(cooling):
    plots = pyplot()
    figure, axes = plots.subplots(figsize=(6.4, 4.4))
    for of, colour, marker, law, shift in zip(cooling, ("C0", "C3"), "os", ("−5/3", "−2"), (4, 0.25)):
        times = of["times"]
        mean = [sum(values) / len(values) for values in zip(*of["temperatures"])]
        axes.plot(times, [value / mean[0] for value in mean], marker, color=colour, markersize=4,
                  label=NAMES[of["force"]])
        late = [(t, shift * mean[-1] / mean[0] * (t / times[-1]) ** SLOPES[of["force"]]) for t in times
                if t >= times[-1] / 10 ** (LATE + 1.5)]
        axes.plot(*zip(*late), "--", color=colour, linewidth=1.5, label=f"∝ t^({law})")
    axes.set(xscale="log", yscale="log", xlabel="t (s)", ylabel="T/T(0)")
    axes.legend(frameon=False)
    axes.grid(alpha=0.3)
    figure.tight_layout()
    save_figure(figure, FIGURES, "cooling")


def cooling_rows(cooling):
    laws = {"viscoelastic": "−5/3 = −1.6667", "linear_dashpot": "−2"}
    for of in cooling:
        slope, error = slope_of(of)
        yield [NAMES[of["force"]], f"{of['restitution']:.3f}", of["collisions"],
               f"{of['temperatures'][0][-1] / of['temperatures'][0][0]:.1e}", f"{slope:.4f} ± {error:.4f}",
               laws[of["force"]]]


# Speed

def speed_rows(rows):
    for row in rows:
        share = {way: row["hard"]["ns_per_collision"] / row[way]["ns_per_collision"] for way in ("tables", "integration")}
        expect(share["tables"] >= MIN_SPEED, f"η = {row['packing_fraction']}: only {share['tables']:.0%} with tables")
        yield [f"{row['packing_fraction']:g}", *(f"{1e6 / row[way]['ns_per_collision']:.3g}" for way in ("hard", *share)),
               *(f"{value:.0%}" for value in share.values()), f"{row['hard']['renewals']:.3g}"]


# Conservation

def drift(value):
    return f"{value:.0e}"


def counts(row):
    return [row["collisions"], row["blocked_rotations"], row["early_releases"]]


def gas_rows(gases):
    for row in gases:
        for key in ("momentum", "energy"):
            expect(row[key] <= MAX_DRIFT, f"{row['gas']}: {key} drifts by {row[key]}")
        yield [row["gas"], *counts(row), drift(row["momentum"]), drift(row["energy"])]


def cluster_rows(clusters):
    for row in clusters:
        expect(row["momentum"] <= MAX_DRIFT and row["energy"] <= MAX_DRIFT, f"clusters: {row}")
        if row["early_release"] == "together":
            expect(row["largest_angular_momentum"] <= MAX_ANGULAR_DRIFT, f"angular momentum is lost: {row}")
        lost = row["angular_momentum"]
        yield [row["early_release"], *counts(row), drift(row["momentum"]), drift(row["energy"]),
               f"{lost['mean']:.1e} ± {lost['error']:.0e}"]


# The page

def measure(build):
    exceptions = measured_exceptions(build)
    check_exceptions(exceptions)
    data = measured(PROGRAM, "release")
    accuracy, cooling = data["accuracy"], data["cooling"]
    factor, inexact, adaptive = check_accuracy(accuracy)
    draw_exceptions(exceptions)
    draw_accuracy(accuracy)
    draw_cooling(cooling)
    usual, = (row for row in exceptions if row["modulus"] == USUAL_MODULUS and row["packing_fraction"] == DILUTE)
    tables, = ways_of(accuracy, "tables")
    count_head = ["collisions", *reversed(EXCEPTIONS.values())]
    return f"""The spheres are those of figure 7 of Müller and Pöschel (2013): R = 0.1 m, 1140 kg/m³, ν = 0.4. Unless stated otherwise,
Y = 1 GPa, the thermal speed √(2kT/m) is 2 m/s, and the box is periodic. Times are CPU times on one core of
{processor()}, build {commit_of(data)}.

### Exceptions (figure 7)

`vitrel sweep` runs `params/articles/mueller_figure_7_density.toml` and `mueller_figure_7_modulus.toml`: {usual['particles']} elastic spheres
from a simple cubic crystal; means and standard errors over {usual['seeds']} seeds. An *early release* is a contact in which a third
particle hits one of the pair. A *blocked rotation* is a contact whose rotation a neighbour blocks. Dashed lines show
the kinetic theory of a dilute gas of nearly hard spheres, with the mean contact duration τ and the mean free time τ_f. A
third particle hits one of the pair in a fraction (3√3/4) τ/τ_f of the collisions; it blocks the rotation in a fraction
(π/6 + √3/16) τ/τ_f. In addition, after an early release the former partner can block the rotation of the released particle
with the third one. Random sampling of such encounters gives a fraction of {refused_after_hit():.3f} of the early releases. At Y = 1 GPa and
η = 0.001 there are {1e3 * usual['early_releases']['mean']:.2f} early releases and {1e3 * usual['blocked_rotations']['mean']:.2f} blocked rotations per 1000 collisions. Both vanish in the dilute limit and in
the hard limit.

![Exceptions against packing fraction and Young's modulus]({FIGURES}/exceptions.svg)

{table(["η", "Y (GPa)", "collisions", "early releases, ‰", "theory", "blocked rotations, ‰", "theory"], list(exception_rows(exceptions)))}

### Accuracy against computing time

{accuracy['particles']} spheres at η = 0.001 with A = 4·10⁻⁵ s (a head-on coefficient of restitution of {data['cooling'][0]['restitution']:.2f} at 2 m/s).
All runs start from the same state of the gas and last one mean free time, {accuracy['duration']:.1f} s; a contact lasts {1e3 * accuracy['contact']:.2f} ms. Errors are the
distances, in radii, from the positions of a reference solution, for the {tables['particles']} particles that have collided. Every earlier
collision in the history of a particle multiplies its error by a hundred or more. The reference solution integrates Newton's
equations cluster by cluster, with adaptive steps in the clusters and no steps in free flight
(`bench/baselines/clusterwise_run.h`). The last row uses ten times its tolerance, so its error bounds that of the reference
solution. The force-based runs use velocity Verlet steps with neighbour lists (`bench/baselines/force_based_run.h`). The
classical rule uses the coefficient of restitution of a head-on impact at the same normal speed.

{table(["method", "time per simulated second", "relative time", "median error", "ninth decile", "maximum"], list(accuracy_rows(accuracy)))}

The finest force-based run takes {factor:.0f} times as long as the event-driven run with tables, and its error is still {inexact:.0f} times as
large. Required: at least {MIN_FACTOR} times as long at equal accuracy. The adaptive run is not an ordinary force-based run, since it
skips free flight. It is as accurate as the event-driven run and takes {adaptive:.0f} times as long{"" if adaptive >= MIN_FACTOR else ", below the requirement"}.
Building the table once takes {accuracy['table']['seconds']:.2f} s; the table occupies {accuracy['table']['megabytes']:.2g} MB.

![Error against computing time. Filled symbols: median; open symbols: ninth decile; numbers: steps per contact]({FIGURES}/accuracy.svg)

### Cooling

Granular gases of {cooling[0]['particles']} spheres at η = {cooling[0]['packing_fraction']:g}, {len(cooling[0]['temperatures'])} runs each. At late times Haff's law gives T ∝ t^(−5/3) for
viscoelastic spheres, whose collisions become more elastic, and T ∝ t^(−2) for the linear dashpot, whose coefficient of
restitution is constant. The viscoelastic gas is the one above; the other has k = 10⁷ N/m and γ = 327 kg/s. The table lists
the slopes of ln T against ln t over the last {LATE:g} decades of time. Required: agreement within {SLOPE_ERROR:g}. Haff's law contains 1 − ε only
to first order in v^(1/5). The next order makes the slope of the viscoelastic gas steeper by an amount ∝ t^(−1/6), which
vanishes slowly.

{table(["force", "restitution at 2 m/s", "collisions", "T/T(0) at the end", "late slope", "Haff's law"], list(cooling_rows(cooling)))}

![Temperature against time]({FIGURES}/cooling.svg)

### Collisions per second

{data['speed'][0]['particles']} elastic spheres, compared with hard spheres in the same engine. Both start from the same state and run
alternately; the table lists the best repetition. Required: with tables, at least {MIN_SPEED:.0%} of the rate of hard spheres. In dilute
gases the renewal of neighbour lists dominates.

{table(["η", "hard, 10³/s", "tables, 10³/s", "integration, 10³/s", "tables/hard", "integration/hard", "renewals per collision"], list(speed_rows(data["speed"])))}

### Conservation

Gases of {accuracy['particles']} spheres at η = 0.01. Momentum is in units of the initial Σ m |v|. The energy includes the dissipated
energy.

{table(["gas", *count_head, "momentum", "energy"], list(gas_rows(data["conservation"]["gases"])))}

{data['conservation']['clusters'][0]['clusters']} hot clusters of {data['conservation']['clusters'][0]['particles']} elastic spheres at η = 0.3 expand into empty space. A particle that is hit during a
contact is released alone or together with its partner. The change of angular momentum is in units of the initial
Σ m |r × v|.

{table(["released", *count_head, "momentum", "energy", "angular momentum"], list(cluster_rows(data["conservation"]["clusters"])))}
"""
