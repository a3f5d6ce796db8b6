"""Three overlap criteria of ellipsoids, on random pairs."""

from validation.common import properties_of_test

TITLE = "Overlap of ellipsoids: three criteria, ten million pairs"
PAIRS = 10_000_000
TEST = "EllipsoidCriteria.ThreeCriteriaAgreeOnRandomPairs"


def measure(build):
    case = properties_of_test(build / "tests/core/test_core", TEST, VITREL_CONTACT_PAIRS=PAIRS)
    decided = int(case["decided_by_eta_1"]) / PAIRS
    overlaps = int(case["random_overlaps"])
    overlooked = int(case["overlooked_by_the_article"]) / overlaps
    return f"""The support gap, Perram and Wertheim's function and the completed criterion of η₁ … η₅ judge 10⁷ random
pairs of scalene ellipsoids: aspect ratios 1 … 100, size ratios 1 … 1000, a third of them at the contact
distance times 1 ± 10⁻¹ … 10⁻¹⁵. Verdicts may differ only where the surfaces are closer than 20 ε (a₁ + a₂),
a the longest semi-axes and ε = 2.2 · 10⁻¹⁶.

Pairs with different verdicts: {case["blurred"]}; the largest distance of surfaces among them:
{float(case["largest_blurred_gap_over_epsilon"]):.2f} ε (a₁ + a₂). The sign of η₁ is above its rounding, and decides, in {decided:.1%} of the pairs.

The article's table of signs, without the last condition, calls {overlooked:.1%} of the {overlaps:,} overlaps among the
pairs that are not near contact separate: those where one body is inside the other or crosses it.
"""
