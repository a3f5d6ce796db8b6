#include "workflow/analyze/observables_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "analysis/observables/observable.h"

namespace vitrel {
namespace {

std::string needs_text(const Needs& needs) {
  std::vector<std::string> parts;
  if (needs.motion) parts.emplace_back("more than one frame");
  if (needs.rotors) parts.emplace_back("particles that are not round");
  if (needs.velocities) parts.emplace_back("velocities");
  if (needs.averages) parts.emplace_back("`analysis.structure.frames` above 0");
  if (needs.waiting_times) parts.emplace_back("`analysis.waiting_times`");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string column_text(const ColumnKind& column) {
  const std::string unit = column.unit == "1" ? "" : " (" + column.unit + ")";
  return fmt::format("- `{}`{}{}: {}\n", column.name, column.has_error ? " ±" : "", unit,
                     column.what);
}

/// The description of a table. `where` says that it holds in the plane or in space only; empty if in both.
std::string lines(const Observable& observable, const std::string& where) {
  std::string items;
  if (!observable.also.empty())
    items += fmt::format("- also called `{}`\n", fmt::join(observable.also, "`, `"));
  if (const std::string needs = needs_text(observable.needs); !needs.empty())
    items += "- needs " + needs + "\n";
  for (const ColumnKind& column : observable.columns) items += column_text(column);
  return where + observable.what + (items.empty() ? "\n" : "\n\n") + items;
}

std::string heading(const Observable& observable) {
  return fmt::format("\n## `{}{}`\n\n", observable.table, observable.has_groups ? "_<group>" : "");
}

const Observable* listed(const std::vector<Observable>& all, const std::string& table) {
  const auto found = std::ranges::find(all, table, &Observable::table);
  return found == all.end() ? nullptr : &*found;
}

/// The section of a table of the plane, with the table of the same name in space if there is one.
std::string section(const Observable& plane, const Observable* space) {
  if (!space) return heading(plane) + lines(plane, "In the plane: ");
  const std::string here = lines(plane, ""), there = lines(*space, "");
  if (here == there) return heading(plane) + here;
  return heading(plane) + lines(plane, "In the plane: ") + "\n" + lines(*space, "In space: ");
}

}  // namespace

std::string observables_page() {
  std::string page =
      "# Tables of `vitrel analyze`\n\n"
      "`vitrel analyze --list` prints this page. A table is there if the run has what it needs; "
      "those of groups\n"
      "of particles are there for all and, in mixtures, for every species. `--only` and "
      "`analysis.only` choose tables by\n"
      "these names, without the group.\n\n"
      "In names of columns `#` is any number and `*` any text; in units `^*` stands "
      "for the power d, the dimension. Averages\n"
      "⟨…⟩ are over particles and origins of time or frames. A column with ± has its standard "
      "error in `<column>_error`,\n"
      "from blocks of the run ([units and errors](units.md)). All conventions are in the "
      "attributes of the HDF5 file and in\n"
      "`columns.csv`.\n";
  const std::vector<Observable> plane = observables(2), space = observables(3);
  for (const Observable& observable : plane)
    page += section(observable, listed(space, observable.table));
  for (const Observable& observable : space)
    if (!listed(plane, observable.table))
      page += heading(observable) + lines(observable, "In space: ");
  return page;
}

}  // namespace vitrel
