"""The exact check computes in long double where that has at least 64 bits, else in the sum of two doubles. Both judge
10⁷ random pairs of ellipses and as many of ellipsoids, once as the check does and once by the criterion alone. Aspect
ratios are 1 … 100 and size ratios 1 … 10. Half of the pairs are anywhere within the circumcircles (spheres). A quarter
each overlap or miss each other by 3 · 10⁻¹⁵ of the longest semi-axis, so that the right verdict is known. Required: all
verdicts agree.

{table}
"""

from validation.common import properties_of_test, table

TITLE = "The exact check: two arithmetics, ten million pairs"
INPUTS = ["core", "tests/core/exact_pair_test.cpp"]
PAIRS = 10_000_000


def measure(build):
    rows = []
    for bodies in ("ellipses", "ellipsoids"):
        test = f"ExactPair.TwoArithmeticsAgreeOn{bodies.capitalize()}"
        case = properties_of_test(build / "tests/core/test_core", test, VITREL_EXTENDED_PAIRS=PAIRS)
        rows.append([bodies, f"{PAIRS:,}", f"{int(case['overlapping']):,}", "0"])
    return {"table": table(["bodies", "pairs", "of these overlap", "different verdicts"], rows)}
