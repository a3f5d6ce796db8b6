#!/bin/bash
# Written by `vitrel sweep --export slurm`. The sweep of sweep.toml as a job array of Slurm, submitted in this folder:
#
#   sbatch --time=24:00:00 job_array.sh        # and --partition, --account, --mem as the cluster wants them
#
# Two minutes before its time limit a task saves its state, is queued again, and continues. What is done is skipped, so
# that the same command also continues a sweep after tasks were cancelled or have failed.
#SBATCH --job-name=vitrel
#SBATCH --array=0-{{last}}{{limit}}
#SBATCH --signal=B:USR1@120
#SBATCH --requeue --output=slurm/%a.log --open-mode=append
VITREL=${VITREL:-{{program}}}  # elsewhere: VITREL=<path> sbatch job_array.sh
SETTINGS=({{settings}})
TASKS=({{tasks}}
)

queue_again() {
    kill -s USR1 "$!"
    wait "$!"
    scontrol requeue "$SLURM_JOB_ID"
    exit
}
trap queue_again USR1
trap '' TERM  # Slurm's, before it ends a job, reaches vitrel, too, which is waited for
for job in ${TASKS[${SLURM_ARRAY_TASK_ID:?sbatch runs this file}]}; do
    "$VITREL" sweep sweep.toml -o . --job "$job" "${SETTINGS[@]}" &
    wait "$!" || exit
done
