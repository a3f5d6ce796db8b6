"""Three overlap criteria that share no helper, on random pairs."""

from validation.common import properties_of_test

TITLE = "Overlap: three criteria, ten million pairs"
PAIRS = 10_000_000
TEST = "OverlapCriteria.ThreeCriteriaAgreeOnRandomPairs"


def measure(build):
    case = properties_of_test(build / "tests/core/test_core", TEST, VITREL_CONTACT_PAIRS=PAIRS)
    largest = float(case["largest_blurred_gap_over_1e-12_b"]) * 1e-12
    return f"""The support gap, Perram and Wertheim's function and Vieillard-Baron's function with the complete
criterion judge 10⁷ random pairs: aspect ratios 1 … 50, size ratios 1 … 100, a third of them at the
contact distance times 1 ± 10⁻¹ … 10⁻¹⁵. Verdicts may differ only where the surfaces are closer than
10⁻⁹ b (b the smaller semi-axis).

Pairs with different verdicts: {case["blurred"]}; the largest distance of surfaces among them: {largest:.1e} b.
"""
