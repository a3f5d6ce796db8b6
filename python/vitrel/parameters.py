"""Settings as Python objects: the sections of the parameter file, and the tables in them.

Written by `vitrel params --python`; a test compares the two.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal, Mapping, Sequence, TypedDict

from .toml import Array, Keys, Numbers, Setting

__all__ = [
    "Gaussian", "Lognormal", "Uniform", "PowerLaw", "Species", "Insert", "Lattice", "Swell", "Compress", "Grow",
    "Hybrid", "Sample", "StateStage", "Duration", "Viscoelastic", "TableRestitution", "Pair", "Driving",
    "InitialVelocities", "Material", "LinearDashpot", "ViscoelasticContact", "Linear", "Logarithmic", "Correlations",
    "ImportSpecies", "Columns", "Structure", "Published"
]


class System(TypedDict, total=False):
    """The system. Units: kT = 1; a b = 1 and mass 1 for particles of size 1; time in √(m a b/kT).

    dimension: Space dimensions: 2 for ellipses, 3 for ellipsoids. Default: 2.
    particles: Number of particles. Default: 1000.
    packing_fraction: Fraction of the box covered by particles: the sum of π a b divided by the area (of 4π/3 a b
        c divided by the volume). It applies to the end of the preparation unless a reduced pressure ends it. Default:
        0.5.
    seed: Seed of all random numbers. Default: 1.
    draw: Distributed sizes and shapes: by quantiles, the species and their numbers of particles determine the list
        of all shapes, and the seed only who has which, so that runs with different seeds are of one liquid; at random,
        each seed draws its own, and what is measured scatters with them. Default: "quantiles".
    box_aspect: Ratio of height to width of the periodic box, L_y/L_x. In three dimensions [L_y/L_x, L_z/L_x], or
        one number for both. A lattice changes it so that whole cells fit. Default: 1.0.
    """

    dimension: int
    particles: int
    packing_fraction: float
    seed: int
    draw: Literal["quantiles", "random"]
    box_aspect: float | Numbers


@dataclass(kw_only=True)
class Gaussian(Setting):
    """Distribution from which the numbers are drawn, as a table instead of a number.

    mean: Mean.
    standard_deviation: Standard deviation of the values (not of their logarithms).
    minimum: No value is smaller: there the distribution is cut off.
    """

    _form: ClassVar = ("distribution", "gaussian")
    mean: float | None = None
    standard_deviation: float = 0.1
    minimum: float | None = None


@dataclass(kw_only=True)
class Lognormal(Setting):
    """Distribution from which the numbers are drawn, as a table instead of a number.

    mean: Mean.
    standard_deviation: Standard deviation of the values (not of their logarithms).
    minimum: No value is smaller: there the distribution is cut off.
    """

    _form: ClassVar = ("distribution", "lognormal")
    mean: float | None = None
    standard_deviation: float = 0.1
    minimum: float | None = None


@dataclass(kw_only=True)
class Uniform(Setting):
    """Distribution from which the numbers are drawn, as a table instead of a number.

    low: Lower bound.
    high: Upper bound.
    minimum: No value is smaller: there the distribution is cut off.
    """

    _form: ClassVar = ("distribution", "uniform")
    low: float | None = None
    high: float | None = None
    minimum: float | None = None


@dataclass(kw_only=True)
class PowerLaw(Setting):
    """Distribution from which the numbers are drawn, as a table instead of a number.

    low: Lower bound.
    high: Upper bound.
    exponent: Exponent of the density, ∝ x^exponent between the bounds.
    minimum: No value is smaller: there the distribution is cut off.
    """

    _form: ClassVar = ("distribution", "power_law")
    low: float | None = None
    high: float | None = None
    exponent: float = -3.0
    minimum: float | None = None


@dataclass(kw_only=True)
class Species(Setting):
    """A species of particles. A file may contain any number of species.

    name: Name in files and tables.
    fraction: Fraction of all particles; the fractions add up to 1. Counts are rounded by the largest-remainder
        method.
    aspect_ratio: κ = a/b ≥ 1, the ratio of major to minor semi-axis: a number or a distribution. In three
        dimensions it defines a prolate spheroid a : a/κ : a/κ.
    aspect_ratios: In three dimensions, instead of aspect_ratio: [R_1, R_2] for the semi-axes a : a/R_1 : a/R_2,
        each a positive number or a distribution like that of aspect_ratio.
    size: √(a b), or (a b c)^(1/3) in three dimensions: a number or a distribution; the default is 1. The
        reference species of size 1 defines the unit of length. Unit: length.
    first_semi_axis: Semi-axis a, instead of the size: a number or a distribution. The others are a/κ, or a/R_1 and
        a/R_2. With drawn aspect ratios all particles can thus have the same a. Unit: length.
    semi_axes: Instead of aspect ratios and size: semi-axes [a, b] with a ≥ b, or [a, b, c] in any order in three
        dimensions, each a number or a distribution like that of aspect_ratio. In the plane the larger of two draws is
        a. Unit: length.
    mass: Mass of every particle of this species. The default is a b (a b c), which gives all species the same
        density. Unit: mass.
    initial_temperature: Temperature of the velocities that are drawn at the start of a run; the default is 1. A
        species at 0 only drifts, so that the net momentum is 0. Unit: kT.
    """

    name: str = "A"
    fraction: float = 1.0
    aspect_ratio: float | Gaussian | Lognormal | Uniform | PowerLaw | Keys | None = None
    aspect_ratios: Sequence[float | Gaussian | Lognormal | Uniform | PowerLaw | Keys] | Array | None = None
    size: float | Gaussian | Lognormal | Uniform | PowerLaw | Keys | None = None
    first_semi_axis: float | Gaussian | Lognormal | Uniform | PowerLaw | Keys | None = None
    semi_axes: Sequence[float | Gaussian | Lognormal | Uniform | PowerLaw | Keys] | Array | None = None
    mass: float | None = None
    initial_temperature: float | None = None


@dataclass(kw_only=True)
class Insert(Setting):
    """Random positions without overlap, as a start at low density.

    packing_fraction: Packing fraction at the end of the stage. The default is that of the system, but at most 0.3
        (0.01 in three dimensions) for insert. There is no default for compress or if a reduced pressure is given.
    attempts: Random positions tried for one particle before the stage fails.
    orientations: Orientations before the particles move: random; aligned, all particles along x; in three
        dimensions planar, axes at random in the plane normal to z; or with a given orientation tensor. The axis is the
        axis of symmetry of a spheroid (the short one of an oblate) and the longest axis of a scalene ellipsoid, around
        which a particle is turned at random. Dynamics turn the particles further: to keep their orientations insert
        densely and grow fast.
    orientation_tensor: Mean ⟨u uᵀ⟩ over the axes u, as its diagonal or row by row, with the sum of the
        diagonal 1. The axes have the angular central Gaussian distribution.
    """

    _form: ClassVar = ("method", "insert")
    packing_fraction: float | None = None
    attempts: int = 1000000
    orientations: Literal["random", "aligned", "planar", "tensor"] = "random"
    orientation_tensor: Numbers | None = None


@dataclass(kw_only=True)
class Lattice(Setting):
    """Regular positions.

    packing_fraction: Packing fraction at the end of the stage. The default is that of the system, but at most 0.3
        (0.01 in three dimensions) for insert. There is no default for compress or if a reduced pressure is given.
    arrangement: Lattice type: square or triangular in two dimensions, the others in three. All but the square
        lattice are stretched like the particles, which lie along the axes of the box.
    angle: Angle from the x axis to the major axes; must be 0 on all but the square lattice. Unit: radians.
    """

    _form: ClassVar = ("method", "lattice")
    packing_fraction: float | None = None
    arrangement: Literal["square", "triangular", "simple_cubic", "face_centred_cubic", "body_centred_cubic"] = "square"
    angle: float = 0.0


@dataclass(kw_only=True)
class Swell(Setting):
    """Monte Carlo while the particles grow to the target packing fraction.

    packing_fraction: Packing fraction at the end of the stage. The default is that of the system, but at most 0.3
        (0.01 in three dimensions) for insert. There is no default for compress or if a reduced pressure is given.
    max_sweeps: Maximum number of sweeps to reach a packing fraction or a number of decorrelations.
    """

    _form: ClassVar = ("method", "swell")
    packing_fraction: float | None = None
    max_sweeps: int = 1000000


@dataclass(kw_only=True)
class Compress(Setting):
    """Monte Carlo at constant pressure, in a box of variable size.

    packing_fraction: Packing fraction at the end of the stage. The default is that of the system, but at most 0.3
        (0.01 in three dimensions) for insert. There is no default for compress or if a reduced pressure is given.
    max_sweeps: Maximum number of sweeps to reach a packing fraction or a number of decorrelations.
    pressure: βP, in units of the inverse unit of area (in three dimensions of volume). Unit: kT/area.
    box: Either all sides of the box change by a common factor (isotropic), or one side at a time does
        (anisotropic). The ratio of two sides stays within a factor of 2 of its initial value.
    sweeps: Number of sweeps. A sweep makes as many trial moves as there are particles. For compress, only without a
        packing fraction; for sample, only without a number of decorrelations.
    """

    _form: ClassVar = ("method", "compress")
    packing_fraction: float | None = None
    max_sweeps: int = 1000000
    pressure: float = 10.0
    box: Literal["isotropic", "anisotropic"] = "isotropic"
    sweeps: int = 1000


@dataclass(kw_only=True)
class Grow(Setting):
    """Event-driven dynamics while the particles grow to a packing fraction or until they jam.

    packing_fraction: Packing fraction at the end of the stage. The default is that of the system, but at most 0.3
        (0.01 in three dimensions) for insert. There is no default for compress or if a reduced pressure is given.
    reduced_pressure: βP/ρ at the end of the stage, at any packing fraction; use 1e6 or more for a jammed state.
        If a packing fraction is also given, the stage ends at whichever comes first.
    growth_rate: Relative growth of all lengths in the time in which a typical particle, the median, moves by its
        own size: √(m a b/kT), or √(m/kT) (a b c)^(1/3). Under slow growth the liquid can order and therefore jams
        at a higher packing fraction.
    retries: If the particles jam below the packing fraction, all lengths shrink by a tenth and grow again at half
        the rate, up to so many times.
    """

    _form: ClassVar = ("method", "grow")
    packing_fraction: float | None = None
    reduced_pressure: float | None = None
    growth_rate: float = 0.001
    retries: int = 5


@dataclass(kw_only=True)
class Hybrid(Setting):
    """Short intervals of event-driven growth that alternate with Monte Carlo.

    packing_fraction: Packing fraction at the end of the stage. The default is that of the system, but at most 0.3
        (0.01 in three dimensions) for insert. There is no default for compress or if a reduced pressure is given.
    reduced_pressure: βP/ρ at the end of the stage, at any packing fraction; use 1e6 or more for a jammed state.
        If a packing fraction is also given, the stage ends at whichever comes first.
    growth_rate: Relative growth of all lengths in the time in which a typical particle, the median, moves by its
        own size: √(m a b/kT), or √(m/kT) (a b c)^(1/3). Under slow growth the liquid can order and therefore jams
        at a higher packing fraction.
    stretch_sweeps: Monte Carlo sweeps after every interval of growth. An interval ends when all lengths have grown
        by 1 %, or by less at high pressure.
    moves: Monte Carlo moves: event chains, which relax density and positions many times faster, or local moves of
        one particle at a time, which can use several threads.
    exchanges: Exchanges of the places of two particles of different shape, as a share of the local moves, or per
        particle and sweep beside event chains. For a broad size distribution 0.2 relaxes dense liquids many times
        faster; for two very different sizes exchanges gain nothing.
    exchange_partners: How close in size the two are, as a share of the ranks of all sizes: 1 exchanges any two.
    collective_exchanges: Steps of collective exchanges per particle and sweep, in which places are given larger and
        larger particles until one does not fit. For sizes distributed continuously and one aspect ratio.
    """

    _form: ClassVar = ("method", "hybrid")
    packing_fraction: float | None = None
    reduced_pressure: float | None = None
    growth_rate: float = 0.001
    stretch_sweeps: int = 100
    moves: Literal["chains", "local"] = "chains"
    exchanges: float = 0.0
    exchange_partners: float = 1.0
    collective_exchanges: float = 0.0


@dataclass(kw_only=True)
class Sample(Setting):
    """Monte Carlo at constant packing fraction.

    max_sweeps: Maximum number of sweeps to reach a packing fraction or a number of decorrelations.
    sweeps: Number of sweeps. A sweep makes as many trial moves as there are particles. For compress, only without a
        packing fraction; for sample, only without a number of decorrelations.
    moves: Monte Carlo moves: event chains, which relax density and positions many times faster, or local moves of
        one particle at a time, which can use several threads.
    exchanges: Exchanges of the places of two particles of different shape, as a share of the local moves, or per
        particle and sweep beside event chains. For a broad size distribution 0.2 relaxes dense liquids many times
        faster; for two very different sizes exchanges gain nothing.
    exchange_partners: How close in size the two are, as a share of the ranks of all sizes: 1 exchanges any two.
    collective_exchanges: Steps of collective exchanges per particle and sweep, in which places are given larger and
        larger particles until one does not fit. For sizes distributed continuously and one aspect ratio.
    decorrelations: If above 0, sampling goes on until the state has decorrelated this often: until places,
        orientations and sizes, each place by place, have fallen to 1/e, again and again. From 10 on, the analysis of a
        run that starts from the state takes it for one in equilibrium.
    """

    _form: ClassVar = ("method", "sample")
    max_sweeps: int = 1000000
    sweeps: int = 1000
    moves: Literal["chains", "local"] = "chains"
    exchanges: float = 0.0
    exchange_partners: float = 1.0
    collective_exchanges: float = 0.0
    decorrelations: int = 0


@dataclass(kw_only=True)
class StateStage(Setting):
    """A state from a file, or from arrays in this file.

    box: Edges [L_x, L_y] or [L_x, L_y, L_z] of the box, centred at the origin, unless the file has it. Unit:
        length.
    file: A state or run, whose last frame is taken, of vitrel or another program: H5MD, GSD, extended XYZ, LAMMPS
        dump, LAMMPS data or CSV (docs/imports.md). Relative to the parameter file.
    on_overlap: Overlapping particles are an error, or all particles are scaled until the first two touch. Contacts
        of dense states stored in single precision become overlaps.
    positions: Instead of a file: the positions [x, y] or [x, y, z] of all particles. Unit: length.
    angles: In two dimensions: angles from the x axis to the major axes. The default is 0. Unit: radians.
    quaternions: In three dimensions: quaternions [w, x, y, z], which turn the axes of the bodies to those of space.
        The default is [1, 0, 0, 0].
    velocities: The default is 0. A run uses them with initial_velocities = "keep". Unit: length/time.
    angular_velocities: A number per particle, in three dimensions a vector [ω_x, ω_y, ω_z] in the axes of space.
        The default is 0. Unit: radians/time.
    semi_axes: Semi-axes [a, b] or [a, b, c] of every particle. By default those of its species. Unit: length.
    species: The name of every particle's species, if there are several.
    masses: The default is a b (a b c), or the mass of the species. Unit: mass.
    """

    _form: ClassVar = ("method", "state")
    box: Numbers | None = None
    file: str | None = None
    on_overlap: Literal["stop", "shrink"] = "stop"
    positions: Sequence[float | Numbers] | Array | None = None
    angles: Numbers | None = None
    quaternions: Sequence[float | Numbers] | Array | None = None
    velocities: Sequence[float | Numbers] | Array | None = None
    angular_velocities: Sequence[float | Numbers] | Array | None = None
    semi_axes: Sequence[float | Numbers] | Array | None = None
    species: Sequence[str] | Array | None = None
    masses: Numbers | None = None


class Prepare(TypedDict, total=False):
    """Preparation of the initial state by consecutive stages.

    quality_sweeps: Monte Carlo sweeps on a copy of the prepared state, in which `vitrel prepare` measures the
        pressure and time correlations of its quality report. With 0 the report omits both. The prepared state does not
        change. Default: 1000.
    stage: The first stage places the particles; later stages move them.
    """

    quality_sweeps: int
    stage: Sequence[Insert | Lattice | Swell | Compress | Grow | Hybrid | Sample | StateStage | Keys]


@dataclass(kw_only=True)
class Duration(Setting):
    """Duration of the sampled part of the run. As a table, the run ends as soon as it has lasted so many relaxation
    times.

    relaxation_times: The run ends after so many of the longer of the relaxation times of translation and, if
        particles are not round, rotation, as correlations on the fly give them. This is looked at after at_most/2,
        at_most/4 …
    at_most: Duration if the relaxation is slower. Unit: time.
    """

    relaxation_times: float = 20.0
    at_most: float = 100.0


@dataclass(kw_only=True)
class Viscoelastic(Setting):
    """Dependence on the approach speed of the surfaces: viscoelastic spheres, or a table.

    value: Coefficient at this speed; it tends to 1 for slow impacts.
    speed: The speed. Unit: speed.
    """

    _form: ClassVar = ("form", "viscoelastic")
    value: float = 1.0
    speed: float = 1.0


@dataclass(kw_only=True)
class TableRestitution(Setting):
    """Dependence on the approach speed of the surfaces: viscoelastic spheres, or a table.

    speeds: Speeds in ascending order. Unit: speed.
    values: Coefficients at these speeds: linear between them, constant outside.
    """

    _form: ClassVar = ("form", "table")
    speeds: Numbers = ()
    values: Numbers = ()


@dataclass(kw_only=True)
class Pair(Setting):
    """A pair of species whose contacts are different. What is not given is as for all pairs.

    first: Name of a species.
    second: Name of the other species, or of the same.
    restitution: As for all pairs.
    friction: As for all pairs.
    tangential_restitution: As for all pairs.
    """

    first: str = "A"
    second: str = "A"
    restitution: float | Viscoelastic | TableRestitution | Keys | None = None
    friction: float | None = None
    tangential_restitution: float | None = None


@dataclass(kw_only=True)
class Driving(Setting):
    """Random kicks of all particles, which conserve the momentum: homogeneous heating, for steady states of inelastic
    particles.

    interval: Time between kicks. It should be well below the time between collisions. Unit: time.
    power: Mean energy that a particle gains per unit of time. Unit: kT/time.
    """

    interval: float = 0.01
    power: float = 1.0


@dataclass(kw_only=True)
class InitialVelocities(Setting):
    """Equilibrium at kT = 1 (maxwell), the same energy entirely in translation or entirely in rotation, or the
    velocities of the initial state (keep). As a table, any split of the energy.

    translation: Share of the energy in translation; the rest is in rotation.
    """

    translation: float = 0.5


@dataclass(kw_only=True)
class Material(Setting):
    """The material of a species. What is not given is as for all. Different materials touch as bodies in series: each
    takes its share of the compression.

    species: Name of the species.
    stiffness: Of law = "linear_dashpot". Unit: N/m.
    damping: Of law = "linear_dashpot". Unit: kg/s.
    youngs_modulus: Of law = "viscoelastic". Unit: Pa.
    poissons_ratio: Of law = "viscoelastic".
    dissipative_time: Of law = "viscoelastic". Unit: s.
    """

    species: str = "A"
    stiffness: str | None = None
    damping: str | None = None
    youngs_modulus: str | None = None
    poissons_ratio: float | None = None
    dissipative_time: str | None = None


@dataclass(kw_only=True)
class LinearDashpot(Setting):
    """Contact force as a function of the compression ξ: spring and dashpot, k ξ + γ dξ/dt, or viscoelastic spheres,
    ρ (ξ + (3/2) A dξ/dt) √ξ with ρ = 2 Y √R_eff/(3 (1 − ν²)).

    radius: Radius of a particle of size 1. Unit: m.
    density: Density. A particle of mass 1 has the mass of a sphere of this radius and density. Unit: kg/m^3.
    thermal_speed: Thermal speed √(kT/m) of a particle of mass 1 at kT = 1. Unit: m/s.
    stiffness: Spring constant k. Unit: N/m.
    damping: Damping γ of the dashpot; "0 kg/s" for elastic particles. Unit: kg/s.
    coefficients: Source of the restitution matrix: a table that is computed once and kept in the user's cache
        folder, or a slower integration of every contact.
    early_release: A particle that is hit during a contact is released alone, as published, or together with its
        partner, which conserves the angular momentum.
    material: The material of a species. What is not given is as for all. Different materials touch as bodies in
        series: each takes its share of the compression.
    """

    _form: ClassVar = ("law", "linear_dashpot")
    radius: str = "0.1 m"
    density: str = "1140 kg/m^3"
    thermal_speed: str = "2 m/s"
    stiffness: str = "1000000 N/m"
    damping: str = "0 kg/s"
    coefficients: Literal["tabulated", "integrated"] = "tabulated"
    early_release: Literal["alone", "together"] = "alone"
    material: Sequence[Material | Keys] = ()


@dataclass(kw_only=True)
class ViscoelasticContact(Setting):
    """Contact force as a function of the compression ξ: spring and dashpot, k ξ + γ dξ/dt, or viscoelastic spheres,
    ρ (ξ + (3/2) A dξ/dt) √ξ with ρ = 2 Y √R_eff/(3 (1 − ν²)).

    radius: Radius of a particle of size 1. Unit: m.
    density: Density. A particle of mass 1 has the mass of a sphere of this radius and density. Unit: kg/m^3.
    thermal_speed: Thermal speed √(kT/m) of a particle of mass 1 at kT = 1. Unit: m/s.
    youngs_modulus: Young's modulus Y. Unit: Pa.
    poissons_ratio: Poisson's ratio ν.
    dissipative_time: Dissipative time A of the material; "0 s" for elastic particles. Unit: s.
    coefficients: Source of the restitution matrix: a table that is computed once and kept in the user's cache
        folder, or a slower integration of every contact.
    early_release: A particle that is hit during a contact is released alone, as published, or together with its
        partner, which conserves the angular momentum.
    material: The material of a species. What is not given is as for all. Different materials touch as bodies in
        series: each takes its share of the compression.
    """

    _form: ClassVar = ("law", "viscoelastic")
    radius: str = "0.1 m"
    density: str = "1140 kg/m^3"
    thermal_speed: str = "2 m/s"
    youngs_modulus: str = "1000000000 Pa"
    poissons_ratio: float = 0.4
    dissipative_time: str = "0 s"
    coefficients: Literal["tabulated", "integrated"] = "tabulated"
    early_release: Literal["alone", "together"] = "alone"
    material: Sequence[Material | Keys] = ()


class Dynamics(TypedDict, total=False):
    """Event-driven dynamics.

    kind: Free flight and collisions (newtonian), or the same with all velocities redrawn after every brownian_step
        (brownian). Default: "newtonian".
    brownian_step: Time τ_B between draws of the velocities. A free particle diffuses with D = kT τ_B/(2 m).
        Brownian dynamics only. Unit: time. Default: 0.1.
    equilibration: Duration of the run before sampling starts, at time 0. Unit: time. Default: 10.0.
    duration: Duration of the sampled part of the run. As a table, the run ends as soon as it has lasted so many
        relaxation times. Unit: time. Default: 100.0.
    restitution: Coefficient of normal restitution, from 0 to 1 (elastic). As a table, a function of the speed.
        Default: 1.0.
    friction: Coulomb's friction coefficient μ: 0 for smooth particles, inf for contacts that do not slip. Where
        there is friction, round particles spin, too. Default: 0.0.
    tangential_restitution: Coefficient β of rough contacts that do not slip: the tangential speed of the surfaces
        remains (-1), vanishes (0) or is reversed (1). Default: 0.0.
    pair: A pair of species whose contacts are different. What is not given is as for all pairs.
    contact_duration: Time t_c of the contact-time model: a collision that comes sooner after the one before of
        either particle is elastic and smooth, so that inelastic collapse does not stop the run; 0 for none. It should
        be well below the time between collisions. Unit: time. Default: 0.0.
    driving: Random kicks of all particles, which conserve the momentum: homogeneous heating, for steady states of
        inelastic particles.
    on_overlap: Action if two particles overlap: stop with exit code 4, or apply and count the correction move of
        the thesis. Default: "stop".
    temperature: Energy that corresponds to kT = 1 when velocities are drawn: a translational energy of N kT (total)
        or of (N − 1) kT (relative: the degrees of freedom that remain once the net momentum is removed). Default:
        "total".
    initial_velocities: Equilibrium at kT = 1 (maxwell), the same energy entirely in translation or entirely in
        rotation, or the velocities of the initial state (keep). As a table, any split of the energy. Default:
        "maxwell".
    rotation: Rotation of ellipsoids with three different semi-axes in free flight: by Euler's equations (euler), or
        about a constant angular velocity (constant), which is faster and has the same static averages. Preparation by
        growth keeps it constant. Default: "euler".
    contact: Contact force of soft particles, which must be round. Without this section particles are hard.
    """

    kind: Literal["newtonian", "brownian"]
    brownian_step: float
    equilibration: float
    duration: float | Duration | Keys
    restitution: float | Viscoelastic | TableRestitution | Keys
    friction: float
    tangential_restitution: float
    pair: Sequence[Pair | Keys]
    contact_duration: float
    driving: Driving | Keys | None
    on_overlap: Literal["stop", "correct"]
    temperature: Literal["total", "relative"]
    initial_velocities: Literal["maxwell", "translation", "rotation", "keep"] | InitialVelocities | Keys
    rotation: Literal["euler", "constant"]
    contact: LinearDashpot | ViscoelasticContact | Keys | None


@dataclass(kw_only=True)
class Linear(Setting):
    """Spacing of the sample times.

    interval: Time between samples. By default a 200th of dynamics.duration, but at least 0.1 (or all of a shorter
        run). Unit: time.
    """

    _form: ClassVar = ("spacing", "linear")
    interval: float | None = None


@dataclass(kw_only=True)
class Logarithmic(Setting):
    """Spacing of the sample times.

    first: First sample after the one at time 0. Unit: time.
    per_decade: Samples per factor of ten in time.
    """

    _form: ClassVar = ("spacing", "logarithmic")
    first: float = 0.01
    per_decade: int = 20


@dataclass(kw_only=True)
class Correlations(Setting):
    """Correlations measured during the run, from states that need not be written: displacement, rotation,
    self-scattering and orientation, over times from the interval to half the run, or longest_lag. The file has the name
    of the run with the suffix .correlations.h5. By default none are measured.

    interval: Time between correlated states; this is the shortest time difference. Unit: time.
    longest_lag: Longest time difference. The default is half the duration; a run that is made longer keeps that of
        its beginning. Unit: time.
    wave_numbers: Wave numbers q of the self-intermediate scattering functions F_s(q, t). If empty: approximately
        that of the main peak of the structure factor, 2π √(2ρ/√3) with the number density ρ. Unit: 1/length.
    """

    interval: float = 0.1
    longest_lag: float | None = None
    wave_numbers: Numbers = ()


class Output(TypedDict, total=False):
    """Output of a run.

    samples: Times at which the state is written to the trajectory.
    velocities: Whether the velocities of all particles are also written. Energies and pressure do not need them.
        Default: True.
    precision: Of the positions, angles and velocities that are written. In single precision the trajectory has
        about half the size and serves to be looked at and analysed; particles that touch may overlap in it by rounding.
        The run itself, and its checkpoint, are not rounded. Default: "double".
    correlations: Correlations measured during the run, from states that need not be written: displacement,
        rotation, self-scattering and orientation, over times from the interval to half the run, or longest_lag. The
        file has the name of the run with the suffix .correlations.h5. By default none are measured.
    checkpoint_interval: Time between checkpoints, from which an interrupted preparation or run continues. Unit:
        seconds of wall time. Default: 30.0.
    """

    samples: Linear | Logarithmic | Keys
    velocities: bool
    precision: Literal["double", "single"]
    correlations: Correlations | Keys | None
    checkpoint_interval: float


@dataclass(kw_only=True)
class ImportSpecies(Setting):
    """Sizes and masses of a species that the file does not have.

    name: The species, or type, as the file calls it.
    diameter: Of disks and spheres. Unit: as the file.
    semi_axes: [a, b] in the plane, [a, b, c] in space. Unit: as the file.
    mass: Of every particle. Unit: mass.
    """

    name: str = "A"
    diameter: float | None = None
    semi_axes: Numbers | None = None
    mass: float | None = None


@dataclass(kw_only=True)
class Columns(Setting):
    """A column of a table that has another name than vitrel's.

    file: The name of a column in CSV or a LAMMPS dump, or a property of XYZ.
    meaning: The column that it is (docs/imports.md), for example qw.
    """

    file: str = ""
    meaning: str = ""


class Import(TypedDict, total=False):
    """What runs of other programs leave open.

    format: The format of the file, which its content tells otherwise: H5MD, GSD, extended XYZ, LAMMPS dump, LAMMPS
        data or CSV.
    group: The group of particles in H5MD, if there are several.
    dimension: 2 or 3, if the file does not say.
    box: Edge lengths, if the file does not have them. Unit: as the file.
    time_per_step: Times are the steps of the file times this. Without it, files that have no times are analysed in
        steps. Unit: time.
    length_unit: All lengths of the file are divided by this, so that it becomes the unit. Unit: as the file.
        Default: 1.0.
    unwrap: How often particles crossed the box, which displacements need: as the file states, or by the nearest
        image from frame to frame where it does not. That is right if no particle moves by more than half a box length
        between frames. Default: "stated".
    angles: Whether orientations in the plane are those of bodies, or of directors, which are known up to half
        turns; those then must turn by less than a quarter turn between frames. Default: "turns".
    species: Sizes and masses of a species that the file does not have.
    columns: A column of a table that has another name than vitrel's.
    """

    format: str | None
    group: str | None
    dimension: int | None
    box: Numbers | None
    time_per_step: float | None
    length_unit: float
    unwrap: Literal["stated", "nearest"]
    angles: Literal["turns", "directors"]
    species: Sequence[ImportSpecies | Keys]
    columns: Sequence[Columns | Keys]


@dataclass(kw_only=True)
class Structure(Setting):
    """Structure factors, pair correlations and order parameters of single frames.

    frames: Maximum number of frames in averages; if there are more, they are thinned evenly, of more than 5000
        particles to 5000000 particles in all frames together, but not below 64 frames. 0: only the order of single
        frames, which the verdict on equilibrium needs.
    wave_number_max: Maximum wave number q of structure factors. Unit: 1/length.
    wave_number_step: Width of the q shells over which structure factors are averaged. Unit: 1/length.
    distance_max: Maximum distance of pair correlations; at most half the shorter side of the box. Unit: length.
    distance_step: Width of the distance bins. Unit: length.
    """

    frames: int = 1000
    wave_number_max: float = 12.0
    wave_number_step: float = 0.1
    distance_max: float = 20.0
    distance_step: float = 0.05


class Analysis(TypedDict, total=False):
    """Analysis of saved runs.

    only: The tables that are computed, by their names in `vitrel analyze --list`, separated by commas, such as
        "msd, fs". All if empty. Default: "".
    longest_lag: Longest time difference, as a fraction of an evenly sampled run. For other runs time differences
        extend to the end. Default: 0.5.
    every_lag_up_to: Up to this value every time difference is evaluated; beyond it they are spaced logarithmically.
        For runs that are not evenly sampled all are spaced logarithmically. Unit: sample intervals. Default: 100.
    lags_per_decade: Time differences per factor of ten in the logarithmic part. Default: 50.
    max_origins: Maximum number of time origins per time difference; if there are more, they are thinned evenly, of
        many particles to 2²¹ origins of all particles together, but not to less than a quarter of this number.
        Default: 4096.
    wave_numbers: Wave numbers q of the intermediate scattering functions. If empty: approximately that of the main
        peak of the structure factor, with the number density ρ 2π √(2ρ/√3), in space 2π √3 (ρ/4)^⅓. A
        sweep over packing fractions uses the highest density of its jobs for all of them. Unit: 1/length.
    orders: Orders n of the orientational correlations, ⟨cos n(θ(t) − θ(0))⟩ in the plane and Legendre's
        ⟨P_n(u(0)·u(t))⟩ in space. If empty: 2 and 4, in space 1 and 2.
    waiting_times: Waiting times since the first sample, each followed by correlations of its frame alone with all
        later ones: how a glass ages. Sample evenly for them. Unit: time.
    overlap_distance: Cutoff distance of the overlap function and the four-point susceptibility: a particle that has
        moved by less counts as immobile. Choose it somewhat larger than the rattling in a cage. Unit: length. Default:
        0.3.
    memory: Memory for particle tracks. Unit: bytes. Default: 1073741824.
    structure: Structure factors, pair correlations and order parameters of single frames.
    """

    only: str
    longest_lag: float
    every_lag_up_to: int
    lags_per_decade: int
    max_origins: int
    wave_numbers: Numbers
    orders: Numbers
    waiting_times: Numbers
    overlap_distance: float
    memory: int
    structure: Structure | Keys


@dataclass(kw_only=True)
class Published(Setting):
    """Results of a publication, which tables and charts of the sweep show beside its own. A file may contain any number
    of them.

    source: The publication, as legends name it.
    quantity: The column of the table of jobs with which the results are compared, for example wall_seconds.
    values: One for each step of [sweep.together], or without that, for each value of the first key of [sweep.grid].
        Unit: as the quantity.
    exponent: Instead of values: the power of the abscissa with which the quantity grows.
    from_: The exponent holds from here. Unit: as the abscissa.
    to: The exponent holds up to here. Unit: as the abscissa.
    """

    source: str = ""
    quantity: str = ""
    values: Numbers = ()
    exponent: float | None = None
    from_: float | None = None
    to: float | None = None


class Sweep(TypedDict, total=False):
    """Several runs from one file; or states, if no key of [dynamics] is given.

    ladder: A key of the grid or of those that advance together. The job with its first value prepares a state;
        every other one starts from the end of the job with the value before, and goes on with the stages that move
        particles.
    axis: The key that charts and tables of the sweep run along. The default is the one with the most values that
        are numbers, seeds apart.
    grid: Keys of this file in quotes, each with a list of values. Every combination of values is a job.
    together: Keys that advance together, each with the same number of values. The first values of all keys make a
        job, the second values the next, and so on. Together with a grid, each of these jobs is combined with every job
        of the grid. Jobs are named after the keys of the grid and the first of these keys, or as many as it takes to
        tell the jobs apart.
    published: Results of a publication, which tables and charts of the sweep show beside its own. A file may
        contain any number of them.
    """

    ladder: str | None
    axis: str | None
    grid: Mapping[str, Sequence[Any]]
    together: Mapping[str, Sequence[Any]]
    published: Sequence[Published | Keys]
