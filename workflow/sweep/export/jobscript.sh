#!/bin/sh
# properties = {properties}
# Partition, account, memory and time limit of the cluster belong here, as in "#SBATCH --time=24:00:00". A job that
# reaches its time limit saves its state, is submitted again, and continues.
# Slurm sends SIGTERM before it ends a job: vitrel then saves its state, and is waited for.
trap '' TERM USR1
{exec_job}
