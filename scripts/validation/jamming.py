"""500 particles are inserted at random at φ = 0.3. They grow during event-driven dynamics (Lubachevsky and Stillinger)
at the rate 0.001 until the compressibility factor Z = βP/ρ is 10⁶. Masses are constant, the moment of inertia follows
the axes, and ω is constant in free flight. Monodisperse disks and nearly round ellipses crystallise. The curve
therefore shows equimolar mixtures of two sizes, 1 : {SIZE_RATIO}. φ_J and C follow from Z = C/(1 − φ/φ_J) at Z = 10⁵
and at the end. In a jammed packing C is the number of degrees of freedom (2 for disks, 3 for ellipses) times the
fraction of non-rattlers. The column *contacts* is the contact number of the quality report, per particle and without
rattlers; *isostatic* is the number that fixes all degrees of freedom. Nearly round ellipses have fewer (Donev et al.
2007).

One seed each. Elongated particles align while they grow (nematic order), so φ_J rises again towards κ = 6.

Required: Z ≥ 10⁶ everywhere; no overlap by the exact check (tolerance zero); C between 75 % and 110 % of the degrees of
freedom; φ_J of the mixtures within {TOLERANCE} of the literature. The sources differ in protocol and in particles.

{packings}

{literature}

`vitrel report` draws packing fraction and contacts of such a sweep against the aspect ratio.
"""

from validation.common import expect, table
from validation.comparison import SCENES, Compared, Scenes, Tolerance, compared
from validation.literature import VALUES

TITLE = "Jammed packings: packing fraction against aspect ratio"
INPUTS = ["edmd", "core", "workflow/stages"]

MIXTURE = (1, 1.1, 1.2, 1.3, 1.4, 1.43, 1.45, 1.5, 2, 3, 4, 6)
ONE_SIZE = (1.4, 4)
SIZE_RATIO = 1.4
FINAL_PRESSURE = 1e6
TOLERANCE = 0.01  # about the scatter of the sources

KAPPA, SIZE = "species.0.aspect_ratio", "species.1.size"
ROWS = tuple({KAPPA: kappa, "species.1.aspect_ratio": kappa, SIZE: size}
             for kappas, size in ((MIXTURE, SIZE_RATIO), (ONE_SIZE, 1)) for kappa in kappas)
PACKINGS = Scenes(SCENES / "jamming.toml", rows=ROWS)


def extrapolated(scene):
    """φ_J and C from φ = φ_J (1 − C/Z) after both stages of growth."""
    stages, = scene.every("prepare.stages")
    z1, z2 = (stage["reduced_pressure"] for stage in stages[1:])
    phi1, phi2 = (stage["packing_fraction"] for stage in stages[1:])
    constant = (phi2 - phi1) / (phi2 / z1 - phi1 / z2)
    return phi2 / (1 - constant / z2), constant


def packing_row(scene):
    """Of a packing that is jammed."""
    state, = scene.every("prepare")
    jamming, constant = extrapolated(scene)
    reached, held = state["stages"][-1]["reduced_pressure"], state["quality"]["jamming"]
    expect(reached >= FINAL_PRESSURE, f"{scene}: reduced pressure {reached}")
    freedoms = 2 if scene[KAPPA] == 1 else 3
    expect(0.75 * freedoms <= constant <= 1.1 * freedoms, f"{scene}: C = {constant}, for {freedoms} degrees of freedom")
    return [scene[KAPPA], f"1 : {scene[SIZE]}", f"{jamming:.5f}", f"{constant:.2f}", f"{reached:.2e}",
            f"{held['contact_number']:.3f}", f"{held['isostatic_number']:.3f}", held["rattlers"],
            f"{state['nematic_order']:.2f}", f"{state['smallest_gap']:.1e}", f"{state['wall_seconds']:.0f} s"]


def literature_row(scenes, known):
    scene, = (one for one in scenes if (one[KAPPA], one[SIZE]) == (known["aspect_ratio"], SIZE_RATIO))
    jamming, _ = extrapolated(scene)
    found = compared(str(scene), jamming, known["packing_fraction"], Tolerance(0, absolute=TOLERANCE))
    return [scene[KAPPA], known["source"], *found.cells()[:3]]


def measure(build):
    packings = PACKINGS.run(build)
    head = ["κ", "sizes", "φ_J", "C", "Z at the end", "contacts", "isostatic", "rattlers", "nematic order", "smallest gap",
            "time"]
    compared_rows = [literature_row(packings, known) for known in VALUES["jammed_ellipses"]]
    return {"packings": table(head, map(packing_row, packings)),
            "literature": table(["κ", "source", "φ_J, literature", *Compared.HEAD[1:3]], compared_rows)}
