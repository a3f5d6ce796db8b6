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
/// The parameter file: what it holds, how it is read, and the texts that describe it. All commands
/// read the same file; each uses the sections it needs.
namespace vitrel {

/// The material of a species, where it differs from that of all.
struct MaterialParameters {
  std::string species = "A";
  std::optional<double> stiffness, damping;                                ///< of LinearDashpot
  std::optional<double> youngs_modulus, poissons_ratio, dissipative_time;  ///< of Viscoelastic
};

/// Soft particles: a law of contact and what gives the units of the run their size, all in SI units.
struct ContactParameters {
  enum class Law { linear_dashpot, viscoelastic };
  enum class Coefficients { tabulated, integrated };

  double radius = 0.1;       ///< m, of a particle of size 1
  double density = 1140;     ///< kg/m³, of it as a sphere
  double thermal_speed = 2;  ///< m/s, its √(kT/m)
  Law law = Law::viscoelastic;
  LinearDashpot linear_dashpot{1e6, 0};
  Viscoelastic viscoelastic{1e9, 0.4, 0};
  std::vector<MaterialParameters> materials;
  Coefficients coefficients = Coefficients::tabulated;
  EarlyRelease early_release = EarlyRelease::alone;
};

/// As the parameter file calls it.
const char* law_name(ContactParameters::Law law);

/// A coefficient of normal restitution (edmd/contact_law.h).
struct RestitutionParameters {
  enum class Form { constant, viscoelastic, table };

  Form form = Form::constant;
  double value = 1, speed = 1;
  std::vector<double> speeds, values;
};

/// The contacts of two species, where they differ from those of all.
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
  double duration = 100;  ///< at most, if relaxation times end the run
  /// The run ends as soon as it has lasted so many of them (workflow/run/correlations_file.h).
  std::optional<double> relaxation_times = {};
  RestitutionParameters restitution;
  double friction = 0, tangential_restitution = 0;
  std::vector<PairLawParameters> pairs;
  double contact_duration = 0;
  std::optional<Driving> driving;
  OnOverlap on_overlap = OnOverlap::stop;
  Temperature temperature = Temperature::total;
  InitialVelocities initial_velocities = InitialVelocities::maxwell;
  double translation_share = InitialEnergies().translation;  ///< of InitialVelocities::split
  FreeRotation rotation = FreeRotation::euler;
  std::optional<ContactParameters> contact;  ///< none: hard particles
};

/// How correlations are measured on the fly.
struct CorrelationParameters {
  double interval = 0.1;
  std::optional<double> longest_lag;  ///< none: half the duration
  std::vector<double> wave_numbers;   ///< empty: main_wave_number
};

struct OutputParameters {
  enum class Spacing { linear, logarithmic };
  enum class Precision { full, single };

  Spacing spacing = Spacing::linear;
  std::optional<double> interval;  ///< none: sample_interval
  double first = 0.01;
  int per_decade = 20;
  bool velocities = true;
  Precision precision = Precision::full;
  std::optional<CorrelationParameters> correlations;
  double checkpoint_interval = 30;
};

/// What a publication says of a sweep like this: numbers, or a power law.
struct PublishedResult {
  std::string source;
  std::string quantity;                 ///< the column of the table of jobs
  std::vector<double> values = {};      ///< for every step of the first axis of the sweep, or none
  std::optional<double> exponent = {};  ///< of the abscissa
  std::optional<double> from = {}, to = {};  ///< the part of the abscissa in which it holds
};

/// The values that keys of the file run through in a sweep.
struct SweepParameters {
  /// A key whose jobs start from the end of the job with the value before; none: all prepare a state of their own.
  std::optional<std::string> ladder = {};
  /// The key that charts and tables run along; none: chosen (study_axes.h).
  std::optional<std::string> axis = {};
  ParameterGrid grid = {};      ///< every value of a key with every value of the others
  ParameterGrid together = {};  ///< the k-th values of all keys together
  std::vector<PublishedResult> published = {};

  /// The number of values of the keys that advance together, or else of the first key of the grid; 1 without both.
  std::size_t first_axis_steps() const;
};

