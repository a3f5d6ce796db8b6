#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>

#include "mc/insertion.h"
#include "tests/support/report_example.h"
#include "workflow/report/packing_page.h"
#include "workflow/report/state_page.h"
#include "workflow/storage/text_file.h"

// write_pages <folder>: the pages that the browser opens, from made-up results.
namespace vitrel {
namespace {

StatePage state() {
  MemoryTrajectory2 trajectory = report_example::lattice(5, 1);
  StatePage page;
  page.title = "state";
  page.rows = {{"packing fraction", "0.196", ""}};
  page.state = trajectory.read(0);
  page.nematic_correlation = {{0.5, 1.5, 2.5}, {0.5, 0.25, 0.125}, {5, 20, 50}};
  page.nematic_order = 0.3;
  page.sweeps = {1, 2, 4};
  page.orientation = {0.9, 0.8, 0.7};
  page.displacement = {0.1, 0.2, 0.3};
  return page;
}

/// Two species, prolate and oblate, in a box that the prolate ones nearly span.
Configuration3 two_species() {
  Configuration3 c;
  c.resize(60);
  c.species_names = {"rods", "plates"};
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.species[i] = static_cast<std::int32_t>(i % 2);
    c.shape[i] = {i % 2 ? Vec3(1.5, 1.5, 0.4) : Vec3(3.5, 0.6, 0.6)};
  }
  insert_particles(c, {0.15, 1'000'000, false}, 1, {});
  return c;
}

/// One body of the semi-axes 3, 1.5 and 0.75 in the middle of a box of 8, turned by 40° about (1, 2, 2).
Configuration3 one_body() {
  Configuration3 c;
  c.resize(1);
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(Vec3::Constant(8));
  c.shape[0] = {Vec3(3, 1.5, 0.75)};
  c.orientation[0] = Quaternion(Eigen::AngleAxisd(40 * std::numbers::pi / 180, Vec3(1, 2, 2) / 3));
  return c;
}

PackingPage packing(const Configuration3& bodies) {
  PackingPage page;
  page.title = "packing";
  page.subtitle = "60 ellipsoids";
  page.rows = {{"packing fraction", "0.15", ""}};
  page.scene = packing_scene(bodies, exact_check(bodies));
  std::vector<double> x;
  for (int k = 1; k <= 40; ++k) x.push_back(0.1 * k);
  const auto wave = [](double value) { return 1 + std::sin(9 * value) / (9 * value); };
  page.results.tables = {
      {"pair_correlation",
       "",
       {report_example::plain("r", "length", x), report_example::column("g", "1", x, wave)}},
      {"structure_factor",
       "",
       {report_example::plain("q", "1/length", x), report_example::column("s", "1", x, wave),
        report_example::column("s_rods_plates", "1", x, wave)}}};
  return page;
}

/// Particle 1 on particle 0.
Configuration3 overlapping() {
  Configuration3 bodies = two_species();
  bodies.position[1] = bodies.position[0] + Vec3(0.5, 0, 0);
  bodies.box.wrap(bodies.position[1], bodies.image[1]);
  return bodies;
}

ReportData one_run() {
  ReportData data = report_example::sweep(2, 1);
  data.runs = {report_example::run(0.7, report_example::lattice(8, 20))};
  data.study = {};
  std::vector<Table>& tables = data.runs.front().results.tables;
  tables.push_back({"on_the_fly_all",
                    "",
                    {report_example::plain("time", "time", {1, 2, 4}),
                     report_example::plain("msd", "length^2", {0.1, 0.2, 0.4}),
                     report_example::plain("fs_1", "1", {0.9, 0.8, 0.6})}});
  tables.push_back(
      {"on_the_fly_wave_numbers",
       "",
       {report_example::plain("index", "1", {1}), report_example::plain("q", "1/length", {3.1})}});
  return data;
}

void write_pages(const std::filesystem::path& folder) {
  ReportData sweep = report_example::sweep(6, 12);
  MemoryTrajectory2 final_state = report_example::lattice(6, 1);
  sweep.runs[1].movie = film(final_state);
  write_text(folder / "sweep.html", report_page(sweep));
  write_text(folder / "run.html", report_page(one_run()));
  write_text(folder / "state.html", state_page(state()));
  write_text(folder / "packing.html", packing_page(packing(two_species())));
  write_text(folder / "one_body.html", packing_page(packing(one_body())));
  write_text(folder / "overlapping.html", packing_page(packing(overlapping())));
  ReportData large = report_example::sweep(2, 1);
  large.runs = {report_example::run(0.7, report_example::lattice(32, 200))};
  write_text(folder / "large.html", report_page(large));
  ReportData bare;
  bare.runs.resize(1);
  write_text(folder / "bare.html", report_page(bare));
}

}  // namespace
}  // namespace vitrel

int main(int, char** arguments) {
  try {
    vitrel::write_pages(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "write_pages: %s\n", error.what());
    return 1;
  }
}
