#pragma once

#include <filesystem>

#include "workflow/configuration/parameters.h"
#include "workflow/sweep/sweep_jobs.h"

/// @file
/// A sweep as a workflow of Snakemake (7), which runs its jobs on this machine or hands them to Slurm:
///
///     sweep/Snakefile                  a rule that runs a job by `vitrel sweep --job`
///          /sweep.toml                 the parameter file, copied
///          /slurm/config.yaml          profile: how jobs are submitted, for the user to complete
///          /slurm/jobscript.sh         what Slurm runs
///          /<id>/parameters.toml …     as `vitrel sweep` makes them
///
/// The folder needs nothing outside but the program, and may be moved to another machine.
namespace vitrel {

/// Writes the workflow into a sweep's folder. A config.yaml that is there already is left alone. Throws
/// FileError.
void export_snakemake(const ParameterSource& source, const std::vector<SweepJob>& jobs,
                      const std::filesystem::path& folder, const std::filesystem::path& program);

}  // namespace vitrel
