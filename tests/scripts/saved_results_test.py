#!/usr/bin/python3
"""scripts/checksums keeps results in a file and compares them as if the programs had just run."""

import pathlib
import tempfile
import unittest

import numpy

from script_tests import module_of

checksums = module_of("checksums")

RESULTS = {"packing state.h5 particles/all/position/value": numpy.array([[0.1, 0.2], [0.3, 1.0]]),
           "packing state_results.h5 two_point/rows": numpy.array([1.0, 1e-3, numpy.nan]),
           "packing 0_prepare.json stages": checksums.as_array([None, "insert"]),
           "packing state.h5 box.boundary": checksums.as_array(numpy.array([b"periodic"], dtype=object))}


def kept(results, scenes=("packing",)):
    """What is read of results that were saved."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "results.npz")
        numpy.savez(file, **results)
        return checksums.saved_results(file, scenes)


def compared(other, tolerance=0):
    """The marks and names of the lines in which other results differ."""
    lines = checksums.differences(kept(RESULTS), kept(other), tolerance)
    return [line.rsplit(maxsplit=1)[0] for line in lines]


def changed(name, change):
    return {**RESULTS, name: RESULTS[name] + change}


class SavedResults(unittest.TestCase):
    def test_the_same(self):
        self.assertEqual(compared(RESULTS), [])

    def test_other_bits_differ(self):
        for name in list(RESULTS)[:2]:
            self.assertEqual(compared(changed(name, 1e-16)), [f"- {name}", f"+ {name}"])

    def test_only_tables_may_be_close(self):
        position, rows, *_ = RESULTS
        self.assertEqual(compared(changed(rows, 1e-13), 1e-12), [])
        self.assertEqual(compared(changed(rows, 1e-11), 1e-12), [f"- {rows}", f"+ {rows}"])
        self.assertEqual(compared(changed(position, 1e-16), 1e-12), [f"- {position}", f"+ {position}"])

    def test_only_the_scenes_asked_for(self):
        self.assertEqual(list(kept({**RESULTS, "sweep a b": numpy.array(1)})), list(RESULTS))
        with self.assertRaisesRegex(checksums.Failure, "no results of sweep"):
            kept(RESULTS, ("packing", "sweep"))

    def test_who_computed_is_no_result(self):
        for name in ("provenance/analysed_by", "analysed_by", "0.version", "wall_seconds"):
            self.assertFalse(checksums.is_result(name), name)
        self.assertTrue(checksums.is_result("particles/all/position/value"))


if __name__ == "__main__":
    unittest.main()
