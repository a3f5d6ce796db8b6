"""Self-diffusion of hard spheres: how it depends on the size of the periodic box, and its limit for an infinite one."""

import concurrent.futures
import math
import pathlib
import statistics
import tempfile

from validation.common import PARAMS, expect, settings, summary_of, table

TITLE = "Self-diffusion of hard spheres"
PARAMETERS = PARAMS / "self_diffusion.toml"
SIGMA = 2  # diameter of a sphere of size 1; its mass and kT are 1

# Of the sum over the images of a particle in a cubic box (Dünweg & Kremer 1993, Yeh & Hummer 2004).
LATTICE_SUM = 2.837297
SLOPE_TOLERANCE = 0.15
# Smaller boxes change the structure of the fluid, so that hydrodynamics is not all. Their Z differs by more than this,
# relatively, from that of the largest box; they are not fitted.
FINITE_SIZE = 0.005
# χ² of the line for so many degrees of freedom: sizes less two coefficients. More has a probability of 0.1 %.
LARGEST_CHI_SQUARE = {2: 13.8, 3: 16.3}
# Speedy (1987) describes simulations of about this many particles.
SPEEDY_PARTICLES, SPEEDY_TOLERANCE = 500, 0.02

# The viscosity comes from runs of their own, of this many particles and these seeds.
PARTICLES, SEEDS = 1372, range(11, 23)
# Packing fraction: sample interval and duration.
SAMPLING = {0.3: (1, 3000), 0.49: (4, 3000)}


def number_density(phi):
    return phi / (math.pi / 6 * SIGMA**3)


def contact_value(phi):
    """g(σ) by Carnahan and Starling."""
    return (1 - phi / 2) / (1 - phi) ** 3


def enskog_diffusion(phi):
    return 1.01896 * 3 / (8 * number_density(phi) * SIGMA**2 * math.sqrt(math.pi) * contact_value(phi))


def enskog_viscosity(phi):
    dilute = 1.016 * 5 / (16 * SIGMA**2 * math.sqrt(math.pi))
    g, co_volume = contact_value(phi), 4 * phi
    return dilute * (1 / g + 0.8 * co_volume + 0.761 * co_volume**2 * g)


def speedy_diffusion(phi):
    n = number_density(phi) * SIGMA**3
    dilute = 3 / 8 * SIGMA / math.sqrt(math.pi)
    return dilute / n * (1 - n / 1.09) * (1 + n**2 * (0.4 - 0.83 * n**2))


# Diffusion

class Diffusion:
    """D of one system: the mean over its seeds, with the error from those of the runs."""

    def __init__(self, jobs):
        for job in jobs:
            found = job["analyze"]
            expect(job["run"]["overlaps"] == 0, f"{job['id']}: overlaps")
            expect(found["diffusion"] is not None, f"{job['id']}: no diffusion coefficient")
        runs = [job["analyze"] for job in jobs]
        self.particles, self.length = runs[0]["particles"], runs[0]["box_x"]
        self.value = statistics.mean(run["diffusion"] for run in runs)
        self.error = math.hypot(*(run["diffusion_error"] for run in runs)) / len(runs)
        self.compressibility = statistics.mean(run["compressibility_factor"] for run in runs)
        self.collisions = sum(run["collisions"] for run in runs)
        self.window = min(run["diffusion_from"] for run in runs), max(run["diffusion_from"] for run in runs)


def diffusion_coefficients(build):
    """For every packing fraction, the coefficients in the order of the number of particles."""
    with tempfile.TemporaryDirectory() as folder:
        jobs = summary_of(build, "sweep", PARAMETERS, "-o", folder, "-j", "2", "--quiet")["jobs"]
    systems = {}
    for job in jobs:
        key = job["values"]["system.packing_fraction"], job["values"]["system.particles"]
        systems.setdefault(key, []).append(job)
    return {phi: [Diffusion(systems[key]) for key in sorted(systems) if key[0] == phi] for phi in SAMPLING}


