#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Descriptions of the tables of an analysis, which do not depend on a run: what the tables need, and how they are best
/// drawn. Help, documentation and pages read them; the tables themselves are in analysis/results.h.
namespace vitrel {

/// One column of a table, or several: `#` in the name stands for any number, `*` for any text.
struct Curve {
  std::string column;         ///< "msd", "fs_#"
  std::string label;          ///< label, with the same `#` or `*`
  bool is_of_rotors = false;  ///< whether it is of particles that are not round only
};

/// A column of a table, or several, as of Curve. A `*` in the unit is a power that depends on the dimension.
struct ColumnKind {
  std::string name, unit;
  std::string what;        ///< its definition
  bool has_error = false;  ///< whether standard errors are beside it
};

/// Columns that several tables have.
inline ColumnKind time_difference_column() {
  return {"time", "time", "t, the time difference"};
}
inline ColumnKind frame_time_column() {
  return {"time", "time", "time of the frame"};
}
inline ColumnKind origins_column() {
  return {"origins", "1", "origins of time averaged over"};
}

/// Curves of one table that belong together. Units are those of the columns.
struct Chart {
  /// Charts show a run or, in the section `study`, one number of every job of a sweep against what the sweep varies.
  enum class Section { motion, relaxation, structure, course, study };
  enum class Scale { linear, logarithmic, from_zero, decay, around_one };
  /// Horizontal lines that depend on the run.
  enum class Level { none, equipartition, mean };

  Section section;
  std::string heading;
  std::string symbol;  ///< symbol of the ordinate
  std::vector<Curve> curves;
  Scale scale = Scale::linear;
  std::string x = "time", x_symbol = "t";
  bool is_x_logarithmic = false;
  std::vector<double> levels = {};  ///< horizontal lines
  Level level_of_run = Level::none;
  std::vector<Curve> references = {};  ///< what theory expects, drawn dashed
  /// What `#` stands for in a name with an index: the value of a column in the row with this index. Without a table,
  /// the number stands for itself.
  struct Numbers {
    std::string table, column, symbol;
  };
  Numbers numbers = {};
  bool has_power_laws = false;    ///< draws slopes of ballistic motion and diffusion
  bool is_angle_of_axis = false;  ///< the angle is the same after half a turn
  std::string if_missing = {};    ///< text in place of the chart of a table without these columns
};

/// What a table needs of a run.
struct Needs {
  bool motion = false;      ///< more than one frame, with images of the particles
  bool rotors = false;      ///< particles that are not round
  bool velocities = false;  ///< particles that move
  /// Frames for averages; there are none with `analysis.structure.frames = 0`.
  bool averages = false;
  bool waiting_times = false;  ///< waiting times, `analysis.waiting_times`
};

/// A table of an analysis.
struct Observable {
  /// Its name. If there is one table for each group of particles, `_` and the group follow.
  std::string table;
  std::string what;  ///< what it holds, in one sentence
  std::vector<ColumnKind> columns = {};
  Needs needs = {};
  std::vector<Chart> charts = {};
  bool has_groups = false;
  std::vector<std::string> also = {};  ///< other names by which it may be chosen, such as "msd"
};

/// Returns the description of the table of that name, or null if it is none of these.
const Observable* find(const std::vector<Observable>& all, std::string_view table);

/// A choice of tables.
class TableChoice {
 public:
  /// `names` are names of tables without their group, or other names that they have (Observable::also), separated by
  /// commas; if it is empty, all tables are chosen. Throws UserError for a name that no table has.
  explicit TableChoice(std::string_view names);

  /// Returns whether one of these tables is chosen.
  bool has(std::initializer_list<std::string_view> tables) const;
  /// Returns the names of the chosen tables; empty if all are chosen.
  const std::vector<std::string>& tables() const { return tables_; }

 private:
  std::vector<std::string> tables_;
};

/// Returns the description of the table of the jobs of a sweep. Its charts are drawn against the packing fraction,
/// unless the sweep varies something else.
Observable jobs_observable();
/// Returns the columns of the charts of jobs_observable.
std::vector<std::string> jobs_quantities();

/// Returns the descriptions of all tables of the analysis of a run in this number of dimensions, in the order in which
/// the results have them.
std::vector<Observable> observables(int dimension);

}  // namespace vitrel
