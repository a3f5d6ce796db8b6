"""Jammed packings of ellipses from event-driven growth: packing fraction against aspect ratio."""

import pathlib
import tempfile

from validation.common import HERE, INSERT, expect, preparation, summary_of, table

TITLE = "Jammed packings: packing fraction against aspect ratio"
FIGURE = HERE.parents[1] / "docs" / "figures" / "jamming.svg"

PARTICLES = 500
GROWTH_RATE = 1e-3
# C is measured at the first pressure, φ_J at the last. At 1e4 some packings still rearrange.
PRESSURES = (1e5, 1e6)
MIXTURE = (1, 1.1, 1.2, 1.3, 1.4, 1.5, 2, 3, 4, 6)
ONE_SIZE = (1.4, 4)
SIZE_RATIO = 1.4

# Aspect ratio, φ_J and source. Disks: two sizes, the usual value; ellipses: each source has its own protocol.
LITERATURE = (
    (1, 0.84, "disks of two sizes"),
    (1.40, 0.8974, "Donev et al. 2007"),
    (1.43, 0.895, "Delaney et al. 2005"),
    (1.45, 0.8917, "Rocks & Hoy 2023"),
)
# About the scatter of these sources.
TOLERANCE = 0.01


def parameters(aspect_ratio, sizes):
    growth = (f'[[prepare.stage]]\nmethod = "grow"\nreduced_pressure = {pressure}\ngrowth_rate = {GROWTH_RATE}'
              for pressure in PRESSURES)
    return preparation(PARTICLES, aspect_ratio, sizes, INSERT, *growth)


class Packing:
    """One packing, grown and checked; its φ_J from Z = C/(1 − φ/φ_J) at both pressures."""

    def __init__(self, build, aspect_ratio, sizes):
        self.aspect_ratio = aspect_ratio
        with tempfile.TemporaryDirectory() as folder:
            file, state = pathlib.Path(folder, "jamming.toml"), pathlib.Path(folder, "state.h5")
            file.write_text(parameters(aspect_ratio, sizes), encoding="utf-8")
            self.summary = summary_of(build, "prepare", file, "-o", state)
            check = summary_of(build, "check", state)
        self.gap = check["smallest_gap"]
        name = f"κ = {aspect_ratio}, {len(sizes)} size(s)"
        expect(check["overlaps"] == 0, f"{name}: {check['overlaps']} overlaps")
        self.growth = [stage for stage in self.summary["stages"] if stage["method"] == "grow"]
        (z1, phi1), (z2, phi2) = ((g["reduced_pressure"], g["packing_fraction"]) for g in self.growth)
        expect(z2 >= PRESSURES[-1], f"{name}: reduced pressure {z2}")
        # φ = φ_J (1 − C/Z) at both.
        self.constant = (phi2 - phi1) / (phi2 / z1 - phi1 / z2)
        self.jamming = phi2 / (1 - self.constant / z2)
        self.pressure = z2
        freedoms = 2 if aspect_ratio == 1 else 3
        expect(0.75 * freedoms <= self.constant <= 1.1 * freedoms,
               f"{name}: C = {self.constant}, for {freedoms} degrees of freedom")

    def row(self):
        collisions = sum(g["collisions"] for g in self.growth)
        held = self.summary["quality"]["jamming"]
        return [self.aspect_ratio, f"{self.jamming:.5f}", f"{self.constant:.2f}", f"{self.pressure:.2e}",
                f"{held['contact_number']:.3f}", f"{held['isostatic_number']:.3f}", held["rattlers"],
                f"{self.summary['nematic_order']:.2f}", f"{collisions:.2e}", f"{self.gap:.1e}",
                f"{self.summary['wall_seconds']:.0f} s"]


