#include "workflow/report/state_report.h"

#include <cmath>

#include "analysis/structure/orientation_tensor.h"
#include "core/error.h"
#include "core/io/h5md.h"
#include "core/io/json.h"
#include "tests/app/end_to_end.h"
#include "tests/support/report_pages.h"
#include "tests/support/scenes.h"
#include "workflow/analyze/analyze.h"
#include "workflow/prepare/quality.h"
#include "workflow/report/run_report.h"

namespace vitrel {
namespace {

/// A cubic lattice of spheroids along x, those of every third particle along z.
Configuration3 lattice() {
  Configuration3 c = cubic_lattice(6, simple_cubic, 0.1, {Vec3(2, 1, 1)});
  for (std::size_t i = 0; i < c.size(); i += 3)
    c.orientation[i] = Quaternion(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);
  return c;
}

class PackingFile : public testing::Test {
 protected:
  PackingFile() { write_state(file(), lattice(), Provenance{}); }

  fs::path file() const { return folder_ / "packing.h5"; }

 private:
  const Folder folder_{"packing_file"};
};

double summary(const Results& results, const char* column) {
  return results.find("summary")->find(column)->value.at(0);
}

// T = diag(2/3, 0, 1/3).
TEST_F(PackingFile, IsAnalysed) {
  const AnalysedRun run = analyze_run(file(), {});
  const Results& results = run.results;
  EXPECT_EQ(summary(results, "particles"), 216);
  EXPECT_TRUE(analysis_summary(run).at("particles").is_number_integer());
  EXPECT_TRUE(std::isinf(analysis_summary(run).at("orientation_ratio").get<double>()));
  EXPECT_EQ(summary(results, "rotors"), 216);
  EXPECT_NEAR(summary(results, "packing_fraction"), 0.1, 1e-12);
  EXPECT_TRUE(std::isinf(summary(results, "orientation_ratio")));
  EXPECT_EQ(summary(results, "isotropic_ratio"), isotropic_ratio(216).mean);
  const Table* tensor = results.find("orientation_tensor");
  ASSERT_TRUE(tensor);
  EXPECT_NEAR(tensor->find("t_x")->value[0], 2.0 / 3, 1e-14);
  EXPECT_NEAR(tensor->find("t_z")->value[2], 1.0 / 3, 1e-14);
  EXPECT_NEAR(tensor->find("eigenvalue")->value[2], 2.0 / 3, 1e-14);
  EXPECT_NEAR(std::abs(tensor->find("eigenvector_x")->value[2]), 1, 1e-14);
  EXPECT_NEAR(std::abs(tensor->find("eigenvector_y")->value[0]), 1, 1e-14);
  // Shells without wave vectors are left out; the first peak of the lattice is at 2π/side.
  const Table* scattering = results.find("structure_factor");
  ASSERT_TRUE(scattering);
  double largest = 0, at = 0;
  for (std::size_t k = 0; k < scattering->rows(); ++k) {
    EXPECT_GT(scattering->find("modes")->value[k], 0);
    const double q = scattering->find("q")->value[k], s = scattering->find("s")->value[k];
    if (q < 2 && s > largest) largest = s, at = q;
  }
  EXPECT_NEAR(at, 2 * M_PI * 6 / lattice().box.lengths().x(), 0.1);
  EXPECT_GT(results.find("pair_correlation")->rows(), 10u);
  ASSERT_TRUE(results.find("pair_correlation_by_angle"));
  EXPECT_GT(results.find("pair_correlation_by_angle")->rows(), 10u);
  const Table* two_point = results.find("two_point");
  ASSERT_TRUE(two_point);
  EXPECT_NEAR(two_point->find("s2")->value[0], 0.1, 0.005);
  EXPECT_NEAR(two_point->find("lineal_path_y")->value[0], 0.1, 1e-12);
}

TEST_F(PackingFile, IsAnalysedAsTheCommandLineSays) {
  AnalysisChoice choice;
  choice.overrides = {"analysis.structure.wave_number_max=3"};
  const Results results = analyze_run(file(), choice).results;
  EXPECT_LT(results.find("structure_factor")->find("q")->value.back(), 3);
}

TEST_F(PackingFile, HasAPage) {
  const StatePage page = packing_page_data(file(), {});
  EXPECT_EQ(page.title, "Packing of 216 ellipsoids, 2 : 1 : 1");
  EXPECT_EQ(page.subtitle, "packing, φ = 0.1");
  EXPECT_EQ(std::get<Movie3>(page.movie).particles(), 216u);
  EXPECT_EQ(std::get<Movie3>(page.movie).frames(), 1u);
  EXPECT_EQ(std::get<Movie3>(page.movie).overlapping_pairs[0], 0u);
  EXPECT_EQ(page.rows.size(), 4u);
  EXPECT_EQ(page.rows[1].value, "0.667, 0.000, 0.333; 0.000, 0.000, 0.000");
  const std::string text = state_page(page);
  expect_parts(text, {"<h1>Packing of 216 ellipsoids, 2 : 1 : 1</h1>", "a b c = 1",
                      "id=\"two_point\"", "id=\"pair_correlation_by_angle\""});
  EXPECT_THAT(text, Not(HasSubstr("{{")));
  EXPECT_LT(text.size(), 175'000u);
}

TEST_F(PackingFile, TakesFromTheQualityReportWhatOnlyThePreparationKnows) {
  PackingQuality quality = measure_quality(lattice(), exact_check(lattice()));
  quality.pressure_from = StateQuality::PressureFrom::sampling;
  quality.reduced_pressure = {17, 0.5, 0};
  quality.first_orientation_tensor = Vec3(0.5, 0.25, 0.25).asDiagonal();
  quality.collisions = 4321;
  quality.wall_seconds = 2.5;
  quality.backbone = JammedBackbone{{6, 1000, 9.52, 10}, 2e-3};
  write_quality(quality_file(file()), quality);
  const std::string text = state_page(packing_page_data(file(), {}));
  expect_parts(text, {"<td>17.00 ± 0.50</td>", "at the start 0.500, 0.250, 0.250; 0.000",
                      "<td>4321</td>", "<td>2.5 s</td>", "<td>9.520</td>",
                      "isostatic: 10; gaps below 0.002", "<td>6 of 216</td>"});

  quality.particles = 7;
  write_quality(quality_file(file()), quality);
  EXPECT_THROW(packing_page_data(file(), {}), FileError);
}

TEST_F(PackingFile, OfARunHasThePageOfARun) {
  const std::vector<std::string> observables = {"rotational_energy", "translational_energy",
                                                "virial"};
  TrajectoryWriter writer = TrajectoryWriter::create(
      file(), lattice(), Provenance{}, {.observables = observables, .overwrite = true});
  Configuration3 c = lattice();
  const double n = static_cast<double>(c.size());
  for (int k = 0; k < 3; ++k) {
    c.time = k;
    if (k == 2) c.position[0].x() += 0.01;
    writer.write(
        c, k,
        {{"rotational_energy", n}, {"translational_energy", 1.5 * (n - 1)}, {"virial", 6 * n * k}});
  }
  writer.close();
  const ReportData data = report_data(analyze_run(file(), {}));
  EXPECT_EQ(data.title, "packing: run of 216 ellipsoids, 2 : 1 : 1");
  EXPECT_EQ(data.subtitle, "φ = 0.1");
  ASSERT_EQ(data.runs.size(), 1u);
  const Movie3& movie = std::get<Movie3>(data.runs[0].movie);
  EXPECT_EQ(movie.particles(), 216u);
  EXPECT_EQ(movie.time, std::vector<double>({0, 1, 2}));
  const Results& results = data.runs[0].results;
  EXPECT_EQ(results.find("energies")->find("translational")->value.size(), 3u);
  EXPECT_FALSE(data.runs[0].cooling);
  const std::string page = report_page(data);
  expect_parts(page, {"a b c = 1", "<td>√(m (abc)^⅔/kT)</td>"});
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  // E = (3 (N − 1) + 2 N) kT/2 at kT = 1, and Z = 1 + 6/3.
  EXPECT_NEAR(results.find("compressibility_factor")->find("z")->value[0], 3, 1e-12);
}

}  // namespace
}  // namespace vitrel
