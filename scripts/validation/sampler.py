"""The speed of Monte Carlo: rewrites bench/sampler.md."""

import datetime

from validation.common import (ROOT, clock_rate, commit_of, expect, measured, millions, processor, rows_by, shape,
                               table)

TITLE = "Speed of Monte Carlo"
PROGRAM = "sampler"
PAGE = ROOT / "bench" / "sampler.md"

# (κ, φ): trials per second wanted on one core of such a machine.
GOALS = {(2, 0.5): 6e6, (6, 0.5): 5e6}
# Two threads against one.
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
                      f"{row['groups']:.2f}", f"{row['alone']:.3f}", f"{plain['decisions']:.2f}"])
    return table(["", "φ", "translation", "rotation", "translations accepted", "rotations accepted", "groups", "alone",
                  "decisions of the baseline"], lines)


def gain(row):
    return row["one"]["ns_per_trial"] / row["two"]["ns_per_trial"]


def check_threads(rows):
    for row in rows:
        expect(gain(row) >= MIN_GAIN, f"{shape(row['aspect_ratio'])}, N = {row['particles']}: two threads are "
                                        f"{gain(row):.2f} times as fast as one, not {MIN_GAIN} at least")


def threads(rows):
    lines = []
    for row in rows:
        wanted = f"≥ {MIN_GAIN}" + ", **missed**" * (gain(row) < MIN_GAIN)
        lines.append([shape(row["aspect_ratio"]), row["packing_fraction"], row["particles"],
                      millions(rate(row["one"])), millions(rate(row["two"])), f"**{gain(row):.2f}**", wanted])
    return table(["", "φ", "N", "one thread", "two threads", "gain", "wanted"], lines)


def lanes(rows):
    lines = [[shape(row["aspect_ratio"]), row["packing_fraction"], f"{row['others']:.2f}", f"{row['clear']:.3f}",
              f"{row['ns_in_lanes']:.0f} ns", f"{row['ns_one_by_one']:.0f} ns",
              f"**{row['ns_one_by_one'] / row['ns_in_lanes']:.2f}**"] for row in rows]
    return table(["", "φ", "others within reach", "clear", "in lanes", "one by one", "gain"], lines)


def page(native, portable):
    psi = " and ".join(f"{native[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    return f"""# How fast is Monte Carlo?

    scripts/validate sampler                         # builds, measures and writes this page
    build/release/bench/vitrel-bench sampler speed threads   # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(native)}, {processor()}{clock_rate()}, {native["compiler"]}, `{native["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run). The portable build: `{portable["flags"]}`, {portable["ns_per_psi"]:.1f} ns per Ψ.

The best and the median of many stretches of whole sweeps, in alternation with what it is compared to. Every state is a
liquid: inserted at random places and angles at φ = 0.2, swollen, and mixed by 500 sweeps. Steps are those at which 0.3
of the moves of each kind are accepted, but a turn is π at most, which more than 0.3 survive where the liquid is thin.

## Trials per second

N = {native["speed"][0]["particles"]}, one thread, in millions of trials per second. The baseline makes one trial after another among all
particles and decides every pair within the circumcircles alone.

{speed(native, portable)}

The steps, the shares that are accepted (sampler / baseline, at the same steps: a sampler's moves across a border between
domains are rejected), *groups* of up to four others looked at per trial, pairs of these that were decided *alone*, and
pairs that the baseline decided.

{work(native)}

## Two threads

In millions of trials per second. The final states are bit-identical.

{threads(native["threads"])}

## Deciding in lanes

The questions of trials in these liquids, with the same others at hand, all within the circumcircles and packed closely:
answered four at a time, or one by one with the same exact decision, until one overlaps. The answers are the same.

{lanes(native["lanes"])}
"""


def measure(_build):
    native, portable = measured(PROGRAM, "release"), measured(PROGRAM, "portable", "speed")
    PAGE.write_text(page(native, portable), encoding="utf-8")
    check_threads(native["threads"])
    return f"""[The page about the speed of Monte Carlo](../bench/sampler.md) is written from this. Wanted: two threads are at least
{MIN_GAIN} times as fast as one at N = 10⁵. Goals, missed or reached as measured:

{speed(native, portable)}

{threads(native["threads"])}
"""