def bulk_like(points):
    """Those with the pressure of the largest system, which is the last."""
    return [p for p in points if abs(p.compressibility / points[-1].compressibility - 1) <= FINITE_SIZE]


class Line:
    """The weighted least-squares line D(L) = limit + slope/L."""

    def __init__(self, points):
        weights = [1 / p.error**2 for p in points]
        inverse = [1 / p.length for p in points]
        total = sum(weights)
        mean = sum(w * x for w, x in zip(weights, inverse)) / total
        spread = sum(w * (x - mean) ** 2 for w, x in zip(weights, inverse))
        self.slope = sum(w * (x - mean) * p.value for w, x, p in zip(weights, inverse, points)) / spread
        self.limit = sum(w * p.value for w, p in zip(weights, points)) / total - self.slope * mean
        self.slope_error = spread**-0.5
        self.limit_error = math.sqrt(1 / total + mean**2 / spread)
        self.chi_square = sum(w * (p.value - self.at(p.length)) ** 2 for w, p in zip(weights, points))
        self.degrees = len(points) - 2

    def at(self, length):
        return self.limit + self.slope / length


# Viscosity

def viscosity_of_run(build, phi, seed):
    """What `vitrel analyze` gives for it, and its standard error."""
    interval, duration = SAMPLING[phi]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "run.h5")
        summary_of(build, "run", PARAMETERS, "-o", file, *settings((
            f"system.packing_fraction={phi}", f"system.particles={PARTICLES}", f"system.seed={seed}",
            f"dynamics.duration={duration}", f"output.samples.interval={interval}")))
        found = summary_of(build, "analyze", file, "--only", "viscosity")
    expect(found["viscosity"] is not None, f"φ = {phi}, seed {seed}: no viscosity")
    return found["viscosity"], found["viscosity_error"]


def viscosity(build, phi):
    """The mean over the runs, with the error from those of the runs."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        values, errors = zip(*pool.map(lambda seed: viscosity_of_run(build, phi, seed), SEEDS))
    return statistics.mean(values), math.hypot(*errors) / len(errors)


# The page

def diffusion_rows(phi, points, line):
    for p in points:
        residual = f"{(p.value - line.at(p.length)) / p.error:+.1f}"
        yield [f"{phi:g}", p.particles, f"{p.length:.2f}", f"{p.compressibility:.3f}", f"{p.value:.5f} ± {p.error:.5f}",
               residual if p in bulk_like(points) else f"({residual})", f"{p.value / enskog_diffusion(phi):.3f}",
               f"{p.window[0]:.3g} … {p.window[1]:.3g}", f"{p.collisions:.1e}"]


def slope_row(build, phi, points, line):
    eta, eta_error = viscosity(build, phi)
    predicted = -LATTICE_SUM / (6 * math.pi * eta)
    ratio = line.slope / predicted
    error = ratio * math.hypot(line.slope_error / line.slope, eta_error / eta)
    expect(line.chi_square <= LARGEST_CHI_SQUARE[line.degrees], f"φ = {phi}: χ² = {line.chi_square:.1f}")
    expect(abs(ratio - 1) <= SLOPE_TOLERANCE,
           f"φ = {phi}: D(L) has the slope {line.slope:.4f} ± {line.slope_error:.4f}, {ratio:.3f} ± {error:.3f} times that "
           f"of hydrodynamics with the viscosity {eta:.3f} ± {eta_error:.3f}")
    return [f"{phi:g}", f"{line.limit:.5f} ± {line.limit_error:.5f}", f"{line.limit / enskog_diffusion(phi):.3f}",
            f"{line.chi_square:.1f}", line.degrees, f"{line.slope:.4f} ± {line.slope_error:.4f}",
            f"{Line(points).slope:.4f}", f"{eta:.3f} ± {eta_error:.3f}", f"{eta / enskog_viscosity(phi):.3f}",
            f"{predicted:.4f}", f"{ratio:.3f} ± {error:.3f}"]


def speedy_row(phi, points):
    found, = (p for p in points if p.particles == SPEEDY_PARTICLES)
    fit = speedy_diffusion(phi)
    expect(abs(found.value / fit - 1) <= SPEEDY_TOLERANCE, f"φ = {phi}: D = {found.value}, by Speedy {fit}")
    return [f"{phi:g}", f"{found.value:.5f} ± {found.error:.5f}", f"{fit:.5f}", f"{found.value / fit - 1:+.2%}"]


def measure(build):
    points = diffusion_coefficients(build)
    lines = {phi: Line(bulk_like(of_phi)) for phi, of_phi in points.items()}
    rows = [row for phi in points for row in diffusion_rows(phi, points[phi], lines[phi])]
    slopes = [slope_row(build, phi, points[phi], line) for phi, line in lines.items()]
    comparison = [speedy_row(phi, of_phi) for phi, of_phi in points.items()]
    return f"""\
