#include <cmath>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/io/text_file.h"
#include "tests/app/end_to_end.h"
#include "tests/support/parameter_refusal.h"
#include "workflow/analyze/observables_page.h"
#include "workflow/configuration/parameters.h"
#include "workflow/sweep/sweep.h"

namespace vitrel {
namespace {

const fs::path source_folder = VITREL_SOURCE_FOLDER;

/// The effective parameters, after a check that reading them gives them again.
std::string written(const Parameters& parameters) {
  const std::string text = effective_parameters(parameters);
  EXPECT_EQ(effective_parameters(parse_parameters(text, "again")), text);
  return text;
}

TEST(ParameterFile, TheDefaultsAreValidAndTheTemplatesAreTheDefaults) {
  const std::string defaults = effective_parameters(Parameters());
  for (const char* command : {"prepare", "run", "analyze", "sweep"}) {
    const std::string text = command_template(command);
    EXPECT_EQ(effective_parameters(parse_parameters(text, "template")), defaults) << command;
  }
  EXPECT_THAT(command_template("prepare"), Not(HasSubstr("[dynamics]")));
  EXPECT_THAT(command_template("analyze"), Not(HasSubstr("[system]")));
  EXPECT_THAT(command_template("sweep"), HasSubstr("[sweep.grid]"));
  EXPECT_THROW(command_template("check"), UserError);
}

TEST(ParameterFile, EffectiveParametersReadBackBitIdentical) {
  Parameters parameters = parse_parameters(R"(
[system]
packing_fraction = 0.7123456789012345
[[species]]
name = "A"
fraction = 0.3333333333333333
semi_axes = [2, 0.1]
[[species]]
name = "B"
fraction = 0.6666666666666667
aspect_ratio = { distribution = "lognormal", mean = 2.5, standard_deviation = 0.3 }
size = { distribution = "power_law", low = 0.7, high = 1.3, exponent = -2.5 }
mass = 3.3
[[prepare.stage]]
[[prepare.stage]]
method = "swell"
[[prepare.stage]]
method = "sample"
sweeps = 12
[output]
samples = { spacing = "logarithmic", first = 0.3, per_decade = 7 }
correlations = { interval = 0.05, wave_numbers = [1, 2.7] }
)",
                                           "file.toml");
  const std::string text = written(parameters);
  EXPECT_THAT(text, HasSubstr("packing_fraction = 0.7123456789012345"));
  EXPECT_THAT(text, HasSubstr("per_decade = 7"));
}

TEST(ParameterFile, OverridesReachSpeciesAndStages) {
  const Parameters parameters = parse_parameters(
      "[[species]]\naspect_ratio = 2\n[[prepare.stage]]\nmethod = \"insert\"\n", "file.toml",
      {"dynamics.duration=10", "species.0.aspect_ratio=3", "prepare.stage.1.method=swell",
       "output.samples.spacing=logarithmic"});
  EXPECT_EQ(parameters.dynamics.duration, 10);
  EXPECT_EQ(parameters.species[0].aspect_ratio->mean, 3);
  ASSERT_EQ(parameters.stages.size(), 2u);
  EXPECT_TRUE(std::holds_alternative<SwellStage>(parameters.stages[1]));
  EXPECT_EQ(parameters.output.spacing, OutputParameters::Spacing::logarithmic);
}

TEST(ParameterFile, KeysOfEarlierVersionsAreStillRead) {
  const Parameters former = parse_parameters("[analysis]\nmost_origins = 7", "");
  EXPECT_EQ(former.analysis.axis.max_origins, 7u);
  const std::string now = effective_parameters(former);
  EXPECT_THAT(now, HasSubstr("max_origins = 7"));
  EXPECT_THAT(now, Not(HasSubstr("most_origins")));
  EXPECT_THAT(refusal("[analysis]\nmax_origins = 7\nmost_origins = 7\n"),
              HasSubstr("file.toml:3:1: key 'analysis.most_origins' is unknown"));

  const std::string stages = "[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"swell\"\n";
  const std::string before = effective_parameters(parse_parameters(stages + "max_sweeps = 3", ""));
  std::string recorded = before;
  recorded.replace(recorded.find("max_sweeps"), 3, "most");
  EXPECT_EQ(forbidden_change(recorded, before, Work::preparation), std::nullopt);
}

TEST(ParameterFile, SampleIntervalFollowsTheDurationUnlessGiven) {
  const auto interval = [](const std::string& text) {
    const Parameters parameters = parse_parameters(text, "file.toml");
    const double found = sample_interval(parameters);
    EXPECT_EQ(parse_parameters(effective_parameters(parameters), "again").output.interval, found);
    return found;
  };
  EXPECT_EQ(interval("[dynamics]\nduration = 5000"), 25);
  EXPECT_EQ(interval("[dynamics]\nduration = 3"), 0.1);
  EXPECT_EQ(interval("[dynamics]\nduration = 0.05"), 0.05);
  EXPECT_EQ(interval("[dynamics]\nduration = 5000\n[output]\nsamples = { interval = 2 }"), 2);
}

TEST(ParameterFile, OnlyHarmlessChangesAreAllowedWhenContinuing) {
  Parameters before, after;
  after.output.checkpoint_interval = 1;
  after.analysis.axis.longest_lag = 0.25;
  const auto forbidden = [&](Work work) {
    return forbidden_change(effective_parameters(before), effective_parameters(after), work);
  };
  EXPECT_FALSE(forbidden(Work::run));
  after.dynamics.brownian_step = 0.2;
  EXPECT_FALSE(forbidden(Work::preparation));
  const auto change = forbidden(Work::run);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->key, "dynamics.brownian_step");
  EXPECT_EQ(change->first, "0.1");
  EXPECT_EQ(change->second, "0.2");
}

