"""Three overlap criteria that share no code, on random pairs."""

from validation.common import properties_of_test

TITLE = "Overlap: three criteria, ten million pairs"
PAIRS = 10_000_000
TEST = "OverlapCriteria.ThreeCriteriaAgreeOnRandomPairs"


def measure(build):
    case = properties_of_test(build / "tests/core/test_core", TEST, VITREL_CONTACT_PAIRS=PAIRS)
    largest = float(case["largest_blurred_gap_over_1e-12_b"]) * 1e-12
    return f"""Three criteria test 10⁷ random pairs of ellipses for overlap: the support gap, the function of Perram and Wertheim, and
the function of Vieillard-Baron with the complete criterion. Aspect ratios are 1 … 50 and size ratios 1 … 100. A third of
the pairs are at the contact distance times 1 ± 10⁻¹ … 10⁻¹⁵. The criteria may disagree only where the surfaces are closer
than 10⁻⁹ b (b: the smaller semi-axis).

Pairs on which they disagree: {case["blurred"]}. The largest distance between the surfaces of such a pair: {largest:.1e} b.
"""
