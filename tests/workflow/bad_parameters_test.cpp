// What no parameter file may say, and what a packing fraction may be.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/parameter_refusal.h"
#include "tests/support/refused_texts.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

// Every rule of `validate`, with the place of the value that breaks it.
TEST(ParameterFile, EveryImpossibleValueIsRefusedWithItsPlace) {
  for (const std::string section :
       {"system", "species", "prepare", "dynamics", "contact", "output", "sweep"})
    for (const auto& [text, message] :
         refused_texts(VITREL_SOURCE_FOLDER "/tests/workflow/bad_parameters/" + section + ".txt"))
      EXPECT_THAT(refusal(text), HasSubstr(message)) << text;
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