TEST(ParameterFile, TheFilesOfTheProjectAreValid) {
  std::set<fs::path> folders;
  for (const auto& entry : fs::recursive_directory_iterator(source_folder / "params")) {
    if (entry.path().extension() != ".toml") continue;
    folders.insert(entry.path().parent_path());
    EXPECT_NO_THROW(sweep_jobs({entry.path(), {}, {}})) << entry.path();
  }
  EXPECT_EQ(folders.size(), 2u);
}

TEST(ParameterFile, ThreeDimensionsAreReadAndWritten) {
  const Parameters read = parse_parameters(
      "[system]\ndimension = 3\npacking_fraction = 0.95\n[[species]]\nsize = 2\n"
      "aspect_ratios = [4, { distribution = \"uniform\", low = 0.1, high = 2 }]",
      "file.toml");
  const auto& [first, second] = read.species[0].aspect_ratios.value();
  EXPECT_EQ(first.kind, Distribution::Kind::constant);
  EXPECT_EQ(first.mean, 4);
  EXPECT_EQ(second.kind, Distribution::Kind::uniform);
  EXPECT_EQ(second.low, 0.1);
  EXPECT_LE(second.minimum, 0.1);
  EXPECT_EQ(end_of_stage(read.stages[0], read.system, 0), 0.01);
  const std::string text = written(read);
  EXPECT_THAT(text,
              HasSubstr("aspect_ratios = [4.0, { distribution = \"uniform\", low = 0.1, high ="));
  EXPECT_THAT(text, HasSubstr("box_aspect = 1.0\n"));
  const Parameters slab = parse_parameters(
      "[system]\ndimension = 3\nbox_aspect = [2, 0.25]\n[[species]]\naspect_ratio = 1",
      "slab.toml");
  EXPECT_EQ(box_proportions<3>(slab.system), Vec3(1, 2, 0.25));
  EXPECT_THAT(effective_parameters(slab), HasSubstr("box_aspect = [2.0, 0.25]\n"));
}

