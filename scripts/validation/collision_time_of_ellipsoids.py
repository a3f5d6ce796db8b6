"""Collision times of ellipsoids: the default method, that of the article, and the root of Perram and Wertheim."""

from validation.collision_time_page import Rows, class_name, classes, stability, time_text, write_counts
from validation.common import compared, expect, save_figure, table
from validation.figures import passing_pair_figure, speed_figure

TITLE = "Collision time of ellipsoids: three methods"
PAIRS = 5_000  # of each class, for the default method
SECONDS = 10  # for each of the others
TOLERANCE = 1e-12  # of the horizon
FIGURES = "figures/collision-time-of-ellipsoids"

DEFAULT = "separating_axis"
NAMES = {DEFAULT: "separating axis (default)", "eta_root": "root of η₁", "perram_wertheim_root": "root of Perram–Wertheim"}


def check(rows):
    """Checks that the default method answers every pair correctly."""
    for row in rows.of(DEFAULT):
        name = class_name((row["class"], row["aspect_ratio"]))
        expect(row["pairs"] == PAIRS, f"{name}: {row['pairs']} pairs")
        expect(row["correct"] == PAIRS, f"{name}: {PAIRS - row['correct']} wrong answers of the default method")
        error = row["largest_error"]
        expect(error is None or error <= TOLERANCE, f"{name}: an error of {error} of the horizon")


def speed(rows):
    """Times for random pairs."""
    lines = []
    for of in (of for of in rows.classes if of[0] in ("generic", "tumbling")):
        times = [rows.of(method, of)["ns_per_call"] for method in NAMES]
        lines.append([class_name(of), time_text(times[0]),
                      *(f"{time_text(other)}, {other / times[0]:.0f} times" for other in times[1:])])
    return table(["pairs", *NAMES.values()], lines)


def passing(data):
    """The answers for two ellipsoids that overlap briefly while passing each other."""
    pair = data["passing_pair"]
    answers = {(answer["method"], answer["tolerance"]): answer for answer in pair["answers"]}
    default = min((a for a in pair["answers"] if a["method"] == DEFAULT), key=lambda a: a["tolerance"])
    expect(default["time"] is not None and abs(default["time"] - pair["contact"]) < 1e-10, f"the passing pair: {default}")
    lines = [[f"{NAMES[DEFAULT]}, {default['steps']} steps", f"{default['time']:.12f}"]]
    for method in (method for method in NAMES if method != DEFAULT):
        for tolerance in sorted({t for m, t in answers if m == method}, reverse=True):
            time = answers[method, tolerance]["time"]
            lines.append([f"{NAMES[method]}, in {1 / tolerance:.0f} steps", "none" if time is None else f"{time:.12f}"])
        expect(answers[method, 0.01]["time"] is None, f"{method} finds the overlap in 100 steps")
        expect(answers[method, 0.001]["time"] is not None, f"{method} misses the overlap in 1000 steps")
    return pair, table(["method", "contact at"], lines)


def figures(data):
    return {"largest": speed_figure(data["tolerances"], "largest_error"),
            "median": speed_figure(data["tolerances"], "median_error"),
            "passing_pair": passing_pair_figure(data["passing_pair"])}


def measure(build):
    data = compared(build, "collision-time-of-ellipsoids", "collision-time.json", "--pairs", PAIRS, "--seconds", SECONDS,
                    "--tolerance", TOLERANCE, "--gap-tolerance", 1e-8)
    rows = Rows(data["rows"])
    check(rows)
    pair, answers = passing(data)
    for name, figure in figures(data).items():
        save_figure(figure, FIGURES, name)
    write_counts(rows, "ellipsoids.csv")
    grazing = [rows.of("eta_root", of) for of in rows.classes if of[0].endswith("grazing")]
    missed, contacts = (sum(row[key] for row in grazing) for key in ("missed", "contacts"))
    return f"""`vitrel-bench collision-time-of-ellipsoids` compares three methods on the same pairs of ellipsoids, growing or of
constant size, rotating about a constant angular velocity or tumbling by Euler's equations. The first is the default method.
The second, that of the article, finds the root of η₁(t) at which η₂, η₃ and η₅ have the signs of external contact. The third
finds the first root of F(t) − 1, where F is the function of Perram and Wertheim. Both root finders scan the time during
which the circumscribed spheres overlap in 100 equal steps and refine the root by algorithm 748 (Alefeld, Potra and Shi).

The reference implementation follows a separating axis in 80-bit arithmetic, with a bound that excludes missed contacts, until
the completed criterion of η₁ … η₅ detects the overlap. Of tumbling bodies it integrates Euler's equations by Taylor series,
and bounds the motion between two times by |ω|² ≤ 2E/I₁, where I₁ is the smallest moment. An answer is correct if its error
is at most {TOLERANCE:g} of the horizon. If the surfaces cross at less than 0.02 (a₁ + a₂)/horizon, an early answer is also correct if
the gap is at most 10⁻⁸ of the shortest semi-axis. The uncertainty of the reference is allowed in addition; it is negligible
except at grazing contacts. If the bodies tumble, what is allowed instead is ten times the effect of one unit in the last
place of each number of their initial orientations and angular velocities: close to the separatrix, and in fast rotation, this
grows by many orders of magnitude.

Required: every answer of the default method is correct. Its wrong answers: 0 of {sum(row["pairs"] for row in rows.of(DEFAULT))}.

Time per call for random pairs, also as a multiple of the default:

{speed(rows)}

![Time per call against the maximum error, one point per tolerance or number of steps]({FIGURES}/largest.svg)

![Time per call against the median error]({FIGURES}/median.svg)

Wrong answers by class; [all counts, errors and times](data/collision-time/ellipsoids.csv):

{stability(rows, NAMES)}

{classes(data)}

Grazing pairs have two close roots, or none. The root of η₁ misses {missed} of {contacts} contacts, all of them overlaps that last
less than a step. For parallel bodies of the same shape η₁ vanishes at all times. Its sign is then that of the rounding
error, the method finds no contact, and the scan is slowest. If a small body meets a large one, η₁ suffers from cancellation.

Two ellipsoids with parallel axes, (2, 1, 1.2) and (1.5, 1, 0.8), pass each other without rotation. They overlap by {pair["depth"]:g}
for {2 * (3 - pair["contact"]):.4f} units of time around t = 3. The exact contact time is t = {pair["contact"]:.12f}:

{answers}

![η₁ of the passing pair, with the samples of a scan in 100 steps]({FIGURES}/passing_pair.svg)
"""
