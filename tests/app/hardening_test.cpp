// Damaged and absurd files, as fuzzing found them: one message, the right exit code, no crash and no hang.
#include <sys/stat.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>

#include "core/io/h5.h"
#include "core/io/h5md.h"
#include "core/io/text_file.h"
#include "tests/app/end_to_end.h"
#include "tests/support/partial_files.h"

namespace vitrel {
namespace {

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

/// The commands read state.h5, and refuse it with this complaint.
void expect_all_refuse(const Folder& folder, const std::vector<std::string>& commands,
                       const std::string& complaint) {
  for (const std::string& command : commands) folder.expect_refusal(command + " -q", 3, complaint);
}

constexpr const char* run_from_state = "run p.toml --from state.h5 -o run.h5";

/// Hands the file state.h5 to `change`.
template <class Change>
void change_file(const Folder& folder, Change change) {
  h5::File file = h5::File::open(folder / "state.h5", h5::Access::write);
  change(file.root());
  file.close();
}

// Reading it would meet the images of millions of boxes.
TEST(Hardening, AbsurdGeometryIsRefusedAtOnce) {
  const Folder folder("absurd_geometry", "# all defaults\n");
  write_changed<2>(folder, [](auto& c) { c.box = PeriodicBox<2>(1e-3 * c.box.lengths()); });
  expect_all_refuse(folder,
                    {"check state.h5", "report state.h5", "analyze state.h5", run_from_state},
                    "state.h5: in frame 0 the ");
  write_changed<3>(folder, [](auto& c) { c.box = PeriodicBox<3>(0.05 * c.box.lengths()); });
  expect_all_refuse(folder,
                    {"check state.h5", "export state.h5 --to geo", "export state.h5 --to vti"},
                    "state.h5: in frame 0 the particles would fill the box 67.02 times");
  write_changed<3>(folder, [](auto& c) { c.shape[0].semi_axes[0] = 1e300; });
  expect_all_refuse(folder, {"export state.h5 --to csv --images", "export state.h5 --to vti"},
                    "state.h5: a semi-axis of particle 0 is 1e+300, but must lie between");
  write_changed<2>(folder, [](auto& c) { c.shape[0].a = 1e300; });
  expect_all_refuse(folder, {"analyze state.h5"},
                    "a semi-axis of particle 0 is 1e+300, but must lie between");
}

// Wrapped into the box, it would have crossed it more often than 32 bits can count.
TEST(Hardening, PositionsFarFromTheBoxAreRefused) {
  const Folder folder("far_positions", "[dynamics]\ninitial_velocities = \"keep\"\n");
  write_changed<3>(folder, [](auto&) {});
  change_file(folder, [](const h5::Group& root) {
    h5::Dataset positions = root.dataset("particles/all/position/value");
    std::vector<double> values = positions.read_frames<double>(0, 1, 3 * 12);
    values[3 * 7] = -1e300;
    positions.write_frames<double>(0, 1, values);
  });
  expect_all_refuse(
      folder, {"check state.h5", "export state.h5 --to xyz", "analyze state.h5", run_from_state},
      "state.h5: in frame 0 particle 7 is at -1e+300, 0, 0, but should be near the box");
}

// The exact check, which scales by the longest side, and the shell of wave vectors would not come to an end.
TEST(Hardening, BoxesOfExtremeProportionsAreRefused) {
  const Folder folder("proportions");
  write_changed<3>(folder, [](auto& c) { c.box = PeriodicBox<3>({60, 10, 1e20}); });
  expect_all_refuse(
      folder, {"check state.h5", "analyze state.h5"},
      "state.h5: in frame 0 the box is 60 × 10 × 1e+20; its sides should not differ by "
      "more than a factor of 1e+06");
}

void write_close_pair(const Folder& folder, const Shift<2>& shift) {
  Configuration<2> c = line_of_bodies<2>();
  c.close_pairs = {{{0, 1, shift}, 1}};
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "state.h5", c, Provenance{},
                                                     {.velocities = true, .close_pairs = true});
  writer.write(c, 0);
  writer.close();
}

TEST(Hardening, ClosePairsOfDistantImagesAreRefused) {
  const Folder folder("close_pairs");
  write_close_pair(folder, {INT32_MAX, 0});
  expect_all_refuse(folder, {"check state.h5", "export state.h5 --to xyz"},
                    "state.h5: row 0 of particles/all/close_pairs/lag should be the shift");
}

TEST(Hardening, ClosePairsThatAreNotThereAreRefused) {
  const std::string group = "particles/all/close_pairs/";
  const auto number = [](std::int64_t end) {
    return fmt::format("should count the pairs up to the end of every frame, but goes from 0 to {}",
                       end);
  };
  for (const auto& [end, message] : std::map<std::int64_t, std::string>{
           {2, "cannot access frame 1 of " + group + "pair: it has 1 frames"},
           {INT64_MAX, "of " + group + "pair: it has 1 frames"},
           {-1, number(-1)}}) {
    const Folder folder("numbers_of_close_pairs");
    write_close_pair(folder, {0, 0});
    change_file(folder, [&](const h5::Group& root) {
      root.dataset(group + "end").write_frames<std::int64_t>(0, 1, {&end, 1});
    });
    expect_all_refuse(folder, {"check state.h5", "export state.h5 --to xyz"}, message);
  }
}

// HDF5 takes the checksum off what it has read without asking for its length.
TEST(Hardening, AChunkShorterThanItsChecksumIsRefused) {
  const Folder folder("short_chunk");
  write_changed<3>(folder, [](auto&) {});
  std::string file = read_text(folder / "state.h5");
  // The keys of chunks in the index: stored size, filters left out, and offsets in the array and in an element.
  std::string key(8 + 4 * 8, '\0');
  const auto set_size = [&](std::uint32_t bytes) { std::memcpy(key.data(), &bytes, sizeof bytes); };
  set_size(3 * 12 * sizeof(double) + 4);
  const std::string whole = key;
  set_size(1);
  std::size_t damaged = 0;
  for (std::size_t at = 0; (at = file.find(whole, at)) != std::string::npos; ++damaged)
    file.replace(at, key.size(), key);
  ASSERT_GT(damaged, 0u);
  std::ofstream(folder / "state.h5", std::ios::binary) << file;
  expect_all_refuse(folder, {"check state.h5", "export state.h5 --to xyz"}, "the file is damaged");
}

// Quantities of files have the bounds that they have as parameters.
TEST(Hardening, SizesBeyondTheirBoundsAreRefused) {
  const Folder folder("sizes");
  const std::vector<std::string> commands = {"check state.h5", "analyze state.h5",
                                             "export state.h5 --to csv"};
  write_changed<2>(folder, [](auto& c) { c.shape[1].b = 1e-300; });
  expect_all_refuse(folder, commands, "a semi-axis of particle 1 is 1e-300, but must lie between");
  write_changed<3>(folder, [](auto& c) { c.shape[1].semi_axes[2] = 1e-300; });
  expect_all_refuse(folder, commands, "a semi-axis of particle 1 is 1e-300, but must lie between");
  write_changed<2>(folder, [](auto& c) { c.shape[1].b = 1e-4 * c.shape[1].a; });
  expect_all_refuse(folder, commands, "is 1e+04 times the shortest, but must be at most 1000");
  write_changed<2>(folder, [](auto& c) { c.box = PeriodicBox<2>(1e12 * c.box.lengths()); });
  expect_all_refuse(folder, commands, "but must be at least 1e-15; box or semi-axes are wrong");
}

TEST(Hardening, MassesAndSpeciesThatCannotBeAreRefusedByAllCommands) {
  const Folder folder("masses", "[dynamics]\ninitial_velocities = \"keep\"\n");
  const std::vector<std::string> commands = {"check state.h5", "analyze state.h5",
                                             "report state.h5", "export state.h5 --to csv",
                                             run_from_state};
  for (const double mass : {-1., 0., double{NAN}, double{INFINITY}, 1e-60}) {
    write_changed<2>(folder, [mass](auto& c) { c.mass[3] = mass; });
    expect_all_refuse(folder, commands, "state.h5: the mass of particle 3 is");
  }
  write_changed<2>(folder, [](auto&) {});
  change_file(folder, [](const h5::Group& root) {
    h5::Group particles = root.group("particles/all");
    particles.remove("species");
    std::vector<std::int32_t> species(12);
    species[0] = 2'147'483'647;
    particles.create_array<std::int32_t>("species", {12}, species);
  });
  expect_all_refuse(folder, commands, "state.h5: the species of particle 0 is 2147483647");
}

TEST(Hardening, AttributesOfAnotherTypeAreRefused) {
  const Folder folder("attributes");
  const auto expect_refusals = [&](auto&& change, const std::string& why) {
    write_changed<2>(folder, [](auto&) {});
    change_file(folder, [&](const h5::Group& root) { change(root.group("parameters")); });
    expect_all_refuse(folder, {"check state.h5", "report state.h5", "analyze state.h5"}, why);
  };
  for (const char* name : {"author", "toml", "version", "parent"}) {
    const std::vector<std::string> texts(100, "a");
    expect_refusals([&](h5::Group group) { group.set_attribute(name, texts, 1); },
                    "it is not one string");
    expect_refusals([&](h5::Group group) { group.set_attribute(name, 2.5); }, "it is not a text");
  }
  for (const char* name : {"seed", "dimension", "wall_seconds"}) {
    const std::vector<double> numbers(2, 2.);
    expect_refusals([&](h5::Group group) { group.set_attribute<double>(name, numbers); },
                    "it is not one number");
    expect_refusals([&](h5::Group group) { group.set_attribute(name, std::string("two")); },
                    "cannot read attribute");
  }
}

TEST(Hardening, OddNamesAndSeedsAreRefusedInPlainWords) {
  const Folder folder("odd_names", "# all defaults\n");
  for (const std::string command : {"prepare", "run"}) {
    folder.expect_refusal(command + " p.toml -o " + std::string(300, 'a'), 3,
                          "aaa: File name too long");
    for (const std::string seed : {"-1", "9223372036854775808", "1e3", "one"})
      folder.expect_refusal(command + " p.toml -o a.h5 --seed " + seed, 2,
                            seed + " is not a whole number between 0 and");
  }
}

TEST(Hardening, PipesAndDevicesAreNoInput) {
  const Folder folder("pipes", "# all defaults\n");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string input : {"pipe", "/dev/null", "/dev/zero"})
    for (const std::string& command :
         {"check " + input, "analyze " + input, "report " + input, "export --to csv " + input,
          "run -o run.h5 " + input, "run p.toml -o run.h5 --from " + input})
      folder.expect_refusal(command, 3, "is not a regular file");
}

