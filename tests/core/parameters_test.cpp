#include "core/io/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/io/quantity.h"

namespace vitrel {
namespace {

using testing::HasSubstr;

enum class Kind { gas, crystal };
constexpr const char* kind_names[] = {"gas", "crystal"};

// A struct with every kind of field.
struct Part {
  std::string name = "A";
  std::optional<double> mass;
};
struct Everything {
  std::int64_t particles = 100;
  std::uint64_t seed = 1;
  int dimension = 2;
  double density = 0.5;
  bool velocities = true;
  Kind kind = Kind::gas;
  std::int64_t atoms_per_cell = 4;
  std::array<double, 2> axes = {2, 1};
  double spread = 1;
  bool spread_is_table = false;
  double low = 0, high = 1;
  double interval = 0.1;
  double stiffness = 2000;
  std::vector<Part> parts = std::vector<Part>(1);
  ParameterGrid grid;
};

void describe_part(Part& part, FieldVisitor& visit) {
  visit.field({"name", "", "Name."}, part.name);
  visit.optional({"mass", "mass", "Mass."}, part.mass, 1.5);
}

void describe(Everything& p, FieldVisitor& visit) {
  visit.table({"system", "", "The system."}, FieldVisitor::TableStyle::section,
              [&](FieldVisitor& in) {
                in.field({"particles", "", "Number of particles."}, p.particles);
                in.field({"seed", "", "Seed."}, p.seed);
                in.field({"dimension", "", "Dimension."}, p.dimension);
                in.field({"density", "1/area", "Density."}, p.density);
                in.field({"velocities", "", "Write velocities."}, p.velocities);
                in.field({"kind", "", "Kind."}, p.kind, kind_names);
                in.when(p.kind == Kind::crystal, "kind = \"crystal\"", [&](FieldVisitor& crystal) {
                  crystal.field({"atoms_per_cell", "", "Atoms."}, p.atoms_per_cell);
                });
                in.field({"axes", "length", "Axes."}, p.axes);
                const Field spread{"spread", "", "Spread."};
                in.value_or_table(
                    spread, p.spread_is_table, [&](FieldVisitor& v) { v.field(spread, p.spread); },
                    [&](FieldVisitor& t) {
                      t.field({"low", "", "Low."}, p.low);
                      t.field({"high", "", "High."}, p.high);
                    });
                in.quantity({"stiffness", "N/m", "Stiffness."}, p.stiffness);
                in.table({"samples", "", "Samples."}, FieldVisitor::TableStyle::inline_table,
                         [&](FieldVisitor& t) {
                           t.field({"interval", "time", "Interval."}, p.interval);
                         });
              });
  visit.list({"part", "", "Parts."}, p.parts, describe_part);
  visit.grid({"grid", "", "Grid."}, p.grid);
}

void validate(const Everything& p) {
  if (!(p.density > 0))
    throw BadValue("system.density", "is " + to_toml(p.density) + ", but must be positive");
  for (std::size_t i = 0; i < p.parts.size(); ++i)
    if (p.parts[i].mass && !(*p.parts[i].mass > 0))
      throw BadValue("part." + std::to_string(i) + ".mass", "must be positive");
}

FieldVisitor::Inside fields(Everything& p) {
  return [&p](FieldVisitor& visit) { describe(p, visit); };
}

Everything read(const TomlNode& root) {
  Everything p;
  read_parameters(root, fields(p), [&] { validate(p); });
  return p;
}
Everything read(const std::string& text) {
  return read(parse_toml(text, "file.toml"));
}

const std::string small_file = "[system]\nseed = 1\n[[part]]\nname = \"A\"\n";

template <class Action>
std::string user_error(Action&& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "nothing was refused";
}

void expect_refusal(const std::string& text, const std::string& message) {
  EXPECT_THAT(user_error([&] { read(text); }), HasSubstr(message)) << text;
}
void expect_refusal_in_system(const std::string& line, const std::string& message) {
  expect_refusal("[system]\n" + line + "\n", message);
}
void expect_override_refusal(const std::string& assignment, const std::string& message) {
  const auto override_and_read = [&] {
    TomlNode root = parse_toml(small_file, "file.toml");
    apply_override(root, assignment, "--set " + assignment);
    read(root);
  };
  EXPECT_THAT(user_error(override_and_read), HasSubstr(message)) << assignment;
}

TEST(Parameters, EveryKindOfFieldIsRead) {
  const Everything p = read(R"(
[system]
particles = 7
seed = 9000000000000000000
dimension = 3
density = 2            # an integer is a number
velocities = false
kind = "crystal"
atoms_per_cell = 2
axes = [3, 0.5]
spread = { low = -1, high = 2.5 }
samples = { interval = 4.0 }
stiffness = "12.5 mN/cm"
[[part]]
name = "B"
mass = 3
[[part]]
[grid]
"system.density" = [0.1, 0.2]
system.kind = ["gas"]
)");
  EXPECT_EQ(p.particles, 7);
  EXPECT_EQ(p.seed, 9000000000000000000u);
  EXPECT_EQ(p.dimension, 3);
  EXPECT_EQ(p.density, 2);
  EXPECT_FALSE(p.velocities);
  EXPECT_EQ(p.kind, Kind::crystal);
  EXPECT_EQ(p.atoms_per_cell, 2);
  EXPECT_EQ(p.axes, (std::array<double, 2>{3, 0.5}));
  EXPECT_TRUE(p.spread_is_table);
  EXPECT_EQ(p.low, -1);
  EXPECT_EQ(p.high, 2.5);
  EXPECT_EQ(p.interval, 4);
  EXPECT_DOUBLE_EQ(p.stiffness, 1.25);
  ASSERT_EQ(p.parts.size(), 2u);
  EXPECT_EQ(p.parts[0].name, "B");
  EXPECT_EQ(p.parts[0].mass, 3);
  EXPECT_FALSE(p.parts[1].mass);
  const ParameterGrid grid = {{"system.density", {"0.1", "0.2"}}, {"system.kind", {"\"gas\""}}};
  EXPECT_EQ(p.grid, grid);
}

TEST(Parameters, FieldsLeftOutKeepTheirDefault) {
  const Everything p = read("");
  EXPECT_EQ(p.particles, 100);
  EXPECT_EQ(p.parts.size(), 1u);
}

TEST(Parameters, SyntaxErrorNamesThePlace) {
  expect_refusal_in_system("seed = = 1", "file.toml:2:8: not valid TOML");
}

TEST(Parameters, UnknownKeyNamesThePlaceAndTheLikelyOne) {
  expect_refusal_in_system("seed = 1\n  particels = 3",
                           "file.toml:3:3: key 'system.particels' is unknown; did you mean "
                           "'particles'? known keys: particles, seed, dimension");
  expect_refusal("[sistem]\n",
                 "file.toml:1:2: key 'sistem' is unknown; did you mean 'system'? known keys: "
                 "system, part, grid");
  expect_refusal("[[part]]\n[[part]]\nweight = 1\n",
                 "file.toml:3:1: key 'part.1.weight' is unknown; known keys: name, mass");
}

TEST(Parameters, KeyOfAnotherAlternativeSaysWhereItBelongs) {
  expect_refusal_in_system("atoms_per_cell = 2",
                           "file.toml:2:1: key 'system.atoms_per_cell' has a meaning only with "
                           "kind = \"crystal\"");
}

TEST(Parameters, WrongTypeNamesThePlaceOfTheValueAndShowsARightOne) {
  expect_refusal_in_system("particles = \"many\"",
                           "file.toml:2:13: key 'system.particles' must be an integer, not the "
                           "string \"many\"; for example particles = 100");
  expect_refusal_in_system("particles = 1.5", "not the number 1.5");
  expect_refusal_in_system("density = true", "must be a number, not true");
  expect_refusal_in_system("velocities = 1", "must be true or false, not the number 1");
  expect_refusal_in_system("kind = 1", "one of the strings \"gas\", \"crystal\"");
  expect_refusal_in_system("kind = \"gass\"", "did you mean 'gas'?");
  for (const std::string stiffness : {"2000.0", "\"2000\"", "\"2 kN\"", "\"kN/m\"", "\"2 kN/n\"",
                                      "\"nan N/m\"", "\"2,0 N/m\"", "\"\""})
    expect_refusal_in_system("stiffness = " + stiffness,
                             "file.toml:2:13: key 'system.stiffness' must be a string with a "
                             "number and a unit that converts to N/m, not ");
  expect_refusal_in_system("stiffness = \"2 kN\"",
                           "not the string \"2 kN\"; for example stiffness = \"2000 N/m\"");
  expect_refusal_in_system("axes = 1", "an array of 2 numbers, not the number 1");
  expect_refusal_in_system("axes = [1, \"x\"]", "file.toml:2:12: ");
  expect_refusal_in_system(
      "axes = [1, 2, 3]", "must be an array of 2 numbers, not of 3; for example axes = [2.0, 1.0]");
  expect_refusal_in_system("spread = \"wide\"", "must be a number");
  expect_refusal_in_system("samples = 1", "must be a table, not the number 1");
  expect_refusal_in_system("seed = -1", "file.toml:2:8: key 'system.seed' is -1");
  expect_refusal_in_system("dimension = 3000000000", "must lie between");
  expect_refusal_in_system("seed = 2024-01-01", "dates and times have no meaning");
  expect_refusal("system = 1\n", "file.toml:1:10: key 'system' must be a table");
  expect_refusal("[part]\nname = \"B\"\n", "write [[part]]");
  expect_refusal("[grid]\nx = 1\n", "arrays of values to run through");
}

TEST(Parameters, ImpossibleValueNamesItsPlace) {
  expect_refusal_in_system("\ndensity = -1",
                           "file.toml:3:11: key 'system.density' is -1.0, but must be positive");
  expect_refusal("[[part]]\n[[part]]\nmass = 0\n", "file.toml:3:8: key 'part.1.mass'");
}

TEST(Quantity, ConvertsWhatIsOfTheSameKind) {
  EXPECT_DOUBLE_EQ(*quantity("1 GPa", "Pa"), 1e9);
  EXPECT_DOUBLE_EQ(*quantity("1.14 g/cm^3", "kg/m^3"), 1140);
  EXPECT_DOUBLE_EQ(*quantity("1140kg m-3", "kg/m^3"), 1140);
  EXPECT_DOUBLE_EQ(*quantity("-3 ms ", "s"), -3e-3);
  EXPECT_EQ(*quantity("0 s", "s"), 0);
  EXPECT_DOUBLE_EQ(*quantity("7.2 km/h", "m/s"), 2);
  EXPECT_DOUBLE_EQ(*quantity("2 µm", "m"), 2e-6);
  EXPECT_FALSE(quantity("1 s", "m"));
  EXPECT_FALSE(quantity("1", "m"));
  for (const char* text : {"10 cm since 2000", "1 m @ 3", "10 lg(re 1 m)", "1e308 km"})
    EXPECT_FALSE(quantity(text, "m")) << text;
  const double odd = 0.1 + 0.2;
  EXPECT_EQ(quantity(quantity_text(odd, "N/m"), "N/m"), odd);
}

TEST(Parameters, OverridesReplaceAndExtend) {
  TomlNode root = parse_toml(small_file, "file.toml");
  for (const std::string assignment :
       {"system.seed=5", "system.kind=crystal", "system.density=0.25", "part.0.mass=2",
        "part.1.name=\"C 1\"", "system.samples.interval=3", "system.axes=[4, 2]",
        "system.spread={ low = 0, high = 3 }"})
    apply_override(root, assignment, "--set " + assignment);
  const Everything p = read(root);
  EXPECT_EQ(p.seed, 5u);
  EXPECT_EQ(p.kind, Kind::crystal);
  EXPECT_EQ(p.density, 0.25);
  ASSERT_EQ(p.parts.size(), 2u);
  EXPECT_EQ(p.parts[0].mass, 2);
  EXPECT_EQ(p.parts[1].name, "C 1");
  EXPECT_EQ(p.interval, 3);
  EXPECT_EQ(p.axes, (std::array<double, 2>{4, 2}));
  EXPECT_EQ(p.high, 3);
  for (const std::string assignment : {"system.stiffness=3 kN/m", "system.stiffness=\"3 kN/m\""}) {
    apply_override(root, assignment, "--set " + assignment);
    EXPECT_EQ(read(root).stiffness, 3000);
  }
}

TEST(Parameters, ErrorsOfOverridesNameTheOption) {
  expect_override_refusal(
      "system.seeds=1",
      "--set system.seeds=1: key 'system.seeds' is unknown; did you mean 'seed'?");
  expect_override_refusal("system.density=-2",
                          "--set system.density=-2: key 'system.density' is -2.0");
  expect_override_refusal("system.density", "key=value is expected");
  expect_override_refusal("system.density=[1,", "is not a TOML value");
  expect_override_refusal("part.5.name=B", "'part' is an array with 1 entries");
  expect_override_refusal("system.seed.x=1", "'system.seed' is the value 1");
  expect_override_refusal("system..seed=1", "has an empty part");
  expect_override_refusal("system.seed=1\nb=2", "is not a TOML value");
}

TEST(Parameters, WrittenTextReadsBackToTheSameTextBitByBit) {
  Everything p;
  p.density = 0.1 + 0.2;  // 17 digits are needed
  p.low = 5e-324;
  p.high = 1e300;
  p.spread_is_table = true;
  p.kind = Kind::crystal;
  p.parts = {{"quote \" and \\ and \n", 1.0 / 3}, {"B", std::nullopt}};
  p.grid = {{"system.density", {"0.5", "0.25"}}};
  const std::string text = write_parameters(fields(p));
  Everything again = read(text);
  EXPECT_EQ(again.density, p.density);
  EXPECT_EQ(again.low, p.low);
  EXPECT_EQ(again.high, p.high);
  EXPECT_EQ(again.parts[0].name, p.parts[0].name);
  EXPECT_EQ(again.parts[0].mass, p.parts[0].mass);
  EXPECT_EQ(write_parameters(fields(again)), text);
}

TEST(Parameters, TheTemplateReadsBackToTheDefaults) {
  Everything defaults;
  const std::string text = parameter_template(fields(defaults));
  Everything read_back = read(text);
  EXPECT_EQ(write_parameters(fields(read_back)), write_parameters(fields(defaults)));
  EXPECT_THAT(text, HasSubstr("# Number of particles.\nparticles = 100\n"));
  EXPECT_THAT(text, HasSubstr("# mass = 1.5\n"));
  EXPECT_THAT(text, HasSubstr("# Only with kind = \"crystal\":\n"));
  EXPECT_THAT(text, HasSubstr("#   interval: Interval. Unit: time.\n"));
}

TEST(Parameters, TheReferenceTablesHaveEveryField) {
  Everything defaults;
  const std::string text = parameter_tables(fields(defaults));
  for (const char* row :
       {"## `[system]`", "| `particles` | `100` |  | Number of particles. |",
        "With `kind = \"crystal\"`: Atoms.", "| `samples.interval` | `0.1` | time |",
        "| `stiffness` | `\"2000 N/m\"` | N/m |", "## `[[part]]`", "| `mass` | none | mass |",
        "## `[grid]`"})
    EXPECT_THAT(text, HasSubstr(row));
}

TEST(Parameters, SectionsAndTablesAreClassesOfPython) {
  Everything defaults;
  const std::string text = python_parameters(fields(defaults), {"Sample"});
  for (const char* part :
       {"__all__ = [\n    \"Spread\", \"Samples\", \"Part\"\n]\n",
        "class System(TypedDict, total=False):\n    \"\"\"The system.\n\n"
        "    particles: Number of particles. Default: 100.\n",
        "    density: Density. Unit: 1/area. Default: 0.5.\n", "    velocities: bool\n",
        "    kind: Literal[\"gas\", \"crystal\"]\n    atoms_per_cell: int\n    axes: Numbers\n",
        "    spread: float | Spread | Keys\n    stiffness: str\n    samples: Samples | Keys\n",
        "@dataclass(kw_only=True)\nclass Samples(Setting):\n    \"\"\"Samples.\n\n"
        "    interval: Interval. Unit: time.\n    \"\"\"\n\n    interval: float = 0.1\n",
        "    name: str = \"A\"\n    mass: float | None = None\n"})
    EXPECT_THAT(text, HasSubstr(part));
}

// A table of two forms; `least` is the default of a key of both.
void describe_forms(double least, FieldVisitor& visit) {
  std::size_t form = 0;
  double size = 1;
  static constexpr const char* names[] = {"round", "far_off"};
  visit.choice({"form", "", "Form. round: a circle; far_off: another thing."}, form, names);
  visit.when(form == 0, "form = \"round\"", [&](FieldVisitor& in) {
    in.field({"size", "", "Size."}, size);
  });
  visit.field({"least", "", "Least."}, least);
}

TEST(Parameters, EveryFormOfATableIsAClassOfPython) {
  const std::string text = python_parameters(
      [](FieldVisitor& visit) {
        visit.table({"all", "", "All."}, FieldVisitor::TableStyle::section, [](FieldVisitor& in) {
          for (const char* key : {"one", "two"})
            in.table({key, "", "Table."}, FieldVisitor::TableStyle::inline_table,
                     [&](FieldVisitor& table) { describe_forms(key[0] == 'o' ? 1 : 2, table); });
        });
      },
      {"Round"});
  EXPECT_THAT(text, HasSubstr("__all__ = [\n    \"RoundOne\", \"FarOff\", \"RoundTwo\"\n]\n"));
  EXPECT_THAT(text,
              HasSubstr("class FarOff(Setting):\n    \"\"\"Another thing.\n\n    least: Least.\n"
                        "    \"\"\"\n\n    _form: ClassVar = (\"form\", \"far_off\")\n"
                        "    least: float | None = None\n"));
  EXPECT_THAT(text,
              HasSubstr("    one: RoundOne | FarOff | Keys\n    two: RoundTwo | FarOff | Keys\n"));
}

TEST(Parameters, TheFirstDifferenceIsNamedUnlessHarmless) {
  const std::string first = "[a]\nx = 1\ny = 2\n";
  const std::string second = "[a]\nx = 3\ny = 4\nz = 5\n";
  const auto none = [](const std::string&) { return false; };
  EXPECT_FALSE(first_difference(first, first, none));
  const auto found =
      first_difference(first, second, [](const std::string& key) { return key == "a.x"; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->key, "a.y");
  EXPECT_EQ(found->first, "2");
  EXPECT_EQ(found->second, "4");
  const auto added = first_difference("", "[a]\nz = 5\n", none);
  ASSERT_TRUE(added);
  EXPECT_EQ(added->first, "nothing");
  EXPECT_EQ(added->second, "5");
}

TEST(Parameters, AMissingFileAndAFolderAreFileErrors) {
  EXPECT_THROW(read_toml_file("no_such_file.toml"), FileError);
  EXPECT_THROW(read_toml_file("."), FileError);
}

TEST(Parameters, ListsOfNumbersHaveAnyLength) {
  std::vector<double> values{1};
  const auto describe = [&](FieldVisitor& visit) {
    visit.field({"values", "", "Values."}, values);
  };
  const auto read = [&](const std::string& text) {
    read_parameters(parse_toml(text, "file.toml"), describe, [] {});
  };
  read("values = [2, 0.5, 3.0]");
  EXPECT_EQ(values, (std::vector<double>{2, 0.5, 3}));
  const std::string written = write_parameters(describe);
  read("values = []");
  EXPECT_TRUE(values.empty());
  EXPECT_EQ(write_parameters(describe), "values = []\n");
  read(written);
  EXPECT_EQ(values, (std::vector<double>{2, 0.5, 3}));
  for (const char* wrong : {"values = 1", "values = [1, \"x\"]"})
    EXPECT_THAT(user_error([&] { read(wrong); }), HasSubstr("'values' must be a")) << wrong;
}

}  // namespace
}  // namespace vitrel
