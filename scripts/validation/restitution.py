"""The restitution matrix of soft spheres: accuracy and speed of integration and tables, maps, one pair."""

import math

from validation.common import expect, measured, pair_columns, pyplot, save_figure, table

TITLE = "Restitution matrix of soft spheres"
PROGRAM = "restitution"
FIGURES = "figures/restitution"

INTEGRATION_ERROR = 1e-12
MAX_MEGABYTES, MAX_SECONDS, MAX_NANOSECONDS = 200, 600, 1000
MAX_WITHOUT_VALUE = 1e-3  # fraction of the domain
PAIR_ERROR = 1e-8  # of positions over l and velocities over v
VISIBLE = 0.1
SIDE = 41  # of a map
PAIR = ("restitution", "--set", "law=linear_dashpot", "--set", "stiffness=2 kN/m", "--speed", "5 m/s",
        "--impact-parameter", "0.3")

NAMES = {"linear_dashpot": "linear dashpot", "viscoelastic": "viscoelastic"}
COEFFICIENTS = {"angle": "ε_φ", "rate": "ε_ṙ", "distance": "ε_r", "duration": "ε_t"}
BOUNDS = {"angle": 2, "rate": 1, "duration": 1, "distance": 2}  # errors in units of the tolerance


# Figures 3 to 5 of the source

def draw_maps(law, columns):
    plots = pyplot()
    damping = next(iter(columns))
    values = list(dict.fromkeys(columns[damping]))
    symbol = "ln c_dis" if damping == "ln_c_dis" else "ln c_dis/c_dis,min"
    figure, axes = plots.subplots(len(values), 4, figsize=(10, 2.1 * len(values)), sharex=True, sharey=True)
    for row, value in zip(axes, values):
        for panel, (key, name) in zip(row, COEFFICIENTS.items()):
            draw_map(figure, panel, columns, value, ("ln_c_phi_over_min", "ln_l_over_min", key))
            panel.set_title(name if value == values[0] else "")
        row[0].set_ylabel(("elastic" if math.isinf(value) else f"{symbol} = {value:.4g}") + "\nln l/l_min")
    for panel in axes[-1]:
        panel.set_xlabel("ln c_φ/c_φ,min")
    figure.tight_layout()
    save_figure(figure, FIGURES, law)


def draw_map(figure, panel, columns, damping, names):
    """The rows of this damping: columns for x, y and the colour."""
    first = columns[next(iter(columns))].index(damping)
    x, y, colour = ([columns[name][k : k + SIDE] for k in range(first, first + SIDE**2, SIDE)] for name in names)
    figure.colorbar(panel.pcolormesh(x, y, colour, shading="gouraud", cmap="viridis", rasterized=True), ax=panel)


def draw_elastic_angle(columns):
    """Figure 3: ε_φ against ln c_φ and ln l."""
    figure, axes = pyplot().subplots(figsize=(5.4, 4))
    draw_map(figure, axes, columns, -math.inf, ("ln_c_phi", "ln_l", "angle"))
    axes.set(xlabel="ln c_φ", ylabel="ln l/X", title="ε_φ")
    figure.tight_layout()
    save_figure(figure, FIGURES, "elastic_angle")


# Figure 6: the paths of one pair, by different rules

def end_of_path(columns, rule):
    """Positions and velocities of both centres after the contact."""
    last = [[columns[f"{rule}_{axis}_{sphere}"][k] for sphere in "12" for axis in "xy"] for k in (-2, -1)]
    step = columns["time"][-1] - columns["time"][-2]
    return last[1], [(b - a) / step for a, b in zip(*last)]


def check_pair(columns):
    """The differences from the integrated path at its end: positions over l, velocities over v."""
    found = {}
    positions, velocities = end_of_path(columns, "integrated")
    for rule in ("soft", "hard"):
        other, others = end_of_path(columns, rule)
        found[rule] = max(*(abs(a - b) / 0.2 for a, b in zip(positions, other)),
                          *(abs(a - b) / 5 for a, b in zip(velocities, others)))
    expect(found["soft"] <= PAIR_ERROR, f"the final state with the matrix is off by {found['soft']}")
    expect(found["hard"] >= VISIBLE, f"the classical rule is off by only {found['hard']}")
    return found


def draw_pair(columns):
    figure, panels = pyplot().subplots(1, 2, figsize=(9, 5), sharex=True, sharey=True)
    marks = [k for k, instant in enumerate(columns["instant"]) if instant == int(instant)]
    for panel, rule in zip(panels, ("hard", "soft")):
        for of, style in (("integrated", "ko-"), (rule, "rs--" if rule == "hard" else "g^--")):
            for sphere in "12":
                x, y = (columns[f"{of}_{axis}_{sphere}"] for axis in "xy")
                panel.plot(x, y, style, markersize=4, markevery=marks, label=of if sphere == "1" else None)
        for sphere in "12":
            centre = [columns[f"hard_{axis}_{sphere}"][marks[3]] for axis in "xy"]
            panel.add_patch(pyplot().Circle(centre, 0.1, fill=False, linestyle=":", color="grey"))
        panel.set(aspect="equal", xlabel="x (m)")
        panel.legend(frameon=False)
    panels[0].set_ylabel("y (m)")
    figure.tight_layout()
    save_figure(figure, FIGURES, "pair")


# The page

