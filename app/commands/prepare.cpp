#include "app/commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "app/terminal/text_lines.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "workflow/prepare/preparation_model.h"
#include "workflow/prepare/preparation_plan.h"
#include "workflow/prepare/prepare.h"
#include "workflow/prepare/quality.h"
#include "workflow/storage/work_timer.h"

namespace vitrel {
namespace {

double ratio(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// The number, or null if it is not positive.
Json if_positive(double value) {
  return value > 0 ? Json(value) : nullptr;
}

Json stage_summary(const Stage& stage, const StageRecord& record) {
  return {{"method", method_name(stage)},
          {"end", record.report.reason},
          {"packing_fraction", record.packing_fraction},
          {"mean_packing_fraction", if_positive(record.mean_packing_fraction.mean)},
          {"mean_packing_fraction_error", if_positive(record.mean_packing_fraction.error)},
          {"reduced_pressure", if_positive(record.reduced_pressure())},
          {"sweeps", record.sweeps},
          {"decorrelations", record.decorrelations},
          {"trial_moves", record.trials.tried()},
          {"chain_contacts", record.chain_contacts},
          {"time", record.growth.time},
          {"collisions", record.growth.counters.collisions},
          {"predictions", record.growth.counters.predictions},
          {"wall_seconds", record.wall_seconds}};
}

Json stage_summaries(const Parameters& parameters, const std::vector<StageRecord>& records) {
  Json stages;
  for (std::size_t k = 0; k < records.size(); ++k)
    stages.push_back(stage_summary(parameters.stages[k], records[k]));
  return stages;
}

/// The wall time of the stages, without the quality report.
template <int Dim>
double seconds_of_stages(const Preparation<Dim>& preparation) {
  double seconds = 0;
  for (const StageRecord& stage : preparation.stages) seconds += stage.wall_seconds;
  return seconds;
}

/// Describes the work that was done. Ratios are NaN if there were no moves.
Json work_summary(const Preparation<2>& preparation, const std::filesystem::path& output) {
  const TrialCounts counts = preparation.trials();
  return {
      {"output", output.string()},
      {"quality_report", quality_file(output).string()},
      {"particles", preparation.configuration.size()},
      {"trial_moves", counts.tried()},
      {"acceptance_translation", ratio(counts.translations_accepted, counts.translations_tried)},
      {"acceptance_rotation", ratio(counts.rotations_accepted, counts.rotations_tried)},
      {"acceptance_exchange", ratio(counts.exchanges.accepted, counts.exchanges.tried)},
      {"acceptance_collective", ratio(counts.exchanges.accepted_steps, counts.exchanges.steps)},
      {"wall_seconds", preparation.wall_seconds},
      {"trial_moves_per_second",
       static_cast<double>(counts.tried()) / seconds_of_stages(preparation)}};
}

/// Describes the work and its results as JSON.
Json summary(const Preparation<2>& preparation, const Parameters& parameters,
             const Quality& quality, const std::filesystem::path& output) {
  Json result = work_summary(preparation, output);
  result["packing_fraction"] = quality.packing_fraction;
  result["nematic_order"] = quality.nematic_order;
  result["overlaps"] = quality.overlaps;
  result["smallest_gap"] = quality.smallest_gap;
  result["reduced_pressure"] = quality.reduced_pressure.mean;
  result["stages"] = stage_summaries(parameters, preparation.stages);
  result["quality"] = quality_json(quality);
  return result;
}

Json summary(const Preparation<3>& preparation, const Parameters& parameters,
             const PackingQuality& quality, const std::filesystem::path& output) {
  Json result = {{"output", output.string()}, {"quality_report", quality_file(output).string()}};
  result.update(quality_json(quality));
  result["collisions_per_second"] = static_cast<double>(quality.collisions) / quality.wall_seconds;
  result["stages"] = stage_summaries(parameters, preparation.stages);
  return result;
}

/// Prints a row in three columns. A remark is wrapped, and begins on a new line if the value is too long for its
/// column.
std::string row_text(const QualityRow& row) {
  constexpr std::size_t values = 27, remarks = 51;
  std::string text = fmt::format("{:<{}}{}", row.name, values, row.value);
  if (row.remark.empty()) return text;
  const bool fits = columns(text) < remarks;
  const std::size_t column = fits ? remarks : values;
  text += fits ? std::string(remarks - columns(text), ' ') : '\n' + std::string(values, ' ');
  return text + indented(wrapped(row.remark, line_width - column), column);
}

void print_rows(const std::vector<QualityRow>& rows) {
  for (const QualityRow& row : rows) print_text(row_text(row) + '\n');
}

/// Prints the work and its results as text, without counts that are 0.
void print_outcome(const PrepareOptions& options, const Preparation<2>& preparation,
                   const Quality& quality) {
  const Json all = work_summary(preparation, options.output);
  Json work;
  for (const auto& [key, value] : all.items())
    if (!value.is_number() || value.get<double>() > 0) work[key] = value;
  print_summary(options.print, work);
  print_rows(quality_rows(quality));
}
void print_outcome(const PrepareOptions& options, const Preparation<3>& preparation,
                   const PackingQuality& quality) {
  print_summary(options.print, {{"output", options.output.string()},
                                {"quality_report", quality_file(options.output).string()},
                                {"particles", preparation.configuration.size()}});
  print_rows(quality_rows(quality));
}

template <int Dim>
int prepare_state(const PrepareOptions& options, const PrepareRequest& request, Session& session) {
  Preparation<Dim> preparation = prepare<Dim>(request, session.control(), session.say());
  const Parameters& parameters = preparation.parameters;
  decltype(measure_quality(preparation, parameters, session.control())) quality;
  if (preparation.complete) {
    session.say()("quality report");
    const WorkTimer timer(preparation.wall_seconds);
    quality = measure_quality(preparation, parameters, session.control(), options.threads);
    preparation.wall_seconds = timer.seconds();
  }
  session.clear();
  set_summary_of_stop("");
  if (!quality) {
    print_stopped(options.print, options.output);
    remark(options.print, "stopped; the same command continues");
    return stopped;
  }
  Provenance provenance = current_provenance(options.command_line, effective_parameters(parameters),
                                             parameters.system.seed);
  provenance.wall_seconds = preparation.wall_seconds;
  provenance.model = preparation_model(parameters, preparation.configuration);
  // The state is written last, so that a state that exists is complete with its report.
  write_quality(quality_file(options.output), *quality);
  try {
    write_state(options.output, preparation.configuration, provenance);
  } catch (const FileError&) {
    std::filesystem::remove(quality_file(options.output));
    throw;
  }
  forget_preparation(options.output);
  if (options.print.json) {
    Json all = summary(preparation, parameters, *quality, options.output);
    all["model"] = provenance.model;
    print_summary(options.print, all);
  } else if (!options.print.quiet) {
    print_outcome(options, preparation, *quality);
  }
  return success;
}

}  // namespace

int prepare_command(const PrepareOptions& options) {
  const PrepareRequest request{load_parameters(parameter_source(options.source, options.start)),
                               options.output, options.command_line, options.threads};
  require_new(options.output);
  if (options.dry_run) {
    print_text(preparation_plan(request));
    return success;
  }
  Session session(options.print.quiet, options.wall_time);
  print_stopped_if_ended(options.print, options.output);
  return prepared_dimension(request) == 2 ? prepare_state<2>(options, request, session)
                                          : prepare_state<3>(options, request, session);
}

}  // namespace vitrel
