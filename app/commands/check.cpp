#include "app/commands/commands.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "app/terminal/exit_codes.h"
#include "app/terminal/session.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "workflow/analyze/analyze.h"
#include "workflow/storage/check.h"

namespace vitrel {
namespace {

template <int Dim>
std::vector<double> components(const Vec<Dim>& vector) {
  return {vector.data(), vector.data() + Dim};
}

template <int Dim>
Json summary(const FileCheck<Dim>& check, const TrajectoryReader& reader) {
  Json result = {{"file", reader.path().string()},
                 {"frames", check.frames},
                 {"particles", check.last.size()},
                 {"box", components<Dim>(check.last.box.lengths())},
                 {"packing_fraction", packing_fraction(check.last)},
                 {"overlaps", check.overlaps},
                 {"smallest_gap", check.smallest_gap},
                 {"smallest_gap_frame", check.smallest_gap_frame}};
  if (reader.has("velocity")) {
    const Mechanics<Dim> sums = mechanics(check.last);
    result["momentum"] = components<Dim>(sums.momentum);
    result["translational_energy"] = sums.translational_energy;
    result["rotational_energy"] = sums.rotational_energy;
  }
  if (!reader.import_report().empty()) result["import"] = import_json(reader.import_report());
  if (check.close_pairs > 0) result["close_pairs"] = check.close_pairs;
  return result;
}

template <int Dim>
int check_and_print(const CheckOptions& options, const TrajectoryReader& reader) {
  Session session(options.print.quiet);
  session.say()("check of " + options.input.string());
  const FileCheck<Dim> check = check_file<Dim>(reader, options.last_only, session.control());
  session.clear();
  remark_import(options.print, options.input, reader.import_report());
  if (check.frames == 0) return stopped;
  print_summary(options.print, summary(check, reader));
  if (check.overlaps > 0) {
    std::string message =
        fmt::format("{}: {} overlapping pair(s); no pair of hard particles may overlap",
                    options.input.string(), check.overlaps);
    for (const std::string& complaint : check.complaints) message += "\n  " + complaint;
    throw InvariantError(message);
  }
  return session.control().stop_requested() ? stopped : success;
}

}  // namespace

int check_command(const CheckOptions& options) {
  const TrajectoryReader reader(options.input, import_choice(options.import));
  return reader.dimension() == 2 ? check_and_print<2>(options, reader)
                                 : check_and_print<3>(options, reader);
}

}  // namespace vitrel
