"""The speed of the engine: rewrites bench/engine.md and its figure."""

import datetime
import math

from validation.common import (ROOT, clock_rate, commit_of, expect, measured, millions, processor, rows_by, shape,
                               table)

TITLE = "Speed of the engine"
PROGRAM = "engine"
PAGE = ROOT / "bench" / "engine.md"
FIGURE = ROOT / "bench" / "engine.svg"

# (κ, φ): collisions per second on one core of such a machine: the goal, and the best public program.
GOALS = {(1, 0.5): (2.4e6, 2.17e6), (1, 0.7): (3.4e6, 3.11e6), (2, 0.5): (5e5, 4.6e3), (2, 0.7): (5e5, 3.2e3),
         (6, 0.5): (3e5, 2.9e3), (6, 0.7): (3e5, 2.4e3)}
# Cost of a collision, relative to N = 1000.
LARGEST_RATIO = {100_000: 1.6, 1_000_000: 2.5}
REFERENCE_SIZE = 1000

# The fastest public code for spheres, measured beside vitrel: million collisions a second of whole processes.
PUBLIC_CODE = """## Against the fastest public code

Smallenburg's event-driven code for spheres (Eur. Phys. J. E 45, 22 (2022), variant Single, confined to a plane for disks)
on the same machine in the same hour, 2026-11-24: whole processes on one core in alternation, the same states, 2·10⁷
collisions, medians of one to three pairs, in millions of collisions per second. vitrel: `vitrel run` as a user builds it, with its
default output. The public code: `-Ofast -march=native`, without thermostat, with the best of several shells.

| | φ | N | vitrel | public code | ratio | before |
| --- | --- | --- | --- | --- | --- | --- |
| disks | 0.5 | 4096 | 1.97 | 1.60 | **1.23** | 0.63 |
| disks | 0.7 | 4096 | 2.73 | 2.28 | **1.19** | 0.60 |
| spheres | 0.30 | 10976 | 0.62 | 0.47 | **1.30** | 0.56 |
| spheres | 0.49 | 10976 | 1.18 | 0.84 | **1.40** | 0.60 |

Geometric mean 1.28. *Before*: the ratio at commit 03c5278, portable build and a frame every 0.1. What made the
difference: contacts of round bodies stay known when a particle leaves its neighbourhood, so that only new neighbours are
predicted; the cell list has positions inside its cells and passes over what the old list contains; records of four
partners are transposed in registers; blocks have 128 events per particle; frames are written without compression.

Tried without gain: other mean numbers of neighbours (7 and 14 are flat optima), one or four particles per cell of that
list, a single pass for the neighbours that stay and the new ones, wider lists in gases.

Ellipses and ellipsoids against commit 85cea2f, in alternation, both native (2026-11-23; the best of five, in millions of
collisions per second):

| | φ | N | before | now | ratio |
| --- | --- | --- | --- | --- | --- |
| κ = 2 | 0.5 | 1024 | 0.516 | 0.648 | **1.25** |
| κ = 2 | 0.7 | 1024 | 0.728 | 0.941 | **1.29** |
| κ = 6 | 0.5 | 1024 | 0.467 | 0.600 | **1.29** |
| κ = 6 | 0.7 | 1024 | 0.653 | 0.865 | **1.32** |
| spheroids of 2 | 0.5 | 1000 | 0.154 | 0.224 | **1.45** |
| rods of 10 | 0.2 | 1000 | 0.045 | 0.063 | **1.39** |

What made the difference: ellipses are screened eight at a time; a search begins at the lower bound that the screen has
found; a new neighbourhood is centred ahead of its particle; clocks are reset within a block instead of ending it, which
for rods was a quarter of the time; records are prefetched. Tried without gain: one division for two reciprocals of the
screen; neighbours dropped by the gap along the axis of the last screen (longer lists); a renewal before a prediction
that it would soon follow; the contact from the Newton step before the last evaluation; the search in the same
translation unit; GCC with AVX-512 is 4 % faster, but miscompiles (cmake/options.cmake).
"""

PROGRAMS = {"vitrel": "vitrel", "all_pairs": "all pairs, collision times of vitrel",
            "all_pairs_slsqp": "all pairs, SLSQP (the thesis)"}
