"""Comparison of the files of sweeps, and what tests of other schedulers wait for."""

import contextlib
import pathlib
import time

from validation.common import Failure, expect


def datasets(file):
    """Type, shape and bytes of all datasets of an HDF5 file except its provenance, by name."""
    import h5py  # needed only to compare files

    found = {}

    def note(name, item):
        if isinstance(item, h5py.Dataset) and not name.startswith("provenance/"):
            found[name] = (str(item.dtype), item.shape, item[()].tobytes())

    with h5py.File(file) as content:
        content.visititems(note)
    return found


def differing_datasets(first, second):
    left, right = datasets(first), datasets(second)
    return sorted(name for name in left.keys() | right.keys() if left.get(name) != right.get(name))


def differing_files(first, second, jobs):
    """The differences between the states, runs and results of two sweeps, and the number of files compared."""
    different, count = [], 0
    for job in jobs:
        names = {str(file.relative_to(sweep / job)) for sweep in (first, second) for kind in ("h5", "csv")
                 for file in (sweep / job).rglob(f"*.{kind}")}
        expect({"state.h5", "run.h5", "results.h5"} <= names, f"{job}: files are missing; found only {', '.join(sorted(names))}")
        for name in sorted(names):
            pair = first / job / name, second / job / name
            if not all(file.exists() for file in pair):
                different.append(f"{job}/{name}: present in only one of the sweeps")
            elif name.endswith(".h5"):
                different += [f"{job}/{name}: {dataset}" for dataset in differing_datasets(*pair)]
            elif pair[0].read_bytes() != pair[1].read_bytes():
                different.append(f"{job}/{name}")
            count += 1
    return different, count


def wait_until(condition, seconds, what):
    """Waits until `condition` returns a true value and returns that value."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.05)
    raise Failure(f"timeout after {seconds} s: {what}")


def process_of_run(sweep, job):
    """The process of `vitrel run` of a job of an exported sweep, or None."""
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            words = (entry / "cmdline").read_bytes().split(b"\0")
            if words[1:2] == [b"run"] and f"./{job}/run.h5".encode() in words and (entry / "cwd").readlink() == sweep:
                return int(entry.name)
    return None
