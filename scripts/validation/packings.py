"""Ellipsoids with semi-axes a : a/R_1 : a/R_2 are inserted at random in a periodic cube at 1 % (or less) and grow
during event-driven dynamics. `vitrel sweep` runs the files `ghossein_*.toml` of `params/articles`, one job at a time.
The growth rate, of all lengths per unit of time, is that of the table, otherwise 0.1. The exact check (tolerance zero)
tests every packing; the volume fraction agrees with the target to 1e-11. Seconds are those of the whole preparation, on
one core of {processor}; the published ones were measured with MATLAB at 1.6 GHz. The table lists means of ten runs with
standard errors, and the ρ of as many random directions (*random ρ*). The target volume fractions are the maximum values
of the article. The last column lists the maximum reached by vitrel: the mean of three packings grown at the rate
{SLOW_RATE:g} to a reduced pressure of 10⁶, required to be no lower. There Z ≈ 6/(1 − φ/φ_J), so the fraction is 6
millionths below its limit. The article stops when 50 iterations gain less than 0.1 %.

{article}

Where ρ exceeds its random value, neighbours are aligned. Platelets of aspect ratio 20 and above are nematic at these
fractions in equilibrium; at higher growth rates they jam before reaching them. The packings as a whole are isotropic:
required is that with eight times as many particles ρ − 1 decreases by a factor of 2, or that ρ is the random one. The
expected factor is √8 = 2.8; in an ordered packing ρ − 1 would not decrease.

{larger}

Jammed packings of 1000 particles at the same reduced pressure, five seeds, must be as dense as in the literature. The
contacts are per particle and without rattlers. Spheres have the isostatic number, but for some 2 % of neighbours that
nearly touch; ellipsoids have fewer (Donev et al. 2007).

{jammed}

The packings of figures 2 to 5 are those of `ghossein_figure_2.toml` to `_5`. `vitrel report` draws ρ, which approaches
1 as the number of particles increases (`ghossein_figure_6.toml`), and the times against number, volume fraction and
aspect ratio (`ghossein_figure_7.toml` to `_9`), with their exponents beside those of the article: 1.03 beside 1.5, 0.8
beside 2.6, and 0.9 beside 0.6 up to R = 10 and 2.8 beyond (commit 91c266f).
"""

import tomllib

from validation.common import PARAMS, expect, processor, table
from validation.comparison import Scenes
from validation.literature import VALUES

TITLE = "Random periodic packings of ellipsoids"
INPUTS = ["edmd", "core", "workflow/stages", "params/articles"]
TABLE_2 = "ghossein_table_2"

RATIOS, PARTICLES, PHI = "species.0.aspect_ratios", "system.particles", "system.packing_fraction"
RATE = "prepare.stage.1.growth_rate"
SLOW_RATE, JAMMING_RATE = 0.01, 0.003
UNTIL_JAMMED = "prepare.stage.1.reduced_pressure=1e6"
NEAR_CONTACTS = 0.05  # of the isostatic number; neighbours that nearly touch (analysis/structure/contacts.h)


def parameters_of(name):
    return tomllib.loads((PARAMS / "articles" / f"{name}.toml").read_text(encoding="utf-8"))


def article(name, *settings, **changes):
    """The scenes of params/articles/<name>.toml."""
    return Scenes(PARAMS / "articles" / f"{name}.toml", ("sweep.published=[]", *settings), parallel=1, **changes)


def check_fraction(scene):
    """The volume fraction must be the one that is given."""
    for reached in scene.every("prepare.packing_fraction"):
        expect(abs(reached / scene[PHI] - 1) < 1e-11, f"{scene}: reached {reached}")


def filled(build, scenes):
    found = scenes.run(build)
    for scene in found:
        check_fraction(scene)
    return found


def means(scene, *names):
    return [scene.mean(f"prepare.{name}") for name in names]