DEVICES = {
    "disks": ("disks as disks", "disks as ellipses with κ = 1"),
    "constant_size": ("ellipses of constant size", "ellipses growing at the rate 0"),
    "contact_screen": ("contact screen of all neighbours, then searches", "every pair searched"),
    "horizon": ("predictions up to the partner's next event", "up to the particle's own next event only"),
    "shaped_lists": ("neighbour lists shaped like the particles", "neighbour lists shaped like the circumcircles"),
}


def rate(row):
    return 1e9 / row["ns_per_collision"]


def seconds_text(seconds):
    for unit in ("s", "ms", "µs"):
        if seconds >= 1:
            break
        seconds *= 1000
    return f"{float(f'{seconds:.2g}'):g} {unit}"


def speed(native, portable):
    portable_rows = rows_by(portable["speed"], "aspect_ratio", "packing_fraction")
    lines = []
    for row in native["speed"]:
        scene = row["aspect_ratio"], row["packing_fraction"]
        goal, public = GOALS[scene]
        reached = "reached" if rate(row) >= goal else "**not reached**"
        lines.append([shape(scene[0]), scene[1], row["particles"], f"**{millions(rate(row))}**",
                      millions(1e9 / row["median_ns_per_collision"]), millions(rate(portable_rows[scene])),
                      f"{millions(goal)}, {reached}", millions(public), f"{rate(row) / public:.3g}",
                      f"{row['reduced_pressure']:.2f}"])
    return table(["", "φ", "N", "millions per second", "median", "portable build", "goal", "best public program",
                  "times as fast", "βP/ρ"], lines)


def count_cells(row):
    return [f"{row[key]:.2f}" for key in ("events", "predictions", "searches", "steps", "renewals")]


COUNTS = ["events", "predictions", "searches", "steps", "renewals"]


def counts(native):
    lines = [[shape(row["aspect_ratio"]), row["packing_fraction"], f"{row['ns_per_collision']:.0f} ns",
              f"{row['ns_per_collision'] / native['ns_per_psi']:.1f}", *count_cells(row)] for row in native["speed"]]
    return table(["", "φ", "per collision", "in Ψ", *COUNTS], lines)


def cost_ratio(sizes, row):
    """Relative to the same shape at N = 1000, or at the smallest N present."""
    same = [of for of in sizes if of["aspect_ratio"] == row["aspect_ratio"]]
    reference = next((of for of in same if of["particles"] == REFERENCE_SIZE), same[0])
    return row["ns_per_collision"] / reference["ns_per_collision"]


def check_sizes(sizes):
    for row in sizes:
        most, ratio = LARGEST_RATIO.get(row["particles"], math.inf), cost_ratio(sizes, row)
        expect(ratio <= most, f"{shape(row['aspect_ratio'])}, N = {row['particles']}: a collision costs {ratio:.2f} "
                              f"times as much as at N = {REFERENCE_SIZE}; the limit is {most}")


def sizes_table(sizes):
    lines = []
    for row in sizes:
        ratio, most = cost_ratio(sizes, row), LARGEST_RATIO.get(row["particles"])
        wanted = "–" if most is None else f"≤ {most}" + ", **missed**" * (ratio > most)
        peak = row.get("peak_bytes_per_particle")
        lines.append([shape(row["aspect_ratio"]), row["particles"], f"{row['ns_per_collision']:.0f} ns",
                      f"{ratio:.2f}", wanted,
                      f"{row['bytes_per_particle']:.0f}", f"{peak:.0f}" if peak else "–"])
    return table(["", "N", "per collision", "relative to the smallest N", "required", "bytes per particle",
                  "peak bytes per particle at the start of a block"], lines)


def charted(rows):
    """(N, seconds per unit of simulated time) of each program; the collision rate is always that of the engine."""
    rates = {row["particles"]: row["collision_rate"] for row in rows if row["program"] == "vitrel"}
    return {program: [(row["particles"], 1e-9 * row["ns_per_collision"] * rates[row["particles"]])
                      for row in rows if row["program"] == program] for program in PROGRAMS}


