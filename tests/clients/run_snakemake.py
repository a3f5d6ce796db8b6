"""Snakemake runs an exported sweep and ends with the datasets of `vitrel sweep`; a job that is stopped
is tried again and continues, one that failed for good is not tried again.
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from validation.common import (  # noqa: E402 (needs the path)
    differing_datasets, differing_files, output_of, process_of_run, wait_until)

SYSTEM = """
[system]
particles = 30
[dynamics]
equilibration = 2
[output]
samples = { spacing = "linear", interval = 1.0 }
checkpoint_interval = 0.2
"""
SWEEP = SYSTEM + """
[sweep.grid]
"system.seed" = [1, 2]
[sweep.together]
"system.packing_fraction" = [0.3, 0.4]
"dynamics.duration" = [20, 30]
"output.samples.interval" = [0.5, 1]
"""
JOBS = [f"packing_fraction-{phi}_seed-{seed}" for phi in (0.3, 0.4) for seed in (1, 2)]
SNAKEMAKE = ["snakemake", "-j", "2", "--keep-going"]


class Snakemake(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def sweep(self, parameters, name, *more):
        file = self.folder / "p.toml"
        file.write_text(parameters)
        return output_of([PROGRAM, "sweep", file, "-o", self.folder / name, "-q", *more])

    def test_equals_the_local_sweep(self):
        # A value that no shell and no template may touch.
        setting = ["--set", 'species.0={ name = "{A} $b \'c\'", aspect_ratio = 2 }']
        self.sweep(SWEEP, "local", "-j", "2", *setting)
        self.sweep(SWEEP, "exported", "--export", "snakemake", *setting)
        moved = self.folder / "moved here"
        (self.folder / "exported").rename(moved)
        output_of(SNAKEMAKE, cwd=moved)
        different, files = differing_files(self.folder / "local", moved, JOBS)
        self.assertEqual(different, [])
        self.assertGreaterEqual(files, 3 * len(JOBS))
        runs = [moved / job / "run.h5" for job in JOBS[:2]]
        self.assertIn("particles/all/position/value", differing_datasets(*runs))

    def test_a_ladder_equals_the_local_one(self):
        ladder = SYSTEM + ('[[prepare.stage]]\nmethod = "insert"\n[[prepare.stage]]\nmethod = "swell"\n'
                           '[sweep]\nladder = "system.packing_fraction"\n'
                           '[sweep.grid]\n"dynamics.duration" = [5]\n"system.packing_fraction" = [0.3, 0.4, 0.5]\n')
        self.sweep(ladder, "local")
        self.sweep(ladder, "exported", "--export", "snakemake")
        output_of(SNAKEMAKE, cwd=self.folder / "exported")
        jobs = [job.parent.name for job in (self.folder / "local").glob("*/done.json")]
        self.assertEqual(len(jobs), 3)
        self.assertEqual(differing_files(self.folder / "local", self.folder / "exported", jobs)[0], [])

    def test_a_stopped_job_continues(self):
        long = SYSTEM + '[sweep.grid]\n"system.particles" = [200]\n"dynamics.duration" = [500]\n'
        self.sweep(long, "local")
        self.sweep(long, "exported", "--export", "snakemake")
        sweep, job = self.folder / "exported", "particles-200_duration-500"
        with subprocess.Popen(SNAKEMAKE, cwd=sweep, stderr=subprocess.PIPE, text=True) as workflow:
            wait_until((sweep / job / "run.h5").exists, 60, "no run")
            os.kill(wait_until(lambda: process_of_run(sweep, job), 60, "no process"), signal.SIGUSR1)
            errors = workflow.communicate()[1]
        self.assertEqual(workflow.returncode, 0, errors)
        self.assertIn("Trying to restart job", errors)
        self.assertIn("continuing at time", (sweep / job / "log.txt").read_text())
        self.assertEqual(differing_files(self.folder / "local", sweep, [job])[0], [])

    def test_a_failed_job_is_not_tried_again(self):
        # No square lattice of ellipses of aspect ratio 6 along x is as dense as 0.85.
        self.sweep(SYSTEM + '[[species]]\naspect_ratio = 6\n[[prepare.stage]]\nmethod = "lattice"\n'
                   '[sweep.grid]\n"system.packing_fraction" = [0.85, 0.1]\n', "exported", "--export", "snakemake")
        sweep = self.folder / "exported"
        done = subprocess.run(SNAKEMAKE, cwd=sweep, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("packing_fraction-0.85: failed with exit code 2"), 1)
        self.assertTrue((sweep / "packing_fraction-0.1/done.json").exists())
        self.assertFalse((sweep / "packing_fraction-0.85/done.json").exists())


if __name__ == "__main__":
    unittest.main()
