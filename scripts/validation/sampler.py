"""The speed of Monte Carlo sampling: rewrites bench/sampler.md."""

import datetime

from validation.common import (ROOT, clock_rate, commit_of, expect, measured, millions, processor, rows_by, shape,
                               table)

TITLE = "Speed of Monte Carlo sampling"
PROGRAM = "sampler"
PAGE = ROOT / "bench" / "sampler.md"

# (κ, φ): goal in trials per second on one core of such a machine.
GOALS = {(2, 0.5): 6e6, (6, 0.5): 5e6, (6, 0.7): 6e6}
# Measured once, by the programs of both commits.
BEFORE_PSI = ("disks 0.98, κ = 2 1.05 at φ = 0.5 and **1.16** at φ = 0.7, κ = 6 **1.24** at φ = 0.5 and **1.43** at "
              "φ = 0.7")
# Two threads relative to one.
MIN_GAIN = 1.6


def rate(row):
    return 1e9 / row["ns_per_trial"]


def scene(row):
    return row["aspect_ratio"], row["packing_fraction"]


def goal_text(row):
    goal = GOALS.get(scene(row))
    if goal is None:
        return "–"
    return f"{millions(goal)}, " + ("reached" if rate(row) >= goal else "**not reached**")


def speed(native, portable):
    portable_rows = rows_by(portable["speed"], "aspect_ratio", "packing_fraction")
    lines = []
    for row in native["speed"]:
        plain = row["plain"]
        lines.append([shape(row["aspect_ratio"]), row["packing_fraction"], f"**{millions(rate(row))}**",
                      millions(1e9 / row["median_ns_per_trial"]), millions(rate(portable_rows[scene(row)])), goal_text(row),
                      millions(rate(plain)), f"{plain['ns_per_trial'] / row['ns_per_trial']:.2f}"])
    return table(["", "φ", "millions per second", "median", "portable build", "goal", "plain baseline", "times as fast"],
                 lines)


def rotations(row, value):
    return "–" if row["aspect_ratio"] == 1 else f"{value:.3f}"


def work(native):
    lines = []
    for row in native["speed"]:
        plain = row["plain"]
        lines.append([shape(row["aspect_ratio"]), row["packing_fraction"], f"{row['translation_step']:.3f}",
                      rotations(row, row["rotation_step"]),
                      f"{row['translations_accepted']:.3f} / {plain['translations_accepted']:.3f}",
                      f"{rotations(row, row['rotations_accepted'])} / {rotations(row, plain['rotations_accepted'])}",
                      f"{row['groups']:.2f}", f"{plain['decisions']:.2f}"])
    return table(["", "φ", "translation", "rotation", "translations accepted", "rotations accepted", "batches",
                  "tests of the baseline"], lines)


def gain(row):
    return row["one"]["ns_per_trial"] / row["two"]["ns_per_trial"]


def check_threads(rows):
    for row in rows:
        expect(gain(row) >= MIN_GAIN, f"{shape(row['aspect_ratio'])}, N = {row['particles']}: two threads are "
                                        f"{gain(row):.2f} times as fast as one; required: {MIN_GAIN}")


def threads(rows):
    lines = []
    for row in rows:
        wanted = f"≥ {MIN_GAIN}" + ", **missed**" * (gain(row) < MIN_GAIN)
        lines.append([shape(row["aspect_ratio"]), row["packing_fraction"], row["particles"],
                      millions(rate(row["one"])), millions(rate(row["two"])), f"**{gain(row):.2f}**", wanted])
    return table(["", "φ", "N", "one thread", "two threads", "speed-up", "required"], lines)


def batches(rows):
    lines = [[shape(row["aspect_ratio"]), row["packing_fraction"], f"{row['others']:.2f}", f"{row['clear']:.3f}",
              f"{row['ns_batched']:.0f} ns", f"{row['ns_single']:.0f} ns",
              f"**{row['ns_single'] / row['ns_batched']:.2f}**"] for row in rows]
    return table(["", "φ", "candidates", "no overlap", "batched", "one at a time", "speed-up"], lines)


def page(native, portable):
    psi = " and ".join(f"{native[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    return f"""# How fast is Monte Carlo sampling?

    scripts/validate sampler                         # builds, measures and writes this page
    build/release/bench/vitrel-bench sampler speed threads   # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(native)}, {processor()}{clock_rate()}, {native["compiler"]}, `{native["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run). The portable build: `{portable["flags"]}`, {portable["ns_per_psi"]:.1f} ns per Ψ.

Times are the best and the median of many measurements of complete sweeps; compared programs run alternately. Every state
is a liquid: particles are inserted with random positions and orientations at φ = 0.2, swollen, and equilibrated by 500
sweeps. Step sizes give an acceptance of 0.3 for each kind of move. Rotations are limited to π; in a dilute liquid more than
0.3 of these are accepted.

## Trials per second

N = {native["speed"][0]["particles"]}, one thread, in millions of trials per second. The baseline makes one trial after another among all
particles and tests every pair with overlapping circumcircles separately.

{speed(native, portable)}

The next table lists the step sizes and the acceptance (sampler / baseline, at the same step sizes; the sampler rejects moves
across a domain boundary). Per trial it lists the *batches* of up to four other particles tested, and the pairs that the
baseline tested.

{work(native)}

## Two threads

In millions of trials per second. The final states are bit-identical.

{threads(native["threads"])}

## Batched overlap tests

The overlap tests of trials in these liquids. The candidates of a trial have overlapping circumcircles and are stored
contiguously. They are tested in overlap batches of four, or one at a time by the separating axis of the largest gap, until
one overlaps. The results are identical.

{batches(native["batches"])}

A batch asks the criterion of Vieillard-Baron, which needs no division and no root and leaves only touching pairs
([header](../core/contact/ellipse_overlap_batch.h)). Until commit b08f312 it asked twice for a separating direction or a
common point, with two square roots each, and left one pair in fifty. Trials per second of commit 28d04cd relative to that,
both run in turns: {BEFORE_PSI}.
"""


def measure(_build):
    native, portable = measured(PROGRAM, "release"), measured(PROGRAM, "portable", "speed")
    PAGE.write_text(page(native, portable), encoding="utf-8")
    check_threads(native["threads"])
    return f"""This command writes [How fast is Monte Carlo sampling?](../bench/sampler.md). Required: two threads are at least
{MIN_GAIN} times as fast as one at N = 10⁵. The page says which goals are reached.
"""
