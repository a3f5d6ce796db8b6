// What no parameter file may say, and what a packing fraction may be.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/parameter_refusal.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

struct BadFile {
  const char* text;
  const char* message;
};

// Every rule of `validate`, with the place of the value that breaks it.
const BadFile bad_files[] = {
    {"[system]\ndimension = 4", "file.toml:2:13: key 'system.dimension' is 4, but must be 2 or 3"},
    {"[system]\nbox_aspect = [1, 2]",
     "file.toml:2:14: key 'system.box_aspect' has 2 entries, but must be one number, L_y/L_x"},
    {"[system]\ndimension = 3\nbox_aspect = [1, 2, 3]",
     "has 3 entries, but must be one number or [L_y/L_x, L_z/L_x]"},
    {"[system]\nbox_aspect = \"wide\"",
     "file.toml:2:14: key 'system.box_aspect' must be a number or an array of numbers"},
    {"[system]\ndimension = 3\npacking_fraction = 1.0", "lies between 0 and 1"},
    {"[system]\ndimension = 3\n[[prepare.stage]]\nmethod = \"lattice\"",
     "file.toml:3:1: key 'prepare.stage.0.arrangement' is \"square\", but must be "
     "\"simple_cubic\", "},
    {"[[prepare.stage]]\nmethod = \"lattice\"\narrangement = \"simple_cubic\"",
     "file.toml:3:15: key 'prepare.stage.0.arrangement' is \"simple_cubic\", but must be "
     "\"square\""},
    {"[system]\ndimension = 3\n[[species]]\nsemi_axes = [2, 1]",
     "file.toml:4:13: key 'species.0.semi_axes' is [2.0, 1.0], but must be [a, b, c], all above 0"},
    {"[system]\ndimension = 3\n[[species]]\nsemi_axes = [2, 1, 0]", "must be [a, b, c], all above"},
    {"[system]\ndimension = 3\n[[species]]\n"
     "semi_axes = [2, 1, { distribution = \"uniform\", low = 2, high = 1 }]",
     "key 'species.0.semi_axes.2.high' is 1.0, but must be above low = 2.0"},
    {"[[species]]\nsemi_axes = [{ distribution = \"uniform\", low = 1, high = 2 }, -1]",
     "file.toml:2:13: key 'species.0.semi_axes' is [uniform from 1 to 2, at least 0.001, -1.0], "
     "but "
     "must be [a, b]"},
    {"[[species]]\naspect_ratio = 2\nsize = 1\nfirst_semi_axis = 1",
     "file.toml:4:19: key 'species.0.first_semi_axis' excludes size"},
    {"[[species]]\naspect_ratio = 2\nfirst_semi_axis = 0",
     "key 'species.0.first_semi_axis' is 0.0, but must be at least 0.001"},
    {"[[species]]\naspect_ratio = 1\nsize = 1e300",
     "file.toml:3:8: key 'species.0.size' is 1e+300, but must be at least 0.001 and at most "
     "1000000.0"},
    {"[[species]]\naspect_ratio = 1\nsize = { distribution = \"uniform\", low = 1, high = 1e300 }",
     "key 'species.0.size.high' is 1e+300, but must be at most 1000000.0"},
    {"[[species]]\nsemi_axes = [1e300, 1]",
     "key 'species.0.semi_axes.0' is 1e+300, but must lie between 1e-06 and 1000000.0"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\nretries = 31",
     "file.toml:4:11: key 'prepare.stage.1.retries' is 31, but must lie between 0 and 30"},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientations = \"planar\"",
     "file.toml:3:16: key 'prepare.stage.0.orientations' is \"planar\", which has a meaning only"},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientations = \"tensor\"",
     "key 'prepare.stage.0.orientation_tensor' is missing; give its diagonal"},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientation_tensor = [0.5, 0.5]",
     "'prepare.stage.0.orientation_tensor' has a meaning only with orientations = \"tensor\""},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientations = \"tensor\"\n"
     "orientation_tensor = [0.6, 0.3, 0.1]",
     "file.toml:4:22: key 'prepare.stage.0.orientation_tensor' is [0.6, 0.3, 0.1], but must be the "
     "diagonal (2 numbers, 0 or more, with the sum 1) or the rows (4) of a symmetric tensor"},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientations = \"tensor\"\n"
     "orientation_tensor = [0.6, 0.5]",
     "is [0.6, 0.5], but must be the diagonal"},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientations = \"tensor\"\n"
     "orientation_tensor = [1.2, -0.2]",
     "is [1.2, -0.2], but must be the diagonal"},
    {"[[prepare.stage]]\nmethod = \"insert\"\norientations = \"tensor\"\n"
     "orientation_tensor = [0.5, 0.1, 0.2, 0.5]",
     "is [0.5, 0.1, 0.2, 0.5], but must be the diagonal"},
    {"[system]\ndimension = 3\n[[species]]\nname = \"B\"",
     "key 'species.0.aspect_ratio' is missing; give aspect_ratio (1 for spheres)"},
    {"[system]\ndimension = 3\n[[species]]\naspect_ratio = 2\naspect_ratios = [2, 3]",
     "file.toml:5:17: key 'species.0.aspect_ratios' excludes aspect_ratio"},
    {"[system]\ndimension = 3\n[[species]]\naspect_ratios = [2, 0]",
     "file.toml:4:21: key 'species.0.aspect_ratios.1' is 0.0, but must be at least 0.001"},
    {"[system]\ndimension = 3\n[[species]]\naspect_ratios = [2]",
     "file.toml:4:17: key 'species.0.aspect_ratios' must be an array of 2 entries, not of 1"},
    {"[system]\ndimension = 3\n[[species]]\n"
     "aspect_ratios = [1, { distribution = \"uniform\", low = 2, high = 1 }]",
     "key 'species.0.aspect_ratios.1.high' is 1.0, but must be above low = 2.0"},
    {"[[species]]\naspect_ratios = [2, 3]",
     "key 'species.0.aspect_ratios' has a meaning only with dimension = 3"},
    {"[dynamics.contact]\n", "key 'species.0' is not round, but soft particles"},
    {"[[species]]\nsemi_axes = [2, 1]\n[dynamics.contact]\n", "key 'species.0' is not round"},
    {"[[species]]\naspect_ratio = { distribution = \"uniform\", low = 1, high = 2 }\n"
     "[dynamics.contact]\n",
     "key 'species.0' is not round"},
    {"[dynamics.contact]\nradius = \"0 m\"",
     "file.toml:2:10: key 'dynamics.contact.radius' is 0.0, but must be positive"},
    {"[dynamics.contact]\ndensity = \"-1 kg/m^3\"", "'dynamics.contact.density' is -1.0"},
    {"[dynamics.contact]\nthermal_speed = \"0 m/s\"", "'dynamics.contact.thermal_speed' is 0.0"},
    {"[dynamics.contact]\nlaw = \"linear_dashpot\"\nstiffness = \"0 N/m\"",
     "'dynamics.contact.stiffness' is 0.0, but must be positive"},
    {"[dynamics.contact]\nlaw = \"linear_dashpot\"\ndamping = \"-1 kg/s\"",
     "'dynamics.contact.damping' is -1.0, but must be 0 or more"},
    {"[dynamics.contact]\nyoungs_modulus = \"0 Pa\"", "'dynamics.contact.youngs_modulus' is 0.0"},
    {"[dynamics.contact]\nyoungs_modulus = \"1 N/m\"",
     "must be a string with a number and a unit that converts to Pa"},
    {"[dynamics.contact]\ndissipative_time = \"1e6 s\"",
     "file.toml:2:20: key 'dynamics.contact.dissipative_time' is so large that nothing is left"},
    {"[[species]]\naspect_ratio = 1\n[dynamics.contact]\nradius = \"1e-200 m\"",
     "key 'dynamics.contact.radius' is 1e-200, but must lie between 1e-20 and 1e+20"},
    {"[dynamics.contact]\nyoungs_modulus = \"1e-6 Pa\"",
     "'dynamics.contact.youngs_modulus' is so small that particles pass through each other"},
    {"[[species]]\naspect_ratio = 1\n[dynamics.contact]\n[[dynamics.contact.material]]\nspecies = "
     "\"B\"\n",
     "file.toml:5:11: key 'dynamics.contact.material.0.species' is \"B\", but must be the name of "
     "a species"},
    {"[[species]]\naspect_ratio = 1\n[dynamics.contact]\n[[dynamics.contact.material]]\nspecies = "
     "\"A\"\n"
     "stiffness = \"1 N/m\"\n",
     "'dynamics.contact.material.0.stiffness' is not a key of law = \"viscoelastic\""},
    {"[[species]]\naspect_ratio = 1\n[dynamics.contact]\n[[dynamics.contact.material]]\nspecies = "
     "\"A\"\n"
     "youngs_modulus = \"-1 Pa\"\n",
     "'dynamics.contact.material.0.youngs_modulus' is -1.0, but must be positive"},
    {"[dynamics.contact]\nlaw = \"linear_dashpot\"\ndamping = \"1e12 kg/s\"",
     "'dynamics.contact.damping' is so large that nothing is left"},
    {"[dynamics.contact]\nlaw = \"linear_dashpot\"\nstiffness = \"1e-3 N/m\"",
     "'dynamics.contact.stiffness' is so small that particles pass"},
    {"[dynamics.contact]\npoissons_ratio = 0.6",
     "'dynamics.contact.poissons_ratio' is 0.6, but must lie above -1 and not above 0.5"},
    {"[dynamics.contact]\ndissipative_time = \"-1 s\"", "'dynamics.contact.dissipative_time' is"},
    {"[dynamics.contact]\nstiffness = \"1 N/m\"",
     "has a meaning only with law = \"linear_dashpot\""},
    {"[[species]]\naspect_ratio = 1\n[dynamics]\nrestitution = 0.9\n[dynamics.contact]\n",
     "file.toml:4:15: key 'dynamics.restitution' is for hard particles"},
    {"[[species]]\naspect_ratio = 1\n[dynamics]\non_overlap = \"correct\"\n[dynamics.contact]\n",
     "file.toml:4:14: key 'dynamics.on_overlap' is for hard particles"},
    {"[system]\nparticles = 0",
     "file.toml:2:13: key 'system.particles' is 0, but must be positive"},
    {"[system]\npacking_fraction = 0.95",
     "file.toml:2:20: key 'system.packing_fraction' is 0.95, but"},
    {"[system]\npacking_fraction = 0.0",
     "key 'system.packing_fraction' is 0.0, but must be positive"},
    {"[system]\npacking_fraction = 1e-16", "is 1e-16, but must be at least 1e-15"},
    {"[dynamics]\nequilibration = 1e15",
     "file.toml:2:17: key 'dynamics.equilibration' is 1000000000000000.0, but must not exceed "
     "6e+09"},
    {"[dynamics]\nduration = 1e12",
     "key 'dynamics.duration' is 1000000000000.0, but must not exceed 6e+09"},
    {"[dynamics]\nkind = \"brownian\"\nbrownian_step = 1e-15",
     "which makes 1.1e+17 steps; at most 1e+12 are possible"},
    {"[dynamics]\nbrownian_step = 1e-60", "is 1e-60, but must lie between 1e-20 and 1e+20"},
    {"[dynamics]\ndriving = { interval = 1e-300 }",
     "key 'dynamics.driving.interval' is 1e-300, but must lie"},
    {"[dynamics]\ndriving = { power = 1e300 }",
     "key 'dynamics.driving.power' is 1e+300, but must lie"},
    {"[[species]]\naspect_ratio = 2\ninitial_temperature = 1e60",
     "key 'species.0.initial_temperature' is 1e+60, but must lie"},
    {"[[species]]\naspect_ratio = 2\nmass = 1e-60", "key 'species.0.mass' is 1e-60, but must lie"},
    {"[[species]]\naspect_ratio = 2\nmass = 1e-30\n[dynamics]\nequilibration = 0",
     "key 'dynamics.duration' is 100.0, but must not exceed 6e-06"},
    {"[[species]]\naspect_ratio = 1\n[dynamics.contact]\nthermal_speed = \"1e-300 m/s\"",
     "key 'dynamics.contact.thermal_speed' is 1e-300, but must lie"},
    {"[output]\nsamples = { spacing = \"logarithmic\", first = 5e-324 }",
     "key 'output.samples.first' is 5e-324, but must lie"},
    {"[output]\nsamples = { spacing = \"logarithmic\", first = 1e-15 }",
     "is 1e-15, but must be at least 1e-12 of dynamics.duration = 100.0"},
    {"[system]\nbox_aspect = -1", "file.toml:2:14: key 'system.box_aspect'"},
    {"species = []", "file.toml:1:11: key 'species' is empty"},
    {"[[species]]\nfraction = 0.5\naspect_ratio = 1",
     "file.toml:1:1: key 'species' has fractions that add up to 0.5"},
    {"[[species]]\nfraction = 1.5", "file.toml:2:12: key 'species.0.fraction' is 1.5"},
    {"[[species]]\nname = \"B\"", "file.toml:1:1: key 'species.0.aspect_ratio' is missing"},
    {"[[species]]\nname = \"\"", "file.toml:2:8: key 'species.0.name' is empty"},
    {"[[species]]\nfraction = 0.5\naspect_ratio = 1\n[[species]]\nfraction = 0.5\naspect_ratio = 1",
     "key 'species.1.name' is \"A\" like that of an earlier species"},
    {"[[species]]\nname = \"all\"\naspect_ratio = 1",
     "file.toml:2:8: key 'species.0.name' is \"all\", which results have in their table "
     "displacements_all"},
    {"[[species]]\nname = \"wave numbers\"\naspect_ratio = 1",
     "is \"wave numbers\", which results have in their table on_the_fly_wave_numbers"},
    {"[[species]]\nname = \"a-1\"\nfraction = 0.5\naspect_ratio = 1\n"
     "[[species]]\nname = \"a 1\"\nfraction = 0.5\naspect_ratio = 1",
     "file.toml:6:8: key 'species.1.name' is \"a 1\", which tables of results call a_1 like the "
     "earlier \"a-1\"; choose names"},
    {"[[species]]\naspect_ratio = 0.5",
     "file.toml:2:16: key 'species.0.aspect_ratio' is 0.5, but must "
     "be at least 1.0"},
    {"[[species]]\naspect_ratio = 2\nsize = 0", "file.toml:3:8: key 'species.0.size' is 0.0"},
    {"[[species]]\naspect_ratio = 2\nmass = 0", "file.toml:3:8: key 'species.0.mass' is 0.0"},
    {"[[species]]\naspect_ratio = 2\nsemi_axes = [2, 1]",
     "file.toml:3:13: key 'species.0.semi_axes' "
     "excludes aspect_ratio and size"},
    {"[[species]]\nsemi_axes = [1, 2]", "file.toml:2:13: key 'species.0.semi_axes' is [1.0, 2.0]"},
    {"[[species]]\naspect_ratio = { distribution = \"uniform\", low = 3, high = 2 }",
     "file.toml:2:60: key 'species.0.aspect_ratio.high' is 2.0, but must be above low = 3.0"},
    {"[[species]]\naspect_ratio = { distribution = \"gaussian\", mean = 2, standard_deviation = 0 "
     "}",
     "key 'species.0.aspect_ratio.standard_deviation' is 0.0, but must be positive"},
    {"[[species]]\naspect_ratio = { distribution = \"gaussian\", mean = 2, low = 1 }",
     "file.toml:2:55: key 'species.0.aspect_ratio.low' has a meaning only with distribution = "
     "\"uniform\""},
    {"[[species]]\naspect_ratio = { distribution = \"gaussian\", mean = 2, minimum = 0.5 }",
     "key 'species.0.aspect_ratio.minimum' is 0.5, but must be at least 1.0"},
    {"[[species]]\naspect_ratio = { distribution = \"lognormal\", mean = 2, minimum = 3 }",
     "key 'species.0.aspect_ratio.mean' is 2.0, but must be at least minimum = 3.0"},
    {"[prepare]\nstage = []", "key 'prepare.stage' is empty"},
    {"[[prepare.stage]]\nmethod = \"swell\"",
     "file.toml:2:10: key 'prepare.stage.0.method' of the first"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"lattice\"",
     "file.toml:3:10: key "
     "'prepare.stage.1.method' of a later"},
    {"[[prepare.stage]]\nmethod = \"lattice\"\narrangement = \"triangular\"\nangle = 1",
     "file.toml:4:9: key 'prepare.stage.0.angle' is 1.0, but must be 0"},
    {"[[prepare.stage]]\nmethod = \"insert\"\nattempts = 0", "file.toml:3:12: key"},
    {"[[prepare.stage]]\nmethod = \"insert\"\npacking_fraction = 1.2", "file.toml:3:20: key"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"swell\"\nmax_sweeps = 0",
     "file.toml:4:14: key"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"sample\"\nsweeps = 0",
     "file.toml:4:10: key"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"swell\"\npacking_fraction = 0.2",
     "file.toml:4:20: key 'prepare.stage.1.packing_fraction' is 0.2, but the stage before ends at "
     "0.3"},
    {"[[prepare.stage]]\nmethod = \"insert\"",
     "file.toml:1:1: key 'prepare.stage.0' ends at the packing "
     "fraction 0.3, but system.packing_fraction is 0.5"},
    {"[[prepare.stage]]\nmethod = \"lattice\"\nattempts = 3",
     "has a meaning only with method = \"insert\""},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"sample\"\nmoves = \"local\"\nexchanges = 1",
     "file.toml:5:13: key 'prepare.stage.1.exchanges' is 1.0, but must lie between 0 and 1, 1 "
     "excluded"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"sample\"\nexchanges = -1",
     "file.toml:4:13: key 'prepare.stage.1.exchanges' is -1.0, but must lie between 0 and"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"sample\"\nexchange_partners = 0.1",
     "file.toml:4:1: key 'prepare.stage.1.exchange_partners' has a meaning only with exchanges "
     "above "
     "0"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"sample\"\nexchanges = 1\n"
     "exchange_partners = 0",
     "file.toml:5:21: key 'prepare.stage.1.exchange_partners' is 0.0, but must lie above 0 and not "
     "above 1"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"hybrid\"\ncollective_exchanges = inf",
     "file.toml:4:24: key 'prepare.stage.1.collective_exchanges' is inf, but must"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"hybrid\"\nstretch_sweeps = 0",
     "file.toml:4:18: key 'prepare.stage.1.stretch_sweeps' is 0, but must be at least 1"},
    {"[system]\npacking_fraction = 0.3\n[[prepare.stage]]\nmethod = \"insert\"\npacking_fraction = "
     "0.4\n"
     "[[prepare.stage]]\nmethod = \"swell\"",
     "file.toml:2:20: key 'system.packing_fraction' is 0.3, but the stage before ends at 0.4"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\ngrowth_rate = 0",
     "file.toml:4:15: key 'prepare.stage.1.growth_rate' is 0.0, but must lie above 0"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\ngrowth_rate = 1.2",
     "growth_rate' is 1.2, but must lie above 0 and not above 1,"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\nreduced_pressure = 1",
     "file.toml:4:20: key 'prepare.stage.1.reduced_pressure' is 1.0, but must lie above 1"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\nreduced_pressure = 1e10",
     "reduced_pressure' is 10000000000.0, but must lie above 1"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\npacking_fraction = 0.2",
     "file.toml:4:20: key 'prepare.stage.1.packing_fraction' is 0.2, but the stage before ends at "
     "0.3"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\npacking_fraction = 0.2\n"
     "reduced_pressure = 1e6",
     "file.toml:4:20: key 'prepare.stage.1.packing_fraction' is 0.2, but the stage before ends at "
     "0.3"},
    {"[[prepare.stage]]\nmethod = \"grow\"", "key 'prepare.stage.0.method' of the first"},
    {"[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"swell\"\nreduced_pressure = 1e6",
     "file.toml:4:1: key 'prepare.stage.1.reduced_pressure' has a meaning only with method = "
     "\"grow\""},
    {"[dynamics]\nbrownian_step = 0", "file.toml:2:17: key 'dynamics.brownian_step' is 0.0"},
    {"[dynamics]\nequilibration = -1", "file.toml:2:17: key 'dynamics.equilibration' is -1.0"},
    {"[dynamics]\nduration = inf", "file.toml:2:12: key 'dynamics.duration' is inf"},
    {"[dynamics]\nrestitution = 1.1", "file.toml:2:15: key 'dynamics.restitution' is 1.1"},
    {"[dynamics]\nrestitution = -0.1", "file.toml:2:15: key 'dynamics.restitution' is -0.1"},
    {"[dynamics]\nrestitution = { form = \"viscoelastic\", value = 1, speed = 1 }",
     "key 'dynamics.restitution.value' is 1.0, but must lie above 0 and below 1"},
    {"[dynamics]\nrestitution = { form = \"viscoelastic\", value = 0.9, speed = 0 }",
     "key 'dynamics.restitution.speed' is 0.0, but must be positive"},
    {"[dynamics]\nrestitution = { form = \"table\", speeds = [1, 2], values = [0.9] }",
     "key 'dynamics.restitution.values' has 1 numbers, but must have as many as "
     "restitution.speeds, which has 2"},
    {"[dynamics]\nrestitution = { form = \"table\", speeds = [2, 1], values = [0.9, 0.8] }",
     "key 'dynamics.restitution.speeds' must hold numbers from 0 on, each above the one "
     "before"},
    {"[dynamics]\nrestitution = { form = \"table\", speeds = [1, 2], values = [0.9, 1.8] }",
     "key 'dynamics.restitution.values.1' is 1.8, but must lie between 0 and 1"},
    {"[dynamics]\nfriction = -1", "file.toml:2:12: key 'dynamics.friction' is -1.0, but must be 0"},
    {"[dynamics]\nfriction = nan", "key 'dynamics.friction' is nan"},
    {"[dynamics]\ntangential_restitution = 1.5",
     "key 'dynamics.tangential_restitution' is 1.5, but must lie between -1 and 1"},
    {"[dynamics]\ncontact_duration = -1", "key 'dynamics.contact_duration' is -1.0"},
    {"[dynamics]\ndriving = { interval = 0, power = 1 }",
     "key 'dynamics.driving.interval' is 0.0, but must be positive"},
    {"[dynamics]\nkind = \"brownian\"\ndriving = { interval = 1, power = 1 }",
     "key 'dynamics.driving' is for kind = \"newtonian\""},
    {"[[dynamics.pair]]\nfirst = \"A\"\nsecond = \"B\"",
     "file.toml:3:10: key 'dynamics.pair.0.second' is \"B\", but must be the name of a species"},
    {"[[dynamics.pair]]\nfirst = \"A\"\nsecond = \"A\"\nrestitution = 2",
     "key 'dynamics.pair.0.restitution' is 2.0"},
    {"[[dynamics.pair]]\nfirst = \"A\"\nsecond = \"A\"\n[[dynamics.pair]]\nfirst = \"A\"\nsecond = "
     "\"A\"\n",
     "key 'dynamics.pair.1.second' makes the same pair as dynamics.pair.0"},
    {"[[species]]\naspect_ratio = 1\n[dynamics]\nfriction = 0.5\n[dynamics.contact]\n",
     "key 'dynamics.friction' is for hard particles"},
    {"[dynamics]\nkind = \"brownan\"",
     "file.toml:2:8: key 'dynamics.kind' is \"brownan\", but must be one of "
     "\"newtonian\", \"brownian\"; did you mean 'brownian'?"},
    {"[output]\nsamples = { interval = 0 }",
     "file.toml:2:24: key 'output.samples.interval' is 0.0"},
    {"[output]\nsamples = { interval = 200 }", "must not exceed dynamics.duration = 100.0"},
    {"[output]\nsamples = { interval = 1e-9 }", "at most 1e8 are possible"},
    {"[output]\nsamples = { spacing = \"logarithmic\", per_decade = 0 }",
     "file.toml:2:51: key 'output.samples.per_decade' is 0"},
    {"[output]\nsamples = { spacing = \"logarithmic\", interval = 1 }",
     "has a meaning only with spacing = \"linear\""},
    {"[output]\ncorrelations = { interval = 0 }",
     "file.toml:2:29: key 'output.correlations.interval' is 0.0"},
    {"[output]\ncorrelations = { interval = 101 }",
     "is 101.0, but must lie between 1e-12 of dynamics.duration = 100.0 and all of it"},
    {"[output]\ncorrelations = { wave_numbers = 3 }",
     "file.toml:2:33: key 'output.correlations.wave_numbers' must be an array of numbers, not the "
     "number 3; for example wave_numbers = [1.0, 2.0]"},
    {"[output]\ncorrelations = { wave_numbers = [3, -1] }",
     "key 'output.correlations.wave_numbers.1' is -1.0, but must be positive"},
    {"[output]\ncheckpoint_interval = -1", "file.toml:2:23: key 'output.checkpoint_interval'"},
    {"[analysis]\nlongest_lag = 2", "file.toml:2:15: key 'analysis.longest_lag' is 2.0"},
    {"[analysis]\nmax_origins = 0", "file.toml:2:15: key 'analysis.max_origins' is 0"},
    {"[analysis]\nstructure = { frames = -1 }",
     "file.toml:2:24: key 'analysis.structure.frames' is -1"},
    {"[analysis]\nstructure = { wave_number_step = 0 }",
     "file.toml:2:34: key 'analysis.structure.wave_number_step' is 0.0, but must be positive"},
    {"[analysis]\nstructure = { distance_step = 21 }",
     "key 'analysis.structure.distance_step' is 21.0, but must lie between 0.002 and distance_max "
     "= 20.0"},
    {"[analysis]\nstructure = { wave_number_max = 2000 }",
     "key 'analysis.structure.wave_number_step' is 0.1, but must lie between 0.2 and "},
    {"[sweep.together]\n\"system.seed\" = [1, 2]\n\"dynamics.duration\" = [50]",
     "file.toml:3:23: key 'sweep.together.dynamics.duration' has 1 value(s), but 'system.seed' has "
     "2"},
    {"[sweep.grid]\nsystem.seed = [1]\n[sweep.together]\n\"system.seed\" = [2]",
     "file.toml:2:15: key 'sweep.grid.system.seed' stands twice in [sweep.grid] and "
     "[sweep.together]"},
    {"[sweep.grid]\nsystem.seed = [1]\n\"system.seed\" = [2]",
     "key 'sweep.grid.system.seed' stands twice"},
    {"[sweep.together]\n\"system.seed\" = []",
     "file.toml:2:17: key 'sweep.together.system.seed' must hold arrays of values to run through, "
     "not an "
     "empty array"},
    {"[sweep.grid]\n\"system.seed\" = [1, 2]\n[[sweep.published]]\nsource = \"A\"\n"
     "quantity = \"wall_seconds\"\nvalues = [1, 2, 3]",
     "file.toml:6:10: key 'sweep.published.0.values' has 3 number(s), but must have 2"},
    {"[[sweep.published]]\nsource = \"A\"\nquantity = \"wall_secs\"\nexponent = 2",
     "file.toml:3:12: key 'sweep.published.0.quantity' is \"wall_secs\", but must be one of "
     "tau_translation, "},
    {"[[sweep.published]]\nsource = \"A\"\nquantity = \"wall_seconds\"",
     "key 'sweep.published.0.values' excludes exponent; give one of the two"},
    {"[[sweep.published]]\nquantity = \"wall_seconds\"\nexponent = 2",
     "key 'sweep.published.0.source' is missing; name the publication"},
};

