"""Chapter 4 of the thesis: its figures again, with a program like its own and with this one."""

from validation.common import compared, expect, save_figure, table
from validation.thesis_figures import IMPROVED, NAMES, OURS, THESIS, thesis_figures

TITLE = "The figures of the thesis"
SECONDS = 2  # of work, after which a run of the thesis's program is cut short
DURATION = 100  # of the runs in simulated time, unless cut short
LARGEST = 400
RUNS = 32  # averaged in figure 4.7
FIGURES = "figures/thesis"

ELLIPSES, CIRCLES = 2, 1
# Between what the powers of N must lie with which the cost grows: linear with lists and calendar. With all pairs, N
# events times N optimisations of ellipses; where only dismissals in closed form are left, N events times N² pairs.
EXPONENTS = {(OURS, ELLIPSES): (0.8, 1.3), (OURS, CIRCLES): (0.8, 1.3),
             (THESIS, ELLIPSES): (1.7, 2.5), (THESIS, CIRCLES): (2.4, 3.2)}
ENERGY_DRIFT = 1e-12  # of figure 4.6, relative
ROUNDING = 4 * 2.0**-52  # of a pair's energy: what an impact may change it by, if all err alike
STANDARD_ERRORS = 4  # false alarm: 6e-5 for each row


def exponent(data, program, kappa):
    return next(e["exponent"] for e in data["exponents"] if (e["program"], e["aspect_ratio"]) == (program, kappa))


def seconds_per_time(data, program, kappa, particles):
    """Mean of the Newtonian and the Brownian run, as in the thesis; None if there is none."""
    values = [row["seconds"] / row["simulated_time"] for row in data["rows"]
              if (row["program"], row["aspect_ratio"], row["particles"]) == (program, kappa, particles)
              and not row["stood_still"]]
    return sum(values) / len(values) if values else None


def number(value, form=".3g"):
    return "–" if value is None else format(value, form)


def ratio(one, two):
    return None if one is None or two is None else one / two


def check_ours(data):
    """No correction move and a clean exact check in every run; energy where it is conserved."""
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
        expect(row["simulated_time"] >= 0.999 * DURATION, f"{name}: {row['simulated_time']} units of time only")
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
            "per 1000 collisions", "deepest overlap (b)", "runs that stood still"]
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
    head = ["φ", "dynamics", "energy at first in", "units of time", "kinetic energy at last",
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
    """Before velocities are drawn anew a dense system comes nearer to equilibrium than a dilute one."""
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
    return f"""Chapter 4 of the thesis again: κ = 2 and circles of the same area, φ = 0.5, kT = m = a b = 1, from
equilibrium unless said otherwise, τ_B = 0.1 where the dynamics are Brownian. `vitrel-bench thesis` runs three programs:

- **all pairs** works as the thesis's does: no calendar, no lists, no cells; after every event every pair is asked
  anew for its next collision, ellipses by SLSQP, circles in closed form; a pair found overlapping gets a correction
  move;
- **all pairs, improved** keeps a table of the pairs' next events, asks only pairs whose motion has changed, and takes
  no answer of SLSQP that violates a constraint;
- **vitrel** is this program's engine.

The first two are cut short after {SECONDS} s of work for each run, at a whole sample (0.1 units of time).

Wanted, and found, of vitrel: no correction move; the exact check (tolerance zero) clean at all {samples} samples; a
drift of the energy in Newtonian runs of at most 4 units in the last place for every impact of a pair, and of at most
{ENERGY_DRIFT:g} of the whole in that of figure 4.6; equipartition within {STANDARD_ERRORS} standard errors after a
wrong split of the energy. Its cost grows as N to the power {powers(OURS, ELLIPSES)} (ellipses and
circles); that of all pairs to the power {powers(THESIS, ELLIPSES)} (ellipses) and {powers(THESIS, CIRCLES)} (circles).

### Time against the number of particles (figures 4.1 and 4.2)

Seconds of work for one unit of simulated time, mean of a Newtonian and a Brownian run as in the thesis. The thesis
fits parabolas to both shapes, up to N = 100. For ellipses *all pairs* grows alike: after each of N events it optimises
about N pairs whose circumcircles overlap. For circles nothing is left but to look at all N²/2 pairs, and the cost
comes closer to N³: either the thesis's circles were not asked all again, or the small N hide it.

{durations(data)}

{picture("duration", "Seconds for one unit of simulated time against the number of particles")}

{picture("linear", "The same for vitrel alone, on linear axes")}

{picture("cost-ratio", "Cost of an ellipse over that of a circle against the number of particles")}

### Collisions and correction moves (figures 4.3 and 4.4)

Ellipses, all particle numbers together. An optimiser whose answer is checked only at the ends of its bracket (as in
the thesis's appendix A.1) reports collisions that do not happen, the more the oftener it is asked; the thesis's own
count is linear in N. One that is local overlooks some: a program that asks every pair again after every event mostly
makes that good; one that does not has to correct.

{corrections(data)}

{picture("collisions", "Collisions per unit of time against the number of particles")}

{picture("collisions-aspect-ratio", "Collisions per particle and unit of time against the aspect ratio at equal area")}

{picture("corrections", "Correction moves per unit of time against the number of particles")}

{picture("corrections-relative", "Correction moves per 1000 collisions against the number of particles")}

### Energy (figures 4.6 and 4.7)

One Newtonian run; its relative energy drift: {data["energy_drift"]:.1e}.

{picture("energies", "Kinetic, rotational and total energy of one run")}

Mean of {RUNS} runs of 100 particles from a square lattice whose energy, 3/2 kT per particle, is all in translation or
all in rotation. At zero momentum and fixed energy E the kinetic energy of translation is in equilibrium E times a
Beta(N − 1, N/2) variable, which gives its mean and the standard error. In the Brownian runs the wrong split is drawn
anew every τ_B: the kinetic energy just before that shows how far the system comes in between.

{relaxed}

{picture("relaxation", "Kinetic energy against time after a wrong split")}
"""
