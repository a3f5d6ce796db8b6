"""Chapter 4 of the thesis: its figures reproduced with a program like that of the thesis and with vitrel."""

from validation.common import compared, expect, save_figure, table
from validation.thesis_figures import IMPROVED, NAMES, OURS, THESIS, thesis_figures

TITLE = "The figures of the thesis"
SECONDS = 2  # CPU time after which a run of the thesis's program ends
DURATION = 100  # simulated time of a complete run
LARGEST = 400
RUNS = 32  # averaged in figure 4.7
FIGURES = "figures/thesis"

ELLIPSES, CIRCLES = 2, 1
# Range of the exponent of N in the cost. Lists and a calendar make it linear. With all pairs, N events require N
# optimisations each for ellipses, and N² closed-form tests each for circles.
EXPONENTS = {(OURS, ELLIPSES): (0.8, 1.3), (OURS, CIRCLES): (0.8, 1.3),
             (THESIS, ELLIPSES): (1.7, 2.5), (THESIS, CIRCLES): (2.4, 3.2)}
ENERGY_DRIFT = 1e-12  # of figure 4.6, relative
ROUNDING = 4 * 2.0**-52  # of a pair's energy: the change by an impact if all rounding errors have the same sign
STANDARD_ERRORS = 4  # false-alarm rate: 6e-5 per row


def exponent(data, program, kappa):
    return next(e["exponent"] for e in data["exponents"] if (e["program"], e["aspect_ratio"]) == (program, kappa))


def seconds_per_time(data, program, kappa, particles):
    """Mean of the Newtonian and the Brownian run, as in the thesis; None without such runs."""
    values = [row["seconds"] / row["simulated_time"] for row in data["rows"]
              if (row["program"], row["aspect_ratio"], row["particles"]) == (program, kappa, particles)
              and not row["stood_still"]]
    return sum(values) / len(values) if values else None


def number(value, form=".3g"):
    return "–" if value is None else format(value, form)


def ratio(one, two):
    return None if one is None or two is None else one / two


def check_ours(data):
    """Checks for correction moves, overlaps and, where energy is conserved, its drift."""
    samples = 0
    for row in data["rows"] + data["by_aspect_ratio"]:
        if row["program"] != OURS:
            continue
        name = f"N = {row['particles']}, κ = {row['aspect_ratio']:g}, {row['dynamics']}"
        expect(row["correction_moves"] == 0, f"{name}: {row['correction_moves']} correction moves")
        expect(row["samples_with_overlap"] == 0, f"{name}: {row['samples_with_overlap']} samples with overlaps")
        expect(row["dynamics"] == "Brownian"
               or row["energy_drift"] <= ROUNDING * (1 + row["collisions"] / row["particles"]),
               f"{name}: relative energy drift {row['energy_drift']} in {row['collisions']} collisions")
        expect(row["simulated_time"] >= 0.999 * DURATION, f"{name}: only {row['simulated_time']} units of time")
        samples += row["samples"]
    expect(data["energy_drift"] <= ENERGY_DRIFT, f"figure 4.6: relative energy drift {data['energy_drift']}")
    for of in data["relaxations"]:
        expect(of["samples_with_overlap"] == 0, f"figure 4.7: {of['samples_with_overlap']} samples with overlaps")
        samples += of["samples"]
    return samples


def check_exponents(data):
    for (program, kappa), (low, high) in EXPONENTS.items():
        found = exponent(data, program, kappa)
        expect(low <= found <= high, f"{NAMES[program]}, κ = {kappa}: cost as N^{found:.2f}")


def powers(program, kappa):
    return " … ".join(f"{power:g}" for power in EXPONENTS[program, kappa])


def durations(data):
    sizes = [n for n in (16, 100, 400) if n <= LARGEST]
    head = ["program", "shape", *(f"N = {n}" for n in sizes), "exponent of N"]
    rows = []
    for program in (THESIS, IMPROVED, OURS):
        for kappa, shape in ((ELLIPSES, "ellipses"), (CIRCLES, "circles")):
            rows.append([NAMES[program], shape, *(number(seconds_per_time(data, program, kappa, n)) for n in sizes),
                         f"{exponent(data, program, kappa):.2f}"])
        costs = [ratio(seconds_per_time(data, program, ELLIPSES, n), seconds_per_time(data, program, CIRCLES, n))
                 for n in sizes]
        rows.append([NAMES[program], "ratio", *map(number, costs), ""])
    return table(head, rows)


def corrections(data):
    head = ["program", "dynamics", "runs", "collisions", "per collision of vitrel", "correction moves",
            "per 1000 collisions", "deepest overlap (b)", "stalled runs"]
    truth = {(row["particles"], row["dynamics"]): row["collisions"] / row["simulated_time"]
             for row in data["rows"] if row["program"] == OURS and row["aspect_ratio"] == ELLIPSES}
    rows = []
    for program in (THESIS, IMPROVED, OURS):
        for dynamics in ("Newtonian", "Brownian"):
            runs = [row for row in data["rows"] if row["program"] == program and row["dynamics"] == dynamics
                    and row["aspect_ratio"] == ELLIPSES]
            collisions, moves = (sum(row[key] for row in runs) for key in ("collisions", "correction_moves"))
            expected = sum(truth[row["particles"], dynamics] * row["simulated_time"] for row in runs)
            depth = max(row["deepest_overlap"] for row in runs)
            rows.append([NAMES[program], dynamics, len(runs), collisions, f"{collisions / expected:.3f}", moves,
                         number(1000 * moves / collisions), number(depth, ".2g") if depth else "·",
                         sum(row["stood_still"] for row in runs)])
    return table(head, rows)