struct Parameters {
  SystemParameters system;
  std::vector<Species> species;
  std::uint64_t quality_sweeps = 1000;
  std::vector<Stage> stages;
  DynamicsParameters dynamics;
  OutputParameters output;
  std::string only;  ///< tables of the analysis (TableChoice)
  DisplacementOptions analysis;
  StructureOptions structure;
  SweepParameters sweep;
  ImportOptions import;
  /// The dotted keys that the file or the command line gives, and their places; others are at their defaults.
  std::map<std::string, std::string> given;

  Parameters();
};

/// The number of the species of this name.
std::optional<std::size_t> species_index(const Parameters& parameters, const std::string& name);

/// The place where a key, or any key in that table, is given.
std::optional<std::string> place_of(const Parameters& parameters, const std::string& key);

/// Parts of the file, for the templates of single commands.
struct Sections {
  bool system = true, prepare = true, run = true, analysis = true, sweep = true;
};

/// The description of a key that a sweep may run through; nothing if there is no such key.
std::optional<Field> parameter_field(const std::string& dotted_key);

/// Names all fields of the given sections.
FieldVisitor::Inside fields(Parameters& parameters, const Sections& sections = {});

/// Throws BadValue for the first impossible value.
void validate(const Parameters& parameters);

/// A state to start from, as the command line gives it.
struct StartFile {
  std::filesystem::path file;
  bool shrink = false;  ///< until no particles overlap
  /// Stages of the parameter file that move particles follow, even if its first stage places them.
  bool keeps_moves = false;
};
/// A file and what the command line puts over it.
struct ParameterSource {
  std::filesystem::path file;               ///< empty: all defaults
  std::vector<std::string> overrides = {};  ///< each "key=value"
  std::optional<std::uint64_t> seed = {};
  /// The first stage is then this state. Stages of the file follow it if the first of them moves particles; if that
  /// places particles, they are how the state was made, and are dropped.
  std::optional<StartFile> start = {};
};
/// Reads, overrides and validates. Throws UserError or FileError.
Parameters load_parameters(const ParameterSource& source);
/// Parses parameters stored in a file; `name` stands for it in messages.
Parameters parse_parameters(const std::string& text, const std::string& name,
                            const std::vector<std::string>& overrides = {});
/// The same for those of a run that may have been begun by an earlier version, which without recording it kept the
/// angular velocities of all ellipsoids constant, and drew sizes and shapes anew for each seed.
Parameters recorded_parameters(const std::string& text, const std::string& name);

/// All values in force as TOML text, without [sweep]; equal parameters give equal text.
std::string effective_parameters(const Parameters& parameters);

/// Those that take a parameter file.
std::vector<std::string> commands_with_parameters();
/// The commented template of one command's parameters; UserError if the command takes none.
std::string command_template(const std::string& command);
/// The page docs/parameters.md.
std::string parameter_page();
/// The module python/vitrel/parameters.py.
std::string parameter_module();

/// For a run that was begun with `recorded`: keys that are not given, and whose defaults depend on the duration or the
/// version, stay as they were.
Parameters continued(Parameters parameters, const Parameters& recorded);

enum class Work { preparation, run };
/// The first key that differs and may not, when a piece of work is continued with changed parameters.
/// Changes of what it does not use do not matter, nor those of the checkpoint interval and the quality
/// sweeps; and a run may become longer.
std::optional<ParameterDifference> forbidden_change(const std::string& before,
                                                    const std::string& after, Work work);

/// The same parameters in the form the engine takes them, without the contact of soft particles
/// (soft_particles.h).
DynamicsOptions dynamics_options(const Parameters& parameters);
InitialEnergies initial_energies(const Parameters& parameters);
/// The time between samples with linear spacing; by default a 200th of the duration, but at least 0.1 (or all of a
/// shorter run), so that the default output of a long run costs little.
double sample_interval(const Parameters& parameters);
/// The longest time difference of correlations on the fly.
double longest_lag(const Parameters& parameters);
/// Sample times, from 0 to the duration.
SampleTimes sample_times(const Parameters& parameters);

}  // namespace vitrel
