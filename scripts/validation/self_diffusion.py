"""`params/self_diffusion.toml`: elastic Newtonian hard spheres of radius 1 in a cube of side L, two runs of every
system. D is the slope of the mean squared displacement that `vitrel analyze` reports, with its standard error. The fit
starts at the time in the column *from*: about three times τ = (L/2π)²/(η/(ρ m) + D), in which the slowest shear modes
of the box decay, or more, and at least 3, when particles have left their cages. By mode-coupling theory these modes
have yet to add 4 τ e⁻³ kT/(N m) to D after 3 τ: at φ = 0.3 this is 0.6 % for N = 108 and 0.2 % for N = 4000, and less
later in the fit. D_E is the Enskog theory with the contact value of Carnahan and Starling (1969).

The line D(L) = D(∞) + s/L, linear in N^(−1/3), is fitted with weights; the column *residual* is in standard errors. The
law assumes that the box leaves the structure of the fluid unchanged. Systems whose compressibility factor Z differs by
more than {FINITE_SIZE:.1%} from that of the largest are therefore not fitted; their residuals are in parentheses. This
condition was added after a first run, in which the line through all sizes at φ = 0.49 was 16 % too steep; *s, all
sizes* is the slope of that line in this run.

The centre of mass is at rest, so displacements are relative to it, and kT = 1 refers to the remaining 3(N − 1) degrees
of freedom. No factor N/(N − 1) is applied: the conserved momentum subtracts kT/(N m) from the velocity correlation at
all times, which is the term k = 0 that the hydrodynamic sum over wave vectors leaves out, so it is part of s.

{diffusion}

Hydrodynamics predicts s = −{VALUES[lattice_sum]} kT/(6π η) (Dünweg and Kremer 1993; Yeh and Hummer 2004). The viscosity
η is measured in other runs, {seeds} of {PARTICLES} spheres each, from the Helfand moments of the stress. η_E is the
viscosity of the Enskog theory. The runs and the method have nothing in common with the displacements except the
dynamics. Required: a ratio of the slopes within {SLOPE_TOLERANCE:.0%} of 1, and χ² below {LARGEST_CHI_SQUARE[2]} (2
degrees of freedom) or {LARGEST_CHI_SQUARE[3]} (3); false-alarm rate of χ²: 0.1 % per row.

{slopes}

The fit of Speedy (1987) to earlier simulations of about {SPEEDY_PARTICLES} particles, compared with the system of that
size. Required: agreement within {SPEEDY_TOLERANCE:.0%}.

{speedy}
"""

import dataclasses
import math

from validation.common import PARAMS, Estimate, expect, table
from validation.comparison import Compared, Scenes, Tolerance, compared
from validation.literature import VALUES, enskog_diffusion, enskog_viscosity, speedy_diffusion

TITLE = "Self-diffusion of hard spheres"
INPUTS = ["edmd", "core", "analysis", "params/self_diffusion.toml", "scripts/validation/literature.py"]

SLOPE_TOLERANCE = 0.15
FINITE_SIZE = 0.005  # smaller boxes change the structure of the fluid, so that hydrodynamics is not all
LARGEST_CHI_SQUARE = {2: 13.8, 3: 16.3}  # by the degrees of freedom: sizes less two coefficients
SPEEDY_PARTICLES, SPEEDY_TOLERANCE = 500, 0.02

PHI, PARTICLES = "system.packing_fraction", 1372
SCENES = Scenes(PARAMS / "self_diffusion.toml")
VISCOSITY = Scenes(
    PARAMS / "self_diffusion.toml", settings=(f"system.particles={PARTICLES}", 'analysis.only="viscosity"'),
    rows=tuple({PHI: phi, "dynamics.duration": 3000, "output.samples.interval": interval}
               for phi, interval in ((0.3, 1), (0.49, 4))),
    seeds=range(11, 23))


