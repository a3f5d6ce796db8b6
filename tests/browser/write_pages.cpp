#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numbers>

#include "core/io/text_file.h"
#include "core/special_values.h"
#include "mc/insertion.h"
#include "tests/support/report_example.h"
#include "workflow/report/pair_figures.h"
#include "workflow/report/state_page.h"

// write_pages <folder>: the pages that the browser opens, from made-up results.
namespace vitrel {
namespace {

StatePage state() {
  MemoryTrajectory2 trajectory = report_example::lattice(5, 1);
  StatePage page;
  page.title = "state";
  page.rows = {{"packing fraction", "0.196", ""}};
  page.structure.tables = report_example::structure();
  page.movie = film(trajectory);
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

/// One body of the semi-axes 3, 1.5 and 0.75 in the middle of a box of 8, turned by so many degrees about (1, 2, 2).
Configuration3 one_body(double degrees = 40) {
  Configuration3 c;
  c.resize(1);
  c.species_names = {"A"};
  c.box = PeriodicBox<3>(Vec3::Constant(8));
  c.shape[0] = {Vec3(3, 1.5, 0.75)};
  c.orientation[0] =
      Quaternion(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Vec3(1, 2, 2) / 3));
  return c;
}

StatePage packing(const Configuration3& bodies) {
  StatePage page;
  page.title = "packing";
  page.subtitle = "60 ellipsoids";
  page.rows = {{"packing fraction", "0.15", ""}};
  MemoryTrajectory3 trajectory({bodies});
  page.movie = film(trajectory);
  std::vector<double> x;
  for (int k = 1; k <= 40; ++k) x.push_back(0.1 * k);
  const auto wave = [](double value) { return 1 + std::sin(9 * value) / (9 * value); };
  page.structure.tables = {
      {"pair_correlation",
       "",
       {report_example::plain("r", "length", x), report_example::column("g", "1", x, wave)}},
      {"structure_factor",
       "",
       {report_example::plain("q", "1/length", x), report_example::column("s", "1", x, wave),
        report_example::column("s_rods_plates", "1", x, wave)}},
      {"two_point",
       "",
       {report_example::plain("r", "length", x), report_example::column("s2", "1", x, wave),
        report_example::column("lineal_path_x", "1", x, wave)}}};
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
  Results& results = data.runs.front().results;
  results.provenance = {{"verdict_reason", "it lasts 4 times tau_2; 16 are needed"}};
  std::vector<Table>& tables = results.tables;
  tables.push_back({"relaxation",
                    "",
                    {report_example::codes("verdict", verdict_names, {2}),
                     report_example::codes("verdict_translation", verdict_names, {0})}});
  static constexpr std::array<std::string_view, 2> times = {"self scattering", "orientation"};
  tables.push_back({"relaxation_times",
                    "",
                    {report_example::plain("group", "1", {0, 0, 1}),
                     report_example::codes("kind", times, {0, 1, 0}),
                     report_example::plain("parameter", "1/length or 1", {2.4, 2, 2.4}),
                     {"tau", "time", {10, unknown, 11}, {0.5, unknown, 0.5}},
                     report_example::plain("least", "time", {unknown, 250, unknown}),
                     report_example::plain("most", "time", {unknown, unknown, unknown})}});
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

/// A series of constants, but for the last digit that the page has, and of a director at ±π/2.
std::vector<Table> monotonous_series() {
  const std::vector<double> t = report_example::evenly(0, 1, 100);
  std::vector<double> z, director;
  for (std::size_t k = 0; k < t.size(); ++k) {
    z.push_back(k % 2 ? 4.5 : 4.50001);
    director.push_back((k % 2 ? 1 : -1) * (0.5 * std::numbers::pi - 0.05));
  }
  return {{"compressibility_factor",
           "",
           {report_example::plain("time", "time", t), report_example::plain("z", "1", z)}},
          {"order",
           "",
           {report_example::plain("time", "time", t),
            report_example::plain("nematic", "1", report_example::constant(100, 0)),
            report_example::plain("director", "rad", director)}}};
}

/// χ₄ = 1 up to t = 100, with errors at t = 6 and beyond t = 20 only, beside an overlap up to t = 250.
Table susceptibility_with_gaps() {
  const std::vector<double> t = report_example::evenly(0.5, 0.5, 500);
  Column overlap = report_example::plain("overlap", "1", report_example::constant(500, 0.5));
  Column chi{"chi_4", "1", report_example::constant(500, 1),
             report_example::constant(500, unknown)};
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] == 6 || t[k] > 20) chi.error[k] = 0.3;
    if (t[k] > 100) chi.value[k] = chi.error[k] = unknown;
  }
  return {"susceptibility", "", {report_example::plain("time", "time", t), overlap, chi}};
}

