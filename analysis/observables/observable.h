#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// What the tables of an analysis are, whether or not a run is there: what they need, and how they are best
/// drawn. Help, documentation and pages read this; tables themselves are in analysis/results.h.
namespace vitrel {

/// One column of a table, or several: `#` in the name stands for any number, `*` for any text.
struct Curve {
  std::string column;         ///< "msd", "fs_#"
  std::string label;          ///< with the same `#` or `*`
  bool is_of_rotors = false;  ///< of particles that are not round only
};

/// A column of a table, or several, as of Curve. A `*` in the unit is a power that depends on the dimension.
struct ColumnKind {
  std::string name, unit;
  std::string what;        ///< its definition
  bool has_error = false;  ///< standard errors are beside it
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
  /// The course of a run, or one number of every job of a sweep along what the sweep runs through.
  enum class Section { motion, relaxation, structure, course, study };
  enum class Scale { linear, logarithmic, from_zero, decay, around_one };
  /// Horizontal lines that depend on the run.
  enum class Level { none, equipartition, mean };

  Section section;
  std::string heading;
  std::string symbol;  ///< of the ordinate
  std::vector<Curve> curves;
  Scale scale = Scale::linear;
  std::string x = "time", x_symbol = "t";
  bool is_x_logarithmic = false;
  std::vector<double> levels = {};  ///< horizontal lines
  Level level_of_run = Level::none;
  std::vector<Curve> references = {};  ///< drawn dashed: what theory expects
  /// What `#` stands for in a name with an index: the value of a column in the row with this index. Without a table it
  /// stands for itself.
  struct Numbers {
    std::string table, column, symbol;
  };
  Numbers numbers = {};
  bool has_power_laws = false;    ///< slopes of ballistic motion and diffusion beside the curves
  bool is_angle_of_axis = false;  ///< the same after half a turn
  std::string if_missing = {};    ///< said in place of the chart of a table without these columns
};

/// What a table needs of a run.
struct Needs {
  bool motion = false;      ///< more than one frame, with images of the particles
  bool rotors = false;      ///< particles that are not round
  bool velocities = false;  ///< particles that move
  /// Frames for averages, which `analysis.structure.frames = 0` leaves out.
  bool averages = false;
  bool waiting_times = false;  ///< `analysis.waiting_times`
};

/// A table of an analysis.
struct Observable {
  std::string
      table;  ///< its name; followed by `_` and a group of particles if there is one for each
  std::string what;  ///< a sentence
  std::vector<ColumnKind> columns = {};
  Needs needs = {};
  std::vector<Chart> charts = {};
  bool has_groups = false;
  std::vector<std::string> also = {};  ///< what it may be called where tables are chosen: "msd"
};

/// What the table of that name is; null if it is none of these.
const Observable* find(const std::vector<Observable>& all, std::string_view table);

/// The tables that are asked for.
class TableChoice {
 public:
  /// Names of tables without their group, or other names that they have (Observable::also), separated by commas; empty:
  /// all. Throws UserError for a name that no table has.
  explicit TableChoice(std::string_view names);

  /// Whether one of these is asked for.
  bool has(std::initializer_list<std::string_view> tables) const;
  /// Empty: all.
  const std::vector<std::string>& tables() const { return tables_; }

 private:
  std::vector<std::string> tables_;
};

/// The table of the jobs of a sweep. Its charts are over the packing fraction, unless the sweep runs along something
/// else.
Observable jobs_observable();
/// The columns of its charts.
std::vector<std::string> jobs_quantities();

/// All tables of the analysis of a run in so many dimensions, in the order in which the results have them.
std::vector<Observable> observables(int dimension);

}  // namespace vitrel
