"""The restitution matrix of soft spheres: accuracy and speed of integration and tables, maps, one pair."""

import math

from validation.common import expect, measured, pyplot, save_figure, table

TITLE = "Restitution matrix of soft spheres"
PROGRAM = "restitution"
FIGURES = "figures/restitution"

INTEGRATION_ERROR = 1e-12
MAX_MEGABYTES, MAX_SECONDS, MAX_NANOSECONDS = 200, 600, 1000
MAX_WITHOUT_VALUE = 1e-3  # fraction of the domain
PAIR_ERROR, TABULATED_PAIR_ERROR = 1e-8, 1e-7  # of positions over l and velocities over v
VISIBLE = 0.1
STEPS = 7  # intervals of the contact, marked in the figure as in the source
REFINED = 2000  # integration steps per interval

NAMES = {"linear_dashpot": "linear dashpot", "viscoelastic": "viscoelastic"}
COEFFICIENTS = {"angle": "ε_φ", "rate": "ε_ṙ", "distance": "ε_r", "duration": "ε_t"}
BOUNDS = {"angle": 2, "rate": 1, "duration": 1, "distance": 2}  # errors in units of the tolerance


# One pair, figure 6 of the source. A state is (x₁, y₁, x₂, y₂, its rates).

def touching(pair):
    """The first contact: particle 1 below, velocities (v/4, ±v/2)."""
    half, v = pair["radius"], pair["speed"]
    sine = pair["eccentricity"]
    x, y = sine * half, math.sqrt(1 - sine**2) * half
    return [-x, -y, x, y, v / 4, v / 2, v / 4, -v / 2]


def slope(pair, state):
    x1, y1, x2, y2, *rates = state
    dx, dy = x1 - x2, y1 - y2
    r = math.hypot(dx, dy)
    push = pair["stiffness"] * (2 * pair["radius"] - r) / (r * pair["mass"])
    return [*rates, push * dx, push * dy, -push * dx, -push * dy]


def advanced(state, rates, step):
    return [x + step * rate for x, rate in zip(state, rates)]


def runge_kutta(pair, state, step):
    a = slope(pair, state)
    b = slope(pair, advanced(state, a, step / 2))
    c = slope(pair, advanced(state, b, step / 2))
    d = slope(pair, advanced(state, c, step))
    return [x + step / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip(state, a, b, c, d)]


def flown(state, time):
    return [x + time * v for x, v in zip(state[:4], state[4:])] + state[4:]


def by_newton(pair, duration):
    """States at the marked times, from the equations of motion of both particles."""
    states = [touching(pair)]
    for _ in range(STEPS):
        state = states[-1]
        for _ in range(REFINED):
            state = runge_kutta(pair, state, duration / STEPS / REFINED)
        states.append(state)
    return states


def by_classical_rule(pair, duration):
    """Elastic: the normal components of equal masses are exchanged at once."""
    state = touching(pair)
    nx, ny = (state[0] - state[2]) / (2 * pair["radius"]), (state[1] - state[3]) / (2 * pair["radius"])
    normal = (state[4] - state[6]) * nx + (state[5] - state[7]) * ny
    state[4:] = [state[4] - normal * nx, state[5] - normal * ny, state[6] + normal * nx, state[7] + normal * ny]
    return [flown(state, duration * k / STEPS) for k in range(STEPS + 1)]


def by_matrix(pair, coefficients, duration):
    """Rotated at first contact, then moving with the centre of mass, and the final velocities at the end."""
    x1, y1, x2, y2, *v = touching(pair)
    r, centre = 2 * pair["radius"], ((v[0] + v[2]) / 2, (v[1] + v[3]) / 2)
    ex, ey = (x1 - x2) / r, (y1 - y2) / r
    radial = (v[0] - v[2]) * ex + (v[1] - v[3]) * ey
    tangential = (v[1] - v[3]) * ex - (v[0] - v[2]) * ey
    angle = math.copysign(coefficients["angle"], tangential)
    ex, ey = ex * math.cos(angle) - ey * math.sin(angle), ex * math.sin(angle) + ey * math.cos(angle)
    x, y = (r * coefficients["distance"] / 2 * component for component in (ex, ey))
    radial, tangential = radial * coefficients["rate"], tangential / coefficients["distance"]
    vx, vy = (radial * ex - tangential * ey) / 2, (radial * ey + tangential * ex) / 2
    rotated = [x, y, -x, -y, *centre, *centre]
    states = [flown(rotated, duration * k / STEPS) for k in range(STEPS)]
    end = flown(rotated, coefficients["duration"] * pair["time"])[:4]
    end += [centre[0] + vx, centre[1] + vy, centre[0] - vx, centre[1] - vy]
    return [*states, flown(end, duration - coefficients["duration"] * pair["time"])]


def difference(pair, one, two):
    """The difference of the final states: positions over l, velocities over v."""
    units = [2 * pair["radius"]] * 4 + [pair["speed"]] * 4
    return max(abs(a - b) / unit for a, b, unit in zip(one[-1], two[-1], units))