TEST(ParameterFile, SemiAxesAreNumbersOrDistributions) {
  const Parameters read = parse_parameters(
      "[system]\ndimension = 3\n[[species]]\n"
      "semi_axes = [4, { distribution = \"uniform\", low = 0.1, high = 2 }, 1]",
      "file.toml");
  const std::vector<Distribution>& axes = read.species[0].semi_axes.value();
  ASSERT_EQ(axes.size(), 3u);
  EXPECT_EQ(axes[0].mean, 4);
  EXPECT_EQ(axes[1].high, 2);
  EXPECT_EQ(axes[2].kind, Distribution::Kind::constant);
  const std::string text = written(read);
  EXPECT_THAT(text, HasSubstr("semi_axes = [4.0, { distribution = \"uniform\", low = 0.1, high ="));
}

TEST(ParameterFile, ContactsAreReadInAnyUnitAndWrittenInSi) {
  const std::string file =
      "[[species]]\nsemi_axes = [2, 2]\n[dynamics.contact]\nradius = \"10 cm\"\n"
      "density = \"1.14 g/cm^3\"\nthermal_speed = \"7.2 km/h\"\nyoungs_modulus = \"10 MPa\"\n"
      "dissipative_time = \"20 µs\"\nearly_release = \"together\"\n";
  const Parameters read = parse_parameters(file, "file.toml");
  const ContactParameters& contact = read.dynamics.contact.value();
  EXPECT_DOUBLE_EQ(contact.radius, 0.1);
  EXPECT_DOUBLE_EQ(contact.density, 1140);
  EXPECT_DOUBLE_EQ(contact.thermal_speed, 2);
  EXPECT_DOUBLE_EQ(contact.viscoelastic.youngs_modulus, 1e7);
  EXPECT_DOUBLE_EQ(contact.viscoelastic.dissipative_time, 2e-5);
  EXPECT_EQ(contact.early_release, EarlyRelease::together);
  const std::string text = written(read);
  EXPECT_THAT(text, HasSubstr("[dynamics.contact]\n"));
  EXPECT_THAT(text, Not(HasSubstr("stiffness")));
  EXPECT_THAT(command_template("run"), HasSubstr("# [dynamics.contact]\n"));
  EXPECT_THAT(command_template("run"), HasSubstr("# youngs_modulus = \"1000000000 Pa\""));
}

TEST(GeneratedFiles, AreUpToDate) {
  struct Generated {
    std::string file, content, command;
  };
  for (const auto& [file, content, command] : std::initializer_list<Generated>{
           {"docs/parameters.md", parameter_page(), "params --reference"},
           {"python/vitrel/parameters.py", parameter_module(), "params --python"},
           {"docs/observables.md", observables_page(), "analyze --list"}})
    EXPECT_EQ(read_text(source_folder / file), content)
        << "regenerate it: vitrel " << command << " > " << file;
}

TEST(RecordedParameters, OfEarlierVersionsDrewShapesForEachSeed) {
  const auto draw = [](const std::string& text) {
    return recorded_parameters(text, "test").system.draw;
  };
  EXPECT_EQ(draw("[system]\nparticles = 10\n"), ShapeDraw::random);
  EXPECT_EQ(draw("[system]\ndraw = \"quantiles\"\n"), ShapeDraw::quantiles);
  EXPECT_EQ(draw(effective_parameters({})), ShapeDraw::quantiles);
  // They are continued so, unless the parameters say otherwise.
  const Parameters recorded = recorded_parameters("[system]\nparticles = 10\n", "test");
  EXPECT_EQ(continued(parse_parameters("", "test"), recorded).system.draw, ShapeDraw::random);
  const std::string asked = "[system]\ndraw = \"quantiles\"\n";
  EXPECT_EQ(continued(parse_parameters(asked, "test"), recorded).system.draw, ShapeDraw::quantiles);
}

