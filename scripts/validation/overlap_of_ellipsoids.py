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
    return f"""Three criteria test 10⁷ random pairs of scalene ellipsoids for overlap: the support gap, the function of Perram and
Wertheim, and the completed criterion of η₁ … η₅. Aspect ratios are 1 … 100 and size ratios 1 … 1000. A third of the pairs
are at the contact distance times 1 ± 10⁻¹ … 10⁻¹⁵. The criteria may disagree only where the surfaces are closer than
20 ε (a₁ + a₂), where a is the longest semi-axis of a body and ε = 2.2 · 10⁻¹⁶.

Pairs on which they disagree: {case["blurred"]}. The largest distance between the surfaces of such a pair:
{float(case["largest_blurred_gap_over_epsilon"]):.2f} ε (a₁ + a₂). In {decided:.1%} of the pairs η₁ exceeds its rounding error, and its sign decides.

The article's table of signs lacks the last condition. It misclassifies {overlooked:.1%} of the {overlaps:,} overlapping pairs
that are not near contact as disjoint: those in which one body contains or crosses the other.
"""
