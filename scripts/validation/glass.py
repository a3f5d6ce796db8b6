"""The glass transition of ellipses: relaxation times against density, nematic order or glass, and fits of φ_c."""

import json

from validation.common import PARAMS, ROOT, expect, output_of, summary_of, table

TITLE = "The glass transition of ellipses"
FOLDER = ROOT / "out" / "glass"  # kept, so that an interrupted study continues
SMALLEST_NEMATIC = 0.5
LONGEST = 4 * 3600 * 2  # seconds of one core
# Packing fractions of the glass transitions in the experiment on monolayers with κ = 6 (Zheng, Wang & Han 2011).
EXPERIMENT_ROTATION, EXPERIMENT_TRANSLATION = 0.72, 0.79


def number(value, error=None, digits=3):
    if value is None:
        return "–"
    text = f"{value:.{digits}g}"
    return text if error is None else f"{text} ± {error:.1g}"


def density(fit):
    if fit["phi_c"] is not None:
        return f"{fit['phi_c']:.3f} ± {fit['phi_c_error']:.3f}"
    return f"> {fit['phi_c_least']:.3f}" if fit["phi_c_least"] is not None else "–"


class Study:
    """One sweep, run or continued, with its analysis."""

    def __init__(self, build, name):
        self.name, self.folder = name, FOLDER / name
        FOLDER.mkdir(parents=True, exist_ok=True)
        summary_of(build, "sweep", PARAMS / f"{name}.toml", "-o", self.folder, "-j", "2", "--quiet")
        summary = summary_of(build, "analyze", self.folder, "--quiet")
        output_of([build / "app/vitrel", "report", self.folder, "--quiet"])
        self.jobs = [json.loads(path.read_text()) for path in sorted(self.folder.glob("*/done.json"))]
        self.runs, self.fits, self.remarks = summary["runs"], summary["glass"]["fits"], summary["glass"]["remarks"]

    def seconds(self):
        return sum(job[step]["wall_seconds"] for job in self.jobs for step in ("prepare", "run"))

    def check(self):
        expect(all("verdict" in run for run in self.runs), f"{self.name}: the analysis of a run is incomplete")
        for job in self.jobs:
            expect(job["run"]["overlaps"] == 0, f"{self.name}, {job['id']}: overlaps")

    def rows(self):
        return [[f"{r['packing_fraction']:.2f}", f"{r['seed']}", f"{r['duration']:.0f}",
                 number(r["nematic_order"], r["nematic_order_error"], 2),
                 number(r["tau_translation"], r["tau_translation_error"]),
                 number(r["tau_rotation"], r["tau_rotation_error"]),
                 r["orientation"], r["verdict_translation"], r["verdict"]] for r in self.runs]

    def reasons(self):
        """Why runs are excluded from the fits of translation or, otherwise, of rotation."""
        lines = []
        for r in self.runs:
            what, reason = (("all", r["reason_translation"]) if r["reason_translation"] else ("rotation", r["reason"]))
            if reason:
                lines.append(f"- φ = {r['packing_fraction']:.2f}, seed {r['seed']}, {what}: {reason}")
        return "\n".join(lines)

    def fit_rows(self):
        return [[f["kind"], f["law"], density(f), number(f["exponent"], f["exponent_error"]),
                 "{:.2f} … {:.2f}".format(*f["window"]) if f["dof"] else "–",
                 number(f["chi2"] / f["dof"], digits=2) if f["dof"] else "–", f["reason"] or "–"] for f in self.fits]

    def text(self):
        runs = table(["φ", "seed", "duration", "S", "τ_α", "τ_2", "orientations", "translation", "all"], self.rows())
        fits = table(["quantity", "law", "φ_c", "exponent", "best window", "χ²/dof", "reason for no fit"], self.fit_rows())
        remarks = "\n\n".join(self.remarks)
        return f"{runs}\n\n{remarks}\n\nRuns excluded from the fits:\n\n{self.reasons()}\n\n{fits}"

    def order(self):
        values = [run["nematic_order"] for run in self.runs]
        return min(values), max(values)

    def growth(self, key):
        """The increase of a time from the lowest density to the highest, averaged over seeds."""
        def mean(phi):
            values = [run[key] for run in self.runs if abs(run["packing_fraction"] - phi) < 1e-6]
            return None if None in values else sum(values) / len(values)
        ends = [mean(end(run["packing_fraction"] for run in self.runs)) for end in (min, max)]
        return " to ".join(number(value) for value in ends)

    def exponent(self, kind, law):
        fit = next(fit for fit in self.fits if (fit["kind"], fit["law"]) == (kind, law))
        return number(fit["exponent"], fit["exponent_error"])

    def found(self, kind):
        return "; ".join(f"{density(fit)} ({fit['law']})" for fit in self.fits if fit["kind"] == kind) or "–"


