#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/dynamics/displacement_options.h"
#include "analysis/structure/structure_options.h"
#include "core/io/foreign/foreign_frame.h"
#include "core/io/parameters.h"
#include "core/state/species.h"
#include "edmd/options.h"
#include "edmd/sampling.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/viscoelastic.h"
#include "workflow/stages/stage.h"
#include "workflow/system_parameters.h"

/// @file
/// The parameter file: its contents, how it is read, and the texts that describe it. All commands read the same file,
/// and each uses the sections that it needs.
namespace vitrel {

/// The material of a species, where it differs from the material of all species.
struct MaterialParameters {
  std::string species = "A";
  std::optional<double> stiffness, damping;                                ///< for LinearDashpot
  std::optional<double> youngs_modulus, poissons_ratio, dissipative_time;  ///< for Viscoelastic
};

/// Soft particles: a contact law, and the quantities that set the units of the run, all in SI units.
struct ContactParameters {
  enum class Law { linear_dashpot, viscoelastic };
  enum class Coefficients { tabulated, integrated };

  double radius = 0.1;       ///< in m, of a particle of size 1
  double density = 1140;     ///< in kg/m³, of this particle as a sphere
  double thermal_speed = 2;  ///< in m/s, the √(kT/m) of this particle
  Law law = Law::viscoelastic;
  LinearDashpot linear_dashpot{1e6, 0};
  Viscoelastic viscoelastic{1e9, 0.4, 0};
  std::vector<MaterialParameters> materials;
  Coefficients coefficients = Coefficients::tabulated;
  EarlyRelease early_release = EarlyRelease::alone;
};

/// The name of the law in the parameter file.
const char* law_name(ContactParameters::Law law);

/// A coefficient of normal restitution (edmd/contact_law.h).
struct RestitutionParameters {
  enum class Form { constant, viscoelastic, table };

  Form form = Form::constant;
  double value = 1, speed = 1;
  std::vector<double> speeds, values;
};

/// The contacts of two species, where they differ from the contacts of all species.
struct PairLawParameters {
  std::string first = "A", second = "A";
  std::optional<RestitutionParameters> restitution;
  std::optional<double> friction, tangential_restitution;
};

struct DynamicsParameters {
  enum class Kind { newtonian, brownian };

  Kind kind = Kind::newtonian;
  double brownian_step = 0.1;
  double equilibration = 10;
  double duration = 100;  ///< an upper bound if relaxation times end the run
  /// The run ends as soon as it has lasted this many relaxation times (workflow/run/correlations_file.h).
  std::optional<double> relaxation_times = {};
  RestitutionParameters restitution;
  double friction = 0, tangential_restitution = 0;
  std::vector<PairLawParameters> pairs;
  double contact_duration = 0;
  std::optional<Driving> driving;
  OnOverlap on_overlap = OnOverlap::stop;
  Temperature temperature = Temperature::total;
  InitialVelocities initial_velocities = InitialVelocities::maxwell;
  double translation_share = InitialEnergies().translation;  ///< for InitialVelocities::split
  FreeRotation rotation = FreeRotation::euler;
  std::optional<ContactParameters> contact;  ///< without it, particles are hard
};

/// Options of the correlations that are measured on the fly.
struct CorrelationParameters {
  double interval = 0.1;
  std::optional<double> longest_lag;  ///< by default half the duration
  std::vector<double> wave_numbers;   ///< main_wave_number if empty
};

struct OutputParameters {
  enum class Spacing { linear, logarithmic };
  enum class Precision { full, single };

  Spacing spacing = Spacing::linear;
  std::optional<double> interval;  ///< by default sample_interval
  double first = 0.01;
  int per_decade = 20;
  bool velocities = true;
  Precision precision = Precision::full;
  std::optional<CorrelationParameters> correlations;
  double checkpoint_interval = 30;
};

/// The published values of a sweep like this one: numbers, or a power law.
struct PublishedResult {
  std::string source;
  std::string quantity;             ///< the column of the table of jobs
  std::vector<double> values = {};  ///< one for every step of the first axis of the sweep, or none
  std::optional<double> exponent = {};  ///< of a power law along the abscissa
  /// The range of the abscissa in which the power law holds.
  std::optional<double> from = {}, to = {};
};

/// The values that keys of the file run through in a sweep.
struct SweepParameters {
  /// A key along which jobs form a chain: each starts from the end of the job with the previous value. Without it,
  /// every job prepares a state of its own.
  std::optional<std::string> ladder = {};
  /// The key along which charts and tables run. Without it, study_axes.h chooses one.
  std::optional<std::string> axis = {};
  ParameterGrid grid = {};      ///< combines every value of a key with every value of the others
  ParameterGrid together = {};  ///< combines the k-th values of all keys
  std::vector<PublishedResult> published = {};

