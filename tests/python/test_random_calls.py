"""Random arguments, of any type, shape and kind of numbers, end in a value or in an exception: never in a crash, nor in an
error of the interpreter. VITREL_RANDOM_CALLS is how many.
"""

import gc
import os
import random

import numpy
import pytest
import vitrel
from vitrel import analysis

CALLS = int(os.environ.get("VITREL_RANDOM_CALLS", "1500"))
SMALL = {"particles": 12, "packing_fraction": 0.3, "aspect_ratio": 2, "prepare__quality_sweeps": 0, "quiet": True}

REFUSALS = (TypeError, ValueError, IndexError, KeyError, OverflowError, OSError, vitrel.UserError, vitrel.FileError,
            vitrel.InvariantError)


def arrays(draw):
    """An array that some function might take, or nearly."""
    shape = draw.choice([(), (0,), (1,), (2,), (3,), (5,), (5, 1), (5, 2), (5, 3), (5, 4), (0, 2), (3, 5, 2), (3, 5, 3), (2, 0, 2), (12, 2)])
    numbers = numpy.random.default_rng(draw.randrange(2**32)).normal(size=shape) * draw.choice([1, 1e-300, 1e300, 0])
    kind = draw.choice([float, float, "float32", int, "int8", complex, bool, object, ">f8", "S3"])
    with numpy.errstate(all="ignore"):
        found = numpy.asarray(numbers).astype(kind)
    if found.size and draw.random() < 0.2 and found.dtype.kind == "f":
        found.flat[0] = draw.choice([numpy.nan, numpy.inf, -numpy.inf])
    return draw.choice([found, found[..., ::-1] if found.ndim else found, found.T, numpy.ma.array(found), found.tolist(),
                        numpy.broadcast_to(found, (2, *found.shape))])


def values(draw, folder, states, run):
    """Anything else."""
    return draw.choice([
        None, True, -1, 0, 1, 2, 7, 2**70, -2**63, 0.5, -0.5, 1e-320, 1e308, float("nan"), float("inf"), 1j, "", "x", "\0", "é" * 9,
        b"x", [], [[1], [2, 3]], {}, {"a": 1}, {None: 2}, (), set(), object(), len, print, ..., range(5), slice(1, 2), vitrel, int,
        folder, folder / "none.h5", folder / "run.h5", str(folder / "run.h5"), folder / "text.toml", states[0], states[1], states,
        list(reversed(states)), run, run[0:2], iter(run), run.times, vitrel.Insert(), vitrel.Gaussian(mean=1),
        vitrel.Bodies([2.0, 1.0], [0.0, 0.0]), vitrel.Bodies([2.0, 1.0, 1.0], numpy.zeros((5, 3)))])


KEYWORDS = ("box", "angle", "semi_axes", "semiaxes", "position", "velocity", "mass", "species", "time", "frame", "horizon", "unwrap",
            "q_max", "only", "colour", "width", "orientation", "angular_velocity", "threads", "stage")


def functions(states, run):
    table = run.results["displacements_all"]
    yield from (vitrel.Bodies, vitrel.gap, vitrel.overlap, vitrel.first_contact, vitrel.restitution, vitrel.read, vitrel.load,
                vitrel.from_toml, vitrel.to_toml, vitrel.State.from_arrays, vitrel.State, vitrel.Run, vitrel.Gaussian, vitrel.Grow)
    yield from (analysis.analyze, analysis.msd, analysis.displacements, analysis.order, analysis.pair_correlation,
                analysis.structure_factor, analysis.self_scattering)
    yield from (run.__getitem__, run.analyze, run.results.__getitem__, table.__getitem__)
    for state in states:
        yield from (state.check, state.unwrapped, state.__eq__, state.picture, state.shrunk)


def argument(draw, folder, states, run):
    return arrays(draw) if draw.random() < 0.6 else values(draw, folder, states, run)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    folder = tmp_path_factory.mktemp("calls")
    (folder / "text.toml").write_text("[system]\nparticles = 3\n", encoding="utf-8")
    run = vitrel.run(output=folder / "run.h5", duration=2, equilibration=0, **SMALL)
    return folder, [run[0], vitrel.prepare(dimension=3, **{**SMALL, "packing_fraction": 0.1})], run


def test_random_calls_return_or_refuse(files):
    folder, states, run = files
    draw = random.Random(int(os.environ.get("VITREL_RANDOM_SEED", "1")))
    callables, kept, returned = list(functions(states, run)), [], 0
    for k in range(CALLS):
        call = draw.choice(callables)
        positional = [argument(draw, folder, states, run) for _ in range(draw.randrange(4))]
        named = {draw.choice(KEYWORDS): argument(draw, folder, states, run) for _ in range(draw.randrange(3))}
        try:
            kept.append(call(*positional, **named))
            returned += 1
        except REFUSALS as refusal:
            assert "\0" in str(positional) or str(refusal), (call, positional, named)
        if draw.random() < 0.1:  # what is returned may outlive what it came from
            kept = [one for one in kept if draw.random() < 0.5]
            gc.collect()
    for one in kept:
        repr(one)
    assert returned > CALLS / 50