def comparison(nematic, isotropic):
    """Both transitions of both systems, compared with the experiment."""
    kinds = {"φ_θ, orientations": ("rotation in the nematic, tau_2", "rotation, tau_2", EXPERIMENT_ROTATION),
             "φ_T, positions": ("translation, tau_alpha", "translation, tau_alpha", EXPERIMENT_TRANSLATION)}
    return table(["", "κ = 6, nematic", "κ = 2, isotropic", "experiment, κ = 6"],
                 [[name, nematic.found(first), isotropic.found(second), experiment]
                  for name, (first, second, experiment) in kinds.items()])


def measure(build):
    nematic, isotropic = (Study(build, name) for name in ("glass_sweep", "glass_sweep_binary"))
    for study in (nematic, isotropic):
        study.check()
    order = isotropic.order()[1]
    expect(order < SMALLEST_NEMATIC, f"the binary mixture is not isotropic: S is up to {order:.2f}")
    seconds = nematic.seconds() + isotropic.seconds()
    expect(seconds < LONGEST, f"the study took {seconds / 7200:.1f} hours on two cores")
    low, high = nematic.order()
    return f"""\
Protocol: random insertion at φ = 0.3, event-driven growth at the rate 10⁻³ to the final density, Brownian dynamics
(τ_B = 0.1, N = 500) for half the duration as equilibration, then for the duration. τ_α is defined by F_s(q, t) = 1/e, with
q = 3.2 for κ = 6 and q = 2.7 for κ = 2. τ_2 is defined by L_2(t) = 1/e; in a nematic this is the connected part, relative to
the director. Only equilibrated runs enter the fits. Fits of translation use the verdict on translation. Errors of φ_c
include those of the fit and of the choice of densities. Preparation and dynamics took {seconds / 7200:.1f} hours on two cores.

{comparison(nematic, isotropic)}

Monodisperse ellipses with κ = 6 are nematic at every density of the study (S = {low:.2f} … {high:.2f}). Nematic order limits
the mean squared rotation, and slow growth does not lead to an isotropic orientational glass. From the lowest density to the
highest, the relaxation time of rotation about the director increases from τ_2 = {nematic.growth("tau_rotation")} and that
of translation from τ_α = {nematic.growth("tau_translation")}. The order parameter itself relaxes on the time scale of the
runs and differs between seeds. At most densities there is thus no verdict of equilibrium, and there is no φ_θ. The power law
gives φ_T with the exponent {nematic.exponent("translation, tau_alpha", "power law")}, while mode-coupling theory requires at
least 1.77. The Vogel–Fulcher law gives a different φ_T. The agreement of the power-law value with the experiment is
therefore no evidence. The two transitions of the experiment do not lie on this path through the nematic.

Binary ellipses with κ = 2 stay isotropic (S ≤ {order:.2f}) and form a glass. By the power law, orientations arrest at a lower
density than positions, as in the experiment. The difference is smaller than in the experiment, however, and smaller than
the difference between the two laws. τ_2 grows from {isotropic.growth("tau_rotation")} and τ_α
from {isotropic.growth("tau_translation")}; the system still relaxes at the highest density, above the φ_θ of the power law.
The exponents, {isotropic.exponent("translation, tau_alpha", "power law")} and {isotropic.exponent("rotation, tau_2", "power law")}, are again below 1.77: the data cover two decades in τ_2, and the laws
extrapolate beyond them. Other simulations of such mixtures also find no two separate transitions (Xu et al. 2014). The
mode-coupling density of binary disks with the same size ratio is 0.795 (Weysser & Hajnal 2011).

### Monodisperse ellipses, κ = 6

{nematic.text()}

### Equimolar binary ellipses, κ = 2, size ratio 1.4

{isotropic.text()}
"""
