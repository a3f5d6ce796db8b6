// vitrel pair from outside.

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "analysis/results.h"
#include "core/io/checked.h"
#include "edmd/soft/linear_dashpot.h"
#include "edmd/soft/restitution.h"
#include "edmd/soft/viscoelastic.h"
#include "tests/app/end_to_end.h"

namespace vitrel {
namespace {

using Json = nlohmann::json;

constexpr double pi = std::numbers::pi;

/// Tables of contacts go to the folder of the test.
class Pair : public testing::Test {
 protected:
  Pair() { checked(setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1), "setenv"); }

  Outcome ask(const std::string& question) const { return folder_.run("pair " + question); }
  Json answer(const std::string& question) const {
    const Outcome outcome = ask(question + " --json");
    EXPECT_EQ(outcome.code, 0) << outcome.errors;
    return Json::parse(outcome.output, nullptr, false);
  }
  /// The question about two bodies, with further options.
  static std::string about(const std::string& one, const std::string& two,
                           const std::string& options = "") {
    return fmt::format(" --body '{}' --body '{}' {}", one, two, options);
  }
  Json gap(const std::string& one, const std::string& two, const std::string& options = "") const {
    return answer("gap" + about(one, two, options));
  }
  Json contact_time(const std::string& one, const std::string& two,
                    const std::string& options = "") const {
    return answer("contact-time" + about(one, two, options));
  }
  void expect_refusal(const std::string& question, int code, const std::string& part) const {
    folder_.expect_refusal("pair " + question, code, part);
  }

  Folder folder_{"pair"};
};

using PairContactTime = Pair;
using PairRestitution = Pair;

void expect_vector(const Json& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance);
}

/// A contact is declared at most 1.25 contact gaps (core/tolerances.h) early, here with surfaces that approach at a speed
/// of 0.5 or more and coordinates up to 8.
constexpr double early = 1.25 * 32 * std::numeric_limits<double>::epsilon() * 8 / 0.5;

// Appendix B.1 of the thesis.
const std::string thesis_1 = "semi_axes=1,0.5";
const std::string thesis_2 =
    "semi_axes=1,0.5 position=1,1 velocity=-1,0 angular_velocity=3.141592653589793";

TEST_F(PairContactTime, IsThatOfTheThesis) {
  const Json found = contact_time(thesis_1, thesis_2);
  EXPECT_EQ(found["outcome"], "contact");
  EXPECT_NEAR(found["time"], 0.08472238582199765, early);
  EXPECT_GT(found["gap"], 0);
  EXPECT_LT(found["gap"], early);
  EXPECT_EQ(found["gap_is"], "distance of the surfaces");
  EXPECT_THAT(ask("contact-time" + about(thesis_1, thesis_2)).output,
              HasSubstr("\ntime                       0.084722386\n"));
}

// Two collisions in extended precision, to the digits given.
TEST_F(PairContactTime, AgreesWithReferenceCollisions) {
  const Json found =
      contact_time("semi_axes=2,1",
                   "semi_axes=2,1 position=6,0.5 angle=1.5707963267948966 velocity=-1,0 "
                   "angular_velocity=0.7");
  EXPECT_NEAR(found["time"], 2.170137851790125, early);
  expect_vector(found["point"], {1.917878297555, 0.283611898450}, 1e-12);
  expect_vector(found["normal"], {0.860699250292, 0.509113740284}, 1e-12);
  const Json other = contact_time(
      "semi_axes=2,1 angle=0.3 velocity=0.2,-0.1 angular_velocity=1.5",
      "semi_axes=2,1 position=3,2.5 angle=-0.4 velocity=-0.5,-0.6 angular_velocity=-0.8");
  EXPECT_NEAR(other["time"], 1.495639195538086, early);
}

TEST_F(PairContactTime, OfSpheresIsTheClosedForm) {
  // |(5 − 2t, 1, 1)| = 1 + 2
  const Json found = contact_time("semi_axes=1,1,1 velocity=2,0,0",
                                  "semi_axes=2,2,2 position=5,1,1 orientation=1,2,3,4");
  EXPECT_NEAR(found["time"], (5 - std::sqrt(7)) / 2, early);
  expect_vector(found["normal"], {std::sqrt(7) / 3, 1.0 / 3, 1.0 / 3}, 1e-13);
}

