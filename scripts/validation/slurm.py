"""A sweep through a real Slurm on this machine equals the local one."""

from validation.common import ROOT, output_of

TITLE = "A sweep through Slurm"


def measure(build):
    return output_of([ROOT / "scripts/slurm_sweep", build / "app/vitrel"])