// What files and command lines hold is quoted, and must not rewrite the terminal.
TEST(Hardening, ControlCharactersAreShownAndNotSent) {
  const Folder folder("escapes");
  const std::string red = "\x1b[31m", shown = "\\x1b[31m";
  folder.write("table.csv", "x,y,angle,a,b,box_x,box_y\n" + red + ",0,0,1,0.5,6,6\n");
  folder.write("p.toml", "[dynamics]\n\"\\u001b[31m\" = 1\n");
  for (const std::string& command :
       {std::string("check table.csv"), std::string("run p.toml -o run.h5"),
        "run p.toml -o run.h5 --set dynamics." + red + "=1", "report " + red + ".h5",
        "run p.toml -o " + red + "/run.h5"}) {
    const Outcome outcome = folder.run(command);
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.errors, HasSubstr(shown));
    EXPECT_THAT(outcome.errors, Not(HasSubstr(red)));
  }
}

TEST(Hardening, JsonOfOthersIsRefusedInVitrelsWords) {
  const Folder folder("json");
  fs::create_directory(folder / "job");
  folder.write("job/parameters.toml", "# all defaults\n");
  for (const char* done :
       {"\"x\"", "3", "[]", "{}", "{\"run\": 3}", "{\"prepare\": null}", "null"}) {
    folder.write("job/done.json", done);
    for (const std::string command : {"report job", "analyze job"}) {
      const Outcome outcome = folder.run(command);
      testing_program::expect_refusal(outcome, 3,
                                      "job/done.json: is JSON, but not the summary of a job");
      EXPECT_THAT(outcome.errors, Not(HasSubstr("json.exception")));
    }
  }
}