def check_integration(force, of):
    for key, symbol in COEFFICIENTS.items():
        expect(of["errors"][key] <= INTEGRATION_ERROR, f"{force}: {symbol} is off by {of['errors'][key]}")


def check_table(of):
    name = f"{of['force']}, {of['kind']}"
    for key, bound in BOUNDS.items():
        expect(of["errors"][key] <= bound * of["tolerance"], f"{name}: {COEFFICIENTS[key]} is off by {of['errors'][key]}")
    expect(of["without_value"] <= MAX_WITHOUT_VALUE * of["points"], f"{name}: {of['without_value']} without a value")
    expect(of["megabytes"] <= MAX_MEGABYTES, f"{name}: {of['megabytes']} MB")
    expect(of["seconds"] <= MAX_SECONDS, f"{name}: built in {of['seconds']} s")
    expect(of["nanoseconds"] <= MAX_NANOSECONDS, f"{name}: {of['nanoseconds']} ns")


def span(interval):
    return f"{interval[0]:.2f} … {interval[1]:.2f}" if interval[1] > interval[0] else f"{interval[0]:.2f}"


def table_row(of):
    errors = [f"{of['errors'][key]:.1e}" for key in COEFFICIENTS]
    return [NAMES[of["force"]], of["kind"], span(of["m"]), span(of["d"]) if "d" in of else "−∞",
            f"{of['tolerance']:.0e}", of["panels"], f"{of['megabytes']:.2g}", f"{of['seconds']:.2g} s", *errors,
            f"{of['without_value']} of {of['points']}", f"{of['nanoseconds']:.0f} ns",
            f"{of['integration_nanoseconds'] / 1000:.0f} µs"]


def source_sentence(tables):
    found = [of for of in tables if "source_impacts" in of]
    for of in found:
        expect(of["source_impacts_without_value"] <= MAX_WITHOUT_VALUE * of["source_impacts"],
               f"{of['force']}: {of['source_impacts_without_value']} impacts of the source without a value")
    return " and ".join(f"{of['source_impacts_without_value']} of {of['source_impacts']} ({NAMES[of['force']]})"
                        for of in found)


def measure(build):
    data = measured(PROGRAM, "release")
    for force, of in data["integration"].items():
        check_integration(force, of)
    for of in data["tables"]:
        check_table(of)
    for law in NAMES:
        columns = pair_columns(build, "--scaled-table", "restitution", "--set", f"law={law}")
        draw_maps(law, columns)
        if law == "linear_dashpot":
            draw_elastic_angle(columns)
    paths = pair_columns(build, "--paths", *PAIR)
    off = check_pair(paths)
    draw_pair(paths)
    integration = [[NAMES[force], of["impacts"], *(f"{of['errors'][key]:.1e}" for key in COEFFICIENTS)]
                   for force, of in data["integration"].items()]
    head = ["force", "impacts of", "m", "d", "tolerance", "panels", "MB", "build time", *COEFFICIENTS.values(),
            "without a value", "lookup", "integration"]
    return f"""The coefficients ε_r, ε_φ, ε_t and ε_ṙ describe a contact of finite duration (Müller and Pöschel 2013). The tables list
maximum errors: absolute ones for ε_r, relative ones for the other coefficients.

The integration is compared with a solution of the original equations of motion, in extended precision and by another method
(`bench/baselines/plain_contact.h`), for random impacts of the source's domain with c_dis ≤ 20. Required: {INTEGRATION_ERROR:g}.

{table(["force", "impacts", *COEFFICIENTS.values()], integration)}

Tables (`edmd/soft/restitution_table.h`) are compared with the integration at random points and at the centres of a grid of
cells, uniform in g, m and d. Required: ε_ṙ and ε_t within the tolerance, ε_φ and ε_r within twice the tolerance; at most
{MAX_MEGABYTES} MB, {MAX_SECONDS} s and {MAX_NANOSECONDS} ns; no value in at most {MAX_WITHOUT_VALUE:.1%} of the domain, where the contact is integrated. The
domain of the source is that of its tables 1 and 2, for any two radii: g from {data['tables'][0]['g'][0]:.2f} to {data['tables'][0]['g'][1]:.2f}. Lookup times include the
logarithms of a random impact and cache misses from random access to a large table.

{table(head, [table_row(of) for of in data["tables"]])}

Random impacts take material, radii, densities and speeds from the ranges of the source, uniform in their logarithms, with
uniform eccentricities. Impacts without a value in the three-dimensional table:
{source_sentence(data["tables"])}.

The coefficients in the domain of the source, by `vitrel pair restitution --scaled-table` (its figures 4 and 5, and its
figure 3: ε_φ of elastic contacts in the plane of ln c_φ and ln l/X):

![Linear dashpot]({FIGURES}/linear_dashpot.svg)

![Viscoelastic]({FIGURES}/viscoelastic.svg)

![ε_φ of elastic contacts, linear dashpot]({FIGURES}/elastic_angle.svg)

The pair of figure 6 (k = 2 kN/m, R = 0.1 m, 1140 kg/m³, 5 m/s, e = 0.3, elastic) by `vitrel pair restitution --paths`, with
marks at equal times. The state after the contact is compared with the integrated path (positions in units of l, velocities
in units of v). The maximum difference is {off['soft']:.1e} with the restitution matrix and {off['hard']:.2g} with the classical rule. Required:
at most {PAIR_ERROR:g}, and at least {VISIBLE}.

![Trajectories of the pair]({FIGURES}/pair.svg)
"""
