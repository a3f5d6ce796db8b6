"""The scene of the thesis and a binary mixture: no overlaps, and conserved quantities stay constant."""

from validation.common import PARAMS, expect, run_and_check, table

TITLE = "The scene of the thesis"
DURATION = 1000  # ten times that of the thesis

SCENES = {
    "thesis, Newtonian": ("thesis.toml", True),
    "thesis, Brownian": ("ellipses_brownian.toml", False),
    "binary mixture, Newtonian": ("binary.toml", True),
}


def row(build, name, file, conserves):
    run, check = run_and_check(build, PARAMS / file, f"dynamics.duration={DURATION}")
    expect(run["correction_moves"] == 0, f"{name}: {run['correction_moves']} correction moves")
    expect(check["overlaps"] == 0, f"{name}: {check['overlaps']} overlaps")
    expect(check["frames"] == run["frames"], f"{name}: {check['frames']} of {run['frames']} frames checked")
    if conserves:
        expect(run["energy_drift"] <= 1e-12, f"{name}: relative energy drift {run['energy_drift']}")
        expect(run["largest_momentum"] <= 1e-11, f"{name}: momentum {run['largest_momentum']}")
    drifts = [f"{run['energy_drift']:.1e}", f"{run['largest_momentum']:.1e}"] if conserves else ["–", "–"]
    return [name, run["collisions"], f"{run['predictions_per_collision']:.1f}", run["correction_moves"],
            *drifts, run["frames"], check["overlaps"], f"{check['smallest_gap']:.1e}"]


def measure(build):
    head = ["scene", "collisions", "predictions per collision", "correction moves", "relative energy drift",
            "largest momentum", "frames", "overlaps", "smallest gap"]
    rows = [row(build, name, *scene) for name, scene in SCENES.items()]
    return f"""`params/ellipses.toml`, `params/ellipses_brownian.toml` and `params/binary.toml` run for {DURATION} units of time. Required: no
correction moves; no overlap in any saved frame by the exact check (tolerance zero); in Newtonian runs, a relative energy
drift of at most 10⁻¹² and a momentum of at most 10⁻¹¹.

{table(head, rows)}
"""