constexpr const char* endless_insertion =
    "[system]\nparticles = 20\npacking_fraction = 0.9\n[[species]]\naspect_ratio = 1\n"
    "[[prepare.stage]]\nmethod = \"insert\"\npacking_fraction = 0.9\n"
    "attempts = 1000000000000000000\n";

TEST(Hardening, APreparationThatIsStoppedHasASummary) {
  const Folder folder("stopped_preparation", endless_insertion);
  for (const std::string command : {"prepare", "run"}) {
    const Outcome outcome = folder.run(command + " p.toml -o out.h5 --json -q --wall-time 0.2");
    EXPECT_EQ(outcome.code, 5) << outcome.errors;
    expect_values(nlohmann::json::parse(outcome.output),
                  {{"output", "out.h5"}, {"complete", false}});
  }
}

// There is nothing to save, and nothing is left.
TEST(Hardening, AnAnalysisIsStoppedAtOnce) {
  const Folder folder("stopped_analysis",
                      "[system]\nparticles = 30\n[dynamics]\nduration = 100\nequilibration = 0\n");
  folder.succeed("run p.toml -o run.h5");
  for (const int signal : {SIGINT, SIGTERM})
    for (const std::string command : {"analyze", "report"}) {
      const Outcome outcome = run_and_signal(
          folder.path(),
          words_of(command + " run.h5 --set analysis.structure.wave_number_max=1000"),
          std::chrono::milliseconds(1000), signal);
      EXPECT_EQ(outcome.code, 5) << outcome.errors;
      EXPECT_THAT(outcome.errors, HasSubstr("stopped; the same command begins again"));
    }
  EXPECT_FALSE(fs::exists(folder / "run_results.h5"));
  EXPECT_THAT(partial_files(folder.path()), IsEmpty());
}

