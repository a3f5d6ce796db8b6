"""A sweep that runs through Slurm on this machine gives the same files as a local sweep."""

from validation.common import ROOT, output_of

TITLE = "A sweep through Slurm"
INPUTS = ["scripts/slurm_sweep", "workflow/sweep"]


def measure(build):
    return output_of([ROOT / "scripts/slurm_sweep", build / "app/vitrel"])
