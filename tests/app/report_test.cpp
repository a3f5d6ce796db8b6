#include "app/workflow/report/report_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/workflow/report/page_parts.h"

namespace vitrel {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++times;
  return times;
}

/// n ellipses (κ = 2) and one disk on a line.
Configuration2 state(std::size_t n) {
  Configuration2 configuration;
  configuration.box = PeriodicBox<2>(Vec2(100, 50));
  configuration.resize(n + 1);
  configuration.time = 12.5;
  for (std::size_t i = 0; i < n; ++i) {
    configuration.shape[i] = {std::sqrt(2.0), std::sqrt(0.5)};
    configuration.position[i] = {static_cast<double>(i % 97) - 48,
                                 static_cast<double>(i % 47) - 23};
    configuration.angle[i] = 7;
  }
  return configuration;
}

ReportRun run(double packing_fraction) {
  ReportRun run;
  run.name = "run <1>";
  run.dynamics = "Brownian, step 0.1";
  run.packing_fraction = packing_fraction;
  run.particles = 11;
  run.rotors = 10;
  run.duration = 12.5;
  run.collisions = 123456;
  run.compressibility = {4.4921, 0.0312, 20};
  DisplacementGroup all;
  all.name = "all";
  all.particles = 11;
  all.rotors = 10;
  for (int k = 1; k <= 500; ++k) {
    run.displacements.lag.push_back(0.025 * k);
    all.translation.value.push_back(2.0 * k);
    all.translation.error.push_back(k < 400 ? 0.1 : none);
    all.rotation.value.push_back(1.0 * k);
    all.rotation.error.push_back(0.1);
  }
  run.displacements.groups = {all};
  for (int k = 0; k < 1000; ++k) {
    run.energy.time.push_back(0.0125 * k);
    run.energy.translational.push_back(1);
    run.energy.rotational.push_back(0.5);
    run.energy.total.push_back(1.5);
  }
  run.final_state = state(10);
  return run;
}

ReportData two_runs() {
  return {"Ellipses & <disks>",
          "N = 11",
          {run(0.7), run(0.5)},
          "[system]\nname = \"</script><b>\"\n",
          {{"version", "0.1.0"}, {"command", "vitrel run \"a\" > b"}}};
}