// Blocks of events, stages and attempts take as long as the input asks for.
TEST(Hardening, AStopIsAnsweredWhateverTheWork) {
  const Folder folder("long_work", "[dynamics]\nequilibration = 0\nduration = 1e4\n");
  folder.write("dense.toml", endless_insertion);
  const std::string run = "run p.toml -o out.h5 --set ";
  /// Work that is far from its end, and what it has said once it is under way.
  const std::pair<std::string, const char*> works[] = {
      {run + "output.samples.interval=1e-3", "run of"},
      {run + "dynamics.kind=brownian --set dynamics.brownian_step=2e-8", "run of"},
      {run + "output.correlations.interval=1e-7", "run of"},
      {run + "system.particles=300000 --set system.packing_fraction=0.3", "insert at"},
      {run + "system.particles=1 --set output.samples.spacing=logarithmic "
             "--set output.samples.per_decade=1000000",
       "run of"},
      {"prepare dense.toml -o out.h5", "insert at"}};
  const int signals[] = {SIGTERM, SIGINT, SIGUSR1, SIGHUP, SIGXCPU};
  std::size_t signal = 0;
  for (const auto& [command, sign] : works) {
    SCOPED_TRACE(command);
    const auto is_under_way = [&, sign = sign] {
      return folder.read("standard_error").find(sign) != std::string::npos;
    };
    const Outcome outcome = run_and_signal(folder.path(), words_of(command), is_under_way,
                                           signals[signal++ % std::size(signals)]);
    EXPECT_EQ(outcome.code, 5) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("the same command continues"));
    EXPECT_EQ(folder.run(command + " --wall-time 0.3").code, 5);
    for (const char* file : {"out.h5", "out.h5.checkpoint", "out.h5.checkpoint.previous",
                             "out.h5.preparation", "out.h5.correlations.h5", "standard_error"})
      fs::remove(folder / file);
  }
}

