"""Snakemake, and the batch script for Slurm, run an exported sweep and end with the datasets of `vitrel sweep`; a job
that is stopped is tried again and continues, one that failed for good is not tried again.
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))

from sweep_files import differing_datasets, differing_files, process_of_run, wait_until  # noqa: E402 (needs the path)
from validation.common import output_of  # noqa: E402

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
LADDER = SYSTEM + """
[[prepare.stage]]
method = "insert"
[[prepare.stage]]
method = "swell"
[sweep]
ladder = "system.packing_fraction"
[sweep.grid]
"dynamics.duration" = [5]
"system.packing_fraction" = [0.3, 0.4, 0.5]
"""
RUNGS = [f"duration-5_packing_fraction-{phi}" for phi in (0.3, 0.4, 0.5)]
LONG = SYSTEM + '[sweep.grid]\n"system.particles" = [200]\n"dynamics.duration" = [500]\n'
LONG_JOB = "particles-200_duration-500"
# No square lattice of ellipses of aspect ratio 6 along x is as dense as 0.85.
IMPOSSIBLE = SYSTEM + """
[[species]]
aspect_ratio = 6
[[prepare.stage]]
method = "lattice"
[sweep.grid]
"system.packing_fraction" = [0.85, 0.1]
"""
# A value that no shell and no template may touch.
SETTING = ["--set", 'species.0={ name = "{A} $b \'c\'", aspect_ratio = 2 }']
SNAKEMAKE = ["snakemake", "-j", "2", "--keep-going"]


class Exported(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def sweep(self, parameters, name, *more):
        file = self.folder / "p.toml"
        file.write_text(parameters)
        return output_of([PROGRAM, "sweep", file, "-o", self.folder / name, "-q", *more])

    def exported(self, parameters, to, *more):
        """The folder of an exported sweep."""
        self.sweep(parameters, "exported", "--export", to, *more)
        return self.folder / "exported"

    def exported_and_moved(self, parameters, to, *more):
        return self.exported(parameters, to, *more).rename(self.folder / "moved here")

    def expect_equal(self, other, jobs):
        """The local sweep has the same files."""
        different, files = differing_files(self.folder / "local", other, jobs)
        self.assertEqual(different, [])
        self.assertGreaterEqual(files, 3 * len(jobs))


class Snakemake(Exported):
    def test_equals_the_local_sweep(self):
        self.sweep(SWEEP, "local", "-j", "2", *SETTING)
        moved = self.exported_and_moved(SWEEP, "snakemake", *SETTING)
        output_of(SNAKEMAKE, cwd=moved)
        self.expect_equal(moved, JOBS)
        runs = [moved / job / "run.h5" for job in JOBS[:2]]
        self.assertIn("particles/all/position/value", differing_datasets(*runs))

    def test_a_ladder_equals_the_local_one(self):
        self.sweep(LADDER, "local")
        sweep = self.exported(LADDER, "snakemake")
        output_of(SNAKEMAKE, cwd=sweep)
        self.expect_equal(sweep, RUNGS)

    def test_a_stopped_job_continues(self):
        self.sweep(LONG, "local")
        sweep = self.exported(LONG, "snakemake")
        with subprocess.Popen(SNAKEMAKE, cwd=sweep, stderr=subprocess.PIPE, text=True) as workflow:
            wait_until((sweep / LONG_JOB / "run.h5").exists, 60, "no run")
            os.kill(wait_until(lambda: process_of_run(sweep, LONG_JOB), 60, "no process"), signal.SIGUSR1)
            errors = workflow.communicate()[1]
        self.assertEqual(workflow.returncode, 0, errors)
        self.assertIn("Trying to restart job", errors)
        self.assertIn("continuing at time", (sweep / LONG_JOB / "log.txt").read_text())
        self.expect_equal(sweep, [LONG_JOB])

    def test_a_failed_job_is_not_tried_again(self):
        sweep = self.exported(IMPOSSIBLE, "snakemake")
        done = subprocess.run(SNAKEMAKE, cwd=sweep, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("packing_fraction-0.85: failed with exit code 2"), 1)
        self.assertTrue((sweep / "packing_fraction-0.1/done.json").exists())
        self.assertFalse((sweep / "packing_fraction-0.85/done.json").exists())

    def test_all_versions_submit_alike(self):
        """Options of Snakemake 8 are those of its documentation and of the plugin cluster-sync."""
        import yaml  # which Snakemake brings

        profile = self.exported(SWEEP, "snakemake") / "slurm"
        former, later = (yaml.safe_load((profile / name).read_text()) for name in ("config.yaml", "config.v8+.yaml"))
        self.assertEqual(later.pop("executor"), "cluster-sync")
        self.assertEqual(later.pop("cluster-sync-submit-cmd"), former.pop("cluster-sync"))
        self.assertEqual(later, former)
        for file in profile.iterdir():
            file.write_text("mine")
        self.exported(SWEEP, "snakemake")
        self.assertEqual({file.read_text() for file in profile.iterdir()}, {"mine"})
        words = ["sweep", self.folder / "p.toml", "-o", profile.parent, "--export", "snakemake", "-j", "2"]
        refused = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("snakemake -j", refused.stderr)


class JobArray(Exported):
    """The batch script, with the environment that Slurm gives its tasks and a scontrol that notes what it is asked."""

    def setUp(self):
        super().setUp()
        scontrol = self.folder / "bin/scontrol"
        scontrol.parent.mkdir()
        scontrol.write_text(f"#!/bin/sh\necho \"$@\" >>'{self.folder}/asked'\n")
        scontrol.chmod(0o755)

    def asked(self):
        return (self.folder / "asked").read_text() if (self.folder / "asked").exists() else ""

    def task(self, sweep, number):
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}",
                       "SLURM_ARRAY_TASK_ID": str(number), "SLURM_JOB_ID": f"job {number}"}
        return subprocess.Popen(["bash", "job_array.sh"], cwd=sweep, env=environment, start_new_session=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def task_at_work(self, sweep):
        """The first task of the long sweep, as soon as its run has a file."""
        task = self.task(sweep, 0)
        wait_until((sweep / LONG_JOB / "run.h5").exists, 60, "no run")
        return task

    def end_of(self, sweep, number):
        task = self.task(sweep, number)
        return task.communicate()[0], task.returncode

    def expect_array(self, sweep, numbers):
        script = (sweep / "job_array.sh").read_text()
        self.assertEqual(re.findall("^#SBATCH --array=(.*)", script, re.MULTILINE), [numbers])

    def test_equals_the_local_sweep(self):
        self.sweep(SWEEP, "local", "-j", "2", *SETTING)
        moved = self.exported_and_moved(SWEEP, "slurm", "-j", "3", *SETTING)
        self.expect_array(moved, "0-3%3")
        for number in range(4):
            self.assertEqual(self.end_of(moved, number)[1], 0)
        self.expect_equal(moved, JOBS)
        self.assertIn("1 of 1 jobs are done already", self.end_of(moved, 0)[0])

    def test_the_jobs_of_a_ladder_are_one_task(self):
        self.sweep(LADDER, "local")
        sweep = self.exported(LADDER, "slurm")
        self.expect_array(sweep, "0-0")
        self.assertEqual(self.end_of(sweep, 0)[1], 0)
        self.expect_equal(sweep, RUNGS)

    def test_before_its_limit_a_task_is_queued_again(self):
        self.sweep(LONG, "local")
        sweep = self.exported(LONG, "slurm")
        task = self.task_at_work(sweep)
        os.kill(task.pid, signal.SIGUSR1)
        self.assertEqual((task.communicate()[1], task.returncode), (None, 0))
        self.assertEqual(self.asked(), "requeue job 0\n")
        self.assertIsNone(process_of_run(sweep, LONG_JOB))
        self.assertEqual(self.end_of(sweep, 0)[1], 0)
        self.assertIn("continuing at time", (sweep / LONG_JOB / "log.txt").read_text())
        self.expect_equal(sweep, [LONG_JOB])

    def test_a_cancelled_task_is_not_queued_again(self):
        sweep = self.exported(LONG, "slurm")
        task = self.task_at_work(sweep)
        os.killpg(task.pid, signal.SIGTERM)
        self.assertIn("the same command continues", task.communicate()[0])
        self.assertEqual((task.returncode, self.asked()), (5, ""))

    def test_a_failed_job_fails_its_task(self):
        sweep = self.exported(IMPOSSIBLE, "slurm")
        self.assertEqual([self.end_of(sweep, number)[1] for number in (0, 1)], [2, 0])
        self.assertEqual(self.asked(), "")


if __name__ == "__main__":
    unittest.main()
