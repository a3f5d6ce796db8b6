#include "workflow/analyze/relaxation_tables.h"

#include <fmt/format.h>

#include "analysis/dynamics/relaxation.h"

namespace vitrel {
namespace {

/// `middle_axis` and `short_axis` are orientations of scalene ellipsoids.
enum class Kind { self_scattering, orientation, middle_axis, short_axis, relative_to_cage };

constexpr Kind orientation_of_axis[] = {Kind::orientation, Kind::middle_axis, Kind::short_axis};

Table empty_table() {
  return {
      "relaxation_times",
      "Relaxation times tau, when a correlation has fallen to 1/e. kind: F_s(q, t), or L_n(t), in "
      "three dimensions P_n of the axis of symmetry, of scalene bodies of the longest and of the "
      "middle and the shortest axis; F_s of the motion relative to the cage is that of "
      "cage_relative; parameter: its q or n. Without tau: a time that it outlives (least) or by "
      "which it has decayed (most), and the reason in the provenance.",
      {{"group", "1"},
       {"kind",
        "1",
        {},
        {},
        {"self scattering", "orientation", "orientation of the middle axis",
         "orientation of the shortest axis", "self scattering relative to the cage"}},
       {"parameter", "1/length or 1"},
       {"tau", "time"},
       {"least", "time"},
       {"most", "time"}}};
}

/// Appends rows to the table, and to the provenance the reasons why rows have no time.
class RelaxationRows {
 public:
  RelaxationRows(const Displacements& found, Results& results) : found_(found), results_(results) {}

  void add_cage_relative(const CageRelative& cage) {
    for (std::size_t k = 0; k < cage.self_scattering.size(); ++k)
      add(0, Kind::relative_to_cage, cage.wave_numbers[k], cage.lag, cage.self_scattering[k]);
  }

  void add_group(std::size_t number) {
    const DisplacementGroup& group = found_.groups[number];
    results_.provenance.emplace_back(fmt::format("group_{}", number), group.name);
    table_.columns.front().labels.push_back(group.name);
    for (std::size_t k = 0; k < group.self_scattering.size(); ++k)
      add(number, Kind::self_scattering, found_.wave_numbers[k], found_.lag,
          group.self_scattering[k]);
    if (group.rotors == 0) return;
    const std::size_t orders = found_.orders.size();
    for (std::size_t k = 0; k < group.orientation.size(); ++k)
      add(number, orientation_of_axis[k / orders], found_.orders[k % orders], found_.lag,
          group.orientation[k]);
  }
  Table table() && { return std::move(table_); }

 private:
  void add(std::size_t group, Kind kind, double parameter, const std::vector<double>& times,
           const Correlation& correlation) {
    const RelaxationTime time = relaxation_time({times, correlation.value, correlation.error});
    if (!time.reason.empty())
      results_.provenance.emplace_back(fmt::format("relaxation_times_{}", table_.rows()),
                                       time.reason);
    add_row(table_, {static_cast<double>(group), static_cast<double>(kind), parameter,
                     Entry(time.value, time.error), time.least, time.most});
  }

  const Displacements& found_;
  Results& results_;
  Table table_ = empty_table();
};

}  // namespace

void store_relaxation_times(const Displacements& found, const CageRelative* cage,
                            Results& results) {
  RelaxationRows rows(found, results);
  for (std::size_t k = 0; k < found.groups.size(); ++k) rows.add_group(k);
  if (cage) rows.add_cage_relative(*cage);
  results.tables.push_back(std::move(rows).table());
}

}  // namespace vitrel