TEST(ParameterFile, EveryImpossibleValueIsRefusedWithItsPlace) {
  for (const BadFile& bad : bad_files)
    EXPECT_THAT(refusal(bad.text), HasSubstr(bad.message)) << bad.text;
}

constexpr const char* dense_plane = "[system]\npacking_fraction = 0.95\n";
constexpr const char* dense_space = "[system]\ndimension = 3\npacking_fraction = 0.75\n";
const std::string drawn = "{ distribution = \"uniform\", low = 1, high = 2 }";

std::string two_species(const std::string& first, const std::string& second) {
  return "[[species]]\nname = \"A\"\nfraction = 0.5\n" + first +
         "\n[[species]]\nname = \"B\"\nfraction = 0.5\n" + second + "\n";
}

// The bound for equal areas holds for any aspect ratios: an n-gon around an ellipse of area A has the area
// (A/π) n tan(π/n) at least, which is 2√3 A/π for the six sides that convex cells have on average.
TEST(ParameterFile, EqualAreasBoundThePackingFraction) {
  const std::string bound = "lies between 0 and π/√12 = 0.9069 where all particles have the same";
  const std::string semi_axes = "semi_axes = [2, 0.5]", disks = "aspect_ratio = 1";
  for (const std::string& species :
       {std::string(), "[[species]]\n" + disks, "[[species]]\n" + semi_axes,
        "[[species]]\naspect_ratio = " + drawn, two_species(semi_axes, disks),
        two_species("aspect_ratio = 3\nfirst_semi_axis = 3",
                    disks + "\nsize = 1.7320508075688772")})
    EXPECT_THAT(refusal(dense_plane + species), HasSubstr("0.95, but a packing fraction " + bound))
        << species;
  EXPECT_THAT(
      refusal("[[prepare.stage]]\npacking_fraction = 0.92"),
      HasSubstr("key 'prepare.stage.0.packing_fraction' is 0.92, but a packing fraction " + bound));
}

