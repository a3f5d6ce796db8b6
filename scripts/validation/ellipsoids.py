"""Spheres and ellipsoids in motion: collisions per second, and the pressure that they add up to."""

from validation.common import commit_of, expect, measured, millions, processor, table

TITLE = "Spheres and ellipsoids in motion"

# Collisions per second of spheres that the code of Smallenburg (2022) reaches, N = 10 000.
PUBLISHED = {0.3: 0.83e6, 0.49: 1.47e6}
# Carnahan and Starling are off by that much in a dense liquid.
TOLERANCE = 0.004


def carnahan_starling(phi):
    return (1 + phi + phi**2 - phi**3) / (1 - phi) ** 3


def virial_series(phi):
    """To the tenth coefficient (Clisby and McCoy 2006), which is enough up to φ = 0.3."""
    coefficients = (1, 4, 10, 18.364768, 28.2245, 39.81515, 53.3444, 68.5375, 85.8128, 105.775)
    return sum(b * phi**k for k, b in enumerate(coefficients))


def per_second(row):
    return 1e9 / row["ns_per_collision"]


def speeds(rows):
    for row in rows:
        phi = row["packing_fraction"]
        published = PUBLISHED.get(phi) if row["name"] == "spheres" else None
        yield [row["name"], row["particles"], f"{phi:g}", millions(per_second(row)),
               millions(published) if published else "",
               millions(per_second(row["as_ellipsoids"])) if "as_ellipsoids" in row else "",
               f"{row['predictions']:.0f}", f"{row['renewals']:.2f}", f"{row['z_of_virial']:.3f}"]


def pressures(rows):
    for row in rows:
        if row["name"] != "spheres":
            continue
        phi, z = row["packing_fraction"], row["z_of_rate"]
        known = carnahan_starling(phi)
        expect(abs(z / known - 1) <= TOLERANCE, f"spheres at {phi}: Z = {z}, by Carnahan and Starling {known}")
        yield [f"{phi:g}", f"{z:.4f}", f"{row['z_of_virial']:.4f}", f"{known:.4f}",
               f"{virial_series(phi):.4f}" if phi <= 0.3 else ""]


def measure(_):
    data = measured("ellipsoids", "release")
    rows = data["speed"]
    return f"""Newtonian dynamics, one core of {processor()}, build {commit_of(data)}; Z by the virial of the collisions.
Spheres beside the same spheres as ellipsoids, and beside what the code of Smallenburg (2022) reaches on a machine of this kind.

{table(["shape", "N", "φ", "10⁶ collisions/s", "published", "as ellipsoids", "pairs asked", "lists renewed", "Z"], list(speeds(rows)))}

Z of spheres from their rate of collisions, Z − 1 = Γ σ √(π m/kT)/6, and from the virial, beside Carnahan and Starling (1969),
which at φ = 0.3 is {1 - carnahan_starling(0.3) / virial_series(0.3):.2%} below the virial series.

{table(["φ", "Z by rate", "Z by virial", "Carnahan–Starling", "virial series"], list(pressures(rows)))}
"""