TEST(RecordedParameters, OfEarlierVersionsKeptAngularVelocitiesConstant) {
  const auto rotation = [](const std::string& text) {
    return recorded_parameters(text, "test").dynamics.rotation;
  };
  const std::string in_space = "[system]\ndimension = 3\n[dynamics]\nduration = 10\n";
  EXPECT_EQ(rotation(in_space), FreeRotation::constant);
  EXPECT_EQ(rotation(in_space + "rotation = \"euler\"\n"), FreeRotation::euler);
  EXPECT_EQ(rotation("[dynamics]\nduration = 10\n"), FreeRotation::euler);
  // A run that was begun by one of them is continued as it was begun.
  Parameters now = parse_parameters(in_space, "test");
  now.system.draw = ShapeDraw::random;
  now.dynamics.rotation = FreeRotation::constant;
  EXPECT_FALSE(forbidden_change(in_space, effective_parameters(now), Work::run));
  now.dynamics.rotation = FreeRotation::euler;
  EXPECT_EQ(forbidden_change(in_space, effective_parameters(now), Work::run)->key,
            "dynamics.rotation");
}

/// The jobs of a sweep of these parameters.
std::vector<SweepJob> jobs_of(const std::string& parameters,
                              const std::vector<std::string>& overrides = {},
                              std::optional<std::uint64_t> seed = {}) {
  const Folder folder("sweep_jobs", parameters);
  return sweep_jobs({folder / "p.toml", overrides, seed});
}

TEST(SweepJobs, EveryCombinationIsAJobOfItsOwn) {
  const std::vector<SweepJob> jobs = jobs_of(
      "[sweep.grid]\n\"system.packing_fraction\" = [0.4, 0.5]\nsystem.seed = [1, 2, 3]\n"
      "\"dynamics.kind\" = [\"brownian\"]\n",
      {"system.particles=7"});
  ASSERT_EQ(jobs.size(), 6u);
  EXPECT_EQ(jobs[1].id, "packing_fraction-0.4_seed-2_kind-brownian");
  EXPECT_EQ(jobs[1].parameters.system.packing_fraction, 0.4);
  EXPECT_EQ(jobs[1].parameters.system.seed, 2u);
  EXPECT_EQ(jobs[1].parameters.system.particles, 7);
  EXPECT_EQ(jobs[5].parameters.system.packing_fraction, 0.5);
  EXPECT_EQ(jobs[5].parameters.dynamics.kind, DynamicsParameters::Kind::brownian);
  EXPECT_THROW(jobs_of("[sweep.grid]\n\"system.seed\" = [1, 1]\n"), UserError);
  EXPECT_THROW(jobs_of("[sweep.grid]\n\"system.sed\" = [1, 2]\n"), UserError);
}

// Three densities with durations and sample intervals of their own, each with both seeds; of the keys that
// advance together only the first is in the names.
TEST(SweepJobs, KeysAdvanceTogether) {
  const std::vector<SweepJob> jobs = jobs_of(
      "[sweep.grid]\n\"system.seed\" = [1, 2]\n[sweep.together]\n"
      "\"system.packing_fraction\" = [0.4, 0.5, 0.6]\n"
      "\"dynamics.duration\" = [10, 20, 40]\n"
      "\"output.samples.interval\" = [0.1, 0.2, 0.5]\n");
  ASSERT_EQ(jobs.size(), 6u);
  const char* ids[] = {"packing_fraction-0.4_seed-1", "packing_fraction-0.4_seed-2",
                       "packing_fraction-0.5_seed-1", "packing_fraction-0.5_seed-2",
                       "packing_fraction-0.6_seed-1", "packing_fraction-0.6_seed-2"};
  const double fractions[] = {0.4, 0.5, 0.6}, durations[] = {10, 20, 40},
               intervals[] = {0.1, 0.2, 0.5};
  for (std::size_t k = 0; k < 6; ++k) {
    const Parameters& p = jobs[k].parameters;
    EXPECT_EQ(jobs[k].id, ids[k]);
    EXPECT_EQ(p.system.packing_fraction, fractions[k / 2]);
    EXPECT_EQ(p.dynamics.duration, durations[k / 2]);
    EXPECT_EQ(p.output.interval, intervals[k / 2]);
    EXPECT_EQ(p.system.seed, 1 + k % 2);
    EXPECT_EQ(jobs[k].values.size(), 4u);
  }
  EXPECT_EQ(&job_named(jobs, ids[3]), &jobs[3]);
  EXPECT_THROW(job_named(jobs, "packing_fraction-0.7_seed-1"), UserError);
}