def draw(mixture, one_size):
    import matplotlib  # only here: a test imports all validations

    matplotlib.use("svg")
    from matplotlib import pyplot

    matplotlib.rcParams.update({"svg.hashsalt": "vitrel", "svg.fonttype": "none", "font.size": 11})
    figure, axes = pyplot.subplots(figsize=(6.4, 4.2))
    axes.plot([p.aspect_ratio for p in mixture], [p.jamming for p in mixture], "o-", label="two sizes, 1 : 1.4")
    axes.plot([p.aspect_ratio for p in one_size], [p.jamming for p in one_size], "s", label="one size")
    axes.plot([x for x, _, _ in LITERATURE], [y for _, y, _ in LITERATURE], "kx", label="literature")
    axes.set(xlabel="aspect ratio κ", ylabel="packing fraction φ_J", xscale="log")
    ticks = (1, 1.5, 2, 3, 4, 6)
    axes.set_xticks(ticks, [f"{x:g}" for x in ticks])
    axes.set_xticks([], minor=True)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    figure.tight_layout()
    FIGURE.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(FIGURE, metadata={"Date": None})
    pyplot.close(figure)


def beside_literature(mixture, one_size):
    """Rows (κ, literature, ours); ours interpolated between the neighbouring aspect ratios."""
    rows = []
    for x, reference, source in LITERATURE:
        left = max((p for p in mixture if p.aspect_ratio <= x), key=lambda p: p.aspect_ratio)
        right = min((p for p in mixture if p.aspect_ratio >= x), key=lambda p: p.aspect_ratio)
        share = 0 if left is right else (x - left.aspect_ratio) / (right.aspect_ratio - left.aspect_ratio)
        ours = left.jamming + share * (right.jamming - left.jamming)
        expect(abs(ours - reference) <= TOLERANCE, f"κ = {x}: φ_J = {ours}, but {reference} ({source})")
        same = [f"{p.jamming:.4f}" for p in one_size if p.aspect_ratio == x]
        rows.append([f"{x:g}", f"{reference:g}", source, f"{ours:.4f}", *(same or ["–"])])
    return rows


def measure(build):
    mixture = [Packing(build, aspect_ratio, (1, SIZE_RATIO)) for aspect_ratio in MIXTURE]
    one_size = [Packing(build, aspect_ratio, (1,)) for aspect_ratio in ONE_SIZE]
    rows = beside_literature(mixture, one_size)
    draw(mixture, one_size)
    head = ["κ", "φ_J", "C", "Z at the end", "contacts", "isostatic", "rattlers", "nematic order", "collisions", "smallest gap", "time"]
    return f"""{PARTICLES} particles are inserted at random at φ = 0.3. They grow during event-driven dynamics (Lubachevsky and Stillinger) at
the rate {GROWTH_RATE:g} until the compressibility factor Z = βP/ρ is {PRESSURES[-1]:.0e}. Masses are constant, the moment of inertia follows
the axes, and ω is constant in free flight. Monodisperse disks and nearly round ellipses crystallise. The curve therefore
shows equimolar mixtures of two sizes, 1 : {SIZE_RATIO}. φ_J and C follow from Z = C/(1 − φ/φ_J) at Z = {PRESSURES[0]:.0e} and at the end. In
a jammed packing C is the number of degrees of freedom (2 for disks, 3 for ellipses) times the fraction of non-rattlers. The
column *contacts* is the contact number of the quality report, per particle and without rattlers; *isostatic* is the number
that fixes all degrees of freedom. Nearly round ellipses have fewer (Donev et al. 2007).

One seed each. Elongated particles align while they grow (nematic order), so φ_J rises again towards κ = 6.

Required: Z ≥ {PRESSURES[-1]:.0e} everywhere; no overlap by the exact check (tolerance zero); C between 75 % and 110 % of the
degrees of freedom; φ_J of the mixtures within {TOLERANCE} of the literature. The sources differ in protocol and in particles.

Two sizes:

{table(head, [packing.row() for packing in mixture])}

One size:

{table(head, [packing.row() for packing in one_size])}

{table(["κ", "φ_J, literature", "source", "two sizes, interpolated", "one size"], rows)}

![Packing fraction of jammed packings against the aspect ratio](figures/jamming.svg)
"""
