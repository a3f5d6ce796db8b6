#include "workflow/prepare/quality.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/text_file.h"
#include "core/special_values.h"
#include "tests/app/end_to_end.h"
#include "tests/support/preparations.h"

namespace vitrel {
namespace {

Parameters small() {
  Parameters parameters;
  parameters.system.particles = 64;
  parameters.quality_sweeps = 100;
  return parameters;
}

Quality measured(const Parameters& parameters) {
  return *measure_quality(prepared(parameters), parameters, {});
}

std::string text(const Quality& quality) {
  return quality_json(quality).dump();
}

// The value of the row of that name.
std::string row(const Quality& quality, const std::string& name) {
  for (const QualityRow& row : quality_rows(quality))
    if (row.name == name) return row.value;
  return "no such row";
}

/// Every field with a value of its own.
Quality example() {
  Quality quality;
  quality.particles = 500;
  quality.rotors = 400;
  quality.packing_fraction = 0.1 + 0.2;
  quality.pressure_from = Quality::PressureFrom::growth;
  quality.reduced_pressure = {1e6, unknown, 0};
  quality.nematic_order = 0.25;
  quality.nematic_correlation = {{0.5, 1.5, 2.5}, {unknown, 0.9, 0.1}, {0, 3, 7}};
  quality.hexatic_order = {0.3, 0.7};
  quality.smallest_gap = 1e-12;
  quality.backbone = JammedBackbone{{20, 1400, 5.83, 5.6}, 2e-3};
  quality.decorrelation =
      Decorrelation{{1, 2}, {0.9, 0.8}, {0.1, 0.2}, {16.5, 16.7}, 0.01, 800, 12, {}};
  return quality;
}

TEST(MeasureQuality, OfASquareLatticeOfParallelEllipses) {
  Parameters parameters = small();
  parameters.system.packing_fraction = 0.3;
  parameters.stages = {LatticeStage()};
  const Quality quality = measured(parameters);
  EXPECT_EQ(quality.particles, 64u);
  EXPECT_EQ(quality.rotors, 64u);
  EXPECT_NEAR(quality.packing_fraction, 0.3, 1e-12);
  EXPECT_NEAR(quality.nematic_order, 1, 1e-12);
  EXPECT_EQ(correlation_length(quality.nematic_correlation), infinity);
  EXPECT_EQ(quality.overlaps, 0u);
  EXPECT_GT(quality.smallest_gap, 0);
  EXPECT_EQ(quality.pressure_from, Quality::PressureFrom::sampling);
  EXPECT_NEAR(quality.reduced_pressure.mean, 2.2, 0.5);
  EXPECT_FALSE(quality.backbone);
}

TEST(MeasureQuality, LeavesTheStateAsItIs) {
  const Parameters parameters = small();
  const Preparation preparation = prepared(parameters);
  const std::vector<Vec2> before = preparation.configuration.position;
  const auto one = measure_quality(preparation, parameters, {});
  EXPECT_EQ(preparation.configuration.position, before);
  // And it measures the same again.
  EXPECT_EQ(text(*one), text(*measure_quality(preparation, parameters, {})));
}

TEST(MeasureQuality, TakesThePressureOfAGrowthThatEndedJammed) {
  Parameters parameters = small();
  GrowStage growth;
  growth.reduced_pressure = 1e6;
  growth.growth_rate = 0.02;
  parameters.stages[1] = growth;
  parameters.species[0].aspect_ratio->mean = 1.4;
  const Preparation grown = prepared(parameters);
  const Quality jammed = *measure_quality(grown, parameters, {});
  EXPECT_EQ(jammed.pressure_from, Quality::PressureFrom::growth);
  EXPECT_EQ(jammed.reduced_pressure.mean, grown.stages.back().growth.reduced_pressure);
  ASSERT_TRUE(jammed.backbone);
  EXPECT_GT(jammed.backbone->contact_number, 4);
  EXPECT_LT(jammed.backbone->contact_number, 6.2);
  EXPECT_FALSE(jammed.decorrelation->displacement_time);

  std::get<GrowStage>(parameters.stages[1]).reduced_pressure = 20;
  const Quality sampled = measured(parameters);
  EXPECT_EQ(sampled.pressure_from, Quality::PressureFrom::sampling);
  EXPECT_FALSE(sampled.backbone);
}

TEST(MeasureQuality, WithoutSweepsThePressureIsThatOfTheGrowth) {
  Parameters parameters = small();
  parameters.quality_sweeps = 0;
  const Quality quality = measured(parameters);
  EXPECT_EQ(quality.pressure_from, Quality::PressureFrom::growth);
  EXPECT_NEAR(quality.reduced_pressure.mean, 4.5, 0.5);
}

TEST(MeasureQuality, WithoutSweepsAndGrowthThereIsNeitherPressureNorTime) {
  Parameters parameters = small();
  parameters.stages[1] = SwellStage();
  parameters.quality_sweeps = 0;
  const Quality quality = measured(parameters);
  EXPECT_EQ(quality.pressure_from, Quality::PressureFrom::nothing);
  EXPECT_TRUE(std::isnan(quality.reduced_pressure.mean));
  EXPECT_FALSE(quality.decorrelation);
  EXPECT_EQ(row(quality, "reduced pressure βP/ρ"), "–");
  EXPECT_EQ(row(quality, "displacement time"), "no such row");
}

TEST(MeasureQuality, TheBudgetStopsIt) {
  RunControl control;
  control.should_stop = [] { return true; };
  const Parameters parameters = small();
  EXPECT_FALSE(measure_quality(prepared(parameters), parameters, control));
}

PackingQuality packing_grown_to(const std::string& pressure) {
  const Parameters parameters = parse_parameters(
      "[system]\ndimension = 3\nparticles = 64\n[[species]]\naspect_ratio = 1\n"
      "[prepare]\nquality_sweeps = 100\n[[prepare.stage]]\n[[prepare.stage]]\nmethod = "
      "\"grow\"\ngrowth_rate = 0.02\n"
      "reduced_pressure = " +
          pressure,
      "p.toml");
  return *measure_quality(prepared<3>(parameters), parameters, {});
}

TEST(MeasureQuality, OfAPackingInSpaceCountsContactsIfItIsJammed) {
  const PackingQuality jammed = packing_grown_to("1e6");
  ASSERT_TRUE(jammed.backbone);
  EXPECT_EQ(jammed.backbone->isostatic_number, 6);
  EXPECT_GT(jammed.backbone->contact_number, 5);
  EXPECT_LT(jammed.backbone->contact_number, 7);
  EXPECT_EQ(quality_json(jammed)["rattlers"], jammed.backbone->rattlers);
  EXPECT_EQ(jammed.pressure_from, StateQuality::PressureFrom::growth);
  EXPECT_FALSE(jammed.decorrelation->displacement_time);
  const PackingQuality fluid = packing_grown_to("20");
  EXPECT_FALSE(fluid.backbone);
  EXPECT_EQ(fluid.pressure_from, StateQuality::PressureFrom::sampling);
  EXPECT_NEAR(fluid.reduced_pressure.mean, 20, 5);
  EXPECT_TRUE(fluid.decorrelation->orientation.empty());
}

// 94 disks that are held need 2 · 93 + 1 contacts.
TEST(StateQuality, TooFewContactsAreNamed) {
  const auto remark = [](std::size_t contacts, std::size_t rotors) {
    Quality quality;
    quality.particles = 100;
    quality.rotors = rotors;
    quality.backbone = JammedBackbone{{6, contacts, 3.9, 4}, 1e-4};
    const std::vector<QualityRow> rows = quality_rows(quality);
    return std::ranges::find(rows, "contacts per particle", &QualityRow::name)->remark;
  };
  EXPECT_NE(remark(184, 0).find("not rigid: there are 184 contacts, but at least 187"),
            std::string::npos);
  EXPECT_EQ(remark(187, 0).find("not rigid"), std::string::npos);
  EXPECT_EQ(remark(184, 100).find("not rigid"), std::string::npos);
}

// Rotation in flight and collisions turn the particles afterwards.
TEST(MeasureQuality, OfAPackingInSpaceKnowsTheOrientationsItBeganWith) {
  const auto grown_from = [](const std::string& orientations) {
    const Parameters parameters = parse_parameters(
        "[system]\ndimension = 3\nparticles = 10\npacking_fraction = 0.1\n[[species]]\n"
        "aspect_ratio = 3\n[[prepare.stage]]\nmethod = \"insert\"\norientations = " +
            orientations + "\n[[prepare.stage]]\nmethod = \"grow\"\ngrowth_rate = 0.1",
        "p.toml");
    return *measure_quality(prepared<3>(parameters), parameters, {});
  };
  const PackingQuality aligned = grown_from("\"aligned\"");
  EXPECT_TRUE(aligned.first_orientation_tensor->isApprox(Mat3(Vec3(1, 0, 0).asDiagonal()), 1e-14));
  EXPECT_LT(aligned.orientation_tensor(0, 0), 1 - 1e-3);
  const PackingQuality planar = grown_from("\"planar\"");
  EXPECT_NEAR(planar.first_orientation_tensor->trace(), 1, 1e-14);
  EXPECT_LT(planar.first_orientation_tensor->col(2).norm(), 1e-14);
  const PackingQuality given = grown_from("\"tensor\"\norientation_tensor = [0.0, 0.0, 1.0]");
  EXPECT_NEAR((*given.first_orientation_tensor)(2, 2), 1, 1e-14);
}

TEST(QualityRows, SayWhatWasNotReached) {
  Quality quality = example();
  EXPECT_EQ(row(quality, "orientation time"), "12 sweeps");
  EXPECT_EQ(row(quality, "displacement time"), "longer than 800 sweeps");
  EXPECT_EQ(row(quality, "nematic correlation"), "up to r = 2");
  EXPECT_EQ(row(quality, "contacts per particle"), "5.830");
  EXPECT_EQ(row(quality, "rattlers"), "20 of 500");
  quality.nematic_correlation.value[2] = 0.5;
  EXPECT_EQ(row(quality, "nematic correlation"), "longer than 3");
  quality.rotors = 0;
  EXPECT_EQ(row(quality, "nematic order S"), "no such row");
  EXPECT_EQ(row(quality, "orientation time"), "no such row");
}

TEST(QualityFile, LiesBesideTheState) {
  EXPECT_EQ(quality_file("folder/a.b.h5"), "folder/a.b.quality.json");
  EXPECT_EQ(quality_file("state"), "state.quality.json");
}

/// A state that the file belongs to, as far as the reader can tell.
Configuration2 fitting_state(Quality& quality) {
  Configuration2 state;
  state.box = PeriodicBox<2>(Vec2(9, 7));
  state.resize(3);
  state.shape = {{1.5, 0.5}, {1.2, 1}, {1, 1}};
  state.angle = {0.1, 0.7, 0};
  state.species_names = {"A"};
  quality.particles = 3;
  quality.packing_fraction = packing_fraction(state);
  quality.nematic_order = nematic_order(state);
  return state;
}

TEST(QualityFile, ReadsBackWhatItWrote) {
  const Folder folder("quality_file");
  Quality quality = example();
  const Configuration2 state = fitting_state(quality);
  write_quality(folder / "a.quality.json", quality);
  const Quality back = read_quality(folder / "a.quality.json", state);
  EXPECT_EQ(text(back), text(quality));
  EXPECT_TRUE(std::isnan(back.nematic_correlation.value[0]));
  EXPECT_EQ(back.pressure_from, quality.pressure_from);
  EXPECT_EQ(back.decorrelation->orientation_time, 12u);
  EXPECT_FALSE(back.decorrelation->displacement_time);
  EXPECT_EQ(back.backbone->rattlers, 20u);

  quality.pressure_from = Quality::PressureFrom::sampling;
  quality.smallest_gap = infinity;
  quality.nematic_correlation = {};
  quality.backbone.reset();
  quality.decorrelation.reset();
  write_quality(folder / "a.quality.json", quality);
  const Quality bare = read_quality(folder / "a.quality.json", state);
  EXPECT_EQ(text(bare), text(quality));
  EXPECT_EQ(bare.smallest_gap, infinity);
  EXPECT_EQ(bare.pressure_from, Quality::PressureFrom::sampling);
  EXPECT_FALSE(bare.decorrelation);
}

TEST(QualityFile, SaysWhatIsWrongWithIt) {
  const Folder folder("quality_errors");
  Quality quality = example();
  const Configuration2 state = fitting_state(quality);
  const auto complaint = [&]() -> std::string {
    try {
      read_quality(folder / "a.quality.json", state);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint(), HasSubstr("a.quality.json: is missing"));
  folder.write("a.quality.json", "{\"particles\": 3}");
  EXPECT_THAT(complaint(), HasSubstr("a.quality.json: is JSON, but not a quality report"));
  folder.write("a.quality.json", "{\"parti");
  EXPECT_THAT(complaint(), HasSubstr("is not JSON"));
  quality.nematic_order *= 1 + 1e-15;  // of a version that rounded otherwise
  write_quality(folder / "a.quality.json", quality);
  EXPECT_EQ(complaint(), "");
  quality.nematic_order += 2e-12;
  write_quality(folder / "a.quality.json", quality);
  EXPECT_THAT(complaint(), HasSubstr("is the quality report of another state"));
}

}  // namespace
}  // namespace vitrel
