#pragma once

#include <span>
#include <string>
#include <vector>

#include "workflow/sweep/sweep.h"

/// @file
/// The export of a sweep to another program. The folder of the sweep then holds the parameter file as `sweep.toml`,
/// the folders of the jobs, and for Snakemake (7 and later), which runs the jobs on this machine or hands them to
/// Slurm,
///
///     sweep/Snakefile                  a rule that runs a job by `vitrel sweep --job`
///          /slurm/config.yaml          profile of Snakemake 7: how jobs are submitted
///          /slurm/config.v8+.yaml      the same profile for later versions
///          /slurm/jobscript.sh         what Slurm runs, for the user to complete
///
/// or for Slurm alone
///
///     sweep/job_array.sh               a batch script; each of its tasks is a job or a chain of jobs
///
/// The folder needs nothing but this program, and may be moved to another machine.
namespace vitrel {

struct SweepExport {
  const char* name;  ///< the value of `--export`
  const char* use;   ///< command that runs the jobs, given in the folder of the sweep
  void (*write)(const SweepRequest& request, const std::vector<SweepJob>& jobs);
};

/// All programs to which a sweep can be exported.
std::span<const SweepExport> sweep_exports();
/// Throws UserError if there is none of this name.
const SweepExport& sweep_export(const std::string& name);

/// Creates the folders and writes the sweep. Files that are already in the folder `slurm` stay as they are. Throws as
/// run_sweep does, and UserError if the request limits the number of jobs at a time for Snakemake.
void export_sweep(const SweepRequest& request, const SweepExport& to);

}  // namespace vitrel