// A body that rotates about its middle axis, a little off, tumbles; about its own axis it does not.
TEST_F(PairContactTime, EllipsoidsTumbleUnlessTheirAngularVelocityIsConstant) {
  const std::string wall = "semi_axes=1,1,1 position=3.2,0,0 velocity=-0.02,0,0";
  const auto time = [&](const std::string& omega, const std::string& rotation) {
    const Json found =
        contact_time("semi_axes=1,2,1.5 angular_velocity=" + omega, wall, "--rotation " + rotation);
    EXPECT_LT(found["gap"], 1e-12);
    return found["time"].get<double>();
  };
  EXPECT_NEAR(time("0,0,1", "euler"), time("0,0,1", "constant"), 1e-11);
  EXPECT_GT(std::abs(time("0.1,0,1", "euler") - time("0.1,0,1", "constant")), 1e-3);
}

TEST_F(PairContactTime, EndsAtTheHorizon) {
  const auto until = [&](const std::string& options) {
    return contact_time("semi_axes=1,1", "semi_axes=1,1 position=12,0 velocity=-1,0", options);
  };
  EXPECT_EQ(until("--horizon 9.99"),
            Json({{"outcome", "no contact before the horizon"}, {"horizon", 9.99}}));
  EXPECT_NEAR(until("--horizon 10.01")["time"], 10, early);
  EXPECT_NEAR(until("")["time"], 10, early);
}

TEST_F(PairContactTime, SaysThatTheBodiesOverlapOrTouchAtTheStart) {
  const Json overlap = contact_time("semi_axes=2,1", "semi_axes=2,1 position=3,0");
  EXPECT_EQ(overlap["outcome"], "overlap at the start");
  EXPECT_NEAR(overlap["gap"], -1, 1e-12);
  EXPECT_EQ(overlap["gap_is"], "minus the depth of the overlap");
  const Json touch = contact_time("semi_axes=2,1", "semi_axes=2,1 position=4,0");
  EXPECT_EQ(touch["outcome"], "touch at the start");
  EXPECT_EQ(touch["gap"], 0);
}

/// The first time at which disks of radius 1 touch, of which the second starts at d + shift ∘ L.
double first_touch(double x, double y, double vx, double vy) {
  const double b = x * vx + y * vy, v = vx * vx + vy * vy, c = x * x + y * y - 4;
  const double discriminant = b * b - v * c;
  return b < 0 && discriminant >= 0 ? c / (std::sqrt(discriminant) - b)
                                    : std::numeric_limits<double>::infinity();
}

// Images are as far as 1000, where a contact gap is 7e-12, and approach at 0.02 or more.
TEST_F(PairContactTime, InABoxIsThatOfTheFirstImage) {
  for (const auto& [vx, vy] : {std::pair(1.0, 0.0), std::pair(1.0, 0.02), std::pair(-0.01, 1.0)}) {
    double expected = std::numeric_limits<double>::infinity();
    int image[2] = {};
    for (int i = -200; i <= 200; ++i)
      for (int j = -200; j <= 200; ++j)
        if (const double time = first_touch(3 + 9 * i, 2.5 + 8 * j, vx, vy); time < expected)
          expected = time, image[0] = i, image[1] = j;
    const Json found = contact_time(
        "semi_axes=1,1", fmt::format("semi_axes=1,1 position=3,2.5 velocity={},{}", vx, vy),
        "--box 9,8 --horizon 1000");
    if (std::isinf(expected)) {
      EXPECT_EQ(found["outcome"], "no contact before the horizon");
      continue;
    }
    EXPECT_NEAR(found["time"], expected, 1e-9);
    EXPECT_EQ(found["image"], Json({image[0], image[1]}));
    EXPECT_LT(std::abs(found["gap"].get<double>()), 1e-11);
  }
}

