// What a sweep runs through: numbers or categories, the abscissa, and what tells curves apart.
#include "workflow/sweep/study_axes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/io/parameters.h"
#include "workflow/configuration/parameters.h"

namespace vitrel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> keys_of(const std::vector<StudyAxis>& axes) {
  std::vector<std::string> keys;
  for (const StudyAxis& axis : axes) keys.push_back(axis.key);
  return keys;
}

/// Jobs by their values as JSON.
std::vector<SweptValues> jobs(const std::vector<const char*>& values) {
  std::vector<SweptValues> all;
  for (const char* text : values) all.push_back(swept_values(parse_json(text, "test")));
  return all;
}

/// The only key of jobs with these values of it.
StudyAxis axis(const std::string& key, const std::vector<std::string>& values) {
  std::vector<SweptValues> all;
  for (const std::string& value : values) all.push_back({{key, value}});
  return study_keys(all).at(0);
}

TEST(StudyAxes, NumbersHaveTheSymbolAndTheUnitOfTheirParameter) {
  const StudyAxis density = axis("system.packing_fraction", {"0.5", "0.6"});
  EXPECT_EQ(density.symbol, "φ");
  EXPECT_EQ(density.unit, "1");
  EXPECT_THAT(density.value, ElementsAre(0.5, 0.6));
  EXPECT_EQ(density.text(1), "φ = 0.6");
  EXPECT_EQ(density.column(), "system_packing_fraction");
  const StudyAxis step = axis("dynamics.brownian_step", {"0.1", "1"});
  EXPECT_EQ(step.text(0), "τ_B = 0.1 time");
  EXPECT_EQ(axis("prepare.stage.1.growth_rate", {"0.1"}).symbol, "growth rate");
}

TEST(StudyAxes, QuantitiesAreReadInTheUnitOfTheirParameter) {
  const StudyAxis modulus = axis("dynamics.contact.youngs_modulus", {"\"0.001 GPa\"", "\"1 GPa\""});
  EXPECT_EQ(modulus.unit, "Pa");
  EXPECT_THAT(modulus.value, ElementsAre(1e6, 1e9));
  EXPECT_FALSE(modulus.is_category());
}

TEST(StudyAxes, ArraysCountByTheirFirstEntryIfTheOthersFollow) {
  const std::string key = "species.0.aspect_ratios";
  EXPECT_THAT(axis(key, {"[2,2]", "[10,10]"}).value, ElementsAre(2, 10));
  EXPECT_THAT(axis(key, {"[2,1]", "[10,1]"}).value, ElementsAre(2, 10));
  EXPECT_THAT(axis(key, {"[2,4]", "[3,6]"}).value, ElementsAre(2, 3));
  const StudyAxis mixed = axis(key, {"[2,2]", "[2,1]", "[2,2]"});
  EXPECT_THAT(mixed.labels, ElementsAre("[2,2]", "[2,1]"));
  EXPECT_THAT(mixed.value, ElementsAre(0, 1, 0));
  EXPECT_EQ(mixed.text(1), "R: [2,1]");
  EXPECT_TRUE(axis(key, {"[2,2]", "[2,2,2]"}).is_category());
}

TEST(StudyAxes, WordsAreCategories) {
  const StudyAxis kind = axis("dynamics.kind", {"\"newtonian\"", "\"brownian\"", "\"newtonian\""});
  EXPECT_THAT(kind.labels, ElementsAre("newtonian", "brownian"));
  EXPECT_EQ(kind.text(1), "kind: brownian");
  // A job begun by an earlier version, or of another file, may lack the key.
  EXPECT_TRUE(study_keys({{{"dynamics.duration", "1"}}, {}}).at(0).is_category());
}

