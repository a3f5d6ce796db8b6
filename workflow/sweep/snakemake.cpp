#include "workflow/sweep/snakemake.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/json.h"
#include "core/io/text_file.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

constexpr const char* snakefile_head =
    R"(# Written by `vitrel sweep --export snakemake`. The sweep of sweep.toml, here or on a cluster:
#
#   snakemake -s Snakefile -j 2
#   snakemake -s Snakefile --profile slurm     # slurm/config.yaml says how jobs are submitted
#
# Stopped or killed, the same command continues; after a kill of Snakemake itself,
# `snakemake -s Snakefile --unlock` comes first.

)";

constexpr const char* snakefile_rules = R"(
workdir: workflow.basedir

localrules: all

rule all:
    input: expand("{id}/done.json", id=JOBS)

# Of a job's files only the last is an output here: Snakemake deletes the outputs of jobs that fail, and
# with its trajectory a run would lose what it is to continue. A job that was stopped (exit code 5),
# killed, or had no room on the disk is tried again and continues; one that failed for good is not.
rule job:
    input: lambda wildcards: [f"{BEFORE[id]}/done.json" for id in [wildcards.id] if id in BEFORE]
    output: "{id}/done.json"
    wildcard_constraints: id="[^/]+"
    retries: 20 if workflow.mode == Mode.default else 0  # not inside a job of the cluster
    resources: attempt=lambda wildcards, attempt: attempt
    shell:
        """
        failed={wildcards.id:q}/failed
        if [ {resources.attempt} -gt 1 ] && [ -e "$failed" ]; then
            echo "{wildcards.id} failed; log.txt in its folder says why" >&2
            exit 1
        fi
        rm -f "$failed"
        trap '' TERM USR1  # vitrel stops, and is waited for
        code=0
        {VITREL:q} sweep sweep.toml -o . --job {wildcards.id:q} {SETTINGS:q} || code=$?
        case $code in 1|2|4) touch "$failed" ;; esac
        exit $code
        """
)";

constexpr const char* slurm_config =
    R"(# Partition, account, memory and time limit of the cluster belong into the call of sbatch. A job that
# reaches its time limit saves its state, is submitted again, and continues.
cluster-sync: "sbatch --wait --job-name={wildcards.id} --cpus-per-task={threads} --output=slurm/{wildcards.id}.log --open-mode=append"
jobscript: jobscript.sh
jobs: 100
keep-going: true
latency-wait: 60
)";

constexpr const char* slurm_job = R"(#!/bin/sh
# properties = {properties}
# Slurm sends SIGTERM before it ends a job: vitrel then saves its state, and is waited for.
trap '' TERM USR1
{exec_job}
)";

/// A string or a list of strings as Python reads it.
std::string python(const Json& value) {
  return json_text(value, -1, JsonCharacters::ascii);
}

std::string snakefile(const ParameterSource& source, const std::vector<SweepJob>& jobs,
                      const fs::path& program) {
  std::vector<std::string> settings;
  for (const std::string& assignment : source.overrides)
    settings.insert(settings.end(), {"--set", assignment});
  if (source.seed) settings.insert(settings.end(), {"--seed", fmt::format("{}", *source.seed)});
  std::string text = snakefile_head;
  text += fmt::format("VITREL = config.get(\"vitrel\", {})  # elsewhere: --config vitrel=<path>\n",
                      python(program.string()));
  text += fmt::format("SETTINGS = {}\nJOBS = [\n", python(settings));
  for (const SweepJob& job : jobs) text += fmt::format("    {},\n", python(job.id));
  text += "]\nBEFORE = {  # jobs that start from the end of another one\n";
  for (const SweepJob& job : jobs)
    if (!job.predecessor.empty())
      text += fmt::format("    {}: {},\n", python(job.id), python(job.predecessor));
  return text + "}\n" + snakefile_rules;
}

}  // namespace

void export_snakemake(const ParameterSource& source, const std::vector<SweepJob>& jobs,
                      const fs::path& folder, const fs::path& program) {
  make_folder(folder / "slurm");
  write_text(folder / "sweep.toml", read_text(source.file));
  write_text(folder / "slurm/jobscript.sh", slurm_job);
  if (!fs::exists(folder / "slurm/config.yaml"))
    write_text(folder / "slurm/config.yaml", slurm_config);
  write_text(folder / "Snakefile", snakefile(source, jobs, program));
}

}  // namespace vitrel