@dataclasses.dataclass(frozen=True)
class Diffusion:
    """D of one system."""

    phi: float
    particles: int
    length: float
    value: float
    error: float
    compressibility: float
    begin: float  # of the fit

    @classmethod
    def of(cls, scene):
        mean = scene.stated_mean("analyze.diffusion")
        return cls(scene[PHI], scene["system.particles"], scene.every("analyze.box_x")[0], *mean,
                   scene.mean("analyze.compressibility_factor").mean, min(scene.every("analyze.diffusion_from")))

    @property
    def estimate(self):
        return Estimate(self.value, self.error)


def bulk_like(points):
    """Those with the pressure of the largest system, which is the last."""
    return [p for p in points if abs(p.compressibility / points[-1].compressibility - 1) <= FINITE_SIZE]


class Line:
    """The weighted least-squares line D(L) = limit + slope/L."""

    def __init__(self, points):
        import numpy  # only here: a test imports all validations

        x, y, error = numpy.array([(1 / p.length, p.value, p.error) for p in points]).T
        (self.slope, self.limit), covariance = numpy.polyfit(x, y, 1, w=1 / error, cov="unscaled")
        self.slope_error, self.limit_error = numpy.sqrt(numpy.diag(covariance))
        self.chi_square = (((y - self.limit - self.slope * x) / error) ** 2).sum()
        self.degrees = len(points) - 2

    def at(self, length):
        return self.limit + self.slope / length


def diffusion_rows(points):
    fitted = bulk_like(points)
    line = Line(fitted)
    for p in points:
        residual = f"{(p.value - line.at(p.length)) / p.error:+.1f}"
        yield [p.phi, p.particles, f"{p.length:.2f}", f"{p.compressibility:.3f}", p.estimate,
               residual if p in fitted else f"({residual})", f"{p.value / enskog_diffusion(p.phi):.3f}", f"{p.begin:.3g}"]


def slope_row(points, eta):
    phi, line = points[0].phi, Line(bulk_like(points))
    expect(line.chi_square <= LARGEST_CHI_SQUARE[line.degrees], f"φ = {phi}: χ² = {line.chi_square:.1f}")
    predicted = -VALUES["lattice_sum"] / (6 * math.pi * eta.mean)
    slopes = compared(f"φ = {phi}: slope", Estimate(line.slope, line.slope_error),
                      Estimate(predicted, abs(predicted) * eta.error / eta.mean), Tolerance(0, SLOPE_TOLERANCE))
    return [phi, Estimate(line.limit, line.limit_error), f"{line.chi_square:.1f}", f"{Line(points).slope:.4f}", eta,
            f"{eta.mean / enskog_viscosity(phi):.3f}", *slopes.cells()]


def speedy_row(points):
    found, = (p for p in points if p.particles == SPEEDY_PARTICLES)
    return [found.phi, *compared(f"φ = {found.phi}: D", found.estimate, speedy_diffusion(found.phi),
                                 Tolerance(0, SPEEDY_TOLERANCE)).cells()]


def measure(build):
    points = sorted(map(Diffusion.of, SCENES.run(build)), key=lambda p: (p.phi, p.particles))
    viscosity = {scene[PHI]: scene.stated_mean("analyze.viscosity") for scene in VISCOSITY.run(build)}
    of_phi = {phi: [p for p in points if p.phi == phi] for phi in viscosity}
    return {
        "seeds": len(VISCOSITY.seeds),
        "diffusion": table(["φ", "N", "L", "Z", "D", "residual", "D/D_E", "from"],
                           [row for some in of_phi.values() for row in diffusion_rows(some)]),
        "slopes": table(["φ", "D(∞)", "χ²", "s, all sizes", "η", "η/η_E", "s, hydrodynamic", "s, measured", *Compared.HEAD[2:]],
                        [slope_row(some, viscosity[phi]) for phi, some in of_phi.items()]),
        "speedy": table(["φ", "D, Speedy", "D, measured", *Compared.HEAD[2:]], map(speedy_row, of_phi.values()))}
