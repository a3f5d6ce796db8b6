#include "workflow/sweep/sweep_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/io/json.h"
#include "core/io/suggestion.h"
#include "core/io/text_file.h"
#include "workflow/report/page_parts.h"
#include "workflow/sweep/export/assets.h"
#include "workflow/sweep/folder_lock.h"
#include "workflow/sweep/job_folder.h"
#include "workflow/sweep/process.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;
using sweep_templates::asset;

/// The words of the command line that set the overrides of the source.
std::vector<std::string> settings(const ParameterSource& source) {
  std::vector<std::string> words;
  for (const std::string& assignment : source.overrides)
    words.insert(words.end(), {"--set", assignment});
  if (source.seed) words.insert(words.end(), {"--seed", fmt::format("{}", *source.seed)});
  return words;
}

/// The value as a Python literal.
std::string python(const Json& value) {
  return json_text(value, 4, JsonCharacters::ascii);
}

/// An existing file stays as it is, because the user may have completed it.
void write_once(const fs::path& file, const std::string& text) {
  if (!fs::exists(file)) write_text(file, text);
}

void write_profile(const fs::path& file, const std::string& versions, const std::string& executor) {
  write_once(file, filled(asset("sweep/export/config.yaml"),
                          {{"versions", versions}, {"executor", executor}}));
}

void write_snakemake(const SweepRequest& request, const std::vector<SweepJob>& jobs) {
  if (request.parallel > 0)
    throw UserError(
        "--jobs is not for --export snakemake: it is snakemake -j that limits the jobs at a time");
  Json names = Json::array(), predecessors = Json::object();
  for (const SweepJob& job : jobs) {
    names.push_back(job.id);
    if (!job.predecessor.empty()) predecessors[job.id] = job.predecessor;
  }
  const fs::path profile = request.folder / "slurm";
  write_once(profile / "jobscript.sh", std::string(asset("sweep/export/jobscript.sh")));
  write_profile(profile / "config.yaml", "7", "cluster-sync");
  write_profile(profile / "config.v8+.yaml", "8 and later",
                "executor: cluster-sync\ncluster-sync-submit-cmd");
  write_text(request.folder / "Snakefile", filled(asset("sweep/export/Snakefile"),
                                                  {{"program", python(request.program.string())},
                                                   {"settings", python(settings(request.source))},
                                                   {"jobs", python(names)},
                                                   {"predecessors", python(predecessors)}}));
}

void write_job_array(const SweepRequest& request, const std::vector<SweepJob>& jobs) {
  std::string words, tasks;
  for (const std::string& word : settings(request.source)) words += shell_word(word) + ' ';
  std::map<std::string, std::string> next;
  for (const SweepJob& job : jobs) next[job.predecessor] = job.id;
  std::size_t count = 0;
  for (const SweepJob& job : jobs) {
    if (!job.predecessor.empty()) continue;
    tasks += "\n    \"" + job.id;
    for (auto to = next.find(job.id); to != next.end(); to = next.find(to->second))
      tasks += ' ' + to->second;
    tasks += '"';
    ++count;
  }
  write_text(request.folder / "job_array.sh",
             filled(asset("sweep/export/job_array.sh"),
                    {{"last", fmt::format("{}", count - 1)},
                     {"limit", request.parallel > 0 ? fmt::format("%{}", request.parallel) : ""},
                     {"program", shell_word(request.program.string())},
                     {"settings", words},
                     {"tasks", tasks}}));
}

}  // namespace

std::span<const SweepExport> sweep_exports() {
  static constexpr SweepExport all[] = {
      {"snakemake",
       "snakemake -j 2 runs the sweep, and snakemake --profile slurm submits its jobs to Slurm",
       write_snakemake},
      {"slurm", "sbatch --time=24:00:00 job_array.sh submits the jobs as a job array",
       write_job_array}};
  return all;
}

const SweepExport& sweep_export(const std::string& name) {
  std::vector<std::string> names;
  for (const SweepExport& to : sweep_exports()) {
    if (to.name == name) return to;
    names.emplace_back(to.name);
  }
  throw UserError(fmt::format("a sweep is exported to {}, not to '{}'{}", fmt::join(names, " or "),
                              name, suggestion(name, names)));
}

void export_sweep(const SweepRequest& request, const SweepExport& to) {
  const std::vector<SweepJob> jobs = sweep_jobs(request.source);
  make_folder(request.folder / "slurm");
  FolderLock lock(request.folder);
  lock.hold_alone();
  for (const SweepJob& job : jobs) write_job_folder(job, request.folder / job.id);
  const fs::path& file = request.source.file;
  write_text(request.folder / "sweep.toml", file.empty() ? "" : read_text(file));
  to.write(request, jobs);
}

}  // namespace vitrel
