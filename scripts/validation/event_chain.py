"""What event chains gain over local moves: rewrites bench/event_chain.md."""

import datetime
import math

from validation.common import ROOT, clock_rate, commit_of, expect, measured, processor, shape, table

TITLE = "Event chains against local moves"
PROGRAM = "event-chain"
PAGE = ROOT / "bench" / "event_chain.md"

QUANTITIES = {"density": "density, longest waves", "place": "place", "hexatic": "hexatic order, ψ₆",
              "nematic": "nematic tensor", "orientation": "orientation"}


def fluid(row):
    if row["size_ratio"] != 1:
        return f"disks 1:{row['size_ratio']:g}"
    return shape(row["aspect_ratio"])


def gain(local, chains):
    """How many times sooner, and its standard error."""
    value = local["seconds"] / chains["seconds"]
    return value, value * math.hypot(local["error"] / local["seconds"], chains["error"] / chains["seconds"])


def is_known(time):
    """Whether a time was measured, and a run was long enough for it."""
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
    """(state, quantity, gain, its error) of all that was measured by both methods."""
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
    return table(["", "φ", "N", "what is forgotten", "local moves", "event chains", "times sooner"], lines)


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
                      f"{chains['ns_per_move']:.0f}", f"{chains['looks_for_a_contact']:.2f}"])
    return table(["", "φ", "N", "Z, local moves", "Z, event chains", "Z of the chains' contacts", "ns per trial",
                  "ns per contact or trial", "looks for a contact"], lines)


def tuning(rows, head, value):
    lines = []
    for row in rows:
        for method in row["methods"]:
            cells = [f"{method[q]['seconds']:.3g} ± {method[q]['error']:.1g}" if is_known(method.get(q)) else "–"
                     for q in ("density", "place", "orientation")]
            lines.append([fluid(row), row["packing_fraction"], value(method), *cells])
    return table(["", "φ", head, "density, s", "place, s", "orientation, s"], lines)


def page(data):
    psi = " and ".join(f"{data[key]:.1f}" for key in ("ns_per_psi", "ns_per_psi_at_the_end"))
    return f"""# Do event chains forget a state sooner than local moves?

    scripts/validate event_chain                          # builds, measures and writes this page
    build/release/bench/vitrel-bench event-chain states lengths   # parts of it, as JSON

Measured on {datetime.date.today()}, commit {commit_of(data)}, {processor()}{clock_rate()}, {data["compiler"]}, `{data["flags"]}`.
Calibration: {psi} ns per Ψ (the function of Vieillard-Baron of two ellipses, from their angles; at the
beginning and at the end of the run).

Local moves are those of `mc/sampler.h` at an acceptance of 0.35, event chains those of `mc/event_chain.h` with its
default options, both on one thread, in alternation in one program, from the same state, which both have mixed. Times are
seconds of the processor, and sweeps: of N trials, or of about N contacts and as many trial rotations if there is
anything to turn. Errors are standard errors.

*Density*: autocorrelation time of ρ(k) at the four shortest k. *Nematic tensor* and *ψ₆* (of bonds shorter than 1.45
radii sums): the same of their sums over all particles. *Place*: until the mean squared displacement is (2b)².
*Orientation*: until ⟨cos 2Δθ⟩ is 1/e. Displacements are those relative to the mean of all, since chains push everything
forwards. Of what is marked ≳ the run saw too few times to give one.

{states(data["states"])}

## Both visit the same states

Z = βP/ρ from the contact function of the states that each visits, and from the distances of the centres at the
contacts of the chains.

{pressures(data["states"])}

## How long chains should be

Contacts of a chain, with one trial rotation for each.

{tuning(data["lengths"], "contacts", lambda method: f"{method['contacts']:g}")}

## How many rotations

Trial rotations for every contact, in chains of 100.

{tuning(data["rotations"], "rotations", lambda method: f"{method['rotations']:g}")}

## Other steps

The steps at an acceptance of 0.35 times a factor: of translations and rotations for local moves, of rotations for event
chains. In the table of all states above both have the factor 1, as in the program.

{tuning(data["steps"], "steps", lambda method: f"{method['method']}, {method['step_factor']:g}")}
"""


def check(rows):
    """Event chains are there for density and place, which they must forget much sooner."""
    for row, quantity, value, error in gains(rows):
        if quantity in ("density", "place"):
            expect(value + 3 * error > 1.5, f"{fluid(row)}, φ = {row['packing_fraction']}: event chains forget the "
                                            f"{quantity} only {value:.2f} times sooner than local moves")


def measure(_build):
    data = measured(PROGRAM, "release")
    PAGE.write_text(page(data), encoding="utf-8")
    check(data["states"])
    return f"""[The page about event chains](../bench/event_chain.md) is written from this. Wanted: density and place are forgotten at
least 1.5 times sooner than by local moves, in seconds of one processor.

{states(data["states"])}
"""