def draw(rows, file):
    import matplotlib  # only here: a test imports all validations

    matplotlib.use("svg")
    from matplotlib import pyplot

    matplotlib.rcParams.update({"svg.hashsalt": "vitrel", "svg.fonttype": "none", "font.size": 11})
    figure, axes = pyplot.subplots(figsize=(7, 4.6))
    for (program, points), marker in zip(charted(rows).items(), "os^"):
        axes.loglog(*zip(*points), marker + "-", label=PROGRAMS[program])
    axes.set(xlabel="particles N", ylabel="seconds per unit of simulated time")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    figure.tight_layout()
    figure.savefig(file, metadata={"Date": None})
    pyplot.close(figure)


def all_pairs(rows):
    points = {program: dict(of) for program, of in charted(rows).items()}

    def cells(n):
        ours = points["vitrel"][n]
        for program in PROGRAMS:
            other = points[program].get(n)
            yield "–" if other is None else seconds_text(other)
            if program != "vitrel":
                yield "–" if other is None else f"{float(f'{other / ours:.2g}'):g}"

    return table(["N", "vitrel", PROGRAMS["all_pairs"], "relative to vitrel", PROGRAMS["all_pairs_slsqp"], "relative to vitrel"],
                 [[n, *cells(n)] for n in points["vitrel"]])


def brownian(rows):
    found = rows_by(rows, "brownian_step", "threads")
    lines = []
    for step in sorted({row["brownian_step"] for row in rows}):
        one, two = found[step, 1], found[step, 2]
        lines.append([step, f"{one['time_per_second']:.3g}", f"{two['time_per_second']:.3g}",
                      f"{two['time_per_second'] / one['time_per_second']:.2f}", f"{one['collisions_per_step']:.0f}",
                      f"{one['predictions_per_step']:.0f}"])
    return table(["τ_B", "one thread", "two threads", "gain", "collisions per step", "predictions per step"], lines)


def gases(rows):
    lines = []
    for row in rows:
        ratio = row["lists"]["ns_per_collision"] / row["cells"]["ns_per_collision"]
        lines.append(["disks" if row["dimension"] == 2 else "spheres", row["particles"], row["packing_fraction"],
                      *(f"{row[of]['ns_per_collision']:.0f} ns" for of in ("lists", "cells")), f"**{ratio:.2f}**",
                      *(f"{row['lists'][key]:.1f} / {row['cells'][key]:.1f}" for key in ("events", "predictions")),
                      row["chosen"]])
    return table(["", "N", "φ", "lists", "cells", "gain", "events", "predictions", "chosen"], lines)


def device_gain(row):
    return row["without"]["ns_per_collision"] / row["with"]["ns_per_collision"]


def devices(rows):
    lines = []
    for row in rows:
        ours, other = DEVICES[row["device"]]
        lines.append([ours, other, f"{shape(row['aspect_ratio'])}, φ = {row['packing_fraction']}",
                      f"{row['with']['ns_per_collision']:.0f} ns", f"{row['without']['ns_per_collision']:.0f} ns",
                      f"**{device_gain(row):.2f}**",
                      *(f"{row['with'][key]:.2f} / {row['without'][key]:.2f}" for key in COUNTS)])
    return table(["the engine", "instead", "scene", "with", "without", "gain", *COUNTS], lines)


def neighbors(rows):
    lines = [[shape(row["aspect_ratio"]), row["packing_fraction"], f"{row['neighbors']['margin']:.2f}",
              f"{row['neighbors']['shaped']:.1f}", f"{row['neighbors']['round']:.1f}"]
             for row in rows if "neighbors" in row]
    return table(["", "φ", "margin", "neighbours, shaped", "neighbours, round"], lines)


def lazy(rows):
    lines = []
    for row in rows:
        scene, eager = shape(row["aspect_ratio"]), row["eager"]
        for of in (eager, *row["lazy"]):
            name = f"{of['search_window']:g}" if "search_window" in of else "searched immediately"
            lines.append([scene, name, f"{of['ns_per_collision']:.0f} ns",
                          f"{eager['ns_per_collision'] / of['ns_per_collision']:.2f}", *count_cells(of)])
    return table(["", "postponed beyond", "per collision", "gain", *COUNTS], lines)