TEST(StudyAxes, TheAbscissaIsTheKeyWithTheMostNumbers) {
  const auto keys = study_keys(jobs({R"({"a.x": 1, "a.y": 1, "a.kind": "p", "system.seed": 1})",
                                     R"({"a.x": 1, "a.y": 2, "a.kind": "q", "system.seed": 2})",
                                     R"({"a.x": 2, "a.y": 3, "a.kind": "r", "system.seed": 3})"}));
  EXPECT_THAT(keys_of(keys), ElementsAre("a.x", "a.y", "a.kind"));
  EXPECT_THAT(keys_of(study_axes(keys, {})), ElementsAre("a.x", "a.kind", "a.y"));
  EXPECT_THAT(keys_of(study_axes(keys, {{}, "a.x"})), ElementsAre("a.y", "a.kind", "a.x"));
  EXPECT_THAT(keys_of(study_axes(keys, {{}, "a.kind"})), ElementsAre("a.x", "a.y", "a.kind"));
  EXPECT_THAT(study_axes({}, {}), IsEmpty());
}

TEST(StudyAxes, KeysThatAdvanceTogetherAreOneAxis) {
  const auto keys = study_keys(jobs(
      {R"({"a.phi": 0.6, "a.time": 10, "a.n": 1})", R"({"a.phi": 0.6, "a.time": 10, "a.n": 2})",
       R"({"a.phi": 0.6, "a.time": 20, "a.n": 1})", R"({"a.phi": 0.6, "a.time": 20, "a.n": 2})",
       R"({"a.phi": 0.7, "a.time": 30, "a.n": 1})", R"({"a.phi": 0.7, "a.time": 30, "a.n": 2})"}));
  // Only the times tell the steps apart.
  EXPECT_THAT(keys_of(study_axes(keys, {{"a.phi", "a.time"}, {}})), ElementsAre("a.n", "a.time"));
  EXPECT_THAT(keys_of(study_axes(keys, {{"a.phi", "a.time"}, "a.phi"})),
              ElementsAre("a.time", "a.n", "a.phi"));
}

TEST(StudyAxes, WithoutANumberThatTellsTheStepsApartTheFirstKeyStandsForAll) {
  const auto keys =
      study_keys(jobs({R"({"a.shape": [2, 2], "a.n": 30})", R"({"a.shape": [2, 1], "a.n": 30})",
                       R"({"a.shape": [5, 1], "a.n": 45})"}));
  EXPECT_THAT(keys_of(study_axes(keys, {{"a.shape", "a.n"}, {}})), ElementsAre("a.shape"));
}

TEST(StudyAxes, ConstantsAreLeftOutUnlessTheyAreAll) {
  EXPECT_THAT(keys_of(study_axes(
                  study_keys(jobs({R"({"a.x": 1, "a.y": 1})", R"({"a.x": 1, "a.y": 2})"})), {})),
              ElementsAre("a.y"));
  EXPECT_THAT(keys_of(study_axes(study_keys(jobs({R"({"a.x": 1, "a.y": 1})"})), {})),
              ElementsAre("a.x"));
}

TEST(StudyAxes, EqualSymbolsAreToldApartByTheirKeys) {
  const auto keys =
      study_keys(jobs({R"({"species.0.aspect_ratio": 2, "species.1.aspect_ratio": 3})"}));
  EXPECT_EQ(keys[0].symbol, "species.0.aspect_ratio");
  EXPECT_EQ(keys[1].symbol, "species.1.aspect_ratio");
}

TEST(StudyAxes, FieldsAreFoundByTheirDottedKeys) {
  const auto unit = [](const std::string& key) {
    const auto field = parameter_field(key);
    return field ? field->unit : "none";
  };
  EXPECT_EQ(unit("dynamics.duration"), "time");
  EXPECT_EQ(unit("species.3.mass"), "mass");
  EXPECT_EQ(unit("dynamics.contact.material.0.stiffness"), "N/m");
  EXPECT_EQ(unit("species.0.semi_axes.1"), "length");
  EXPECT_EQ(unit("dynamics.durations"), "none");
  EXPECT_EQ(unit("dynamics"), "");
  EXPECT_EQ(parameter_field("species.0.aspect_ratios.1")->key, "aspect_ratios");
}

}  // namespace
}  // namespace vitrel
