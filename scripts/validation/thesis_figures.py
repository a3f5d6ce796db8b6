"""The figures of chapter 4 of the thesis, from the data of vitrel-bench thesis."""

from validation.figures import COLOURS, chart, floor, legend, points

OURS, THESIS, IMPROVED = "vitrel", "thesis", "improved"
NAMES = {OURS: "vitrel", THESIS: "all pairs", IMPROVED: "all pairs, improved"}
SHAPES = {2: "ellipses", 1: "circles"}
LONG_ENOUGH = 1  # minimum simulated time of a run whose collisions are counted
N = "number of particles N"


def durations(rows, program, kappa):
    """Mean seconds per unit of simulated time by N, over Newtonian and Brownian runs as in the thesis."""
    found = {}
    for row in rows:
        if (row["program"], row["aspect_ratio"], row["stood_still"]) == (program, kappa, False):
            found.setdefault(row["particles"], []).append(row["seconds"] / row["simulated_time"])
    return {particles: sum(values) / len(values) for particles, values in sorted(found.items())}


def duration_figure(data):
    figure, axes = chart("Figure 4.1: CPU seconds per unit of simulated time, φ = 0.5", N, "seconds per unit of time")
    exponents = {(e["program"], e["aspect_ratio"]): e["exponent"] for e in data["exponents"]}
    for k, program in enumerate((THESIS, IMPROVED, OURS)):
        for kappa, shape in SHAPES.items():
            exponent = exponents[program, kappa]
            power = "" if exponent is None else f": N^{exponent:.2f}"
            points(axes, f"{NAMES[program]}, {shape}{power}", 2 * k + (kappa == 1),
                   [(n, s, kappa == 1) for n, s in durations(data["rows"], program, kappa).items()])
    return legend(figure, axes, ["all pairs: the thesis's program,", "predicts every pair after every event",
                                 "improved: only changed pairs,", "and every solution checked"])


def linear_figure(data):
    figure, axes = chart("Figure 4.2: CPU milliseconds per unit of simulated time, vitrel, φ = 0.5", N,
                         "milliseconds per unit of time", log="")
    for k, (kappa, shape) in enumerate(SHAPES.items()):
        points(axes, shape, k, [(0, 0, True), *((n, 1000 * s, kappa == 1) for n, s in durations(data["rows"], OURS, kappa).items())])
    return legend(figure, axes)


def ratio_figure(data):
    figure, axes = chart("Cost of an ellipse (κ = 2) relative to a circle of the same area, φ = 0.5", N,
                         "ratio of the times per unit of time")
    for k, program in enumerate((THESIS, IMPROVED, OURS)):
        circles = durations(data["rows"], program, 1)
        points(axes, NAMES[program], k, [(n, s / circles[n], False) for n, s in durations(data["rows"], program, 2).items()
                                         if n in circles])
    return legend(figure, axes)


def draw_series(axes, rows, name_of, point):
    """One series for every name; rows without a name are left out."""
    series = {}
    for row in rows:
        if name := name_of(row):
            series.setdefault(name, []).append(point(row))
    for k, (name, shown) in enumerate(series.items()):
        points(axes, name, k, shown)


def rate(row):
    return row["collisions"] / row["simulated_time"]


def collisions_figure(data):
    figure, axes = chart("Figure 4.3: collisions per unit of time, φ = 0.5", N, "collisions per unit of time", log="")

    def name_of(row):
        if row["program"] == IMPROVED or row["stood_still"] or row["simulated_time"] < LONG_ENOUGH:
            return None
        name = f"{row['dynamics']} {SHAPES[row['aspect_ratio']]}"
        if row["program"] == OURS:
            return name
        return None if row["aspect_ratio"] == 1 else name + ", all pairs"

    draw_series(axes, data["rows"], name_of, lambda row: (row["particles"], rate(row), row["program"] != OURS))
    return legend(figure, axes, ["Brownian: τ_B = 0.1", "ellipses: κ = 2, of the same area", "hollow: the thesis's program"])


def aspect_ratio_figure(data):
    figure, axes = chart("Figure 4.3 at equal area: collisions against the aspect ratio, N = 100, φ = 0.5", "aspect ratio κ",
                         "collisions per particle and unit of time", log="")
    draw_series(axes, data["by_aspect_ratio"], lambda row: row["dynamics"],
                lambda row: (row["aspect_ratio"], rate(row) / row["particles"], False))
    return legend(figure, axes)


def corrections_figure(data, relative):
    unit = "1000 collisions" if relative else "unit of time"
    none = 1e-2 if relative else 1e-3
    figure, axes = chart(f"Figure 4.4: correction moves per {unit}, ellipses", N, f"moves per {unit}")

    def name_of(row):
        if row["aspect_ratio"] == 1 or row["simulated_time"] < LONG_ENOUGH:
            return None
        return NAMES[OURS] if row["program"] == OURS else f"{NAMES[row['program']]}, {row['dynamics']}"

    def moves(row):
        return row["correction_moves"] / (row["collisions"] / 1000 if relative else row["simulated_time"])

    draw_series(axes, data["rows"], name_of, lambda row: (row["particles"], max(moves(row), none), row["stood_still"]))
    floor(axes, none, "none")
    return legend(figure, axes, ["hollow: the run stalled"])


def energies_figure(data):
    figure, axes = chart("Figure 4.6: energies of one run per particle, N = 100, κ = 2, φ = 0.5", "time",
                         "energy per particle / kT", log="")
    times, kinetic, rotational = zip(*data["energies"])
    total = [k + r for k, r in zip(kinetic, rotational)]
    for k, (name, values, mean) in enumerate((("total", total, None), ("kinetic", kinetic, 2 / 3 * total[0]),
                                              ("rotational", rotational, total[0] / 3))):
        axes.plot(times, values, color=COLOURS[k], linewidth=1, label=name)
        if mean is not None:
            axes.axhline(mean, color=COLOURS[k], linewidth=0.7, linestyle="--")
    return legend(figure, axes, ["dashed: equipartition"])


def relaxation_figure(data):
    figure, axes = chart("Figure 4.7: relaxation of the kinetic energy, N = 100, κ = 2", "time",
                         "kinetic energy per particle / kT", log="x")
    for k, of in enumerate(data["relaxations"]):
        spinning = ", spinning" if of["share_in_translation"] == 0 else ""
        points(axes, f"φ = {of['packing_fraction']:g}, {of['dynamics']}{spinning}", k,
               [(t, e, of["brownian_step"] > 0) for t, e in zip(of["times"], of["kinetic"])])
    axes.axhline(1, color="black", linewidth=0.8, linestyle="--")
    return legend(figure, axes, ["initial energy: translational", "or (spinning) rotational;",
                                 "Brownian: redrawn like this every", "τ_B = 0.1, shown just before it;", "dashed: equipartition"])


def thesis_figures(data):
    return {"duration": duration_figure(data), "linear": linear_figure(data), "cost-ratio": ratio_figure(data),
            "collisions": collisions_figure(data), "collisions-aspect-ratio": aspect_ratio_figure(data),
            "corrections": corrections_figure(data, relative=False), "corrections-relative": corrections_figure(data, relative=True),
            "energies": energies_figure(data), "relaxation": relaxation_figure(data)}