// The tables themselves: tests/workflow/pair_figures_test.cpp.
TEST_F(PairContactTime, ThePathIsATableOrAPage) {
  const std::string thesis = "path" + about(thesis_1, thesis_2);
  const Json found = answer(thesis);
  EXPECT_EQ(found["psi"], 125);
  EXPECT_EQ(found["g_1"], -2);
  EXPECT_NEAR(found["d"], std::sqrt(5) - 2, 1e-15);  // unit circles, the second one at (1, 2)
  EXPECT_NEAR(found["first_contact"], 0.08472238582199765, early);
  EXPECT_NEAR(found["until"], 1 + std::sqrt(3), 1e-15);
  EXPECT_FALSE(found.contains("output"));
  EXPECT_EQ(answer(thesis + "--until 0.05")["first_contact"], nullptr);
  EXPECT_EQ(answer(thesis + "--until 2 --points 5 -o path.csv")["output"], "path.csv");
  std::istringstream csv(folder_.read("path.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "time,gap,touching_scale,d,psi,g_1,g_2");
  EXPECT_EQ(std::count(std::istreambuf_iterator<char>(csv), {}, '\n'), 5);
  EXPECT_EQ(ask(thesis + "-o path.h5 -q").code, 0);
  const Results results = read_results(folder_ / "path.h5");
  EXPECT_EQ(results.find("path")->rows(), 1000u);
  EXPECT_EQ(results.find("first_contact")->rows(), 1u);
  EXPECT_THAT(results.text("parameters"), HasSubstr("[[body]]"));
  EXPECT_EQ(ask(thesis + "-o path.html -q").code, 0);
  EXPECT_THAT(folder_.read("path.html"), HasSubstr("first contact, t = 0.084722"));
  const Json in_space = answer("path" + about("semi_axes=1,1,1", "semi_axes=1,1,1 position=3,0,0"));
  EXPECT_EQ(in_space["first_contact"], nullptr);
  EXPECT_FALSE(in_space.contains("psi"));

  folder_.write("other.html", "mine");
  for (const auto& [options, part] :
       {std::pair("-o path.txt", "-o path.txt: the name must end in .csv, .h5 or .html"),
        {"-o other.html", "other.html: exists and is not an HTML page"},
        {"--points 1", "--points"},
        {"--until 0", "--until"},
        {"--until 1e9 --box 5,5", "more than 1e+06 times the shortest side"}})
    expect_refusal(thesis + options, 2, part);
}

// A file, the command line and --set lead to the same pair.
TEST_F(PairContactTime, OfAFileIsThatOfTheCommandLine) {
  folder_.write("pair.toml",
                "horizon = 5\n[[body]]\nsemi_axes = [1, 0.5]\n[[body]]\nsemi_axes = [1, 0.5]\n"
                "position = [1, 1]\nvelocity = [-1, 0]\nangular_velocity = 0.0\n");
  EXPECT_EQ(folder_.succeed(
                "pair contact-time pair.toml --set body.1.angular_velocity=3.141592653589793"),
            ask("contact-time" + about(thesis_1, thesis_2)).output);
}

TEST_F(PairContactTime, TheTemplateIsAPair) {
  folder_.write("pair.toml", folder_.succeed("params pair"));
  EXPECT_EQ(answer("contact-time pair.toml")["outcome"], "contact");
}

// Distances at which ellipses (2, 1) touch, with their angles and the direction of the centres, in degrees.
TEST_F(Pair, TouchAtTheReferenceDistances) {
  struct Case {
    double angle1, angle2, direction, distance;
  };
  const double degree = pi / 180;
  for (const Case& of :
       {Case{0, 0, 30, 3.023715784073818}, Case{0, 90, 0, 3}, Case{0, 90, 45, std::sqrt(10)},
        Case{0, 45, 0, 3.335855487022610}, Case{30, 100, 20, 2.955140520703047}})
    for (const double distance : {1.0, 2.9, 3.5, 7.0}) {
      const Json found = answer(
          "overlap" + about(fmt::format("semi_axes=2,1 angle={}", of.angle1 * degree),
                            fmt::format("semi_axes=2,1 angle={} position={},{}", of.angle2 * degree,
                                        distance * std::cos(of.direction * degree),
                                        distance * std::sin(of.direction * degree))));
      EXPECT_NEAR(found["touching_scale"], distance / of.distance, 1e-13);
      EXPECT_EQ(found["overlap"], distance < of.distance);
      EXPECT_EQ(found["gap"] < 0, distance < of.distance);
      const bool is_negative = found["g_1"] < 0 || found["g_2"] < 0;
      EXPECT_EQ(found["psi"] > 0 && is_negative, distance > of.distance);
    }
}

// Parallel equal ellipses: their Minkowski difference is the ellipse (4, 2). On its axis, the closest point to (1, 0) is
// x = 4/3, y² = 32/9.
TEST_F(Pair, DepthOfAnOverlapIsTheShortestTranslation) {
  EXPECT_NEAR(gap("semi_axes=2,1", "semi_axes=2,1 position=1,0")["gap"], -std::sqrt(33) / 3, 1e-12);
  EXPECT_NEAR(gap("semi_axes=2,1", "semi_axes=2,1")["gap"], -2, 1e-12);
}

TEST_F(Pair, GapHasItsNormalAndItsEnds) {
  const Json found = gap("semi_axes=2,1 position=1,1", "semi_axes=2,1 position=1,5");
  EXPECT_EQ(found["gap"], 2);
  expect_vector(found["normal"], {0, 1}, 1e-15);
  expect_vector(found["point_on_1"], {1, 2}, 1e-15);
  expect_vector(found["point_on_2"], {1, 4}, 1e-15);
  EXPECT_FALSE(gap("semi_axes=2,1", "semi_axes=2,1 position=1,0").contains("normal"));
  // An ellipsoid whose long axis is turned to y; the quaternion is normalised.
  const Json solid = gap("semi_axes=2,1,0.5 orientation=3,0,0,3", "semi_axes=1,1,1 position=0,4,0");
  EXPECT_NEAR(solid["gap"], 1, 1e-15);
  expect_vector(solid["normal"], {0, 1, 0}, 1e-15);
  expect_vector(solid["point_on_1"], {0, 2, 0}, 1e-15);
}

TEST_F(Pair, InABoxTheClosestImageCounts) {
  const Json found = gap("semi_axes=2,1", "semi_axes=2,1 position=0,3.5", "--box 9,5");
  EXPECT_EQ(found["image"], Json({0, -1}));
  EXPECT_NEAR(found["gap"], -0.5, 1e-12);
  // Across the long axes another centre is closer, at (−2.4, 2.5), but not its surface.
  const Json along = gap("semi_axes=2,1 angle=0.7853981633974483",
                         "semi_axes=2,1 angle=0.7853981633974483 position=2.5,2.5", "--box 4.9,6");
  EXPECT_EQ(along["image"], Json({0, 0}));
  EXPECT_NEAR(along["gap"], 2.5 * std::sqrt(2) - 4, 1e-12);
}

TEST_F(Pair, RefusesRotationsThatNoSearchCanFollow) {
  for (const auto& [spinning, other] :
       {std::pair("semi_axes=2,1 angular_velocity=2e4", "semi_axes=1,1"),
        {"semi_axes=2,1,1 angular_velocity=0,1.5e4,1.5e4", "semi_axes=1,1,1"}})
    expect_refusal("contact-time" + about(spinning, other), 2,
                   "radians until the horizon, but at most 1e+06 are possible");
}

TEST_F(Pair, RefusesBadBodies) {
  for (const auto& [body, part] :
       {std::pair("semi_axes=2,1 positon=1,1",
                  "--body 'semi_axes=2,1 positon=1,1': key 'body.0.positon' is unknown; did you "
                  "mean 'position'?"),
        {"semi_axes=1,2", "'body.0.semi_axes' is [1.0, 2.0], but must be [a, b]"},
        {"semi_axes=2,-1", "'body.0.semi_axes' is [2.0, -1.0], but must be [a, b]"},
        {"semi_axes=2,1,1,1", "but must be [a, b] with a ≥ b > 0, or [a, b, c]"},
        {"semi_axes=1e60,1", "but must be finite, at most 1e+50"},
        {"semi_axes=1e4,1", "the longest may be at most 1000 times the shortest"},
        {"semi_axes=1e-60,1e-60", "but must not be below 1e-50"},
        {"semi_axes=2", "must be an array of numbers, not the number 2"},
        {"position=2,1", "'body.0.semi_axes' is missing"},
        {"semi_axes=2,1,1", "'body.1.semi_axes' has 2 entries, but body.0.semi_axes 3"},
        {"semi_axes=2,1 position=1,1,1", "'body.0.position' is [1.0, 1.0, 1.0], but must have 2"},
        {"semi_axes=2,1 velocity=1,nan", "'body.0.velocity' is [1.0, nan], but must be finite"},
        {"semi_axes=2,1 angular_velocity=1,0,0", "but must be one number"},
        {"semi_axes=2,1,1 angular_velocity=1", "but must be [ω_x, ω_y, ω_z]"},
        {"semi_axes=2,1 orientation=1,0,0,0", "has a meaning only with three semi-axes"},
        {"semi_axes=2,1,1 angle=1", "has a meaning only with two semi-axes"},
        {"semi_axes=2,1,1 orientation=0,0,0,0", "[0.0, 0.0, 0.0, 0.0], but must be a rotation"},
        {"semi_axes=2,1 here", "'here' is not key=value; write, for example, --body"},
        {"", "'' is not key=value"},
        {"semi_axes=2,x", "'[2,x]' is not a TOML value"}})
    expect_refusal("gap" + about(body, "semi_axes=2,1"), 2, part);
}

TEST_F(Pair, RefusesAnythingButTwoBodies) {
  folder_.write("one.toml", "[[body]]\nsemi_axes = [1, 0.5]\nangle = \"up\"\n");
  folder_.write("key.toml", "horizon = 1\nboddy = []\n");
  const std::string body = " --body semi_axes=2,1";
  for (const auto& [options, code, part] : std::initializer_list<testing_program::Refusal>{
           {"overlap", 2, "give two bodies, --body"},
           {"overlap" + body, 2, "must have two entries, one for each body, not 1"},
           {"overlap" + body + body + body, 2, "not 3"},
           {"overlap none.toml", 3, "none.toml: cannot be read"},
           {"overlap none.toml" + body, 2, "file excludes --body"},
           {"overlap one.toml", 2,
            "one.toml:3:9: key 'body.0.angle' must be a number, not the string \"up\""},
           {"overlap one.toml --set body.0.angle=0", 2, "not 1"},
           {"overlap key.toml", 2, "key.toml:2:1: key 'boddy' is unknown; did you mean 'body'?"}})
    expect_refusal(options, code, part);
}

TEST_F(PairContactTime, RefusesBadOptions) {
  for (const auto& [options, part] :
       {std::pair("--horizon soon", "--horizon soon: key 'horizon' must be a number"),
        {"--horizon -1", "'horizon' is -1.0, but must be 0 or more"},
        {"--horizon 1e9 --box 5,5", "more than 1e+06 times the shortest side"},
        {"--box 5", "'box' must be an array of numbers"},
        {"--box 5,5,5", "must have 2 sides"},
        {"--box 5,-5", "'box' is -5.0, but must be positive"},
        {"--box 5,1.9", "no side may be shorter than 2.0"},
        {"--rotation fast", "'fast' is none of euler, constant"},
        {"--set body.1.spin=1", "--set body.1.spin=1: key 'body.1.spin' is unknown"}})
    expect_refusal("contact-time" + about(thesis_1, thesis_2, options), 2, part);
}

// Restitution

ContactPair spheres(double radius1, double radius2) {
  const auto mass = [](double radius) { return 1140 * 4 * pi / 3 * std::pow(radius, 3); };
  return contact_pair(radius1, mass(radius1), radius2, mass(radius2));
}

void expect_coefficients(const Json& found, const Restitution& expected, double tolerance) {
  EXPECT_NEAR(found["distance"], expected.distance, tolerance);
  EXPECT_NEAR(found["angle"], expected.angle, tolerance);
  EXPECT_NEAR(found["duration"], expected.duration, tolerance);
  EXPECT_NEAR(found["rate"], expected.rate, tolerance);
}

// Figure 6 of mueller2013: 0.1 m, 1140 kg/m³, 2 kN/m, elastic.
TEST_F(PairRestitution, IsThatOfTheSource) {
  const std::string figure_6 =
      "restitution --set law=linear_dashpot --set 'stiffness=2 kN/m' --speed '5 m/s' "
      "--impact-parameter 0.3";
  const Restitution expected{1, 1.7243731112, 2.1182452973, -1};
  const Json found = answer(figure_6);
  EXPECT_EQ(found["law"], "linear_dashpot");
  EXPECT_NEAR(found["scaled_distance"], 1.2135915965, 1e-10);
  EXPECT_NEAR(found["scaled_angular_momentum"], 0.3816569006, 1e-10);
  EXPECT_EQ(found["scaled_damping"], 0);
  EXPECT_NEAR(found["contact_time"], 0.07318852, 5e-9);
  expect_coefficients(found["integrated"], expected, 6e-11);
  expect_coefficients(found["tabulated"], expected, 2e-8);
  for (const char* const name : {"distance", "angle", "duration", "rate"})
    EXPECT_DOUBLE_EQ(found["difference"][name], found["tabulated"][name].get<double>() -
                                                    found["integrated"][name].get<double>());
  const Outcome text = ask(figure_6);
  EXPECT_THAT(text.output, HasSubstr("relative speed             5 m/s\n"));
  EXPECT_THAT(text.output, HasSubstr("ε_φ (angle)                1.72437311119        1.72437311"));
  EXPECT_EQ(text.errors, "");  // the table is there
}

// l/X = 10, e = 0.5 and c_dis = 0.2, of an independent integration to the digits given.
TEST_F(PairRestitution, IsThatOfTheMaterialInAParameterFile) {
  const ContactPair pair = spheres(0.1, 0.1);
  const double speed = 2, normal_speed = speed * std::sqrt(0.75);
  const double time = pair.distance / 10 / normal_speed;
  const std::string sphere = "[[species]]\naspect_ratio = 1\n[dynamics.contact]\n";
  folder_.write("dashpot.toml",
                sphere + fmt::format("law = \"linear_dashpot\"\n"
                                     "stiffness = \"{} N/m\"\n"
                                     "damping = \"{} kg/s\"\n",
                                     pair.mass / (time * time), 0.2 * pair.mass / time));
  const Json dashpot = answer("restitution dashpot.toml --impact-parameter 0.5");
  EXPECT_NEAR(dashpot["scaled_distance"], 10, 1e-12);
  EXPECT_NEAR(dashpot["scaled_damping"], 0.2, 1e-14);
  const Restitution of_dashpot{0.985005066, 0.185758530, 2.861236631, -0.749746697};
  expect_coefficients(dashpot["integrated"], of_dashpot, 6e-10);
  expect_coefficients(dashpot["tabulated"], of_dashpot, 3e-8);

  // T = κ^(−2/5) v^(−1/5), κ = 2 Y √R_eff/(3 (1 − ν²) m_eff), c_dis = 3A/(2T)
  const double kappa = std::pow(time * std::pow(normal_speed, 0.2), -2.5), poisson = 0.3;
  folder_.write("spheres.toml",
                sphere + fmt::format("youngs_modulus = \"{} Pa\"\npoissons_ratio = {}\n"
                                     "dissipative_time = \"{} s\"\n",
                                     kappa * pair.mass * 3 * (1 - poisson * poisson) / 2 /
                                         std::sqrt(pair.radius),
                                     poisson, 0.2 * 2 * time / 3));
  const Json viscoelastic = answer("restitution spheres.toml --impact-parameter 0.5");
  const Restitution of_spheres{0.983858836, 0.200069121, 3.026685354, -0.807058208};
  expect_coefficients(viscoelastic["integrated"], of_spheres, 6e-10);
  expect_coefficients(viscoelastic["tabulated"], of_spheres, 3e-8);
}

// Unlike spheres damp differently, so that their table has a tolerance of 1e-6.
TEST_F(PairRestitution, TakesASecondRadius) {
  const Json found = answer(
      "restitution --set 'dissipative_time=1e-4 s' --speed '3 m/s' "
      "--impact-parameter 0.6 --second-radius '8 cm'");
  const Viscoelastic force{1e9, 0.4, 1e-4};
  const Restitution expected =
      integrate_contact<Viscoelastic>(scaled_impact(force, spheres(0.1, 0.08), 2.4, 1.8));
  expect_coefficients(found["integrated"], expected, 1e-11);
  expect_coefficients(found["tabulated"], expected, 4e-6);
}

// Head-on and hard, the coefficient of the linear dashpot at c_dis = 1 (schwager2007); outside the table.
TEST_F(PairRestitution, IsIntegratedOutsideTheTable) {
  const ContactPair pair = spheres(0.1, 0.1);
  const double stiffness = 1e9, damping = std::sqrt(stiffness * pair.mass);
  const std::string head_on = fmt::format(
      "restitution --set law=linear_dashpot --set 'stiffness=1e9 N/m' --set 'damping={} kg/s'",
      damping);
  const Json found = answer(head_on);
  EXPECT_NEAR(found["integrated"]["rate"], -0.2984360592, 6e-11);
  EXPECT_TRUE(found["tabulated"].is_null());
  EXPECT_TRUE(found["difference"].is_null());
  EXPECT_THAT(ask(head_on).errors, HasSubstr("lies outside the table; a run integrates it"));
}

TEST_F(PairRestitution, WritesTheTable) {
  const std::string question = "restitution --set law=linear_dashpot --set 'damping=100 kg/s' -q ";
  for (const char* const file : {"table.csv", "table.h5"}) {
    const Outcome outcome = ask(question + "--table " + file);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.output + outcome.errors, "");
  }
  EXPECT_EQ(ask(question + "--table table.html --scaled-table scaled.html --paths paths.html").code,
            0);
  EXPECT_THAT(folder_.read("table.html"),
              HasSubstr("<title>Restitution of two soft spheres</title>"));
  EXPECT_THAT(folder_.read("scaled.html"), HasSubstr("ln c_dis = -12.47"));
  EXPECT_THAT(folder_.read("paths.html"), HasSubstr("Collision of finite duration"));
  const Results results = read_results(folder_ / "table.h5");
  EXPECT_THAT(results.text("parameters"), HasSubstr("damping = \"100 kg/s\""));
  const Table* table = results.find("restitution");
  ASSERT_TRUE(table);
  ASSERT_EQ(table->rows(), 10'000u);
  const LinearDashpot force{1e6, 100};
  std::istringstream csv(folder_.read("table.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "relative_speed,impact_parameter,distance,angle,duration,rate,contact_time");
  for (std::size_t row = 0; row < table->rows(); ++row) {
    std::getline(csv, line);
    std::istringstream numbers(line);
    std::vector<double> of;
    for (const Column& column : table->columns) {
      std::string number;
      std::getline(numbers, number, ',');
      of.push_back(std::stod(number));
      EXPECT_EQ(of.back(), column.value[row]);
    }
    if (row % 97 != 0) continue;
    const double across = of[0] * of[1], normal = std::sqrt(of[0] * of[0] - across * across);
    const ScaledImpact impact = scaled_impact(force, spheres(0.1, 0.1), normal, across);
    const Restitution expected = integrate_contact<LinearDashpot>(impact);
    EXPECT_NEAR(of[2], expected.distance, 1e-8);
    EXPECT_NEAR(of[3] / expected.angle, 1, 3e-8);
    EXPECT_NEAR(of[4] / expected.duration, 1, 2e-8);
    EXPECT_NEAR(of[5] / expected.rate, 1, 2e-8);
    EXPECT_NEAR(of[6] / (of[4] * force.scales(normal, spheres(0.1, 0.1)).time), 1, 1e-12);
  }
}

TEST_F(PairRestitution, RefusesBadImpacts) {
  folder_.write("hard.toml", "[system]\nparticles = 10\n");
  for (const auto& [options, code, part] : std::initializer_list<testing_program::Refusal>{
           {"--speed 5", 2, "--speed 5: key 'speed' must be a string with a number and a unit"},
           {"--speed '5 kg'", 2, "converts to m/s"},
           {"--speed '0 m/s'", 2, "'speed' is 0.0, but must be positive"},
           {"--speed '1e30 m/s'", 2, "so high that the spheres pass through each other"},
           {"--impact-parameter 1", 2, "must lie from 0 (head-on) to below 1 (grazing)"},
           {"--second-radius '1 km'", 2, "must lie between 0.0001 m and 100 m"},
           {"--set 'young=1 GPa'", 2, "'dynamics.contact.young' is unknown"},
           {"--set 'stiffness=1 N/m'", 2, "has a meaning only with law = \"linear_dashpot\""},
           {"--table table.txt", 2, "--table table.txt: the name must end in .csv, .h5 or .html"},
           {"--table no/table.h5", 3, "there is no folder"},
           {"none.toml", 3, "none.toml: cannot be read"},
           {"hard.toml", 2, "hard.toml: has no section [dynamics.contact]"}})
    expect_refusal("restitution " + options, code, part);
}

}  // namespace
}  // namespace vitrel
