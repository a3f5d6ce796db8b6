"""The default collision-time method on every class of pairs, compared with the guaranteed reference."""

import json

from validation.common import expect, output_of, table

TITLE = "Collision time: the default method on every class"
PAIRS = 800_000  # of each class, all its aspect ratios taken together
MIN_PAIRS = 10_000_000  # in total, if PAIRS has its regular value
TIME_TOLERANCE = 1e-12  # of the horizon

# core/contact/first_contact.h declares a contact at a gap of at most 1.25 contact gaps. A contact gap is
# 32 units in the last place of the sum of the larger semi-axes; rounding may add 4 of these units.
LARGEST_GAP = 1.25 + 4 / 32

FAILURES = ["early", "late", "missed", "false", "not_converged"]


def survey(build, pairs, classes=()):
    # Early answers for degenerate pairs are checked below, more strictly than by --gap-tolerance.
    command = [build / "bench/vitrel-bench", "contact-time", "plane", "--method", "separating_axis", "--pairs", str(pairs),
               "--tolerance", str(TIME_TOLERANCE), "--gap-tolerance", "1e-8", "--json", "-q"]
    return json.loads(output_of(command + [word for name in classes for word in ("--class", name)]))["parts"][0]["rows"]


def rows(build):
    """Half of the pairs at each aspect ratio; a class with a single aspect ratio gets all of them."""
    halves = survey(build, PAIRS // 2)
    names = [one["class"] for one in halves]
    once = [name for name in names if names.count(name) == 1]
    return [one for one in halves if one["class"] not in once] + survey(build, PAIRS, once)


def number(value, form):
    return "–" if value is None else format(value, form)


def row(measured):
    """Checks a class and returns its table row."""
    name = f"{measured['class']}, κ = {measured['aspect_ratio']:g}"
    expect(measured["pairs"] >= PAIRS // 2, f"{name}: only {measured['pairs']} pairs")
    for failure in FAILURES:
        expect(measured[failure] == 0, f"{name}: {measured[failure]} {failure.replace('_', ' ')}")
    error, gap = measured["largest_error"], measured["largest_moot_gap"]
    expect(error is None or error <= TIME_TOLERANCE, f"{name}: an error of {error} of the horizon")
    expect(gap is None or gap <= LARGEST_GAP, f"{name}: a contact reported at {gap} contact gaps")
    return [measured["class"], f"{measured['aspect_ratio']:g}", measured["pairs"], measured["contacts"],
            measured["degenerate"], number(error, ".1e"), number(gap, ".3f")]


def measure(build):
    measured = rows(build)
    pairs = sum(one["pairs"] for one in measured)
    expect(PAIRS < 800_000 or pairs >= MIN_PAIRS, f"only {pairs} pairs in total")
    head = ["class", "largest κ", "pairs", "contacts", "degenerate", "largest error", "largest gap"]
    return f"""`vitrel bench contact-time plane` runs the default method on {pairs} pairs of {len(measured)} classes and compares every answer with
the reference in 80-bit arithmetic. Required: no answer is late, missed, false or lacking, and none is early by
more than {TIME_TOLERANCE:g} of the horizon (*largest error*, in fractions of the horizon). Degenerate pairs are exempt: their
surfaces cross so slowly (below 0.02 (a₁ + a₂)/horizon) that the time is ill-defined. For these, and for a reported contact
of a pair that does not quite touch, the true gap at the reported time (*largest gap*) must be at most {LARGEST_GAP:g} contact
gaps: 1.25 by construction plus 4 units in the last place of a₁ + a₂. A contact gap is 32 of these units.

{table(head, [row(one) for one in measured])}

Late, missed, false or no answer: 0 of {pairs}.
"""