nlohmann::json embedded_data(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = page.find(open) + open.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(ReportPage, NeedsNothingBesideIt) {
  const std::string page = report_page(two_runs());
  EXPECT_EQ(count(page, " src="), 0u);
  EXPECT_EQ(count(page, "<link"), 0u);
  EXPECT_EQ(count(page, "@import"), 0u);
  EXPECT_EQ(count(page, "url("), 0u);
  EXPECT_EQ(count(page, "fetch("), 0u);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  // The one address is the home page of uPlot in its licence comment.
  EXPECT_EQ(count(page, "https://"), 1u);
  EXPECT_EQ(count(page, "http://"), 0u);
  EXPECT_NE(page.find("Copyright (c) 2022 Leon Sorokin"), std::string::npos);
  EXPECT_EQ(count(page, "{{"), 0u);
}

TEST(ReportPage, IsSmall) {
  ReportData data = two_runs();
  for (int k = 0; k < 5; ++k) data.runs.push_back(run(0.4 + 0.01 * k));
  for (ReportRun& run : data.runs) run.final_state = state(255);
  EXPECT_LT(report_page(data).size(), 300'000u);
}

TEST(ReportPage, TextFromOutsideStaysText) {
  const std::string page = report_page(two_runs());
  EXPECT_NE(page.find("<h1>Ellipses &amp; &lt;disks&gt;</h1>"), std::string::npos);
  EXPECT_NE(page.find("name = &quot;&lt;/script&gt;&lt;b&gt;&quot;"), std::string::npos);
  EXPECT_NE(page.find("vitrel run &quot;a&quot; &gt; b"), std::string::npos);
  EXPECT_EQ(count(page, "run <1>"), 0u);
  // Two scripts, and the data; a text of ours never ends one.
  EXPECT_EQ(count(page, "</script>"), 3u);
}

TEST(ReportPage, TableHasOneRowPerRunInTheOrderOfDensities) {
  const std::string page = report_page(two_runs());
  const std::size_t low = page.find("<th scope=\"row\">0.50</th>");
  const std::size_t high = page.find("<th scope=\"row\">0.70</th>");
  ASSERT_NE(low, std::string::npos);
  ASSERT_NE(high, std::string::npos);
  EXPECT_LT(low, high);
  EXPECT_EQ(count(page, "<td>4.492 ± 0.031</td>"), 2u);
  EXPECT_EQ(count(page, "<td>123\u202f456</td>"), 2u);
  // MSD 80 t and MSR 40 t: D = 20 in two dimensions, D_r = 20 in one; the MSD has no error at the
  // end.
  EXPECT_EQ(count(page, "<td>20</td>"), 2u);
  EXPECT_EQ(count(page, "<td>20.0000 ± 0.0085</td>"), 2u);
}

TEST(ReportPage, CarriesTheCurvesAndThePicture) {
  const nlohmann::json runs = embedded_data(report_page(two_runs()))["runs"];
  ASSERT_EQ(runs.size(), 2u);
  const nlohmann::json& first = runs[0];
  EXPECT_EQ(first["label"], "φ = 0.50");
  EXPECT_EQ(first["dynamics"], "Brownian, step 0.1");
  // 500 lags over 2.7 decades at 30 a decade: the first ones all, then thinned.
  const nlohmann::json& msd = first["msd"];
  EXPECT_EQ(msd["time"][0], 0.025);
  EXPECT_EQ(msd["value"][2], 6);
  EXPECT_LT(msd["time"].size(), 82u);
  EXPECT_GT(msd["time"].size(), 50u);
  EXPECT_EQ(msd["time"].size(), msd["error"].size());
  EXPECT_TRUE(msd["error"].back().is_null());
  EXPECT_EQ(first["energy"]["stride"], 3);
  EXPECT_EQ(first["energy"]["time"].size(), 334u);
  const nlohmann::json& state = first["state"];
  ASSERT_EQ(state["particles"].size(), 11u * 5);
  EXPECT_EQ(state["particles"][0], -48);
  EXPECT_NEAR(state["particles"][2], 7 - 2 * M_PI, 1e-3);
  EXPECT_EQ(state["particles"][53], state["particles"][54]);
}

TEST(ReportPage, RunsOfEqualDensityAreToldApartByName) {
  ReportData data = two_runs();
  data.runs[0].packing_fraction = 0.5;
  data.runs[0].name = "seed_2";
  const nlohmann::json runs = embedded_data(report_page(data))["runs"];
  EXPECT_EQ(runs[0]["label"], "φ = 0.50 (seed_2)");
  EXPECT_EQ(runs[1]["label"], "φ = 0.50 (run <1>)");
}

TEST(ReportPage, LargeSystemsArePicturedInPart) {
  ReportData data = two_runs();
  data.runs[0].final_state = state(20'000);
  const nlohmann::json runs = embedded_data(report_page(data))["runs"];
  EXPECT_TRUE(runs[0]["state"]["periodic"].get<bool>());
  const nlohmann::json& part = runs[1]["state"];
  EXPECT_FALSE(part["periodic"].get<bool>());
  EXPECT_NEAR(part["window"][0], 100 * std::sqrt(4000.0 / 20'001), 1e-3);
  EXPECT_LT(part["particles"].size(), 5u * 5500);
  EXPECT_GT(part["particles"].size(), 5u * 3000);
}

TEST(ReportPage, WhatIsNotKnownIsADash) {
  ReportRun run;
  run.name = "empty";
  run.compressibility = {none, none, 0};
  const std::string page = report_page({"t", "s", {run}, "", {}});
  EXPECT_EQ(count(page, "<td>–</td>"), 5u);
  EXPECT_TRUE(embedded_data(page)["runs"][0]["msd"].is_null());
  EXPECT_TRUE(embedded_data(page)["runs"][0]["state"].is_null());
}

TEST(WithError, TwoDigitsOfTheError) {
  EXPECT_EQ(with_error(4.49213, 0.03121), "4.492 ± 0.031");
  EXPECT_EQ(with_error(1234.5, 41.7), "1234 ± 42");
  EXPECT_EQ(with_error(1.00004, 0.0999), "1.00 ± 0.10");
  EXPECT_EQ(with_error(1.5, 0), "1.5");
  EXPECT_EQ(with_error(2.71828, none), "2.718");
  EXPECT_EQ(with_error(none, 1), "–");
}

}  // namespace
}  // namespace vitrel
