// Damaged and absurd files, as fuzzing found them: one message, the right exit code, no crash and no hang.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "core/io/h5.h"
#include "core/io/h5md.h"
#include "tests/app/program.h"

namespace vitrel {
namespace {

using testing_program::expect_refusal;
using testing_program::Folder;
using testing_program::run;

/// 12 bodies on a line, far apart.
template <int Dim>
Configuration<Dim> line_of_bodies() {
  Configuration<Dim> c;
  c.resize(12);
  Vec<Dim> lengths = Vec<Dim>::Constant(10);
  lengths[0] = 60;
  c.box = PeriodicBox<Dim>(lengths);
  c.species_names = {"A"};
  for (std::size_t i = 0; i < c.size(); ++i) {
    c.position[i] = Vec<Dim>::Zero();
    c.position[i][0] = -27.5 + 5 * static_cast<double>(i);
  }
  return c;
}

template <int Dim>
void write_changed(const Folder& folder, const std::function<void(Configuration<Dim>&)>& change) {
  Configuration<Dim> c = line_of_bodies<Dim>();
  change(c);
  write_state(folder / "state.h5", c, Provenance{}, true);
}

void expect_all_refuse(const Folder& folder, const std::vector<std::vector<std::string>>& commands,
                       const std::string& complaint) {
  for (std::vector<std::string> words : commands) {
    words.push_back("-q");
    expect_refusal(run(folder.path(), words), 3, complaint);
  }
}

// Reading it would meet the images of millions of boxes.
TEST(Hardening, AbsurdGeometryIsRefusedAtOnce) {
  const Folder folder("absurd_geometry");
  folder.write("p.toml", "# all defaults\n");
  write_changed<2>(folder, [](auto& c) { c.box = PeriodicBox<2>(1e-3 * c.box.lengths()); });
  expect_all_refuse(folder,
                    {{"check", "state.h5"},
                     {"report", "state.h5"},
                     {"analyze", "state.h5"},
                     {"run", "p.toml", "--from", "state.h5", "-o", "run.h5"}},
                    "state.h5: in frame 0 the ");
  write_changed<3>(folder, [](auto& c) { c.box = PeriodicBox<3>(0.05 * c.box.lengths()); });
  expect_all_refuse(folder,
                    {{"check", "state.h5"},
                     {"export", "state.h5", "--to", "geo"},
                     {"export", "state.h5", "--to", "vti"}},
                    "state.h5: in frame 0 the particles would fill the box 67.02 times");
  write_changed<3>(folder, [](auto& c) { c.shape[0].semi_axes[0] = 1e300; });
  expect_all_refuse(
      folder,
      {{"export", "state.h5", "--to", "csv", "--images"}, {"export", "state.h5", "--to", "vti"}},
      "state.h5: in frame 0 the longest semi-axis is 1e+300");
  write_changed<2>(folder, [](auto& c) { c.shape[0].a = 1e300; });
  expect_all_refuse(folder, {{"analyze", "state.h5"}}, "the longest semi-axis is 1e+300");
}

TEST(Hardening, MassesAndSpeciesThatCannotBeAreRefusedByAllCommands) {
  const Folder folder("masses");
  folder.write("p.toml", "[dynamics]\ninitial_velocities = \"keep\"\n");
  const std::vector<std::vector<std::string>> commands = {
      {"check", "state.h5"},
      {"analyze", "state.h5"},
      {"report", "state.h5"},
      {"export", "state.h5", "--to", "csv"},
      {"run", "p.toml", "--from", "state.h5", "-o", "run.h5"}};
  for (const double mass : {-1., 0., double{NAN}, double{INFINITY}}) {
    write_changed<2>(folder, [mass](auto& c) { c.mass[3] = mass; });
    expect_all_refuse(folder, commands, "state.h5: the mass of particle 3 is");
  }
  write_changed<2>(folder, [](auto&) {});
  {
    h5::File file = h5::File::open(folder / "state.h5", h5::Access::write);
    h5::Group particles = file.root().group("particles/all");
    particles.remove("species");
    std::vector<std::int32_t> species(12);
    species[0] = 2'147'483'647;
    particles.create_array<std::int32_t>("species", {12}, species);
    file.close();
  }
  expect_all_refuse(folder, commands, "state.h5: the species of particle 0 is 2147483647");
}

TEST(Hardening, AnArrayInThePlaceOfAStringIsRefused) {
  const Folder folder("array_of_strings");
  for (const char* name : {"author", "toml", "version", "parent"}) {
    write_changed<2>(folder, [](auto&) {});
    h5::File file = h5::File::open(folder / "state.h5", h5::Access::write);
    file.root().group("parameters").set_attribute(name, std::vector<std::string>(100, "a"), 1);
    file.close();
    for (const char* command : {"check", "report", "analyze"})
      expect_refusal(run(folder.path(), {command, "state.h5", "-q"}), 3, "it is not one string");
  }
}

TEST(Hardening, OddNamesAndSeedsAreRefusedInPlainWords) {
  const Folder folder("odd_names");
  folder.write("p.toml", "# all defaults\n");
  for (const char* command : {"prepare", "run"}) {
    expect_refusal(run(folder.path(), {command, "p.toml", "-o", ""}), 2,
                   "-o: the name of the output is empty");
    expect_refusal(run(folder.path(), {command, "p.toml", "-o", std::string(300, 'a')}), 3,
                   "aaa: File name too long");
    for (const char* seed : {"-1", "9223372036854775808", "1e3", "one"})
      expect_refusal(run(folder.path(), {command, "p.toml", "-o", "a.h5", "--seed", seed}), 2,
                     std::string(seed) + " is not a whole number between 0 and");
  }
}

// The names and the values of a checkpoint no longer fit together.
TEST(Hardening, ADamagedCheckpointIsNamedAndTheOneBeforeUsed) {
  const Folder folder("damaged_checkpoint");
  folder.write("p.toml",
               "[system]\nparticles = 20\n[dynamics]\nequilibration = 0\nduration = 4\n"
               "[output]\ncheckpoint_interval = 0\nsamples.interval = 1\n");
  ASSERT_EQ(run(folder.path(), {"run", "p.toml", "-o", "run.h5", "-q"}).code, 0);
  std::string checkpoint = folder.read("run.h5.checkpoint");
  const std::size_t names = checkpoint.find("energy_drift");
  ASSERT_NE(names, std::string::npos);
  checkpoint[names + 2] = '\0';
  folder.write("run.h5.checkpoint", checkpoint);
  const auto again = run(folder.path(), {"run", "p.toml", "-o", "run.h5"});
  EXPECT_EQ(again.code, 0) << again.errors;
  EXPECT_THAT(again.errors,
              testing::HasSubstr("run.h5.checkpoint: is damaged: its checksum is missing or wrong; "
                                 "taking the one before it"));
}

}  // namespace
}  // namespace vitrel
