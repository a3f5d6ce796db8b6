#pragma once

#include <span>
#include <string>
#include <vector>

#include "workflow/sweep/sweep.h"

/// @file
/// A sweep for another program to run. Its folder then has the parameter file as `sweep.toml`, the folders of the jobs, and
/// for Snakemake (7 and later), which runs them on this machine or hands them to Slurm,
///
///     sweep/Snakefile                  a rule that runs a job by `vitrel sweep --job`
///          /slurm/config.yaml          profile of Snakemake 7: how jobs are submitted
///          /slurm/config.v8+.yaml      the same for later versions
///          /slurm/jobscript.sh         what Slurm runs, for the user to complete
///
/// or for Slurm alone
///
///     sweep/job_array.sh               a batch script, each of whose tasks is a job, or jobs that start one from the other
///
/// The folder needs nothing outside but this program, and may be moved to another machine.
namespace vitrel {

struct SweepExport {
  const char* name;  ///< the value of `--export`
  const char* use;   ///< what runs the jobs, in the folder of the sweep
  void (*write)(const SweepRequest& request, const std::vector<SweepJob>& jobs);
};

/// All of them.
std::span<const SweepExport> sweep_exports();
/// UserError if there is none of this name.
const SweepExport& sweep_export(const std::string& name);

/// Makes the folders and writes the sweep. What is in the folder slurm already is left alone. Throws like run_sweep, and
/// UserError if the request limits the jobs at a time of Snakemake.
void export_sweep(const SweepRequest& request, const SweepExport& to);

}  // namespace vitrel
