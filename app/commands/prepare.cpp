#include "app/workflow/prepare.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/workflow/quality_file.h"
#include "core/io/h5md.h"

namespace vitrel {
namespace {

double ratio(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

/// A number, or null where there is none.
nlohmann::ordered_json if_positive(double value) {
  return value > 0 ? nlohmann::ordered_json(value) : nullptr;
}

nlohmann::ordered_json stage_summary(const PrepareStage& stage, const StageRecord& record) {
  return {{"method", method_name(stage.method)},
          {"end", record.report.reason},
          {"packing_fraction", record.packing_fraction},
          {"mean_packing_fraction", if_positive(record.mean_packing_fraction.mean)},
          {"mean_packing_fraction_error", if_positive(record.mean_packing_fraction.error)},
          {"reduced_pressure", if_positive(record.growth.reduced_pressure)},
          {"sweeps", record.sweeps},
          {"trial_moves", record.trials.tried()},
          {"chain_contacts", record.chain_contacts},
          {"time", record.growth.time},
          {"collisions", record.growth.counters.collisions},
          {"predictions", record.growth.counters.predictions},
          {"wall_seconds", record.wall_seconds}};
}

/// What was done; ratios of no moves at all are NaN.
nlohmann::ordered_json work_summary(const Preparation& preparation,
                                    const std::filesystem::path& output) {
  const TrialCounts counts = preparation.trials();
  return {
      {"output", output.string()},
      {"quality_report", quality_file(output).string()},
      {"particles", preparation.configuration.size()},
      {"trial_moves", counts.tried()},
      {"acceptance_translation", ratio(counts.translations_accepted, counts.translations_tried)},
      {"acceptance_rotation", ratio(counts.rotations_accepted, counts.rotations_tried)},
      {"acceptance_exchange", ratio(counts.exchanges_accepted, counts.exchanges_tried)},
      {"wall_seconds", preparation.wall_seconds},
      {"trial_moves_per_second", static_cast<double>(counts.tried()) / preparation.wall_seconds}};
}

/// What was done and what came out, for other programs.
nlohmann::ordered_json summary(const Preparation& preparation, const Parameters& parameters,
                               const Quality& quality, const std::filesystem::path& output) {
  nlohmann::ordered_json result = work_summary(preparation, output);
  result["packing_fraction"] = quality.packing_fraction;
  result["nematic_order"] = quality.nematic_order;
  result["overlaps"] = quality.overlaps;
  result["smallest_gap"] = quality.smallest_gap;
  result["reduced_pressure"] = quality.reduced_pressure.mean;
  for (std::size_t k = 0; k < preparation.stages.size(); ++k)
    result["stages"].push_back(stage_summary(parameters.stages[k], preparation.stages[k]));
  result["quality"] = quality_json(quality);
  return result;
}

/// The same for a person, who does not need to be told what there was none of.
void print_summary(const Arguments& arguments, const Preparation& preparation,
                   const Quality& quality) {
  const nlohmann::ordered_json all = work_summary(preparation, arguments.output);
  nlohmann::ordered_json work;
  for (const auto& [key, value] : all.items())
    if (!value.is_number() || value.get<double>() > 0) work[key] = value;
  print_summary(arguments, work);
  for (const QualityRow& row : quality_rows(quality))
    fmt::print("{:<26} {:<26} {}\n", row.name, row.value, row.remark);
  flush_output();
}

}  // namespace

int prepare_command(const Arguments& arguments) {
  const Parameters parameters = load_parameters(parameter_source(arguments));
  require_new(arguments.output);
  Session session(arguments);
  const Preparation preparation =
      prepare({parameters, arguments.output, arguments.command_line, arguments.threads},
              session.budget(), session.say());
  std::optional<Quality> quality;
  if (preparation.complete) {
    session.say()("quality report");
    quality = measure_quality(preparation, parameters, session.budget(), arguments.threads);
  }
  session.clear();
  if (!quality) {
    remark(arguments, "stopped; the same command continues");
    return stopped;
  }
  Provenance provenance = current_provenance(
      arguments.command_line, effective_parameters(parameters), parameters.system.seed);
  provenance.wall_seconds = preparation.wall_seconds;
  // The state comes last: where there is one, all is there.
  write_quality(quality_file(arguments.output), *quality);
  write_state(arguments.output, preparation.configuration, provenance);
  forget_preparation(arguments.output);
  if (arguments.json) {
    print_summary(arguments, summary(preparation, parameters, *quality, arguments.output));
  } else if (!arguments.quiet) {
    print_summary(arguments, preparation, *quality);
  }
  return success;
}

}  // namespace vitrel
