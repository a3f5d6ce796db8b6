#include "app/workflow/prepare.h"

#include <nlohmann/json.hpp>

#include "analysis/order.h"
#include "app/commands/common.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/state/check.h"

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

nlohmann::ordered_json summary(const Preparation& preparation,
                               const std::filesystem::path& output) {
  const StageReport& counts = preparation.report;
  const std::uint64_t moves = counts.translations_tried + counts.rotations_tried;
  const ExactCheck check = exact_check(preparation.configuration);
  nlohmann::ordered_json result = {
      {"output", output.string()},
      {"particles", preparation.configuration.size()},
      {"packing_fraction", packing_fraction(preparation.configuration)},
      {"nematic_order", nematic_order(preparation.configuration)},
      {"overlaps", check.overlaps.size()},
      {"smallest_gap", check.smallest_gap},
      {"trial_moves", moves},
      {"acceptance_translation", ratio(counts.translations_accepted, counts.translations_tried)},
      {"acceptance_rotation", ratio(counts.rotations_accepted, counts.rotations_tried)},
      {"wall_seconds", preparation.wall_seconds},
      {"trial_moves_per_second", static_cast<double>(moves) / preparation.wall_seconds}};
  if (!preparation.growth.empty()) {
    result["reduced_pressure"] = preparation.growth.back().reduced_pressure;
    for (const GrowthReport& growth : preparation.growth)
      result["growth"].push_back(growth_summary(growth));
  }
  return result;
}

}  // namespace

int prepare_command(const Arguments& arguments) {
  const Parameters parameters = load_parameters(parameter_source(arguments));
  if (std::filesystem::exists(arguments.output))
    throw UserError(arguments.output.string() +
                    ": exists already; choose another output, or delete it");
  Session session(arguments);
  const Preparation preparation = prepare(parameters, session.budget(), session.say());
  if (preparation.report.end == StageEnd::stopped) {
    remark(arguments, "stopped; a preparation is not continued but made anew by the same command");
    return stopped;
  }
  write_state(arguments.output, preparation.configuration,
              current_provenance(arguments.command_line, effective_parameters(parameters),
                                 parameters.system.seed));
  print_summary(arguments, summary(preparation, arguments.output));
  return success;
}

}  // namespace vitrel
