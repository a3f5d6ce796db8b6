"""Reads the plain text of a trajectory as the thesis's program does (appendix B.3) and compares every number."""
import numpy as np

from exported import expect, export

right, path = export("xytheta")
out = np.loadtxt(path, ndmin=2)


def column(index):
    """out[[All, index]] of Mathematica, which counts from 1."""
    return out[:, index - 1]


expect("columns", out.shape, (right.frames, 1 + 3 * right.n))
expect("time", column(1), right.time)
for i in range(1, right.n + 1):
    expect("x", column(3 * i - 1), right.position[:, i - 1, 0])
    expect("y", column(3 * i), right.position[:, i - 1, 1])
    expect("angle", column(3 * i + 1), right.angle[:, i - 1])
half = right.box[:, None, :2] / 2
assert np.all(np.abs(right.position[:, :, :2]) <= half), "outside of the picture"
