"""The speed of the engine: rewrites bench/engine.md and its picture."""

import datetime
import math

from validation.common import (ROOT, clock_rate, commit_of, expect, measured, millions, processor, rows_by, shape,
                               table)

TITLE = "Speed of the engine"
PROGRAM = "engine"
PAGE = ROOT / "bench" / "engine.md"
FIGURE = ROOT / "bench" / "engine.svg"

# (κ, φ): goal and the best public program, collisions per second on one core of such a machine.
GOALS = {(1, 0.5): (2.4e6, 2.17e6), (1, 0.7): (3.4e6, 3.11e6), (2, 0.5): (5e5, 4.6e3), (2, 0.7): (5e5, 3.2e3),
         (6, 0.5): (3e5, 2.9e3), (6, 0.7): (3e5, 2.4e3)}
# Times the cost of a collision at N = 1000.
LARGEST_RATIO = {100_000: 1.6, 1_000_000: 2.5}
REFERENCE_SIZE = 1000

PROGRAMS = {"vitrel": "vitrel", "all_pairs": "all pairs, our collision times",
            "all_pairs_slsqp": "all pairs, SLSQP (the thesis)"}
DEVICES = {
    "disks": ("disks as disks", "as ellipses that happen to be round"),
    "constant_size": ("ellipses of constant size", "as ellipses that grow at the rate 0"),
    "look": ("first look at all neighbours, then searches", "every pair searched"),
    "horizon": ("predictions up to the partner's own entry", "up to the particle's own entry only"),
    "shaped_lists": ("lists shaped like the particles", "shaped like the circumcircles"),
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
    """Against the same shape at N = 1000, or the fewest particles that there are."""
    same = [of for of in sizes if of["aspect_ratio"] == row["aspect_ratio"]]
    reference = next((of for of in same if of["particles"] == REFERENCE_SIZE), same[0])
    return row["ns_per_collision"] / reference["ns_per_collision"]


def check_sizes(sizes):
    for row in sizes:
        most, ratio = LARGEST_RATIO.get(row["particles"], math.inf), cost_ratio(sizes, row)
        expect(ratio <= most, f"{shape(row['aspect_ratio'])}, N = {row['particles']}: a collision costs {ratio:.2f} "
                              f"times what it costs at N = {REFERENCE_SIZE}, not {most} at most")


def sizes_table(sizes):
    lines = []
    for row in sizes:
        ratio, most = cost_ratio(sizes, row), LARGEST_RATIO.get(row["particles"])
        wanted = "–" if most is None else f"≤ {most}" + ", **missed**" * (ratio > most)
        peak = row.get("peak_bytes_per_particle")
        lines.append([shape(row["aspect_ratio"]), row["particles"], f"{row['ns_per_collision']:.0f} ns",
                      f"{ratio:.2f}", wanted,
                      f"{row['bytes_per_particle']:.0f}", f"{peak:.0f}" if peak else "–"])
    return table(["", "N", "per collision", "times that at the least N", "wanted", "bytes per particle",
                  "bytes while a block begins, at most"], lines)


def charted(rows):
    """(N, seconds per unit of simulated time) of each program; the collision rate is always the engine's own."""
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

    return table(["N", "vitrel", PROGRAMS["all_pairs"], "times ours", PROGRAMS["all_pairs_slsqp"], "times ours"],
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
            name = f"{of['free_times']:g}" if "free_times" in of else "searched at once"
            lines.append([scene, name, f"{of['ns_per_collision']:.0f} ns",
                          f"{eager['ns_per_collision'] / of['ns_per_collision']:.2f}", *count_cells(of)])
    return table(["", "put off beyond", "per collision", "gain", *COUNTS], lines)


def page(native, portable):
    psi = " and ".join(f"{native[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    return f"""# How fast is the engine?

    scripts/validate engine                       # builds, measures and writes this page
    build/release/bench/vitrel-bench engine speed sizes   # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(native)}, {processor()}{clock_rate()}, {native["compiler"]}, `{native["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run). The portable build: `{portable["flags"]}`, {portable["ns_per_psi"]:.1f} ns per Ψ.

Times are those of the process, on one core; the best of five stretches of whole blocks of at least a second each,
with what the beginning and the end of a block takes. Every state is a liquid: inserted at random places and angles
at φ = 0.2, swollen, mixed by 500 sweeps of Monte Carlo and a second of the run itself. Counts are per collision:
*events* taken from the calendar, *predictions* (pairs looked at), *searches* (pairs that the first look did not
settle), *steps* along separating axes, *renewals* of neighbour lists.

## Collisions per second

Newtonian dynamics, in millions of collisions per second. The best public programs, measured on a machine of this kind
(EPYC, `-O3 -march=native`, double precision): for disks Smallenburg's code of 2022, held to a plane; for ellipses a
generic code by the algorithm of Gilbert, Johnson and Keerthi, which lets overlaps through.

{speed(native, portable)}

{counts(native)}

## Against the number of particles

φ = 0.5. An equilibrated liquid of 1000 particles is repeated, every copy with other velocities, the particles numbered
at random, and moved for about five collisions of each; then five stretches, or as many as begin within twenty seconds.

{sizes_table(native["sizes"])}

## Beside the program of the thesis

The same scene (κ = 2, φ = 0.5) without event calendar, neighbour lists and cells: after every event all pairs are asked
again, as in the thesis, by its method or by ours. Time per unit of simulated time; the slow ones get 2000 collisions or
eight seconds for each point, as far as their memory goes (88 bytes for each pair).

![Time per unit of simulated time against the number of particles]({FIGURE.name})

{all_pairs(native["all_pairs"])}

## Brownian dynamics

κ = 6, φ = 0.72, N = {native["brownian"][0]["particles"]}: simulated time per second. Every τ_B all velocities are drawn and all pairs of
neighbours predicted anew, on so many threads; results do not depend on it.

{brownian(native["brownian"])}

## What each simplification and each device gains

The engine as it is and with something else in its place, in alternation in the same run; counts with / without.

{devices(native["devices"])}

Neighbours per particle at the margin of the lists, shaped like the particles or like their circumcircles:

{neighbors(native["devices"])}

Lazy refinement: a contact that the first look rules out for long is not searched, but looked at again then. Long means
longer than so many mean times between two collisions of a particle; the engine takes 1.

{lazy(native["lazy"])}

## A hundred million collisions

`scripts/validate engine_long`: [validation.md](../docs/validation.md).
"""


def measure(_build):
    native, portable = measured(PROGRAM, "release"), measured(PROGRAM, "portable", "speed")
    draw(native["all_pairs"], FIGURE)
    PAGE.write_text(page(native, portable), encoding="utf-8")
    check_sizes(native["sizes"])
    return f"""[The page about the engine's speed](../bench/engine.md) is written from this. Wanted: a collision costs at most
{LARGEST_RATIO[100_000]} times as much at N = 10⁵ as at 10³, and {LARGEST_RATIO[1_000_000]} times at 10⁶. Goals, missed or reached as measured:

{speed(native, portable)}
"""
