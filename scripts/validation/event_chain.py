"""Speed-up by event chains over local moves: rewrites bench/event_chain.md."""

import datetime
import math

from validation.common import ROOT, clock_rate, commit_of, expect, measured, processor, shape, table

TITLE = "Event chains and local moves"
PROGRAM = "event-chain"
PAGE = ROOT / "bench" / "event_chain.md"

QUANTITIES = {"density": "density, longest waves", "place": "position", "hexatic": "hexatic order, ψ₆",
              "nematic": "nematic tensor", "orientation": "orientation"}


def fluid(row):
    if row["size_ratio"] != 1:
        return f"disks 1:{row['size_ratio']:g}"
    return shape(row["aspect_ratio"])


def gain(local, chains):
    """The speed-up and its standard error."""
    value = local["seconds"] / chains["seconds"]
    return value, value * math.hypot(local["error"] / local["seconds"], chains["error"] / chains["seconds"])


def is_known(time):
    """Whether a time was measured and the run was long enough for it."""
    return time is not None and time.get("is_long_enough", True)


def with_error(value, error):
    """1.23 ± 0.04, with two digits of the error."""
    digits = max(0, 1 - math.floor(math.log10(error))) if error > 0 else 2
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def time_text(method, quantity):
    time = method[quantity]
    if time is None:
        return f"> {method['seconds']:.2g} s"
    sweeps = time["seconds"] / method["seconds_per_sweep"]
    sign = "" if is_known(time) else "≳ "
    return f"{sign}{time['seconds']:.3g} s = {sweeps:.3g} sweeps"


def gains(rows):
    """(state, quantity, speed-up, its error) of everything measured with both methods."""
    found = []
    for row in rows:
        local, chains = row["methods"]
        found += [(row, quantity, *gain(local[quantity], chains[quantity])) for quantity in QUANTITIES
                  if quantity in local and is_known(local[quantity]) and is_known(chains[quantity])]
    return found


def states(rows):
    known = {(id(row), quantity): (value, error) for row, quantity, value, error in gains(rows)}
    lines = []
    for row in rows:
        local, chains = row["methods"]
        for quantity, words in QUANTITIES.items():
            if quantity not in local:
                continue
            value = known.get((id(row), quantity))
            lines.append([fluid(row), row["packing_fraction"], row["particles"], words, time_text(local, quantity),
                          time_text(chains, quantity), f"**{with_error(*value)}**" if value else "–"])
    return table(["", "φ", "N", "quantity", "local moves", "event chains", "speed-up"], lines)


def pressures(rows):
    lines = []
    for row in rows:
        local, chains = row["methods"]
        if "compressibility" not in local:
            continue
        lines.append([fluid(row), row["packing_fraction"], row["particles"],
                      with_error(local["compressibility"], local["compressibility_error"]),
                      with_error(chains["compressibility"], chains["compressibility_error"]),
                      f"{chains['compressibility_of_chains']:.3f}", f"{local['ns_per_move']:.0f}",
                      f"{chains['ns_per_move']:.0f}", f"{chains['searches_per_contact']:.2f}"])
    return table(["", "φ", "N", "Z, local moves", "Z, event chains", "Z from the contacts of the chains", "ns per trial",
                  "ns per contact or trial", "searches per contact"], lines)


def tuning(rows, head, value):
    lines = []
    for row in rows:
        for method in row["methods"]:
            cells = [f"{method[q]['seconds']:.3g} ± {method[q]['error']:.1g}" if is_known(method.get(q)) else "–"
                     for q in ("density", "place", "orientation")]
            lines.append([fluid(row), row["packing_fraction"], value(method), *cells])
    return table(["", "φ", head, "density, s", "position, s", "orientation, s"], lines)


def page(data):
    psi = " and ".join(f"{data[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    return f"""# Do event chains decorrelate states faster than local moves?

    scripts/validate event_chain                          # builds, measures and writes this page
    build/release/bench/vitrel-bench event-chain states lengths   # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(data)}, {processor()}{clock_rate()}, {data["compiler"]}, `{data["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run).

Local moves (`mc/sampler.h`) have an acceptance of 0.35; event chains (`mc/event_chain.h`) use the default options. Both run
on one thread, alternately in one process, and start from the same state, which both have equilibrated. Times are given as
CPU seconds and as sweeps. A sweep is N trials, or about N contacts and, for non-circular particles, as many trial rotations.
Errors are standard errors.

*Density* is the autocorrelation time of ρ(k) at the four shortest k. *Nematic tensor* and *ψ₆* (from bonds shorter than
1.45 sums of radii) are the autocorrelation times of these quantities, summed over all particles. *Position* is the time
after which the mean squared displacement is (2b)². *Orientation* is the time after which ⟨cos 2Δθ⟩ is 1/e. Displacements
are relative to the mean displacement of all particles, since chains push everything forwards. The sign ≳ marks times for
which the run is too short.

{states(data["states"])}

## Both sample the same distribution

Z = βP/ρ from the contact function of the states that each method samples, and from the centre distances at the contacts of
the chains.

{pressures(data["states"])}

## Optimal chain length

Contacts per chain, with one trial rotation per contact.

{tuning(data["lengths"], "contacts", lambda method: f"{method['contacts']:g}")}

## Optimal number of rotations

Trial rotations per contact, in chains of 100 contacts.

{tuning(data["rotations"], "rotations", lambda method: f"{method['rotations']:g}")}

## Other step sizes

The step sizes that give an acceptance of 0.35 are multiplied by a factor: those of translations and rotations for local
moves, those of rotations for event chains. In the table of all states above the factor is 1, as in the program.

{tuning(data["steps"], "steps", lambda method: f"{method['method']}, {method['step_factor']:g}")}
"""


def check(rows):
    """Event chains must decorrelate density and positions much faster than local moves."""
    for row, quantity, value, error in gains(rows):
        if quantity in ("density", "place"):
            expect(value + 3 * error > 1.5, f"{fluid(row)}, φ = {row['packing_fraction']}: event chains relax the "
                                            f"{quantity} only {value:.2f} times as fast as local moves")


def measure(_build):
    data = measured(PROGRAM, "release")
    PAGE.write_text(page(data), encoding="utf-8")
    check(data["states"])
    return f"""This command writes [Do event chains decorrelate states faster than local moves?](../bench/event_chain.md). Required: event
chains relax density and positions at least 1.5 times as fast as local moves, in CPU time.

{states(data["states"])}
"""
