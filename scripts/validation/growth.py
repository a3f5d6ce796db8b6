"""Growth of the cost of analysing motion, with frames, particles, time differences and threads."""

import math

from validation.common import expect, measured, pyplot, save_figure, table

TITLE = "Growth of the analysis of motion"
AXES = {"frames": "frames", "particles": "particles", "lags": "time differences"}
LARGEST_DIFFERENCE = 1e-9  # F_s in the plane is off by 1e-10
LARGEST_EXPONENT = 1.15


def exponent(rows, axis):
    """Of the cost, from the smallest to the largest size."""
    first, last = rows[0], rows[-1]
    return math.log(last["seconds"] / first["seconds"]) / math.log(last[axis] / first[axis])


def drawn(data):
    figure, axes = pyplot().subplots(1, len(AXES), figsize=(9, 3.2), layout="constrained", sharey=True)
    for place, (axis, name) in zip(axes, AXES.items()):
        for key, label in (("plain_seconds", "plain loops"), ("seconds", "vitrel, with errors")):
            place.plot([row[axis] for row in data[axis]], [row[key] for row in data[axis]], marker="o", label=label)
        place.set(xscale="log", yscale="log", xlabel=name)
        place.set_xticks([row[axis] for row in data[axis]], [row[axis] for row in data[axis]])
        place.minorticks_off()
        place.grid(alpha=0.25)
    axes[0].set_ylabel("time / s")
    axes[0].legend(frameon=False, fontsize="small")
    save_figure(figure, "figures", "analysis_growth")


def measure(_build):
    data = measured("analysis-growth", "release")
    rows = [row for axis in (*AXES, "threads") for row in data[axis]]
    for row in rows:
        expect(row["difference"] <= LARGEST_DIFFERENCE, f"means differ by {row['difference']:.1e}")
    for axis in AXES:
        expect(exponent(data[axis], axis) <= LARGEST_EXPONENT, f"{axis}: exponent {exponent(data[axis], axis):.2f}")
    drawn(data)
    one, two = (row["seconds"] for row in data["threads"])
    exponents = ", ".join(f"{exponent(data[axis], axis):.2f} in {name}" for axis, name in AXES.items())
    lines = [[row["frames"], row["particles"], row["lags"], row["threads"], f"{row['seconds']:.3f}",
              f"{1e9 * row['seconds'] / (row['frames'] * row['particles'] * row['lags']):.1f}",
              f"{row['plain_seconds']:.2f}", f"{row['plain_seconds'] / row['seconds']:.1f}"] for row in rows]
    return f"""
Random walks of ellipses, in memory: mean squared displacement and rotation, F_s and L_2 with their errors, beside plain
loops that compute the means alone. The means agree within 10⁻⁹. The cost grows with the exponents
{exponents} (required: {LARGEST_EXPONENT:g} at most); two threads take {two / one:.2f} of the time of one.
Of more than 4096 frames that many are origins of time, so that the cost hardly grows beyond.

![Time against frames, particles and time differences](figures/analysis_growth.svg)

{table(["frames", "particles", "time differences", "threads", "s", "ns for each of all three", "plain loops, s", "ratio"], lines)}
"""
