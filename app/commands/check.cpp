#include "app/workflow/check.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands/common.h"
#include "core/error.h"

namespace vitrel {
namespace {

nlohmann::ordered_json summary(const FileCheck& check, const std::filesystem::path& file) {
  const Mechanics sums = mechanics(check.last);
  const Vec2& box = check.last.box.lengths();
  return {{"file", file.string()},
          {"frames", check.frames},
          {"particles", check.last.size()},
          {"box", {box.x(), box.y()}},
          {"packing_fraction", packing_fraction(check.last)},
          {"overlaps", check.overlaps},
          {"smallest_gap", check.smallest_gap},
          {"smallest_gap_frame", check.smallest_gap_frame},
          {"momentum", {sums.momentum.x(), sums.momentum.y()}},
          {"translational_energy", sums.translational_energy},
          {"rotational_energy", sums.rotational_energy}};
}

}  // namespace

int check_command(const Arguments& arguments) {
  Session session(arguments);
  session.say()("check of " + arguments.input.string());
  const FileCheck check = check_file(arguments.input, arguments.last_only, session.budget());
  session.clear();
  if (check.frames == 0) return stopped;
  print_summary(arguments, summary(check, arguments.input));
  if (check.overlaps > 0) {
    std::string message =
        fmt::format("{}: {} overlapping pair(s); no pair of hard particles may overlap",
                    arguments.input.string(), check.overlaps);
    for (const std::string& complaint : check.complaints) message += "\n  " + complaint;
    throw InvariantError(message);
  }
  return session.budget().stop_requested() ? stopped : success;
}

}  // namespace vitrel
