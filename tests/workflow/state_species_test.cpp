// Parameters of a run that starts from a state: they must describe the particles of that state.
#include "workflow/configuration/state_species.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"

namespace vitrel {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* mixture =
    "[system]\nparticles = 30\nbox_aspect = 2.0\n"
    "[[species]]\nname = \"rod\"\nfraction = 0.4\nmass = 3.0\n"
    "aspect_ratio = { distribution = \"uniform\", low = 1.2, high = 1.8 }\n"
    "[[species]]\nname = \"disk\"\nfraction = 0.6\naspect_ratio = 1.0\nsize = 0.8\n";
constexpr const char* solids =
    "[system]\ndimension = 3\nparticles = 10\npacking_fraction = 0.01\n"
    "[[species]]\naspect_ratios = [1.5, 2.5]\nsize = 0.7\n";

Parameters parse(const std::string& text) {
  return parse_parameters(text, "p.toml");
}

Configuration2 drawn(const Parameters& p) {
  return draw_particles<2>(p.species, static_cast<std::size_t>(p.system.particles),
                           p.system.packing_fraction, box_proportions<2>(p.system), p.system.seed);
}

/// What starts from a state, given `text`.
template <int Dim>
Parameters taken(const std::string& text, const Configuration<Dim>& state,
                 const std::string& record) {
  Parameters parameters = parse(text);
  take_species(parameters, state, {"state.h5", record});
  return parameters;
}

template <int Dim>
std::string refusal(const std::string& text, const Configuration<Dim>& state,
                    const std::string& record) {
  try {
    taken(text, state, record);
  } catch (const UserError& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(StateSpecies, WhatIsNotGivenIsAsRecorded) {
  const Parameters made = parse(mixture);
  const std::string record = effective_parameters(made);
  const Configuration2 state = drawn(made);
  for (const char* given :
       {"",
        "[[species]]\nname = \"rod\"\nfraction = 0.4\n"
        "aspect_ratio = { distribution = \"uniform\", low = 1.2, high = 1.8 }\n"
        "[[species]]\nname = \"disk\"\nfraction = 0.6\nsemi_axes = [0.8, 0.8]\nmass = 0.64\n"})
    EXPECT_EQ(effective_parameters(
                  taken(std::string("[system]\nparticles = 30\n") + given, state, record)),
              record);
  EXPECT_EQ(effective_parameters(taken(mixture, state, record)), record);
}

TEST(StateSpecies, WhatContradictsTheRecordIsRefusedWithItsPlace) {
  const Parameters made = parse(mixture);
  const std::string record = effective_parameters(made);
  const Configuration2 state = drawn(made);
  const auto changed = [&](const std::string& part, const std::string& other) {
    std::string text = mixture;
    text.replace(text.find(part), part.size(), other);
    return refusal(text, state, record);
  };
  EXPECT_THAT(changed("size = 0.8", "size = 0.9"),
              AllOf(HasSubstr("p.toml:13:8: key 'species.1.size' is 0.9, but particle "),
                    HasSubstr(" has 0.8"), HasSubstr("(state.h5)")));
  EXPECT_THAT(changed("mass = 3.0", "mass = 2.0"), HasSubstr("'species.0.mass' is 2, but"));
  EXPECT_THAT(changed("\"rod\"", "\"bar\""), HasSubstr("is \"bar\", but in the state \"rod\""));
  EXPECT_THAT(changed("aspect_ratio = 1.0", "aspect_ratio = 1.1"),
              HasSubstr("'species.1.aspect_ratio' is 1.1, but particle"));
  // It would allow all particles, but they were not drawn from it.
  EXPECT_THAT(changed("high = 1.8", "high = 1.9"),
              HasSubstr("'species.0.aspect_ratio' is uniform from 1.2 to 1.9, at least 1, but the "
                        "state was drawn from uniform from 1.2 to 1.8"));
  EXPECT_THAT(changed("box_aspect = 2.0", "box_aspect = 1.0"),
              HasSubstr("'system.box_aspect' is 1, but that of the state 2"));
  EXPECT_THAT(refusal("[[species]]\naspect_ratio = 2.0\n", state, record),
              HasSubstr("'species' has 1 entries, but the state has 2 species"));
  std::string halves = mixture;
  halves.replace(halves.find("fraction = 0.4"), 14, "fraction = 0.5");
  halves.replace(halves.find("fraction = 0.6"), 14, "fraction = 0.5");
  EXPECT_THAT(refusal(halves, state, record),
              HasSubstr("is 0.5, which makes 15 of 30 particles, but the state has 12"));
}

TEST(StateSpecies, WithoutARecordTheParticlesDecide) {
  const Parameters made = parse(mixture);
  Configuration2 state = drawn(made);
  EXPECT_EQ(taken(mixture, state, "").species.front().mass, 3);
  // The ranges of particles that differ.
  const Distribution a = taken("", state, "").species.front().semi_axes->front();
  std::vector<double> rods;
  for (std::size_t i = 0; i < state.size(); ++i)
    if (state.species[i] == 0) rods.push_back(state.shape[i].a);
  EXPECT_EQ(a.low, std::ranges::min(rods));
  EXPECT_EQ(a.high, std::ranges::max(rods));
  // 1.7 to 1.8 leaves out some of the particles.
  std::string narrow = mixture;
  narrow.replace(narrow.find("low = 1.2"), 9, "low = 1.7");
  EXPECT_THAT(refusal(narrow, state, ""),
              HasSubstr("'species.0.aspect_ratio' is uniform from 1.7 to 1.8, at least 1, but"));
  for (Ellipse& shape : state.shape) shape = {1.5, 0.5};
  for (double& mass : state.mass) mass = 3;
  const Parameters found = taken("", state, "");
  ASSERT_EQ(found.species.size(), 2u);
  EXPECT_THAT(effective_parameters(found), HasSubstr("semi_axes = [1.5, 0.5]"));
  EXPECT_EQ(found.species[0].mass, 3);
  EXPECT_EQ(found.species[1].name, "disk");
  EXPECT_EQ(found.species[1].fraction, 0.6);
  EXPECT_NEAR(found.system.box_aspect.at(0), 2, 1e-12);
  // A record that does not describe the particles counts as none.
  EXPECT_EQ(effective_parameters(taken("", state, effective_parameters(made))),
            effective_parameters(found));
}

TEST(StateSpecies, SolidsKeepTheirTwoRatios) {
  const Parameters made = parse(solids);
  const Configuration3 state = draw_particles<3>(made.species, 10, 0.01, Vec3::Ones(), 1);
  const std::string record = effective_parameters(made);
  EXPECT_FALSE(species_conflict(made.species, state));
  const std::string rest = "[system]\ndimension = 3\nparticles = 10\npacking_fraction = 0.01\n";
  EXPECT_EQ(effective_parameters(taken(rest, state, record)), record);
  EXPECT_THAT(refusal(rest + "[[species]]\naspect_ratio = 1.5\n", state, record),
              HasSubstr("'species.0.aspect_ratio' is 1.5, but particle 0 has 2.5"));
  EXPECT_THAT(refusal(rest + "[[species]]\nsemi_axes = [1.0, 1.0, 1.0]\n", state, ""),
              HasSubstr("'species.0.semi_axes' is [1.0, 1.0, 1.0], but particle 0 has ["));
}

TEST(StateSpecies, DrawnSemiAxesAllowTheParticlesDrawnFromThem) {
  const auto with = [](const std::string& axes, const std::string& a) {
    return "[system]\nparticles = 20\n[[species]]\n" + axes + "\nfraction = 0.5\n" +
           "[[species]]\nname = \"B\"\naspect_ratio = 2.0\nfirst_semi_axis = " + a +
           "\nfraction = 0.5\n";
  };
  const std::string flat = "{ distribution = \"uniform\", low = 1.0, high = 2.0 }";
  const Parameters made = parse(with("semi_axes = [" + flat + ", 1.5]", flat));
  const Configuration2 state = drawn(made);
  const std::string record = effective_parameters(made);
  EXPECT_FALSE(species_conflict(made.species, state));
  EXPECT_EQ(effective_parameters(taken("[system]\nparticles = 20\n", state, record)), record);
  EXPECT_THAT(
      refusal(with("semi_axes = [" + flat + ", 1.4]", flat), state, ""),
      HasSubstr("'species.0.semi_axes' is [uniform from 1 to 2, at least 0.001, 1.4], but"));
  EXPECT_THAT(refusal(with("semi_axes = [" + flat + ", 1.5]", "1.5"), state, ""),
              HasSubstr("'species.1.first_semi_axis' is 1.5, but particle"));
  // It would allow all particles, but they were not drawn from it.
  const std::string wide = "{ distribution = \"uniform\", low = 0.5, high = 2.0 }";
  for (const std::string& other : {with("semi_axes = [" + wide + ", 1.5]", flat),
                                   with("semi_axes = [" + flat + ", 1.5]", wide)})
    EXPECT_THAT(refusal(other, state, record),
                HasSubstr("is uniform from 0.5 to 2, at least 0.001, "
                          "but the state was drawn from"));
}

}  // namespace
}  // namespace vitrel
