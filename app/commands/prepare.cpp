#include "app/workflow/prepare.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/workflow/quality_file.h"
#include "core/error.h"
#include "core/io/h5md.h"

namespace vitrel {
namespace {

double ratio(std::uint64_t part, std::uint64_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

nlohmann::ordered_json growth_summary(const GrowthReport& growth) {
  return {{"packing_fraction", growth.packing_fraction},
          {"reduced_pressure", growth.reduced_pressure},
          {"time", growth.time},
          {"collisions", growth.counters.collisions},
          {"predictions", growth.counters.predictions}};
}

/// What was done; ratios of no moves at all are NaN.
nlohmann::ordered_json work_summary(const Preparation& preparation,
                                    const std::filesystem::path& output) {
  const StageReport& counts = preparation.report;
  const std::uint64_t moves = counts.translations_tried + counts.rotations_tried;
  return {
      {"output", output.string()},
      {"quality_report", quality_file(output).string()},
      {"particles", preparation.configuration.size()},
      {"trial_moves", moves},
      {"acceptance_translation", ratio(counts.translations_accepted, counts.translations_tried)},
      {"acceptance_rotation", ratio(counts.rotations_accepted, counts.rotations_tried)},
      {"wall_seconds", preparation.wall_seconds},
      {"trial_moves_per_second", static_cast<double>(moves) / preparation.wall_seconds}};
}

/// What was done and what came out, for other programs.
nlohmann::ordered_json summary(const Preparation& preparation, const Quality& quality,
                               const std::filesystem::path& output) {
  nlohmann::ordered_json result = work_summary(preparation, output);
  result["packing_fraction"] = quality.packing_fraction;
  result["nematic_order"] = quality.nematic_order;
  result["overlaps"] = quality.overlaps;
  result["smallest_gap"] = quality.smallest_gap;
  result["reduced_pressure"] = quality.reduced_pressure.mean;
  for (const GrowthReport& growth : preparation.growth)
    result["growth"].push_back(growth_summary(growth));
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
  if (std::filesystem::exists(arguments.output))
    throw UserError(arguments.output.string() +
                    ": exists already; choose another output, or delete it");
  Session session(arguments);
  const Preparation preparation =
      prepare(parameters, session.budget(), session.say(), arguments.threads);
  std::optional<Quality> quality;
  if (preparation.report.end == StageEnd::reached) {
    session.say()("quality report");
    quality = measure_quality(preparation, parameters, session.budget(), arguments.threads);
  }
  if (!quality) {
    remark(arguments, "stopped; a preparation is not continued but made anew by the same command");
    return stopped;
  }
  Provenance provenance = current_provenance(
      arguments.command_line, effective_parameters(parameters), parameters.system.seed);
  provenance.wall_seconds = preparation.wall_seconds;
  write_state(arguments.output, preparation.configuration, provenance);
  write_quality(quality_file(arguments.output), *quality);
  if (arguments.json) {
    print_summary(arguments, summary(preparation, *quality, arguments.output));
  } else if (!arguments.quiet) {
    print_summary(arguments, preparation, *quality);
  }
  return success;
}

}  // namespace vitrel