def article_rows(packings, densest):
    """The rows of the article, with the maximum volume fractions that vitrel reaches."""
    published, = parameters_of(TABLE_2)["sweep"]["published"]
    for scene, dense, seconds in zip(packings, densest, published["values"], strict=True):
        for reached in dense.every("prepare.packing_fraction"):
            expect(reached >= scene[PHI], f"{dense}: jammed at {reached}, below {scene[PHI]}")
        ratio, isotropic, measured = means(scene, "orientation_ratio", "isotropic_ratio", "wall_seconds")
        r1, r2 = scene[RATIOS]
        yield ["prolate" if r1 == r2 else "oblate", r1, scene[PARTICLES], f"{scene[PHI]:.0%}", scene[RATE], ratio,
               f"{isotropic.mean:.2f}", seconds, measured, f"{seconds / measured.mean:.0f}",
               f"{dense.mean('prepare.packing_fraction').mean:.3f}"]


def larger_rows(packings, larger):
    """In isotropic packings of correlated particles ρ − 1 ∝ N^(−1/2); in ordered ones it is independent of N."""
    for small, large in zip(packings, larger, strict=True):
        (ratio, ), (ratio_8, isotropic) = means(small, "orientation_ratio"), means(large, "orientation_ratio", "isotropic_ratio")
        decrease = (ratio.mean - 1) / (ratio_8.mean - 1)
        expect(decrease > 2 or ratio_8.mean - 2 * ratio_8.error <= isotropic.mean, f"{small}: ρ = {ratio}, then {ratio_8}")
        yield [small[RATIOS], f"{small[PHI]:.0%}", small[PARTICLES], ratio, ratio_8, f"{decrease:.1f}"]


def larger_packings(packings):
    """Those whose ρ exceeds the random one, with eight times as many particles."""
    chosen = [scene for scene in packings if scene[RATIOS][1] == 1 or scene[RATIOS][0] == 5]
    return chosen, article(TABLE_2, rows=tuple({**scene.values, PARTICLES: 8 * scene[PARTICLES]} for scene in chosen))


def jammed_row(known, scene):
    name, lowest, highest = known["name"], known["lowest"], known["highest"]
    fraction, contacts, isostatic, rattlers, seconds = means(scene, "packing_fraction", "contact_number", "isostatic_number",
                                                             "rattlers", "wall_seconds")
    expect(lowest <= fraction.mean <= highest, f"{name}: jammed at {fraction}, not between {lowest} and {highest}")
    expect(contacts.mean < (1 + NEAR_CONTACTS) * isostatic.mean, f"{name}: {contacts} contacts per particle")
    return [name, fraction, f"{lowest:g} – {highest:g}", contacts, isostatic, f"{rattlers.mean / 1000:.1%}", seconds]


def measure(build):
    packings = filled(build, article(TABLE_2))
    kept = tuple({key: scene[key] for key in (RATIOS, PARTICLES)} for scene in packings)
    densest = article(TABLE_2, f"{RATE}={SLOW_RATE}", UNTIL_JAMMED, rows=kept, seeds=(1, 2, 3)).run(build)
    chosen, larger = larger_packings(packings)
    dense = article(TABLE_2, f"{PARTICLES}=1000", f"{RATE}={JAMMING_RATE}", UNTIL_JAMMED, seeds=range(1, 6),
                    rows=tuple({RATIOS: known["aspect_ratios"]} for known in VALUES["jammed_ellipsoids"])).run(build)
    jammed = map(jammed_row, VALUES["jammed_ellipsoids"], dense)
    return {
        "processor": processor(),
        "article": table(["shape", "R_1", "N", "volume fraction", "growth rate", "ρ", "random ρ", "published, s", "measured, s",
                          "ratio", "maximum fraction"], article_rows(packings, densest)),
        "larger": table(["R_1, R_2", "volume fraction", "N", "ρ", "ρ at 8 N", "decrease of ρ − 1"],
                        larger_rows(chosen, filled(build, larger))),
        "jammed": table(["shape", "volume fraction", "literature", "contacts", "isostatic", "rattlers", "seconds"], jammed)}
