#pragma once

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

/// Curves of one table that belong together. Units are those of the columns.
struct Chart {
  /// The course of a run, or one number of every run of a sweep against its density.
  enum class Section { motion, relaxation, structure, course, density };
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
  Needs needs = {};
  std::vector<Chart> charts = {};
  bool has_groups = false;
};

/// What the table of that name is; null if it is none of these.
const Observable* find(const std::vector<Observable>& all, std::string_view table);

/// All tables of the analysis of a run in so many dimensions, in the order in which the results have them.
std::vector<Observable> observables(int dimension);

}  // namespace vitrel