def page(native, portable):
    psi = " and ".join(f"{native[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    return f"""# How fast is the engine?

    scripts/validate engine                       # builds, measures and writes this page
    build/release/bench/vitrel-bench engine speed sizes   # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(native)}, {processor()}{clock_rate()}, {native["compiler"]}, `{native["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run). The portable build: `{portable["flags"]}`, {portable["ns_per_psi"]:.1f} ns per Ψ.

Times are CPU times on one core, the best of five measurements. Each measurement lasts at least a second and consists of
complete blocks, including their start and end. Every state is a liquid: particles are inserted with random positions and
orientations at φ = 0.2, swollen, and equilibrated by 500 Monte Carlo sweeps and a second of the run itself. Counts are per
collision: *events* taken from the calendar, *predictions* (pairs tested), *searches* (pairs that the contact screen leaves
undecided), *steps* along separating axes, *renewals* of neighbour lists.

## Collisions per second

Newtonian dynamics, in millions of collisions per second. The best public programs were measured on a similar machine
(EPYC, `-O3 -march=native`, double precision). For disks this is Smallenburg's code of 2022, confined to a plane. For
ellipses it is a generic code with the algorithm of Gilbert, Johnson and Keerthi, which permits overlaps.

{speed(native, portable)}

{counts(native)}

{PUBLIC_CODE}
## Scaling with the number of particles

φ = 0.5. The initial state consists of copies of an equilibrated liquid of 1000 particles. Every copy has different
velocities, and the particles are numbered at random. After about five collisions per particle come five measurements, or
as many as begin within twenty seconds.

{sizes_table(native["sizes"])}

## Comparison with the program of the thesis

The same scene (κ = 2, φ = 0.5) without event calendar, neighbour lists and cells. After every event these programs predict
the collisions of all pairs again, as in the thesis, either with its method or with vitrel's. The table lists the time per
unit of simulated time. The slow programs run for 2000 collisions or eight seconds per point, as far as memory permits
(88 bytes per pair).

![Time per unit of simulated time against the number of particles]({FIGURE.name})

{all_pairs(native["all_pairs"])}

## Brownian dynamics

κ = 6, φ = 0.72, N = {native["brownian"][0]["particles"]}: simulated time per second. After every τ_B the engine draws all velocities and
predicts the collisions of all neighbouring pairs, on one or two threads. Results do not depend on the number of threads.

{brownian(native["brownian"])}

## Gases

Disks and spheres have neighbour lists or cells without lists ([cell_neighbors.h](../core/neighbors/cell_neighbors.h)). In a
gas, lists are renewed many times between two collisions; in a liquid they spare predictions. The engine chooses by the
number of particles in a cell of the least width, with a lower limit for systems that exceed the caches. Particles are
inserted at random; both run alternately in the same process. Counts: with lists / with cells, per collision.

{gases(native["gases"])}

## Speed-up by each specialisation and optimisation

Each row compares the engine with a variant in which one optimisation is replaced. Both run alternately in the same
process. Counts: with / without the optimisation.

{devices(native["devices"])}

Neighbours per particle at the margin used, with lists shaped like the particles or like their circumcircles:

{neighbors(native["devices"])}

Lazy refinement: if the contact screen excludes a contact for a long time, the engine does not search for it but screens
the pair again at the end of that time. "Long" is the given multiple of the mean time between two collisions of a particle;
the engine uses 1.

{lazy(native["lazy"])}

## A hundred million collisions

`scripts/validate engine_long`: [validation.md](../docs/validation.md).
"""


def measure(_build):
    native, portable = measured(PROGRAM, "release"), measured(PROGRAM, "portable", "speed")
    draw(native["all_pairs"], FIGURE)
    PAGE.write_text(page(native, portable), encoding="utf-8")
    check_sizes(native["sizes"])
    return f"""This command writes [How fast is the engine?](../bench/engine.md). Required: a collision costs at most
{LARGEST_RATIO[100_000]} times as much at N = 10⁵ as at 10³, and at most {LARGEST_RATIO[1_000_000]} times as much
at 10⁶. The page says which goals are reached.
"""