// nohup starts a program with SIGHUP ignored.
TEST(Hardening, AnIgnoredHangupStaysIgnored) {
  const Folder folder("ignored_signal", "[system]\nparticles = 50\n[dynamics]\nduration = 300\n");
  const auto before = std::signal(SIGHUP, SIG_IGN);
  const auto outcome = run_and_signal(
      folder.path(), words_of("run p.toml -o run.h5"),
      [&] { return folder.read("standard_error").find("run of") != std::string::npos; }, SIGHUP);
  ASSERT_NE(std::signal(SIGHUP, before), SIG_ERR);
  EXPECT_EQ(outcome.code, 0) << outcome.errors;
}

TEST(Hardening, AFileThatMayNotGrowIsAnErrorOfWriting) {
  const Folder folder("file_size_limit",
                      "[system]\nparticles = 50\n[dynamics]\nequilibration = 0\nduration = 20\n"
                      "[output]\ncheckpoint_interval = 0\nsamples.interval = 0.05\n");
  testing_program::expect_refusal(folder.run_with_file_limit(800'000, "run p.toml -o run.h5 -q"), 3,
                                  "File too large");
  folder.succeed("check run.h5 -q");
  folder.succeed("run p.toml -o run.h5 -q");
}

TEST(Hardening, WithoutRoomForAStateThereIsNoQualityReportEither) {
  const Folder folder("no_room_for_state", "[prepare]\nquality_sweeps = 1\n");
  const std::string prepare = "prepare p.toml -o state.h5 -q";
  testing_program::expect_refusal(folder.run_with_file_limit(20'000, prepare), 3, "state.h5");
  EXPECT_FALSE(fs::exists(folder / "state.quality.json"));
  folder.succeed(prepare);
  EXPECT_TRUE(fs::exists(folder / "state.quality.json"));
}

TEST(Hardening, ARunIsNotContinuedThroughALink) {
  const Folder folder("link", "[system]\nparticles = 20\n[dynamics]\nduration = 1\n");
  folder.succeed("run p.toml -o run.h5 -q");
  fs::create_symlink("run.h5", folder / "link.h5");
  for (const std::string last : {"-q", "--dry-run"})
    folder.expect_refusal("run p.toml -o link.h5 " + last, 2, "link.h5: is a link to run.h5");
}

// The names and the values of a checkpoint no longer fit together.
TEST(Hardening, ADamagedCheckpointIsNamedAndTheOneBeforeUsed) {
  const Folder folder("damaged_checkpoint",
                      "[system]\nparticles = 20\n[dynamics]\nequilibration = 0\nduration = 4\n"
                      "[output]\ncheckpoint_interval = 0\nsamples.interval = 1\n");
  folder.succeed("run p.toml -o run.h5 -q");
  std::string checkpoint = folder.read("run.h5.checkpoint");
  const std::size_t names = checkpoint.find("energy_drift");
  ASSERT_NE(names, std::string::npos);
  checkpoint[names + 2] = '\0';
  folder.write("run.h5.checkpoint", checkpoint);
  const auto again = folder.run("run p.toml -o run.h5");
  EXPECT_EQ(again.code, 0) << again.errors;
  EXPECT_THAT(again.errors,
              HasSubstr("run.h5.checkpoint: is damaged: its checksum is missing or wrong; "
                        "taking the one before it"));
}

}  // namespace
}  // namespace vitrel