/// The body turns by 20° a frame, and its gas cools as Haff's law says, with τ = 3.
ReportData space_run() {
  std::vector<Configuration3> frames;
  for (int k = 0; k < 5; ++k) {
    frames.push_back(one_body(20 * k));
    frames.back().time = k;
  }
  MemoryTrajectory3 trajectory(std::move(frames));
  const std::vector<double> t = report_example::evenly(0, 1, 50);
  const auto energy = [](double time) { return 1.5 / std::pow(1 + time / 3, 2); };
  ReportData data = one_run();
  data.title = "space: run of 1 ellipsoid";
  ReportRun& run = data.runs.front();
  run.movie = film(trajectory);
  run.cooling = Cooling{2, "the coefficient of restitution is constant"};
  std::erase_if(run.results.tables, [](const Table& table) { return table.name == "energies"; });
  run.results.tables.push_back({"energies",
                                "",
                                {report_example::plain("time", "time", t),
                                 report_example::column("translational", "kT", t, energy)}});
  return data;
}

/// Spheres of radius 1 in a box of 8. One goes (1.5, 0, 0) a frame, from (−2, 0, 0): it overlaps the other one, at
/// (1, 1.9, 0), in frame 2 only, and lies half across the face in frame 4.
ReportData spheres_run() {
  std::vector<Configuration3> frames;
  for (int k = 0; k < 5; ++k) {
    Configuration3& c = frames.emplace_back();
    c.resize(2);
    c.species_names = {"A"};
    c.box = PeriodicBox<3>(Vec3::Constant(8));
    c.position = {Vec3(1.5 * k - 2, 0, 0), Vec3(1, 1.9, 0)};
    c.box.wrap(c.position[0], c.image[0]);
    c.time = k;
  }
  MemoryTrajectory3 trajectory(std::move(frames));
  ReportData data = one_run();
  data.runs.front().movie = film(trajectory);
  return data;
}

/// Two runs at different wave numbers, the second one of unevenly spaced samples; both of another origin.
ReportData two_runs() {
  ReportData data = report_example::sweep(2, 1);
  data.runs.pop_back();
  data.study.tables.pop_back();
  for (std::size_t k = 0; k < 2; ++k) {
    ReportRun& run = data.runs[k];
    run.results.tables = monotonous_series();
    run.results.tables.push_back(susceptibility_with_gaps());
    run.results.tables.push_back({"wave_numbers",
                                  "",
                                  {report_example::plain("index", "1", {1}),
                                   report_example::plain("q", "1/length", {k ? 3.1 : 2.4})}});
    for (Table& table : report_example::correlations(10, "all"))
      run.results.tables.push_back(std::move(table));
    run.provenance = {{"commit", "c0ffee"}, {"seed", k ? "12" : "7"}, {"host", k ? "b" : "a"}};
  }
  data.runs[1].results.provenance = {{"time_axis", "unevenly sampled: 500 lags"}};
  return data;
}

void write_pages(const std::filesystem::path& folder) {
  ReportData sweep = report_example::sweep(6, 12);
  MemoryTrajectory2 final_state = report_example::lattice(6, 1);
  sweep.runs[1].movie = film(final_state);
  write_text(folder / "sweep.html", report_page(sweep));
  write_text(folder / "run.html", report_page(one_run()));
  write_text(folder / "two_runs.html", report_page(two_runs()));
  write_text(folder / "state.html", state_page(state()));
  write_text(folder / "space_run.html", report_page(space_run()));
  write_text(folder / "spheres_run.html", report_page(spheres_run()));
  write_text(folder / "packing.html", state_page(packing(two_species())));
  write_text(folder / "one_body.html", state_page(packing(one_body())));
  write_text(folder / "overlapping.html", state_page(packing(overlapping())));
  const Pair<2> ellipses{{{1, 0.5}, {{0, 0}, 0}, {{0, 0}, 0}},
                         {{1, 0.5}, {{1, 1}, 0}, {{-1, 0}, std::numbers::pi}},
                         std::nullopt,
                         100};
  write_figures(folder / "pair_path.html", path_of_pair(ellipses, 2, 1000));
  write_figures(folder / "impact_paths.html", impact_paths(load_impact({})));
  write_figures(folder / "scaled_maps.html", scaled_maps(ContactParameters::Law::linear_dashpot));
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
