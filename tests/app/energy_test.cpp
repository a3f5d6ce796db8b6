// Energy has no sources but the laws of the scene, in all scenes that come with vitrel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run;

std::set<std::filesystem::path> scenes() {
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(VITREL_PARAMS))
    if (entry.path().extension() == ".toml" && !entry.is_symlink()) files.insert(entry.path());
  return files;
}

/// A short run. Jammed particles are few here, as they collide very often.
std::vector<std::string> shortened(const std::filesystem::path& scene) {
  if (scene.filename().string().starts_with("jammed"))
    return {"--set", "dynamics.duration=1e-6", "--set", "system.particles=100"};
  return {"--set", "dynamics.duration=2"};
}

TEST(Energy, OfAllScenesChangesByTheirLawsOnly) {
  const Folder folder("energy");
  ASSERT_GT(scenes().size(), 15u);
  for (const std::filesystem::path& scene : scenes()) {
    SCOPED_TRACE(scene);
    const std::string output = scene.stem().string() + ".h5";
    std::vector<std::string> words = {
        "run", scene.string(), "-o", output, "--json", "-q", "--set", "dynamics.equilibration=0"};
    std::ranges::copy(shortened(scene), std::back_inserter(words));
    const Outcome outcome = run(folder.path(), words);
    ASSERT_EQ(outcome.code, 0) << outcome.errors;
    const auto summary = nlohmann::json::parse(outcome.output);
    EXPECT_GT(summary["collisions"], 0);
    EXPECT_EQ(summary["overlaps"], 0);
    const bool has_source = summary.value("added_energy", 0.0) > 0;
    EXPECT_LT(summary["energy_drift"], has_source ? 1e-5 : 1e-10);
  }
}

// Contacts that last as long as the time between collisions once heated an elastic gas.
TEST(Energy, IsNotAddedByLongContacts) {
  const Folder folder("long_contacts");
  folder.write("p.toml",
               "[system]\nparticles = 50\npacking_fraction = 0.3\n[[species]]\naspect_ratio = 2\n"
               "[dynamics]\nequilibration = 0\nduration = 10\n[output]\n"
               "samples = { spacing = \"linear\", interval = 1 }\n");
  for (const char* restitution : {"1", "0.5"})
    for (const char* contact_duration : {"0.1", "0.3", "3"}) {
      SCOPED_TRACE(std::string(restitution) + ", " + contact_duration);
      const std::string output = std::string(restitution) + "-" + contact_duration + ".h5";
      const Outcome outcome =
          run(folder.path(), {"run", "p.toml", "-o", output, "--json", "--set",
                              std::string("dynamics.restitution=") + restitution, "--set",
                              std::string("dynamics.contact_duration=") + contact_duration});
      ASSERT_EQ(outcome.code, 0) << outcome.errors;
      const auto summary = nlohmann::json::parse(outcome.output);
      EXPECT_LT(summary["energy_drift"], 1e-5);
      EXPECT_LE(summary["added_energy"], 75e-5);
      EXPECT_GE(summary.value("dissipated_energy", 0.0), 0);
      EXPECT_EQ(summary["overlaps"], 0);
      const bool warns =
          outcome.errors.find("contact_duration is not well below") != std::string::npos;
      EXPECT_EQ(warns, restitution != std::string("1")) << outcome.errors;
    }
}

}  // namespace
}  // namespace vitrel
