// Energy has no sources but the laws of the scene, in all scenes that come with vitrel.

#include <set>

#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

std::set<fs::path> scenes() {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(VITREL_PARAMS))
    if (entry.path().extension() == ".toml" && !entry.is_symlink()) files.insert(entry.path());
  return files;
}

/// A short run. Jammed particles are few here, as they collide very often.
std::string shortened(const fs::path& scene) {
  return scene.filename().string().starts_with("jammed")
             ? "--set dynamics.duration=1e-6 --set system.particles=100"
             : "--set dynamics.duration=2";
}

TEST(Energy, OfAllScenesChangesByTheirLawsOnly) {
  const Folder folder("energy");
  ASSERT_GT(scenes().size(), 15u);
  for (const fs::path& scene : scenes()) {
    SCOPED_TRACE(scene);
    const auto summary =
        folder.summary(fmt::format("run '{}' -o {}.h5 --set dynamics.equilibration=0 {}",
                                   scene.string(), scene.stem().string(), shortened(scene)));
    EXPECT_GT(summary["collisions"], 0);
    EXPECT_EQ(summary["overlaps"], 0);
    const bool has_source = summary.value("added_energy", 0.0) > 0;
    EXPECT_LT(summary["energy_drift"], has_source ? 1e-5 : 1e-10);
  }
}

// Contacts that last as long as the time between collisions once heated an elastic gas.
TEST(Energy, IsNotAddedByLongContacts) {
  const Folder folder(
      "long_contacts",
      "[system]\nparticles = 50\npacking_fraction = 0.3\n[[species]]\naspect_ratio = 2\n"
      "[dynamics]\nequilibration = 0\nduration = 10\n[output]\n"
      "samples = { spacing = \"linear\", interval = 1 }\n");
  for (const std::string restitution : {"1", "0.5"})
    for (const std::string contact_duration : {"0.1", "0.3", "3"}) {
      const std::string name = restitution + "-" + contact_duration;
      SCOPED_TRACE(name);
      const Outcome outcome = folder.run(
          "run p.toml --json --set dynamics.restitution=" + restitution +
          " --set dynamics.contact_duration=" + contact_duration + " -o " + name + ".h5");
      ASSERT_EQ(outcome.code, 0) << outcome.errors;
      const auto summary = nlohmann::json::parse(outcome.output);
      EXPECT_LT(summary["energy_drift"], 1e-5);
      EXPECT_LE(summary["added_energy"], 75e-5);
      EXPECT_GE(summary.value("dissipated_energy", 0.0), 0);
      EXPECT_EQ(summary["overlaps"], 0);
      const bool warns =
          outcome.errors.find("contact_duration is not well below") != std::string::npos;
      EXPECT_EQ(warns, restitution != "1") << outcome.errors;
    }
}

}  // namespace
}  // namespace vitrel
