#include "core/io/number_text.h"
#include "workflow/report/report_page.h"

#include <cmath>

#include "core/special_values.h"
#include "tests/app/end_to_end.h"
#include "tests/support/report_example.h"
#include "tests/support/report_pages.h"
#include "workflow/report/page_parts.h"

namespace vitrel {
namespace {

using report_example::codes;
using report_example::lattice;
using report_example::plain;
using report_example::set_runs;
using report_example::sweep;

TEST(ReportPage, NeedsNothingBesideIt) {
  const std::string page = report_page(sweep(3, 4));
  expect_counts(page, {{" src=", 0}, {"<link", 0}, {"@import", 0}});
  // Parts of a picture refer to one another.
  EXPECT_EQ(count(page, "url("), count(page, "url(#"));
  EXPECT_EQ(count(page, "fetch("), 0u);
  expect_parts(page, {"default-src 'none'"});
  // The one address is the home page of uPlot in its licence comment; the other one is the name of SVG.
  EXPECT_EQ(count(page, "https://"), 1u);
  EXPECT_EQ(count(page, "http://"), count(page, "http://www.w3.org/2000/svg"));
  expect_parts(page, {"Copyright (c) 2022 Leon Sorokin"});
  EXPECT_EQ(count(page, "{{"), 0u);
}

TEST(ReportPage, TwoHundredFramesOfAThousandParticlesTakeTwoMegabytes) {
  ReportData data = sweep(2, 1);
  data.runs = {report_example::run(0.7, lattice(32, 300))};
  data.runs.front().movie = Movie2();
  const std::size_t without = report_page(data).size();
  MemoryTrajectory2 trajectory = lattice(32, 300);
  data.runs.front().movie = film(trajectory);
  const Movie2& movie = std::get<Movie2>(data.runs.front().movie);
  EXPECT_EQ(movie.particles(), 1024u);
  EXPECT_EQ(movie.frames(), 195u);
  const std::size_t size = report_page(data).size();
  EXPECT_LT(size, 2'000'000u);
  // Eight characters a pose, and little else.
  EXPECT_NEAR(static_cast<double>(size - without), 8.0 * 1024 * 195, 30'000);
}

TEST(ReportPage, TextFromOutsideStaysText) {
  const std::string page = report_page(sweep(2, 1));
  expect_parts(
      page, {"<h1>Ellipses &amp; &lt;disks&gt;</h1>", "name = &quot;&lt;/script&gt;&lt;b&gt;&quot;",
             "vitrel run &quot;a&quot; &gt; b"});
  EXPECT_EQ(count(page, "run <1>"), 0u);
  // Two scripts, and the data; a text of ours never ends one.
  EXPECT_EQ(count(page, "</script>"), 3u);
}

TEST(ReportPage, TableHasOneRowPerRunInTheirOrder) {
  ReportData data = sweep(2, 1);
  set_runs(data, {data.runs[2], data.runs[1], data.runs[0]});
  const std::string page = report_page(data);
  const std::size_t table = page.find("Table of runs</h2>");
  const std::size_t low = page.find("<th scope=\"row\">0.50</th>", table);
  const std::size_t high = page.find("<th scope=\"row\">0.70</th>", table);
  ASSERT_NE(low, std::string::npos);
  ASSERT_NE(high, std::string::npos);
  EXPECT_LT(high, low);
  expect_counts(page, {{"<td>4.492 ± 0.031</td>", 3},
                       {"<td>0.5000 ± 0.0010</td>", 3},
                       {"<td>123\u202f456</td>", 3},
                       {"<td>300\u202f000</td>", 3}});
  // The rotational diffusion coefficients are not known, and have no column.
  EXPECT_EQ(count(page.substr(table), "<th scope=\"col\">D<sub>r</sub></th>"), 0u);
  EXPECT_EQ(count(page.substr(table), "<th scope=\"col\">D</th>"), 1u);
}

TEST(ReportPage, TableOfFitsGivesValuesBoundsAndDashes) {
  const std::string page = report_page(sweep(2, 1));
  expect_counts(page,
                {{"<tr><th scope=\"row\">translation, τ<sub>α</sub></th><td>power law</td>"
                  "<td>0.8000 ± 0.0050</td><td>2.00 ± 0.10</td>"
                  "<td>0.62 … 0.72</td><td>1.20</td><td>1</td></tr>",
                  1},
                 {"<tr><th scope=\"row\">rotation, τ<sub>2</sub></th><td>power law</td>"
                  "<td>&gt; 0.795</td><td>–</td><td>0.6 … 0.66</td><td>1.00</td><td>1.5</td></tr>",
                  1},
                 {"<tr><th scope=\"row\">rotation, τ<sub>2</sub></th><td>Vogel–Fulcher</td>"
                  "<td>–</td><td>–</td><td>0.6 … 0.66</td><td>20.00</td><td>1.5</td></tr>",
                  1},
                 {"<th scope=\"row\">rotation in the nematic, τ<sub>2</sub></th>", 1}});
}

TEST(ReportPage, LawsThatNoDataCouldBeFittedToHaveNoWindow) {
  ReportData data = sweep(2, 1);
  Table& fits = data.study.tables[1];
  for (Column& column : fits.columns) {
    const bool told = column.name == "kind" || column.name == "law" || column.name == "scatter";
    column.value = {told ? 1 : column.name == "verdict" ? 2 : unknown};
    if (!column.error.empty()) column.error = {unknown};
  }
  expect_counts(report_page(data),
                {{"<tr><th scope=\"row\">rotation, τ<sub>2</sub></th>"
                  "<td>Vogel–Fulcher</td><td>–</td><td>–</td><td>–</td><td>–</td><td>–</td></tr>",
                  1}});
}

TEST(ReportPage, TableOfRunsOfTheStudyNamesVerdictsAndOrientations) {
  const std::string page = report_page(sweep(2, 1));
  // τ_α = 0.1 (0.8 − 0.6)^−2 and τ_2 = 4 (0.81 − 0.6)^−2.5, errors 5 %.
  expect_counts(
      page,
      {{"<tr><th scope=\"row\">0.60</th><td>1</td><td>equilibrated</td><td>equilibrated</td>"
        "<td>relaxes</td><td>3.873</td><td>2.50 ± 0.12</td><td>197.9 ± 9.9</td>"
        "<td>0.1000 ± 0.0050</td><td>0.04</td><td>–</td><td>2500</td></tr>",
        1},
       {"<td>equilibrated</td><td>nematic order</td>", 6},
       {"<td>ageing</td><td>nematic order</td>", 2},
       {"<td>not enough time</td><td>not within this run</td><td>4.359</td><td>62.5 ± 3.1</td>"
        "<td>–</td><td>0.690 ± 0.034</td><td>0.04</td><td>0.4</td><td>2500</td></tr>",
        2}});
}

TEST(ReportPage, NotesOfTheStudyAreAList) {
  ReportData data = sweep(2, 1);
  const std::string page = report_page(data);
  EXPECT_EQ(count(page,
                  "<ul class=\"note\">\n<li>phi-0.74 (density 0.74, seed 1) stays out of the fits, "
                  "ageing: S drifts</li>\n<li>rotation, tau_2, Vogel-Fulcher: no phi_c, chi^2 "
                  "&lt;is&gt; too large</li>\n</ul>"),
            1u);
  EXPECT_EQ(count(page, "phi-0.6/run.h5"), 0u);
  data.study.provenance.clear();
  EXPECT_EQ(count(report_page(data), "<ul"), 0u);
}

TEST(ReportPage, CarriesTheTables) {
  const nlohmann::json data = embedded_data(report_page(sweep(3, 4)));
  ASSERT_EQ(data["runs"].size(), 3u);
  const nlohmann::json& first = data["runs"][0];
  EXPECT_EQ(first["label"], "φ = 0.50");
  EXPECT_EQ(first["dynamics"], "Brownian, step 0.1");
  EXPECT_EQ(data["study"]["jobs"]["columns"]["collisions_per_second_with_output"]["value"],
            nlohmann::json({300'000, 300'000, 300'000}));
  EXPECT_EQ(data["study"]["axes"],
            nlohmann::json::array({{{"column", "packing_fraction"}, {"symbol", "φ"}}}));
  // 500 times over 2.7 decades at 20 a decade: the first ones all, then thinned.
  const nlohmann::json& decay = first["tables"]["susceptibility"]["columns"];
  EXPECT_EQ(decay["time"]["value"][1], 1);
  EXPECT_EQ(decay["time"]["unit"], "time");
  EXPECT_GT(decay["time"]["value"].size(), 35u);
  EXPECT_LT(decay["time"]["value"].size(), 55u);
  EXPECT_NEAR(decay["overlap"]["value"][0], std::exp(-0.5 * 0.09 / 0.1), 1e-5);
  EXPECT_EQ(decay["overlap"]["error"].size(), decay["time"]["value"].size());
  // 1000 rows: every third.
  const nlohmann::json& energies = first["tables"]["energies"];
  EXPECT_EQ(energies["stride"], 3);
  EXPECT_EQ(energies["columns"]["time"]["value"].size(), 334u);
  EXPECT_FALSE(energies["columns"]["total"].contains("error"));
  EXPECT_EQ(first["tables"]["pair_correlation"]["columns"]["r"]["value"].size(), 100u);
  EXPECT_TRUE(first["tables"]["summary"]["columns"]["rotational_diffusion"]["value"][0].is_null());
  EXPECT_EQ(data["study"]["relaxation"]["columns"]["verdict"]["value"].size(), 18u);
  EXPECT_EQ(first["movie"]["particles"], 9);
}

/// Runs of 484 particles in seven groups, with twelve frames each in the page.
ReportData many_runs(std::size_t runs) {
  ReportData data = sweep(2, 1);
  ReportRun run = report_example::run(0.7, lattice(22, 12));
  for (const char* group : {"C", "D", "E", "F"})
    for (Table& table : report_example::correlations(10, group))
      run.results.tables.push_back(std::move(table));
  set_runs(data, std::vector(runs, run));
  return data;
}

std::size_t rows_of(const nlohmann::json& page, const char* table, const char* column) {
  return page["runs"][0]["tables"][table]["columns"][column]["value"].size();
}

TEST(ReportPage, TablesOfManyRunsAreThinnedUntilThePageHasTwoMegabytes) {
  const std::string few = report_page(many_runs(4)), many = report_page(many_runs(20));
  const nlohmann::json all = embedded_data(few), thinned = embedded_data(many);
  EXPECT_LT(few.size(), 2'000'000u);
  EXPECT_EQ(rows_of(all, "energies", "time"), 334u);
  EXPECT_LT(many.size(), 2'000'000u);
  // Not more than is needed: a step takes a quarter.
  EXPECT_GT(many.size(), 1'600'000u);
  EXPECT_LT(rows_of(thinned, "energies", "time"), rows_of(all, "energies", "time"));
  EXPECT_LT(rows_of(thinned, "displacements_A", "time"), rows_of(all, "displacements_A", "time"));
  // The study is not thinned.
  EXPECT_EQ(thinned["study"]["relaxation"], all["study"]["relaxation"]);
  EXPECT_EQ(thinned["study"]["jobs"]["columns"]["packing_fraction"]["value"].size(), 20u);
}

TEST(ReportPage, TablesOfManyRunsKeepFiveRowsADecade) {
  const nlohmann::json data = embedded_data(report_page(many_runs(100)));
  // Times 0.5 … 250 at 20 · 0.75⁵ a decade; 1000 rows by strides of 11, as 400 · 0.75⁵ rounds to 94.
  EXPECT_EQ(data["runs"][0]["tables"]["energies"]["stride"], 11);
  EXPECT_GE(rows_of(data, "displacements_A", "time"), 10u);
  EXPECT_LE(rows_of(data, "displacements_A", "time"), 14u);
}

TEST(ReportPage, TablesThatItDoesNotShowStayOut) {
  ReportData data = sweep(2, 1);
  const std::size_t size = report_page(data).size();
  for (const char* name : {"relaxation_times", "glass_fit_windows", "runs"}) {
    const Table table{name, "", {plain("time", "time", {1, 2, 3})}};
    data.study.tables.push_back(table);
    data.runs[0].results.tables.push_back(table);
  }
  EXPECT_EQ(report_page(data).size(), size);
}

TEST(ReportPage, SeveralAxesLeadTheTableAndNameTheRuns) {
  ReportData data = sweep(2, 1);
  Table& jobs = data.study.tables.back();
  jobs.columns.push_back(plain("species_0_aspect_ratio", "1", {2, 2, 4}));
  data.axes = {{"species_0_aspect_ratio", "κ", "aspect ratio"},
               {"packing_fraction", "φ", "packing fraction"}};
  Table& relaxation = data.study.tables.front();
  relaxation.columns.push_back(
      {"run", "1", report_example::constant(relaxation.rows(), 0), {}, {"run <1>"}});
  for (ReportRun& run : data.runs) run.label = "κ = 2, φ < 1";
  const std::string page = report_page(data);
  expect_counts(page, {{"<tr><th scope=\"col\">κ</th><th scope=\"col\">φ</th><th", 1},
                       {"<tr><th scope=\"row\">4</th><td>0.70</td>", 1}});
  EXPECT_EQ(count(page, "<th scope=\"row\">κ = 2, φ &lt; 1</th><td>1</td>"), 9u);
  EXPECT_EQ(count(page, ">Against the packing fraction</h2>"), 1u);
  EXPECT_EQ(embedded_data(page)["study"]["axes"].size(), 2u);
}

TEST(ReportPage, BoundsThatAreNotKnownAreDashes) {
  ReportData data = sweep(2, 1);
  for (Column& column : data.study.tables[1].columns)
    if (column.name == "phi_c_least") column.value[2] = unknown;
  const std::string page = report_page(data);
  EXPECT_EQ(count(page, "&gt; –"), 0u);
  EXPECT_EQ(
      count(page, "<th scope=\"row\">rotation, τ<sub>2</sub></th><td>power law</td><td>–</td>"),
      1u);
}

/// A table of relaxation times; the groups are those of all particles unless given.
Table relaxation_times(std::vector<double> kinds, const std::vector<double>& parameter,
                       const std::vector<double>& tau,
                       const std::vector<double>& group = {0, 0, 0}) {
  static constexpr std::array<std::string_view, 5> names = {
      "self scattering", "orientation", "orientation of the middle axis",
      "orientation of the shortest axis", "self scattering relative to the cage"};
  return {"relaxation_times",
          "",
          {plain("group", "1", {group.begin(), group.begin() + std::ssize(tau)}),
           codes("kind", names, std::move(kinds)), plain("parameter", "1/length or 1", parameter),
           plain("tau", "time", tau)}};
}

/// The page of one run with these results, from the heading of its verdict on.
std::string result_of(Results results) {
  ReportData data;
  data.runs.resize(1);
  data.runs[0].results = std::move(results);
  const std::string page = report_page(data);
  const std::size_t begin = page.find("<h2 id=\"result\">");
  return begin == std::string::npos ? ""
                                    : page.substr(begin, page.find("</section>", begin) - begin);
}

TEST(ReportPage, RunsThatCannotBeJudgedSayWhy) {
  Table times = relaxation_times({0, 0}, {2.4, 2.4}, {unknown, 5}, {0, 1});
  times.columns.push_back(plain("least", "time", {unknown, unknown}));
  times.columns.push_back(plain("most", "time", {0.25, unknown}));
  const std::string result = result_of({{times}, {{"not_judged", "uneven <samples>"}}});
  // The other group is not that of all particles.
  expect_counts(result, {{"<td>not judged: uneven &lt;samples&gt;</td>", 1},
                         {"<td>&lt; 0.25 √(m ab/kT)</td>", 1},
                         {"<tr>", 2}});
  EXPECT_EQ(result_of({}), "");
}

TEST(ReportPage, RelaxationTimesRelativeToTheCageAreThoseOfScattering) {
  const std::string result = result_of({{relaxation_times({4}, {2.4}, {5})}, {}});
  expect_counts(result, {{"τ<sub>α</sub> relative to the cage</th><td>5 √(m ab/kT)</td>", 1},
                         {"F<sub>s</sub>(q, t) = 1/e at q = 2.4/√(ab)", 1}});
}

TEST(ReportPage, RelaxationTimesOfFurtherAxesNameThem) {
  const std::string result = result_of({{relaxation_times({1, 2, 3}, {2, 2, 2}, {5, 4, 3})}, {}});
  expect_counts(result, {{"τ<sub>2</sub></th><td>5 √(m ab/kT)</td>", 1},
                         {"τ<sub>2</sub> of the middle axis</th><td>4 √(m ab/kT)</td>", 1},
                         {"τ<sub>2</sub> of the shortest axis</th><td>3 √(m ab/kT)</td>", 1}});
}

TEST(ReportPage, OrientationsOfANematicAreSeenFromTheDirector) {
  const auto result = [](double tau) {
    return result_of({{{"relaxation",
                        "",
                        {codes("verdict", verdict_names, {0}),
                         codes("verdict_translation", verdict_names, {0}),
                         plain("plateau", "1", {0.4}),
                         {"tau_rotation", "time", {tau}, {0.5}}}}},
                      {}});
  };
  EXPECT_EQ(count(result(12), "seen from the director</th><td>12.00 ± 0.50 √(m ab/kT)</td>"), 1u);
  EXPECT_EQ(count(result(unknown), "seen from the director</th><td>not within this run</td>"), 1u);
}

/// A short run at the sample times that this says.
std::string small_run(const std::string& samples) {
  return "[system]\nparticles = 16\npacking_fraction = 0.2\n"
         "[[species]]\nname = \"A\"\naspect_ratio = 2.0\n"
         "[prepare]\nquality_sweeps = 0\n[[prepare.stage]]\nmethod = \"insert\"\n"
         "[dynamics]\nequilibration = 0\nduration = 2.0\n"
         "[output]\nsamples = { " +
         samples + " }\n";
}

TEST(ReportPage, OfUnevenSamplesDoesNotBlameBlocksForMissingErrors) {
  const Folder folder("uneven_samples");
  for (const std::string spacing : {"linear", "logarithmic"}) {
    folder.write("p.toml", small_run("spacing = \"" + spacing + "\""));
    folder.succeed("run p.toml -q -o " + spacing + ".h5");
    folder.succeed("report -q " + spacing + ".h5");
    const std::string page = folder.read(spacing + ".html");
    EXPECT_EQ(embedded_data(page)["runs"][0]["evenlySampled"], spacing == "linear");
    EXPECT_EQ(count(page, "<h1>" + spacing + ": run of 16 ellipses"), 1u);
  }
}

TEST(ReportPage, OfASweepNamesItAndGivesTheProvenanceOfEveryJob) {
  const Folder folder("sweep_of_seeds");
  folder.write("p.toml", small_run("spacing = \"linear\", interval = 0.1") +
                             "[sweep.grid]\n\"system.seed\" = [7, 12]\n");
  folder.succeed("sweep p.toml -o seeds -q");
  folder.succeed("report seeds -q");
  const std::string page = folder.read("seeds/report.html");
  expect_counts(page, {{"<title>seeds</title>", 1}, {"<h1>seeds</h1>", 1}});
  const std::size_t table = page.find("id=\"job-provenance\"");
  ASSERT_NE(table, std::string::npos);
  const std::string jobs = page.substr(table, page.find("</table>", table) - table);
  expect_counts(jobs, {{"<th scope=\"col\">command_line</th>", 1},
                       {"<th scope=\"col\">seed</th>", 1},
                       {"<th scope=\"row\">seed-7</th>", 1},
                       {"<th scope=\"row\">seed-12</th>", 1},
                       {"<td>7</td>", 1},
                       {"<td>12</td>", 1}});
  EXPECT_EQ(count(page, "# of seed-7\n"), 1u);
  // What all share stands once.
  expect_counts(page, {{"<dt>version</dt>", 1}, {"<dt>seed</dt>", 0}});
}

TEST(ReportPage, SaysThatOtherSeedsHaveOtherParticles) {
  const Folder folder("own_particles", small_run("spacing = \"linear\", interval = 0.1"));
  const auto page_with = [&](const std::string& name, const std::string& settings) {
    folder.succeed("run p.toml -q " + settings + " -o " + name + ".h5");
    folder.succeed("report -q " + name + ".h5");
    return folder.read(name + ".html");
  };
  const std::string random = "--set system.draw=random ";
  const std::string sizes = "--set 'species.0.size={ standard_deviation = 0.05 }'";
  const char* note = "of this realisation of sizes and shapes";
  EXPECT_EQ(count(page_with("random", random + sizes), note), 1u);
  EXPECT_EQ(count(page_with("quantiles", sizes), note), 0u);
  EXPECT_EQ(count(page_with("alike", random), note), 0u);
}

TEST(ReportPage, WhatIsNotKnownIsADash) {
  ReportData data;
  data.runs.resize(1);
  data.runs[0].name = "empty";
  const std::string page = report_page(data);
  expect_counts(page, {{"{{", 0}, {"<th scope=\"row\">", 0}});
  EXPECT_TRUE(embedded_data(page)["runs"][0]["tables"].empty());
  EXPECT_TRUE(embedded_data(page)["runs"][0]["movie"].is_null());
}

TEST(WithError, TwoDigitsOfTheError) {
  EXPECT_EQ(with_error(4.49213, 0.03121), "4.492 ± 0.031");
  EXPECT_EQ(with_error(1234.5, 41.7), "1234 ± 42");
  EXPECT_EQ(with_error(1.00004, 0.0999), "1.00 ± 0.10");
  EXPECT_EQ(with_error(1.5, 0), "1.5");
  EXPECT_EQ(with_error(1.5 + 2e-15, 9e-16), "1.5");
  EXPECT_EQ(with_error(-1.5, 1.4e-12), "-1.5");
  EXPECT_EQ(with_error(1.5, 1.6e-12), "1.5000000000000 ± 0.0000000000016");
  EXPECT_EQ(with_error(2.71828, unknown), "2.718");
  EXPECT_EQ(with_error(unknown, 1), "–");
}

}  // namespace
}  // namespace vitrel