TEST(SweepJobs, PublishedValuesBelongToTheStepsOfTheFirstAxis) {
  const std::vector<SweepJob> jobs = jobs_of(
      "[sweep.grid]\n\"system.packing_fraction\" = [0.4, 0.5, 0.6]\n"
      "\"system.seed\" = [1, 2]\n"
      "[[sweep.published]]\nsource = \"A\"\nquantity = \"diffusion\"\n"
      "values = [3, 2, 1]\n"
      "[[sweep.published]]\nsource = \"B\"\nquantity = \"diffusion\"\n"
      "exponent = -2\nfrom = 0.5\n");
  for (std::size_t k = 0; k < 6; ++k) {
    ASSERT_EQ(jobs[k].published.size(), 2u);
    EXPECT_EQ(jobs[k].published[0].value, 3.0 - static_cast<double>(k / 2));
    EXPECT_FALSE(jobs[k].published[0].is_exponent);
    EXPECT_EQ(jobs[k].published[1].value, -2);
    EXPECT_TRUE(jobs[k].published[1].is_exponent);
    EXPECT_EQ(jobs[k].published[1].from, 0.5);
    EXPECT_EQ(jobs[k].published[1].to, std::numeric_limits<double>::infinity());
  }
}

/// The wave numbers of the analysis of the last job.
std::vector<double> wave_numbers(const std::string& parameters) {
  return jobs_of(parameters).back().parameters.analysis.wave_numbers;
}

// Particles of size 1 have the area π, so that ρ = φ/π; of size 2, four times that.
TEST(SweepJobs, DifferentDensitiesAreAnalyzedAtOneWaveNumber) {
  const std::string densities =
      "[dynamics]\nduration = 10\n[sweep.grid]\n\"system.packing_fraction\" = [0.7, 0.4]\n";
  const double pi = std::numbers::pi, q = 2 * pi * std::sqrt(2 * 0.7 / pi / std::sqrt(3.0));
  ASSERT_EQ(wave_numbers(densities).size(), 1u);
  EXPECT_NEAR(wave_numbers(densities)[0], q, 1e-12 * q);
  EXPECT_NEAR(wave_numbers("[[species]]\naspect_ratio = 2\nsize = 2\n" + densities)[0], q / 2,
              1e-12 * q);
  EXPECT_THAT(wave_numbers("[analysis]\nwave_numbers = [3.5]\n" + densities), ElementsAre(3.5));
  // At one density every job finds the same, and a packing is no run.
  EXPECT_THAT(wave_numbers("[dynamics]\nduration = 10\n[sweep.grid]\nsystem.seed = [1, 2]\n"),
              IsEmpty());
  EXPECT_THAT(wave_numbers("[sweep.grid]\n\"system.packing_fraction\" = [0.7, 0.4]\n"), IsEmpty());
}

TEST(SweepJobs, WhatTheCommandLineWouldSetInVainIsRefused) {
  const std::string sweep =
      "[sweep.grid]\n\"system.seed\" = [1, 2]\n"
      "[sweep.together]\n\"system.particles\" = [10, 20]\n";
  EXPECT_THROW(jobs_of(sweep, {}, 7), UserError);
  EXPECT_THROW(jobs_of(sweep, {"system.seed=7"}), UserError);
  EXPECT_THROW(jobs_of(sweep, {"system.particles=7"}), UserError);
  EXPECT_EQ(jobs_of(sweep, {"dynamics.duration=7"}).size(), 4u);
}

}  // namespace
}  // namespace vitrel