`params/self_diffusion.toml`: elastic Newtonian hard spheres of radius 1 in a cube of side L, two runs of every system. D is
the slope of the mean squared displacement that `vitrel analyze` reports, with its standard error. The fit starts at the time
in the column *from* (of both runs): about three times τ = (L/2π)²/(η/(ρ m) + D), in which the slowest shear modes of the box
decay, or more, and at least 3, when particles have left their cages. By mode-coupling theory these modes have yet to add
4 τ e⁻³ kT/(N m) to D after 3 τ: at φ = 0.3 this is 0.6 % for N = 108 and 0.2 % for N = 4000, and less later in the fit.
D_E is the Enskog theory with the contact value of Carnahan and Starling (1969).

The line D(L) = D(∞) + s/L, linear in N^(−1/3), is fitted with weights; the column *residual* is in standard errors. The law
assumes that the box leaves the structure of the fluid unchanged. Systems whose compressibility factor Z differs by more than
{FINITE_SIZE:.1%} from that of the largest are therefore not fitted; their residuals are in parentheses. This
condition was added after a first run, in which the line through all sizes at φ = 0.49 was 16 % too steep; *s, all sizes* is
the slope of that line in this run.

The centre of mass is at rest, so displacements are relative to it, and kT = 1 refers to the remaining 3(N − 1) degrees of
freedom. No factor N/(N − 1) is applied: the conserved momentum subtracts kT/(N m) from the velocity correlation at all times,
which is the term k = 0 that the hydrodynamic sum over wave vectors leaves out, so it is part of s.

{table(["φ", "N", "L", "Z", "D", "residual", "D/D_E", "from", "collisions"], rows)}

Hydrodynamics predicts s = −{LATTICE_SUM} kT/(6π η) (Dünweg and Kremer 1993; Yeh and Hummer 2004). The viscosity η is measured in
other runs, {len(SEEDS)} of {PARTICLES} spheres each, by `vitrel analyze --only viscosity` from the Helfand moments of the stress.
η_E is the viscosity of the Enskog theory. The runs and the method have nothing in common with the displacements except the
dynamics. Required: a ratio of the slopes within {SLOPE_TOLERANCE:.0%} of 1, and χ² below
{" or ".join(f"{limit:g} ({degrees} degrees of freedom)" for degrees, limit in LARGEST_CHI_SQUARE.items())}; false-alarm rate of χ²: 0.1 % per row.

{table(["φ", "D(∞)", "D(∞)/D_E", "χ²", "degrees of freedom", "s", "s, all sizes", "η", "η/η_E", "s, hydrodynamic", "ratio"], slopes)}

The fit of Speedy (1987) to earlier simulations of about {SPEEDY_PARTICLES} particles, compared with the system of that size. Required:
agreement within {SPEEDY_TOLERANCE:.0%}.

{table(["φ", f"D, N = {SPEEDY_PARTICLES}", "Speedy", "difference"], comparison)}
"""
