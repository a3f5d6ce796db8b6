#include "workflow/report/state_page.h"

#include <cmath>
#include <numbers>

#include "tests/app/end_to_end.h"
#include "tests/support/report_pages.h"

namespace vitrel {
namespace {

StatePage example(std::size_t particles) {
  StatePage page;
  page.title = "dense <1>";
  page.subtitle = "ellipses & disks";
  page.rows = {{"packing fraction", "0.7", ""}, {"pressure", "16.6 ± 0.2", "a < b"}};
  Configuration2 state;
  state.box = PeriodicBox<2>(Vec2(100, 50));
  state.resize(particles);
  state.shape[0] = {2, 0.5};
  state.angle[0] = 7;
  MemoryTrajectory2 trajectory({state});
  page.movie = film(trajectory);
  page.nematic_correlation = {{0.5, 1.5, 2.5}, {NAN, 0.25, 0.125}, {0, 2, 50}};
  page.nematic_order = 0.3;
  page.sweeps = {1, 2, 4};
  page.orientation = {0.9, 0.8, 0.7};
  page.displacement = {0.1, 0.2, 0.3};
  page.parameters = "name = \"</script>\"\n";
  page.provenance = {{"seed", "1"}};
  return page;
}

TEST(StatePage, NeedsNothingBesideItAndIsSmall) {
  const std::string page = state_page(example(1000));
  expect_counts(page, {{" src=", 0}, {"<link", 0}});
  EXPECT_EQ(count(page, "url("), count(page, "url(#"));
  EXPECT_EQ(count(page, "{{"), 0u);
  expect_parts(page, {"default-src 'none'"});
  EXPECT_LT(page.size(), 150'000u);
}

TEST(StatePage, HasARowForEveryPropertyAndKeepsTextAsText) {
  const std::string page = state_page(example(2));
  expect_parts(page,
               {"<h1>dense &lt;1&gt;</h1>", "ellipses &amp; disks",
                "<tr><th scope=\"row\">pressure</th><td>16.6 ± 0.2</td><td>a &lt; b</td></tr>"});
  expect_counts(page, {{"<tr>", 2}, {"</script>", 3}});
}

TEST(StatePage, CarriesThePictureAndTheCurves) {
  const nlohmann::json data = embedded_data(state_page(example(2)));
  EXPECT_EQ(data["movie"]["particles"], 2);
  EXPECT_EQ(data["movie"]["shapes"], nlohmann::json({{2, 0.5}, {1, 1}}));
  // The second particle, a disk of radius 1, lies on the first.
  EXPECT_EQ(data["movie"]["overlapping"], nlohmann::json({{0, 1}}));
  // Bins with pairs only; independent angles scatter by 1/√(2 pairs).
  EXPECT_EQ(data["correlation"]["time"], nlohmann::json({1.5, 2.5}));
  EXPECT_EQ(data["correlation"]["value"], nlohmann::json({0.25, 0.125}));
  EXPECT_EQ(data["correlation"]["error"], nlohmann::json({0.5, 0.1}));
  EXPECT_EQ(data["order"], 0.3);
  EXPECT_EQ(data["orientation"]["value"], nlohmann::json({0.9, 0.8, 0.7}));
  EXPECT_EQ(data["displacement"]["time"], nlohmann::json({1, 2, 4}));
}

TEST(StatePage, WhatIsUnknownIsNotThere) {
  StatePage page = example(2);
  page.nematic_correlation = {};
  page.sweeps = page.orientation = page.displacement = {};
  const nlohmann::json data = embedded_data(state_page(page));
  for (const char* curve : {"correlation", "orientation", "displacement"})
    EXPECT_TRUE(data[curve].is_null()) << curve;
  EXPECT_TRUE(data["tables"].empty());
}

/// The tables of the page of the state that these parameters prepare.
nlohmann::json tables_of_page(const std::string& name, const std::string& parameters) {
  const Folder folder(name);
  folder.write("p.toml", parameters);
  folder.succeed("prepare p.toml -o s.h5 -q");
  folder.succeed("report s.h5 -q");
  return embedded_data(folder.read("s.html"))["tables"];
}

TEST(StatePage, OfAFileHasItsStructure) {
  // A square lattice of 100 disks in a box of side 10 s, s² = π/φ.
  const nlohmann::json tables =
      tables_of_page("state_structure",
                     "[system]\nparticles = 100\npacking_fraction = 0.5\n"
                     "[[species]]\nname = \"A\"\naspect_ratio = 1.0\n"
                     "[prepare]\nquality_sweeps = 0\n[[prepare.stage]]\nmethod = "
                     "\"lattice\"\narrangement = \"square\"\n");
  const nlohmann::json& g = tables["pair_correlation"]["columns"];
  std::size_t first = 0;
  while (g["g"]["value"][first] == 0) ++first;
  const double spacing = std::sqrt(std::numbers::pi / 0.5);
  EXPECT_NEAR(g["r"]["value"][first].get<double>(), spacing, 0.025);
  EXPECT_FALSE(g.contains("g_2"));
  // All waves of a wave number below 2π/s vanish on the lattice.
  const nlohmann::json& s = tables["structure_factor"]["columns"];
  for (std::size_t k = 0; s["q"]["value"][k] < 2 * std::numbers::pi / spacing - 0.1; ++k)
    EXPECT_NEAR(s["s"]["value"][k].get<double>(), 0, 1e-6);
}

// g_2 and g_4 of a single state are noise; pairs of species are not.
TEST(StatePage, OfAMixtureHasThePairsOfSpecies) {
  const nlohmann::json tables =
      tables_of_page("state_mixture",
                     "[system]\nparticles = 60\npacking_fraction = 0.3\n"
                     "[[species]]\nname = \"A\"\nfraction = 0.5\naspect_ratio = 2.0\n"
                     "[[species]]\nname = \"B\"\nfraction = 0.5\naspect_ratio = 1.5\n"
                     "[prepare]\nquality_sweeps = 0\n[[prepare.stage]]\nmethod = \"insert\"\n");
  std::vector<std::string> names;
  for (const auto& [name, column] : tables["pair_correlation"]["columns"].items())
    names.push_back(name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("r", "g", "g_A_A", "g_A_B", "g_B_B"));
}

}  // namespace
}  // namespace vitrel
