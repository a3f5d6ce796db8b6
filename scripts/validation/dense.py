"""Dense states from random starts: the packing fractions that each method reaches, and its running time."""

import json
import pathlib
import re
import subprocess
import tempfile

from validation.common import INSERT, POWER_LAW, expect, preparation, shape, summary_of, table

TITLE = "Dense states: methods, packing fractions and times"
PARTICLES = 1000

# Aspect ratio, sizes, packing fraction, and whether the first method must reach it.
SPREAD = '{ distribution = "uniform", low = 0.6, high = 1.4 }'
STATES = (
    (1, (1, 1.4), 0.83, True),
    (1, (1, 1.4), 0.845, False),
    (1.4, (1, 1.4), 0.86, True),
    (1.4, (1, 1.4), 0.89, False),
    (2, (1,), 0.80, True),
    (6, (1,), 0.80, True),
    (1, (SPREAD,), 0.86, False),
    (2, (SPREAD,), 0.88, False),
    (1, (POWER_LAW,), 0.89, False),
    (2, (POWER_LAW,), 0.893, False),
)
NAMES = {(1,): "one", (1, 1.4): "1 : 1.4", (SPREAD,): "0.6 … 1.4", (POWER_LAW,): "σ⁻³"}
METHODS = {
    "grow, rate 1e-3": 'method = "grow"\ngrowth_rate = 1e-3',
    "grow, rate 1e-2": 'method = "grow"\ngrowth_rate = 1e-2',
    "hybrid, rate 1e-2": 'method = "hybrid"\ngrowth_rate = 1e-2',
    "hybrid with exchanges": 'method = "hybrid"\ngrowth_rate = 1e-2\nmoves = "local"\nexchanges = 0.2',
    "hybrid with collective exchanges": 'method = "hybrid"\ngrowth_rate = 1e-2\ncollective_exchanges = 4',
    "swell": 'method = "swell"',
    "compress, βP = 100": 'method = "compress"\npressure = 100\npacking_fraction = {fraction}',
}
MAX_SECONDS = 100
STOPPED = 5  # exit code


def parameters(kappa, sizes, fraction, method):
    stage = METHODS[method].format(fraction=fraction)
    return preparation(PARTICLES, kappa, sizes, "[prepare]\nquality_sweeps = 0", INSERT, f"[[prepare.stage]]\n{stage}")


def packing_fraction_of_failure(words):
    """The packing fraction at which a preparation reports that it is stuck."""
    found = re.search(r"(?:packing fraction of|it is) ([0-9.]+[0-9])", words)
    return found and float(found[1])


def outcome(build, kappa, sizes, fraction, method):
    """Whether the packing fraction was reached, and the text for the table."""
    with tempfile.TemporaryDirectory() as folder:
        file, state = pathlib.Path(folder, "dense.toml"), pathlib.Path(folder, "state.h5")
        file.write_text(parameters(kappa, sizes, fraction, method), encoding="utf-8")
        done = subprocess.run([build / "app/vitrel", "prepare", file, "-o", state, "--json", "-q", "--wall-time",
                               str(MAX_SECONDS), "--set", f"system.packing_fraction={fraction}"],
                              check=False, capture_output=True, text=True)
        if done.returncode == STOPPED:
            return False, f"not in {MAX_SECONDS} s"
        if done.returncode != 0:
            stuck_at = packing_fraction_of_failure(done.stderr)
            expect(stuck_at, f"{method}, κ = {kappa}: {done.stderr}")
            return False, f"stuck at {stuck_at:.4f}"
        overlaps = summary_of(build, "check", state)["overlaps"]
        expect(overlaps == 0, f"{method}, κ = {kappa}: {overlaps} overlaps")
        return True, f"{json.loads(done.stdout)['wall_seconds']:.1f} s"


def measure(build):
    rows = []
    for kappa, sizes, fraction, must in STATES:
        found = {method: outcome(build, kappa, sizes, fraction, method) for method in METHODS}
        reached, words = next(iter(found.values()))
        expect(reached or not must, f"κ = {kappa}, φ = {fraction}: {words}")
        rows.append([shape(kappa), NAMES[sizes], fraction, *(words for _, words in found.values())])
    return f"""{PARTICLES} particles, one seed each. They are inserted with random positions and orientations at φ = 0.3; one more stage, on one
core, brings them to φ. The exact check (tolerance zero) finds no overlap in any state. The default, growth at the rate
1e-3, must reach 0.83 (disks), 0.86 (κ = 1.4) and 0.80 (κ = 2 and 6); 0.845 and 0.89 are goals. The hybrid method runs 100
Monte Carlo sweeps after every growth interval, either with event chains or with local moves, a fifth of which exchange the
positions of two particles, or with event chains and 4 steps of collective exchanges per particle and sweep. Compression at
constant pressure is also Monte Carlo. Sizes 0.6 … 1.4 are uniformly distributed; σ⁻³ is the density of sizes from 0.725 to
1.61.

{table(["", "sizes", "φ", *METHODS], rows)}
"""
