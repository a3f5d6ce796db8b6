"""The glass transition of ellipses: relaxation times over the density, order or glass, and the fits of φ_c."""

import json

from validation.common import PARAMS, ROOT, expect, output_of, summary_of, table

TITLE = "The glass transition of ellipses"
FOLDER = ROOT / "out" / "glass"  # kept, so that a study that was stopped goes on
SMALLEST_NEMATIC = 0.5
LONGEST = 4 * 3600 * 2  # seconds of one core
# Where the experiment on monolayers of κ = 6 (Zheng, Wang & Han 2011) sees rotation and translation stop.
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
    """One sweep: run or continued, analysed and read."""

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
        expect(all("verdict" in run for run in self.runs), f"{self.name}: a run could not be judged")
        for job in self.jobs:
            expect(job["run"]["overlaps"] == 0, f"{self.name}, {job['id']}: overlaps")

    def rows(self):
        return [[f"{r['packing_fraction']:.2f}", f"{r['seed']}", f"{r['duration']:.0f}",
                 number(r["nematic_order"], r["nematic_order_error"], 2),
                 number(r["tau_translation"], r["tau_translation_error"]),
                 number(r["tau_rotation"], r["tau_rotation_error"]),
                 r["orientation"], r["verdict_translation"], r["verdict"]] for r in self.runs]

    def reasons(self):
        """Why runs stay out of fits: of translation, and where that is in, of rotation."""
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
        fits = table(["of", "law", "φ_c", "exponent", "best window", "χ²/dof", "why not"], self.fit_rows())
        remarks = "\n\n".join(self.remarks)
        return f"{runs}\n\n{remarks}\n\nRuns that stay out of the fits:\n\n{self.reasons()}\n\n{fits}"

    def order(self):
        values = [run["nematic_order"] for run in self.runs]
        return min(values), max(values)

    def growth(self, key):
        """Of a time, from the lowest density to the highest, in the mean over seeds."""
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
    """Both transitions of both systems beside those of the experiment."""
    kinds = {"φ_θ, orientations": ("rotation in the nematic, tau_2", "rotation, tau_2", EXPERIMENT_ROTATION),
             "φ_T, places": ("translation, tau_alpha", "translation, tau_alpha", EXPERIMENT_TRANSLATION)}
    return table(["", "κ = 6, nematic", "κ = 2, isotropic", "experiment, κ = 6"],
                 [[name, nematic.found(first), isotropic.found(second), experiment]
                  for name, (first, second, experiment) in kinds.items()])


def measure(build):
    nematic, isotropic = (Study(build, name) for name in ("glass_sweep", "glass_sweep_binary"))
    for study in (nematic, isotropic):
        study.check()
    order = isotropic.order()[1]
    expect(order < SMALLEST_NEMATIC, f"the companion is not isotropic: S up to {order:.2f}")
    seconds = nematic.seconds() + isotropic.seconds()
    expect(seconds < LONGEST, f"the study took {seconds / 7200:.1f} hours on two cores")
    low, high = nematic.order()
    return f"""\
Protocol: random insertion at φ = 0.3, growth in motion at a rate of 10⁻³ to the density, Brownian dynamics
(τ_B = 0.1, N = 500) for half the duration to age, then the duration. τ_α: F_s(q, t) = 1/e, at q = 3.2 for κ = 6 and
2.7 for κ = 2; τ_2: L_2(t) = 1/e, in a nematic of the connected part seen from the director. Only runs in equilibrium
enter the fits, of translation by the verdict of translation. Errors of φ_c are those of the fit and of the choice of
densities. Preparation and dynamics took {seconds / 7200:.1f} hours on two cores.

{comparison(nematic, isotropic)}

Equal ellipses of κ = 6 are nematic at every density of the study (S = {low:.2f} … {high:.2f}). There the mean squared
rotation stops because of order, and slow growth does not lead to an isotropic glass of orientations. What is left of
rotation, about the director, slows from τ_2 = {nematic.growth("tau_rotation")} between the lowest density and the
highest, places from τ_α = {nematic.growth("tau_translation")}. Order itself changes as slowly as the runs last, and
differs between seeds: there is no verdict of equilibrium at most densities, and no φ_θ. φ_T is what the power law says,
but its exponent is {nematic.exponent("translation, tau_alpha", "power law")}, where mode-coupling theory has no less
than 1.77, and Vogel and Fulcher's φ_T is another: that the first is near the experiment's is no evidence. The two stops
of the experiment are not on this path through the nematic.

Binary ellipses of κ = 2 stay isotropic (S ≤ {order:.2f}): what stops there is a glass. Orientations come first by the
power law, as in the experiment, but by less, and the laws differ by more than that: τ_2 grows
from {isotropic.growth("tau_rotation")} and τ_α from {isotropic.growth("tau_translation")}, and what still relaxes at the
highest density is above the power law's φ_θ. Exponents ({isotropic.exponent("translation, tau_alpha", "power law")} and
{isotropic.exponent("rotation, tau_2", "power law")}) are below 1.77 here, too: the growth is followed over two decades
in τ_2, and the laws are extrapolations from there. No two separate transitions are what other simulations of such
mixtures say (Xu et al. 2014); the mode-coupling density of binary disks of the same ratio is 0.795 (Weysser & Hajnal
2011).

### Ellipses of κ = 6

{nematic.text()}

### Two sizes of κ = 2, 1 : 1.4 in equal numbers

{isotropic.text()}
"""
