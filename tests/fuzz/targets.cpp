#include "tests/fuzz/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "core/io/h5.h"
#include "core/io/text_file.h"
#include "core/random/stream.h"
#include "tests/fuzz/execution.h"
#include "tests/fuzz/mutations.h"

namespace vitrel::fuzz {
namespace {

namespace fs = std::filesystem;

/// Without waiting for the disk, as a file is written for every input.
void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

/// A small run in each of the dimensions, and of soft disks, of three frames each.
const std::string plane =
    "[system]\nparticles = 12\npacking_fraction = 0.4\n"
    "[[species]]\nname = \"A\"\nfraction = 0.5\naspect_ratio = 2\n"
    "[[species]]\nname = \"B\"\nfraction = 0.5\naspect_ratio = 1\nsize = 0.8\n"
    "[dynamics]\nequilibration = 0\nduration = 2\n"
    "[output]\nvelocities = true\n"
    "samples = { spacing = \"linear\", interval = 1 }\ncorrelations = { interval = 0.1 }\n";
const std::string space =
    "[system]\ndimension = 3\nparticles = 10\npacking_fraction = 0.2\n"
    "[[species]]\nsemi_axes = [1.25, 1, 0.8]\n"
    "[dynamics]\nequilibration = 0\nduration = 2\n"
    "[output]\nvelocities = true\n"
    "samples = { spacing = \"linear\", interval = 1 }\n";
const std::string soft =
    "[system]\nparticles = 12\npacking_fraction = 0.5\n[[species]]\naspect_ratio = 1\n"
    "[dynamics]\nequilibration = 0\nduration = 2\n"
    "[dynamics.contact]\nlaw = \"linear_dashpot\"\nstiffness = \"1e5 N/m\"\ndamping = \"200 "
    "kg/s\"\n"
    "[output]\nvelocities = true\n"
    "samples = { spacing = \"linear\", interval = 1 }\n";
const std::string sweep = plane + "[sweep.grid]\n\"system.seed\" = [1, 2]\n";
const char* const pair =
    "[[body]]\nsemi_axes = [2, 1]\nposition = [0, 0]\nangle = 0.1\n"
    "velocity = [1, 0]\nangular_velocity = 0.2\n"
    "[[body]]\nsemi_axes = [1, 1]\nposition = [4, 0.5]\n";

// LAMMPS' own forms of two ellipsoids.
const char* const dump =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n-5 5\n0 10\n-5 5\n"
    "ITEM: ATOMS id type xs ys zs ix iy iz quatw quati quatj quatk shapex shapey shapez vx vy vz "
    "mass\n2 1 0.5 0.5 0.5 0 0 0 1 0 0 0 2 1 1 1 0 0 1\n1 1 0.1 0.1 0.5 0 0 0 0 1 0 0 2 1 1 0 1 0 "
    "1\nITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n-5 5\n0 10\n-5 "
    "5\nITEM: ATOMS id type xs ys zs ix iy iz quatw quati quatj quatk shapex shapey shapez vx vy "
    "vz "
    "mass\n1 1 0.2 0.1 0.5 0 0 0 0 1 0 0 2 1 1 0 1 0 1\n2 1 0.6 0.5 0.5 0 0 0 1 0 0 0 2 1 1 1 0 0 "
    "1\n";
const char* const data =
    "two ellipsoids\n\n2 atoms\n1 atom types\n2 ellipsoids\n-5 5 xlo xhi\n-5 5 ylo yhi\n-5 5 zlo "
    "zhi\n0 0 0 xy xz yz\n\nAtoms # ellipsoid\n\n1 1 1 1.0 0 0 0 0 0 0\n2 1 1 1.0 3 0 0 1 0 0\n\n"
    "Ellipsoids\n\n1 2 1 1 1 0 0 0\n2 2 1 1 0.7071067811865476 0 0 0.7071067811865476\n\n"
    "Velocities\n\n1 0.1 0 0 0 0 0\n2 -0.1 0 0 0 0 0.5\n";

void succeed(const std::vector<std::string>& command) {
  const Outcome outcome = execute(command);
  if (outcome.code == 0) return;
  throw std::runtime_error(fmt::format("{}: {}", command_line(command), outcome.errors));
}

/// Writes <name>.h5 and what belongs to it into the working folder, unless another target did.
void make_run(const std::string& name, const std::string& parameters) {
  const std::string file = name + ".h5";
  if (fs::exists(file)) return;
  write(name + ".toml", parameters);
  succeed({"run", name + ".toml", "-o", file, "-q"});
}

void make_runs() {
  for (const auto& [name, text] : {std::pair{"plane", plane}, {"space", space}, {"soft", soft}})
    make_run(name, text);
}

/// The contents of files in the working folder.
std::vector<std::string> contents(const std::vector<fs::path>& files) {
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(read_text(file));
  return texts;
}

std::vector<std::string> parameter_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(VITREL_PARAMS))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<std::string> texts = contents(files);
  texts.insert(texts.end(), {plane, space, soft, sweep});
  return texts;
}

