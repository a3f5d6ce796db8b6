"""The glass transition of ellipses: relaxation times over the density, order or glass, and the fits of φ_c."""

import json

import h5py

from validation.common import PARAMS, ROOT, expect, output_of, summary_of, table

TITLE = "The glass transition of ellipses"
FOLDER = ROOT / "out" / "glass"  # kept, so that a study that was stopped goes on
VERDICTS = ("equilibrated", "ageing", "not enough time")
ORIENTATIONS = ("round", "relaxes", "nematic order", "frozen")
KINDS = ("translation, τ_α", "rotation, τ_2", "rotation in the nematic, τ_2", "diffusion, 1/D",
         "rotational diffusion, 1/D_r")
LAWS = ("power law", "Vogel–Fulcher")
# Where the experiment on monolayers of κ = 6 (Zheng, Wang & Han 2011) sees translation and rotation stop.
EXPERIMENT = {0: 0.79, 1: 0.72, 2: 0.72, 3: 0.79, 4: 0.72}
SMALLEST_NEMATIC = 0.5
LONGEST = 4 * 3600 * 2  # seconds of one core


def columns(results, name):
    """The columns of a table of results by name; that of the errors of x is x_error."""
    group = results[name]
    return {key: group[key][:] for key in group}


def number(value, error=None, digits=3):
    if value != value:
        return "–"
    text = f"{value:.{digits}g}"
    return text if error is None or error != error else f"{text} ± {error:.1g}"


class Study:
    """One sweep: run or continued, analysed and read."""

    def __init__(self, build, name):
        self.name, self.folder = name, FOLDER / name
        FOLDER.mkdir(parents=True, exist_ok=True)
        summary_of(build, "sweep", PARAMS / f"{name}.toml", "-o", self.folder, "-j", "2", "--quiet")
        summary_of(build, "analyze", self.folder, "--quiet")
        output_of([build / "app/vitrel", "report", self.folder, "--quiet"])
        self.jobs = [json.loads(path.read_text()) for path in sorted(self.folder.glob("*/done.json"))]
        with h5py.File(self.folder / "results.h5") as results:
            self.runs, self.fits = columns(results, "relaxation"), columns(results, "glass_fit")

    def seconds(self):
        return sum(job[step]["wall_seconds"] for job in self.jobs for step in ("prepare", "run"))

    def check(self):
        expect(len(self.jobs) == len(self.runs["packing_fraction"]), f"{self.name}: a run could not be judged")
        for job in self.jobs:
            expect(job["run"]["overlaps"] == 0, f"{self.name}, {job['id']}: overlaps")

    def rows(self):
        r = self.runs
        return [[f"{r['packing_fraction'][k]:.2f}", f"{r['seed'][k]:.0f}", f"{r['duration'][k]:.0f}",
                 number(r["nematic_order"][k], r["nematic_order_error"][k], 2),
                 number(r["tau_translation"][k], r["tau_translation_error"][k]),
                 number(r["tau_rotation"][k], r["tau_rotation_error"][k]),
                 ORIENTATIONS[int(r["orientation"][k])],
                 VERDICTS[int(r["verdict_translation"][k])], VERDICTS[int(r["verdict"][k])]]
                for k in range(len(r["seed"]))]

    def fit_rows(self):
        f = self.fits
        rows = []
        for k, kind in enumerate(map(int, f["kind"])):
            found, bounded = f["verdict"][k] == 0, f["verdict"][k] == 1
            phi = (f"{f['phi_c'][k]:.3f} ± {f['phi_c_error'][k]:.3f}" if found else
                   f"> {f['phi_c_least'][k]:.3f}" if bounded else "–")
            rows.append([KINDS[kind], LAWS[int(f["law"][k])], phi, number(f["exponent"][k], f["exponent_error"][k]),
                         f"{f['window_low'][k]:.2f} … {f['window_high'][k]:.2f}" if found or bounded else "–",
                         number(f["chi2"][k] / f["dof"][k], digits=2) if f["dof"][k] > 0 else "–",
                         EXPERIMENT[kind]])
        return rows

    def text(self):
        runs = table(["φ", "seed", "duration", "S", "τ_α", "τ_2", "orientation", "places", "all"], self.rows())
        fits = table(["kind", "law", "φ_c", "exponent", "densities", "χ²/dof", "experiment, κ = 6"], self.fit_rows())
        return f"{runs}\n\n{fits}"


def measure(build):
    nematic, isotropic = (Study(build, name) for name in ("glass_sweep", "glass_sweep_binary"))
    for study in (nematic, isotropic):
        study.check()
    order = isotropic.runs["nematic_order"]
    expect(max(order) < SMALLEST_NEMATIC, f"the companion is not isotropic: S up to {max(order):.2f}")
    seconds = nematic.seconds() + isotropic.seconds()
    expect(seconds < LONGEST, f"the study took {seconds / 7200:.1f} hours on two cores")
    return f"""\
Protocol: random insertion at φ = 0.3, growth in motion at a rate of 10⁻³ to the density, Brownian dynamics
(τ_B = 0.1, N = 500) for half the duration to age, then the duration. τ_α: F_s(q, t) = 1/e at the main peak; τ_2:
L_2(t) = 1/e, in a nematic of the connected part. Only equilibrated runs enter the fits. Errors of φ_c are those
of the fit and of the choice of densities. Preparation and dynamics took {seconds / 7200:.1f} hours on two cores.

### Ellipses of κ = 6

{nematic.text()}

### Two sizes of κ = 2, 1 : 1.4 in equal numbers

{isotropic.text()}
"""