  /// The number of values of the keys that advance together, or of the first key of the grid if there are none, or 1.
  std::size_t first_axis_steps() const;
};

struct Parameters {
  SystemParameters system;
  std::vector<Species> species;
  std::uint64_t quality_sweeps = 1000;
  std::vector<Stage> stages;
  DynamicsParameters dynamics;
  OutputParameters output;
  std::string only;  ///< names of the tables to analyze (TableChoice)
  DisplacementOptions analysis;
  StructureOptions structure;
  SweepParameters sweep;
  ImportOptions import;
  /// The dotted keys that the file or the command line gives, with their places. All other keys have their defaults.
  std::map<std::string, std::string> given;

  Parameters();
};

/// The index of the species of this name.
std::optional<std::size_t> species_index(const Parameters& parameters, const std::string& name);

/// The place where the key, or any key in the table of that name, is given.
std::optional<std::string> place_of(const Parameters& parameters, const std::string& key);

/// The parts of the file that the template of a single command contains.
struct Sections {
  bool system = true, prepare = true, run = true, analysis = true, sweep = true;
};

/// The description of a key that a sweep may run through; no value if there is no such key.
std::optional<Field> parameter_field(const std::string& dotted_key);

/// Describes all fields of the given sections.
FieldVisitor::Inside fields(Parameters& parameters, const Sections& sections = {});

/// Throws BadValue for the first invalid value.
void validate(const Parameters& parameters);

/// A state to start from as the command line gives it.
struct StartFile {
  std::filesystem::path file;
  bool shrink = false;  ///< scales particles down until none overlap
  /// If true, the stages of the parameter file that move particles follow, even if its first stage places them.
  bool keeps_moves = false;
};
/// A parameter file and what the command line sets on top of it.
struct ParameterSource {
  std::filesystem::path file;               ///< all defaults if empty
  std::vector<std::string> overrides = {};  ///< "key=value"
  std::optional<std::uint64_t> seed = {};
  /// If given, this state becomes the first stage. If the first stage of the file moves particles, the stages of the
  /// file follow. If it places particles, the stages of the file describe how the state was made and are dropped.
  std::optional<StartFile> start = {};
};
/// Reads the file, applies the overrides, and validates. Throws UserError or FileError.
Parameters load_parameters(const ParameterSource& source);
/// Parses parameters that are stored in a file. `name` stands for that file in messages.
Parameters parse_parameters(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides = {});
/// Parses the parameters of a run that an earlier version may have begun. Without recording it, early versions kept
/// the angular velocities of all ellipsoids constant and drew sizes and shapes anew for each seed.
Parameters recorded_parameters(const std::string& text, const std::string& name);

/// All values in force as TOML, without [sweep]. Equal parameters give equal text.
std::string effective_parameters(const Parameters& parameters);

/// The names of the commands that take a parameter file.
std::vector<std::string> commands_with_parameters();
/// The commented template of the parameters of one command. Throws UserError if the command takes none.
std::string command_template(const std::string& command);
/// The text of docs/parameters.md.
std::string parameter_page();
/// The text of python/vitrel/parameters.py.
std::string parameter_module();

/// The parameters for continuing a run that was begun with `recorded`. Keys that are not given, and whose defaults
/// depend on the duration or the version, keep their recorded values.
Parameters continued(Parameters parameters, const Parameters& recorded);

enum class Work { preparation, run };
/// The first key that must not differ but does, when a preparation or run continues with changed parameters. Keys
/// that it does not use may change, and so may the checkpoint interval, the quality sweeps and the file of the state
/// to start from; the duration may grow.
std::optional<ParameterDifference> forbidden_change(const std::string& before,
                                                    const std::string& after, Work work);

/// The parameters in the form that the engine takes, without the contacts of soft particles (soft_particles.h).
DynamicsOptions dynamics_options(const Parameters& parameters);
InitialEnergies initial_energies(const Parameters& parameters);
/// The time between samples with linear spacing. The default is a 200th of the duration, so that the output of a long
/// run costs little, but at least 0.1 or the whole of a shorter run.
double sample_interval(const Parameters& parameters);
/// The longest time difference of correlations on the fly.
double longest_lag(const Parameters& parameters);
/// The times of the samples, from 0 to the duration.
SampleTimes sample_times(const Parameters& parameters);

}  // namespace vitrel