def relaxation(data):
    head = ["φ", "dynamics", "initial energy in", "units of time", "final kinetic energy",
            "equipartition", "standard error"]
    rows = []
    for of in data["relaxations"]:
        last, expected, error = of["kinetic"][-1], of["expected"], of["standard_error"]
        newtonian = of["dynamics"] == "Newtonian"
        start = "translation" if of["share_in_translation"] == 1 else "rotation"
        if newtonian:
            expect(abs(last - expected) <= STANDARD_ERRORS * error,
                   f"figure 4.7, φ = {of['packing_fraction']:g}, {start}: energy {last}, not {expected} ± {error}")
        rows.append([f"{of['packing_fraction']:g}", of["dynamics"], start, f"{of['times'][-1]:g}", f"{last:.4f}",
                     *([f"{expected:.4f}", f"{error:.4f}"] if newtonian else ["–", "–"])])
    return table(head, rows)


def check_brownian_relaxation(data):
    """Between two draws of the velocities a dense system comes closer to equilibrium than a dilute one."""
    reached = {of["packing_fraction"]: abs(of["kinetic"][-1] - of["expected"]) for of in data["relaxations"]
               if of["dynamics"] == "Brownian" and of["share_in_translation"] == 1}
    dilute, dense = min(reached), max(reached)
    expect(reached[dense] < reached[dilute], f"figure 4.7, Brownian: {reached}")


def picture(name, text):
    return f"![{text}]({FIGURES}/{name}.svg)"


def measure(build):
    data = compared(build, "thesis", "thesis.json", "--seconds", SECONDS, "--duration", DURATION, "--largest", LARGEST,
                    "--runs", RUNS)
    samples = check_ours(data)
    check_exponents(data)
    check_brownian_relaxation(data)
    relaxed = relaxation(data)
    for name, figure in thesis_figures(data).items():
        save_figure(figure, FIGURES, name)
    return f"""The figures of chapter 4 of the thesis, reproduced for ellipses with κ = 2 and circles of the same area. Parameters are
φ = 0.5 and kT = m = a b = 1; Brownian dynamics uses τ_B = 0.1. Runs start from equilibrium unless stated otherwise.
`vitrel-bench thesis` runs three programs:

- **all pairs** is a program like that of the thesis, without calendar, lists or cells. After every event it predicts the
  next collision of every pair, for ellipses with SLSQP and for circles in closed form. Overlapping pairs are separated by
  a correction move.
- **all pairs, improved** keeps a table of the next events of the pairs. It predicts only for pairs whose motion has changed
  and rejects solutions of SLSQP that violate a constraint.
- **vitrel** is the engine of this program.

Runs of the first two end after {SECONDS} s of CPU time, at a complete sample (0.1 units of time).

vitrel meets these requirements: no correction moves; no overlap at any of the {samples} samples by the exact check
(tolerance zero); in Newtonian runs, an energy drift of at most 4 units in the last place per impact of a pair, and of at most
{ENERGY_DRIFT:g} of the total energy in the run of figure 4.6; equipartition within {STANDARD_ERRORS} standard errors after a
start far from it. Required exponents of N in the cost: {powers(OURS, ELLIPSES)} for vitrel (ellipses and
circles); for all pairs {powers(THESIS, ELLIPSES)} (ellipses) and {powers(THESIS, CIRCLES)} (circles).

### Time against the number of particles (figures 4.1 and 4.2)

CPU seconds per unit of simulated time, averaged over a Newtonian and a Brownian run as in the thesis. The thesis fits
parabolas to both shapes, up to N = 100. For ellipses the cost of *all pairs* is also quadratic: after each of N events it
optimises about N pairs whose circumcircles overlap. For circles the test of all N²/2 pairs dominates, and the cost
approaches N³. Either the program of the thesis does not predict for all circles again, or N is too small there to show this.

{durations(data)}

{picture("duration", "CPU seconds per unit of simulated time against the number of particles")}

{picture("linear", "The same for vitrel alone, on linear axes")}

{picture("cost-ratio", "Cost of an ellipse relative to a circle against the number of particles")}

### Collisions and correction moves (figures 4.3 and 4.4)

Ellipses, all particle numbers combined. The optimiser of appendix A.1 of the thesis checks its solution only at the ends of
the bracket. It reports false collisions, and more of them the more often it runs; the count in the thesis is linear in N. A
local optimiser also misses collisions. A program that predicts for every pair after every event usually finds these later;
one that does not needs correction moves.

{corrections(data)}

{picture("collisions", "Collisions per unit of time against the number of particles")}

{picture("collisions-aspect-ratio", "Collisions per particle and unit of time against the aspect ratio at equal area")}

{picture("corrections", "Correction moves per unit of time against the number of particles")}

{picture("corrections-relative", "Correction moves per 1000 collisions against the number of particles")}

### Energy (figures 4.6 and 4.7)

One Newtonian run. Its relative energy drift is {data["energy_drift"]:.1e}.

{picture("energies", "Kinetic, rotational and total energy of one run")}

Mean of {RUNS} runs of 100 particles that start from a square lattice. The initial energy, 3/2 kT per particle, is entirely
translational or entirely rotational. At zero momentum and fixed energy E the translational kinetic energy in equilibrium is
E times a Beta(N − 1, N/2) variable; this gives its mean and the standard error. In the Brownian runs the velocities are drawn
with the initial partition after every τ_B. The kinetic energy just before a draw shows how far the system relaxes in between.

{relaxed}

{picture("relaxation", "Kinetic energy against time, from a start without equipartition")}
"""