TEST(ParameterFile, ParticlesOfDifferentAreaMayFillMore) {
  const std::string disks = "aspect_ratio = 1\n";
  for (const std::string& species :
       {two_species(disks, disks + "size = 0.1"), two_species(disks, "semi_axes = [2, 1]"),
        "[[species]]\n" + disks + "size = " + drawn,
        "[[species]]\nfirst_semi_axis = 1\naspect_ratio = " + drawn,
        "[[species]]\nsemi_axes = [1, " + drawn + "]"}) {
    EXPECT_NO_THROW(parse_parameters(dense_plane + species, "file.toml")) << species;
    EXPECT_THAT(refusal("[system]\npacking_fraction = 1.0\n" + species),
                HasSubstr("is 1.0, but a packing fraction lies between 0 and 1"))
        << species;
  }
}

// Kepler's bound is for equal spheres; ellipsoids of aspect ratio √3 crystallize at 0.7707.
TEST(ParameterFile, EqualSpheresBoundThePackingFraction) {
  const std::string spheres = "aspect_ratio = 1\n";
  for (const std::string& species :
       {"[[species]]\n" + spheres, std::string("[[species]]\nsemi_axes = [2, 2, 2]\n"),
        two_species(spheres, "aspect_ratios = [1, 1]")})
    EXPECT_THAT(
        refusal(dense_space + species),
        HasSubstr("lies between 0 and π/√18 = 0.7405 where all particles are equal spheres"))
        << species;
  for (const std::string& species : {std::string("[[species]]\naspect_ratio = 1.7320508\n"),
                                     two_species(spheres, spheres + "size = 0.5"),
                                     "[[species]]\n" + spheres + "size = " + drawn})
    EXPECT_NO_THROW(parse_parameters(dense_space + species, "file.toml")) << species;
}

}  // namespace
}  // namespace vitrel
