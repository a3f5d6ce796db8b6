"""The structure factor by fast Fourier transform, compared with the direct sum: error and speed-up."""

from validation.common import expect, measured, table

TITLE = "Structure factor: transform and direct sum"


def measure(_build):
    rows = measured("structure-factor", "release")["rows"]
    for row in rows:
        expect(row["share_of_bound"] <= 1, f"N = {row['particles']}: an error is {row['share_of_bound']:.2f} times its bound")
    lines = [[row["particles"], f"{row['wave_vectors']:.0f}", f"{row['transform_ms']:.2f}", f"{row['direct_ms']:.2f}",
              f"{row['direct_ms'] / row['transform_ms']:.1f}", f"{row['largest_error']:.1e}",
              f"{row['share_of_bound']:.0e}"] for row in rows]
    head = ["N", "wave vectors", "transform, ms", "direct, ms", "times as fast", "largest error of S", "error/bound"]
    return f"""Ellipses with κ = 4 at φ = 0.3 in a square box. The structure factors of centres and orientations are computed in shells
up to q = 12, with a B-spline grid of order 12 and by direct sums over the same wave vectors. Times are CPU times on one
core. The error bound is 2 ε √(N S) + ε² N with ε = 10⁻⁶ (`analysis/structure/density_grid.h`). For 16 or fewer particles
the analysis uses direct sums.

{table(head, lines)}
"""