def pair_ways(pair):
    duration = pair["integrated"]["duration"] * pair["time"]
    return {"Newton": by_newton(pair, duration), "classical": by_classical_rule(pair, duration),
            "matrix": by_matrix(pair, pair["integrated"], duration),
            "matrix from a table": by_matrix(pair, pair["tabulated"], duration)}


def check_pair(pair, ways):
    found = {name: difference(pair, ways["Newton"], states) for name, states in ways.items()}
    expect(found["matrix"] <= PAIR_ERROR, f"the final state with the matrix is off by {found['matrix']}")
    expect(found["matrix from a table"] <= TABULATED_PAIR_ERROR, f"the final state with the matrix from a table is off by {found['matrix from a table']}")
    expect(found["classical"] >= VISIBLE, f"the classical rule is off by only {found['classical']}")
    return found


# Pictures

def damping_label(force, of):
    if "damping" not in of:
        return "elastic"
    return f"{'ln c_dis' if force == 'linear_dashpot' else 'd'} = {of['damping']:g}"


def draw_maps(force, maps):
    plots = pyplot()
    figure, axes = plots.subplots(len(maps), 4, figsize=(10, 2.3 * len(maps)), sharex=True, sharey=True)
    for row, of in zip(axes, maps):
        extent = (0, of["g"][1] - of["g"][0], 0, of["m"][1] - of["m"][0])
        for panel, (key, symbol) in zip(row, COEFFICIENTS.items()):
            image = panel.imshow(of[key], origin="lower", extent=extent, aspect="auto", cmap="viridis")
            figure.colorbar(image, ax=panel)
            if of is maps[0]:
                panel.set_title(symbol)
        row[0].set_ylabel(f"{damping_label(force, of)}\nln l/l_min")
    for panel in axes[-1]:
        panel.set_xlabel("ln c_φ/c_φ,min")
    figure.tight_layout()
    save_figure(figure, FIGURES, force)


def middles(interval, count):
    return [interval[0] + (k + 0.5) / count * (interval[1] - interval[0]) for k in range(count)]


def draw_elastic_angle(of):
    """Figure 3: ε_φ against ln c_φ and ln l, onto which the rectangle of g and m is mapped."""
    plots = pyplot()
    columns, rows = middles(of["g"], len(of["angle"][0])), middles(of["m"], len(of["angle"]))
    length = [[m + math.log1p(math.exp(2 * g)) / 2 for g in columns] for m in rows]
    momentum = [[size + g for size, g in zip(line, columns)] for line in length]
    figure, axes = plots.subplots(figsize=(5.4, 4))
    mesh = axes.pcolormesh(momentum, length, of["angle"], shading="gouraud", cmap="viridis", rasterized=True)
    figure.colorbar(mesh, ax=axes, label="ε_φ")
    axes.set(xlabel="ln c_φ", ylabel="ln l/X")
    figure.tight_layout()
    save_figure(figure, FIGURES, "elastic_angle")


def draw_pair(pair, ways):
    plots = pyplot()
    figure, panels = plots.subplots(1, 2, figsize=(9, 5), sharex=True, sharey=True)
    duration = pair["integrated"]["duration"] * pair["time"]
    for panel, name in zip(panels, ("classical", "matrix")):
        for of, style in (("Newton", "ko-"), (name, "rs--" if name == "classical" else "g^--")):
            for x, y in ((0, 1), (2, 3)):
                before = flown(touching(pair), -duration / 2)
                points = [before, touching(pair), *ways[of], flown(ways[of][-1], duration / 2)]
                panel.plot([p[x] for p in points], [p[y] for p in points], style, markersize=4,
                           label=of if x == 0 else None)
        for centre in (touching(pair)[:2], touching(pair)[2:4]):
            panel.add_patch(plots.Circle(centre, pair["radius"], fill=False, linestyle=":", color="grey"))
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


def measure(_build):
    data = measured(PROGRAM, "release")
    for force, of in data["integration"].items():
        check_integration(force, of)
    for of in data["tables"]:
        check_table(of)
    ways = pair_ways(data["pair"])
    off = check_pair(data["pair"], ways)
    for force, maps in data["maps"].items():
        draw_maps(force, maps)
    draw_elastic_angle(data["maps"]["linear_dashpot"][0])
    draw_pair(data["pair"], ways)
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

The coefficients in the domain of the source (its figures 4 and 5), and ε_φ of elastic contacts in the plane of ln c_φ and
ln l/X (its figure 3):

![Linear dashpot]({FIGURES}/linear_dashpot.svg)

![Viscoelastic]({FIGURES}/viscoelastic.svg)

![ε_φ of elastic contacts, linear dashpot]({FIGURES}/elastic_angle.svg)

The pair of figure 6 (k = 2 kN/m, R = 0.1 m, 1140 kg/m³, 5 m/s, e = 0.3, elastic), with marks at equal times. The final state
of the contact is compared with the solution of Newton's equations (positions in units of l, velocities in units of v). The
maximum difference is {off['matrix']:.1e} with the restitution matrix, {off['matrix from a table']:.1e} with the tabulated matrix, and {off['classical']:.2g} with the
classical rule. Required: at most {PAIR_ERROR:g}, at most {TABULATED_PAIR_ERROR:g}, and at least {VISIBLE}.

![Trajectories of the pair]({FIGURES}/pair.svg)
"""