Target parameters() {
  return {"fuzzed.toml",
          Kind::text,
          parameter_files(),
          {{"run", "fuzzed.toml", "-o", "out.h5", "--dry-run"},
           {"sweep", "fuzzed.toml", "-o", "sweep", "--status"}}};
}

Target pairs() {
  return {"pair.toml",
          Kind::text,
          {pair},
          {{"pair", "gap", "pair.toml"},
           {"pair", "contact-time", "pair.toml"},
           {"pair", "overlap", "pair.toml"},
           {"pair", "path", "pair.toml", "--points", "3"}}};
}

std::vector<std::vector<std::string>> commands_for(const std::string& file) {
  write("p.toml", plane);
  return {{"check", file, "-q"},
          {"analyze", file, "-q", "-o", "results.h5"},
          {"export", file, "--to", "csv", "-o", "out.csv", "-q"},
          {"run", "p.toml", "--from", file, "-o", "out.h5", "--dry-run"}};
}

/// A file of another program, whose shapes are in the parameter file where it has none.
Target foreign(const std::string& format, Kind kind) {
  make_runs();
  std::vector<fs::path> originals;
  for (const std::string name : {"plane", "space", "soft"}) {
    const fs::path& original = originals.emplace_back(name + "." + format);
    succeed({"export", name + ".h5", "--to", format, "-o", original, "-q"});
  }
  const std::string file = "foreign." + format;
  auto commands = commands_for(file);
  commands.push_back({"check", file, "--params", "p.toml", "-q"});
  return {file, kind, contents(originals), commands};
}

Target gsd() {
  return foreign("gsd", Kind::bytes);
}

Target xyz() {
  return foreign("xyz", Kind::text);
}

Target csv() {
  return foreign("csv", Kind::text);
}

/// Files of vitrel that name another program as their creator.
Target foreign_h5md() {
  make_runs();
  std::vector<fs::path> files;
  for (const char* name : {"plane", "space", "soft"}) {
    const fs::path& file = files.emplace_back(std::string("other_") + name + ".h5");
    fs::copy_file(std::string(name) + ".h5", file);
    h5::File written = h5::File::open(file, h5::Access::write);
    written.root().group("h5md/creator").set_attribute("name", std::string("another program"));
    written.close();
  }
  return {"foreign.h5", Kind::hdf5, contents(files), commands_for("foreign.h5")};
}

Target lammps() {
  return {"foreign.lammps", Kind::text, {dump, data}, commands_for("foreign.lammps")};
}

Target trajectory() {
  make_runs();
  auto commands = commands_for("fuzzed.h5");
  commands.push_back({"report", "fuzzed.h5", "-o", "report.html", "-q"});
  commands.push_back({"export", "fuzzed.h5", "--to", "xyz", "-o", "out.xyz", "-q"});
  return {"fuzzed.h5", Kind::hdf5, contents({"plane.h5", "space.h5", "soft.h5"}), commands};
}

Target checkpoint() {
  make_run("plane", plane);
  fs::copy_file("plane.h5", "run.h5");
  return {"run.h5.checkpoint",
          Kind::hdf5,
          contents({"plane.h5.checkpoint"}),
          {{"run", "plane.toml", "-o", "run.h5", "--dry-run"}}};
}

Target correlations() {
  make_run("plane", plane);
  return {"plane.h5.correlations.h5",
          Kind::hdf5,
          contents({"plane.h5.correlations.h5"}),
          {{"analyze", "plane.h5", "-o", "results.h5", "-q", "--only", "on_the_fly"}}};
}

}  // namespace

const std::vector<NamedTarget>& targets() {
  static const std::vector<NamedTarget> all = {{"parameters", parameters},
                                               {"pairs", pairs},
                                               {"trajectory", trajectory},
                                               {"checkpoint", checkpoint},
                                               {"correlations", correlations},
                                               {"gsd", gsd},
                                               {"xyz", xyz},
                                               {"csv", csv},
                                               {"h5md", foreign_h5md},
                                               {"lammps", lammps}};
  return all;
}

const std::vector<std::string>& write_input(const Target& target, Stream& stream) {
  const std::string& original = target.originals[stream.below(target.originals.size())];
  const std::vector<std::string>& command = target.commands[stream.below(target.commands.size())];
  for (const char* output : {"out.h5", "out.csv", "out.xyz", "results.h5", "report.html"})
    fs::remove(output);
  write(target.file, original);
  // Half of the HDF5 files are damaged as such: the library finds damaged bytes by its checksums.
  const bool is_done =
      target.kind == Kind::hdf5 && stream.below(2) && damage_hdf5(target.file, stream);
  const auto damaged = target.kind == Kind::text ? damaged_text : damaged_bytes;
  if (!is_done) write(target.file, damaged(original, target.originals, stream));
  return command;
}

}  // namespace vitrel::fuzz
