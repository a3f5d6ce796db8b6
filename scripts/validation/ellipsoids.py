"""Dynamics of spheres and ellipsoids: collisions per second, and the pressure from the collisions."""

from validation.common import carnahan_starling, commit_of, expect, measured, millions, processor, table

TITLE = "Dynamics of spheres and ellipsoids"

# Collisions per second of spheres that the code of Smallenburg (2022) reaches, N = 10 000.
PUBLISHED = {0.3: 0.83e6, 0.49: 1.47e6}
# The error of Carnahan and Starling in a dense liquid.
TOLERANCE = 0.004


def virial_series(phi):
    """To the tenth coefficient (Clisby and McCoy 2006), sufficient up to φ = 0.3."""
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
    return f"""Newtonian dynamics on one core of {processor()}, build {commit_of(data)}. Z comes from the collisional virial.
Spheres are compared with the same spheres simulated as ellipsoids, and with the rate that the code of Smallenburg (2022)
reaches on a similar machine (*published*).

{table(["shape", "N", "φ", "10⁶ collisions/s", "published", "as ellipsoids", "predictions", "list renewals", "Z"], list(speeds(rows)))}

Z of spheres from the collision rate, Z − 1 = Γ σ √(π m/kT)/6, and from the virial, compared with the equation of state of
Carnahan and Starling (1969), which at φ = 0.3 is {1 - carnahan_starling(0.3) / virial_series(0.3):.2%} below the virial series.

{table(["φ", "Z from rate", "Z from virial", "Carnahan–Starling", "virial series"], list(pressures(rows)))}
"""
