// Pictures: what is covered, hidden and cut, what colours mean, and the files.
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/error.h"
#include "core/io/checked.h"
#include "core/io/h5md.h"
#include "tests/app/end_to_end.h"
#include "tests/support/partial_files.h"
#include "workflow/picture/image_files.h"

namespace vitrel {
namespace {

using std::numbers::pi;

template <int Dim>
Configuration<Dim> particles(const Vec<Dim>& box, const std::vector<ParticleShape<Dim>>& shapes) {
  Configuration<Dim> configuration;
  configuration.box = PeriodicBox<Dim>(box);
  configuration.resize(shapes.size());
  configuration.shape = shapes;
  configuration.species_names = {"A", "B"};
  return configuration;
}

Configuration3 one_ellipsoid(const Vec3& semi_axes) {
  return particles<3>({10, 10, 10}, {{semi_axes}});
}

template <int Dim>
std::vector<Colour> species_colours(const Configuration<Dim>& configuration) {
  std::optional<ColourScale> none;
  return particle_colours(configuration, "species", none);
}

/// A picture of a scene, asked in the units of the scene.
struct Shown {
  Scene scene;
  Image image;

  Shown(Scene shown, int width)
      : scene(std::move(shown)), image(cast_rays(scene, width, height_of(scene, width))) {}

  double pixels_per_length() const { return 0.5 * image.width / scene.half.x(); }
  /// The pixel around a point.
  Colour at(double x, double y) {
    const int column = static_cast<int>((x + scene.half.x()) * pixels_per_length());
    const int row = static_cast<int>((scene.half.y() - y) * pixels_per_length());
    const std::uint8_t* pixel = image.pixel(row, column);
    return {pixel[0], pixel[1], pixel[2]};
  }
  /// Pixels that are neither background nor edges, which are grey up to 9.
  int coloured() const {
    int count = 0;
    for (std::size_t k = 0; k < image.pixels.size(); k += 3) {
      const auto [low, high] =
          std::minmax({image.pixels[k], image.pixels[k + 1], image.pixels[k + 2]});
      count += high - low > 9;
    }
    return count;
  }
  /// A pixel that a body covers in part is nearer to its outline than the diagonal of a pixel.
  void expect_area(double area, double outline) const {
    const double scale = pixels_per_length();
    EXPECT_NEAR(coloured(), area * scale * scale, std::sqrt(2) * outline * scale);
  }
};

Shown seen(const Configuration3& configuration, const View& view = {}, int width = 400) {
  return {scene_of(configuration, species_colours(configuration), view), width};
}

bool is_ink(const Colour& colour) {
  return *std::ranges::max_element(colour) < 60;
}

// ---- rays -------------------------------------------------------------------------------------------

TEST(Picture, AnEllipseCoversItsArea) {
  Configuration2 one = particles<2>({20, 16}, {{3, 1}});
  one.position[0] = {2, -1};
  one.angle[0] = 0.5;
  Shown shown(scene_of(one, species_colours(one)), 424);
  EXPECT_EQ(shown.image.height, 339);  // 16 by 20, and the margins
  shown.expect_area(one.shape[0].volume(), perimeter(one.shape[0]));
  EXPECT_EQ(shown.at(2, -1), species_colour(0));
  EXPECT_EQ(shown.at(2 + 2.5 * std::cos(0.5), -1 + 2.5 * std::sin(0.5)), species_colour(0));
  EXPECT_EQ(shown.at(2 + 2.5 * std::cos(0.5), -1 - 2.5 * std::sin(0.5)), background);
}

// With P = Σ⁻¹ and n towards the eye the projected area is π abc √(nᵀ P n).
TEST(Picture, AnEllipsoidCoversItsProjection) {
  Configuration3 one = one_ellipsoid({3, 2, 0.5});
  one.orientation[0] = normalized(Quaternion(1, 2, 3, 4));
  const Mat3 turn = rotation_matrix(one.orientation[0]);
  for (const View& view : {View{0, 0}, View{90, 0}, View{304, 24}, View{-20, -70}, View{10, 90}}) {
    const double a = view.azimuth * pi / 180, e = view.elevation * pi / 180;
    const Vec3 toward(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
    const Vec3 in_body = turn.transpose() * toward;
    const double area = pi * 3 * norm(Vec3(in_body.cwiseQuotient(one.shape[0].semi_axes)));
    seen(one, view).expect_area(area, 2 * pi * 3);
  }
}

TEST(Picture, ARodAlongTheViewIsADisc) {
  const Configuration3 rod = one_ellipsoid({4, 0.5, 0.5});
  seen(rod, {0, 0}).expect_area(pi * 0.25, pi);
  seen(rod, {90, 0}).expect_area(pi * 2, 2 * pi * 4);
  Shown above = seen(rod, {0, 90});  // y is to the right, and x downwards
  EXPECT_NE(above.at(0, -3.5), background);
  EXPECT_EQ(above.at(-3.5, 0), background);
}

// The colours of species 0 and 1 are blue and orange.
TEST(Picture, TheNearerBodyHidesTheFarther) {
  Configuration3 two = particles<3>({10, 10, 10}, {{Vec3::Ones()}, {Vec3::Ones()}});
  two.species = {0, 1};
  two.position = {{3, 0, 0}, {-3, 0, 0}};
  const Colour from_front = seen(two, {0, 0}).at(0, 0), from_behind = seen(two, {180, 0}).at(0, 0);
  EXPECT_GT(from_front[2], from_front[0]);
  EXPECT_GT(from_behind[0], from_behind[2]);
  const Configuration3 one = one_ellipsoid(Vec3::Ones());
  EXPECT_EQ(seen(two, {0, 0}).coloured(), seen(one, {0, 0}).coloured());
}

TEST(Picture, FacesOfTheBoxCutBodiesFlat) {
  Configuration3 one = one_ellipsoid(Vec3::Ones());
  one.position[0] = {-5, 2, 0};  // half is at one face, and the other half at the opposite one
  Shown cut = seen(one, {0, 0}), whole = seen(one, {0, 0, true});
  EXPECT_EQ(cut.at(2, 0), cut.at(2.6, 0.6));
  cut.expect_area(pi, 2 * pi);
  EXPECT_NE(whole.at(2, 0), whole.at(2.6, 0.6));
  whole.expect_area(pi, 2 * pi);
  EXPECT_EQ(cut.scene.bodies.size(), 2u);
  EXPECT_EQ(whole.scene.bodies.size(), 1u);
}

// Lines are 1/800 of the width, here two pixels. Along a diagonal the nearest and the farthest corner are both in the
// middle.
TEST(Picture, EdgesOfTheBoxAreHiddenWhereTheyAreBehind) {
  const View diagonal{45, std::atan(std::sqrt(0.5)) * 180 / pi, true};
  Configuration3 one = one_ellipsoid(Vec3::Constant(4));
  EXPECT_TRUE(is_ink(seen(one, diagonal, 1600).at(0, 0)));
  one = one_ellipsoid(Vec3::Ones());
  one.position[0] = {4.9, 4.9, 4.9};
  EXPECT_FALSE(is_ink(seen(one, diagonal, 1600).at(0, 0)));
  one.position[0] = {-4.9, -4.9, -4.9};
  EXPECT_TRUE(is_ink(seen(one, diagonal, 1600).at(0, 0)));
  EXPECT_EQ(seen(one, diagonal, 1600).at(1, 0.7), background);  // between edges
}

TEST(Picture, ImagesInThePlaneFillTheBoxAndArePaleOutside) {
  Configuration2 one = particles<2>({20, 20}, {{1, 1}});
  one.position[0] = {9.9, 9.9};
  Shown shown(scene_of(one, species_colours(one)), 1696);
  EXPECT_EQ(shown.scene.bodies.size(), 4u);
  for (const double x : {-9.6, 9.6})
    for (const double y : {-9.6, 9.6}) EXPECT_EQ(shown.at(x, y), species_colour(0)) << x << y;
  const Colour outside = shown.at(10.3, 9.6), inside = species_colour(0);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(outside[c], 0.65 * 255 + 0.35 * inside[c], 1);
  EXPECT_TRUE(is_ink(shown.at(10, 0)));
  EXPECT_EQ(shown.at(9.6, 0), background);
}

TEST(Picture, AHeightBeyondMemoryIsRefused) {
  const Configuration2 strip = particles<2>({1, 1e6}, {{0.1, 0.1}});
  EXPECT_THROW(height_of(scene_of(strip, species_colours(strip)), 1000), UserError);
}

// ---- colours ----------------------------------------------------------------------------------------

TEST(PictureColours, OfOrientationsAreCyclicAndMixed) {
  // Grey of the lightness 0.88 and 0.40 in OKLab, whose cube is the linear light.
  const auto grey = [](double lightness) {
    return std::lround(255 * (1.055 * std::pow(lightness, 3 / 2.4) - 0.055));
  };
  for (const std::uint8_t channel : orientation_colour(0)) EXPECT_EQ(channel, grey(0.88));
  for (const std::uint8_t channel : orientation_colour(pi / 2)) EXPECT_EQ(channel, grey(0.40));
  EXPECT_EQ(orientation_colour(1), orientation_colour(1 + pi));
  EXPECT_GT(orientation_colour(pi / 4)[0], orientation_colour(pi / 4)[2]);
  EXPECT_LT(orientation_colour(-pi / 4)[0], orientation_colour(-pi / 4)[2]);
  EXPECT_EQ(orientation_colour(Vec3(1, 0, 0)), (Colour{238, 170, 40}));
  EXPECT_EQ(orientation_colour(Vec3(0, -1, 0)), (Colour{52, 176, 160}));
  EXPECT_EQ(orientation_colour(normalized(Vec3(1, 1, 1))), (Colour{125, 139, 132}));
}

TEST(PictureColours, OfParticles) {
  Configuration2 two = particles<2>({20, 20}, {{2, 1}, {1, 1}});
  two.angle[0] = 0.3;
  two.species = {0, 1};
  std::optional<ColourScale> scale;
  EXPECT_EQ(default_colouring(two), "orientation");
  EXPECT_EQ(particle_colours(two, "orientation", scale),
            (std::vector<Colour>{orientation_colour(0.3), {154, 163, 173}}));
  EXPECT_EQ(particle_colours(two, "species", scale),
            (std::vector<Colour>{species_colour(0), species_colour(1)}));
  EXPECT_FALSE(scale);
  EXPECT_EQ(particle_colours(two, "size", scale),
            (std::vector<Colour>{sequential_colour(1), sequential_colour(0)}));
  EXPECT_DOUBLE_EQ(scale->high, std::sqrt(2));
  EXPECT_DOUBLE_EQ(scale->low, 1);
  two.shape[0] = {1, 1};
  EXPECT_EQ(default_colouring(two), "species");
  EXPECT_EQ(sequential_colour(0), (Colour{68, 1, 84}));
  EXPECT_EQ(sequential_colour(2), (Colour{253, 231, 37}));
}

TEST(PictureColours, OfATriangularLatticeShowFullHexaticOrder) {
  Configuration2 lattice =
      particles<2>({4, 2 * std::sqrt(3)}, std::vector<Ellipse>(16, {0.4, 0.4}));
  for (std::size_t i = 0; i < 16; ++i) {
    const std::size_t row = i / 4, column = i % 4;
    const double shift = row % 2 == 0 ? 0 : 0.5;
    lattice.position[i] = {static_cast<double>(column) - 1.9 + shift,
                           (static_cast<double>(row) - 1.9) * std::sqrt(0.75)};
  }
  std::optional<ColourScale> scale;
  EXPECT_EQ(particle_colours(lattice, "psi6", scale),
            std::vector<Colour>(16, sequential_colour(1)));
}

TEST(PictureColours, OfDisplacementsEndWhereTwoPercentAreBeyond) {
  std::vector<double> distances(101);
  for (std::size_t k = 0; k < distances.size(); ++k) distances[k] = static_cast<double>(100 - k);
  EXPECT_EQ(displacement_scale(distances).high, 98);
  EXPECT_EQ(displacement_scale({0, 0}).high, 1);
}

// ---- files ------------------------------------------------------------------------------------------

TEST(Picture, PngKeepsEveryPixel) {
  Image image = seen(one_ellipsoid({3, 2, 1})).image;
  const std::string bytes = png_of(image);
  png_image read{};
  read.version = PNG_IMAGE_VERSION;
  ASSERT_TRUE(png_image_begin_read_from_memory(&read, bytes.data(), bytes.size()));
  read.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(read));
  ASSERT_TRUE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr));
  EXPECT_EQ(static_cast<int>(read.width), image.width);
  EXPECT_EQ(pixels, image.pixels);
}

TEST(Picture, SvgHasAnEllipsePerImage) {
  Configuration2 one = particles<2>({20, 20}, {{2, 1}});
  one.position[0] = {9.9, 0};
  one.angle[0] = 0.5;
  const std::string svg = svg_of(scene_of(one, species_colours(one)), 212);
  // Ten pixels per length; the right one is at 10.6 + 9.9, with half of a line of 212/800 as rim.
  EXPECT_THAT(svg, HasSubstr("<ellipse rx=\"19.8675\" ry=\"9.8675\" transform=\"translate(205 106) "
                             "rotate(-28.6479)\" fill=\"#0072b2\""));
  EXPECT_THAT(svg, HasSubstr("translate(5 106)"));
  std::size_t ellipses = 0;
  for (std::size_t at = 0; (at = svg.find("<ellipse", at)) != std::string::npos; ++at) ++ellipses;
  EXPECT_EQ(ellipses, 2u);
}

/// Frames of three particles that move to the right, each time by 0.1, 0.2 and 0.3.
template <int Dim>
void write_run(const fs::path& path, int frames) {
  Configuration<Dim> state =
      particles<Dim>(Vec<Dim>::Constant(20), std::vector<ParticleShape<Dim>>(3));
  for (std::size_t i = 0; i < 3; ++i) state.position[i].y() = 3.0 * static_cast<double>(i);
  auto writer = TrajectoryWriter::create(path, state, current_provenance("", "", 1));
  for (int k = 0; k < frames; ++k) {
    state.time = k;
    writer.write(state, k);
    for (std::size_t i = 0; i < 3; ++i) state.position[i].x() += 0.1 * static_cast<double>(i + 1);
  }
  writer.close();
}

/// The variable PATH, until the end of the scope.
class Path {
 public:
  explicit Path(const std::string& value) {
    if (const char* const before = std::getenv("PATH")) before_ = before;
    checked(setenv("PATH", value.c_str(), 1), "setenv");
  }
  ~Path() { static_cast<void>(setenv("PATH", before_.c_str(), 1)); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string before_;
};

class PictureCommand : public testing::Test {
 protected:
  PictureCommand() {
    write_run<2>(folder_ / "run.h5", 5);
    write_run<3>(folder_ / "space.h5", 1);
  }
  ~PictureCommand() override { EXPECT_THAT(partial_files(folder_.path()), IsEmpty()); }
  /// Puts a program named ffmpeg there; returns PATH with the folder that it is in.
  std::string path_with_ffmpeg(const std::string& script) const {
    fs::create_directory(folder_ / "bin");
    folder_.write("bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder_ / "bin/ffmpeg", fs::perms::owner_all);
    const char* const path = std::getenv("PATH");
    return (folder_ / "bin").string() + ":" + (path ? path : "");
  }

  const Folder folder_{"picture"};
};

TEST_F(PictureCommand, DrawsTheLastFrameBesideTheFile) {
  const auto summary = folder_.summary("picture run.h5 --width 106 --colour displacement");
  expect_values(summary, {{"output", "run.png"},
                          {"frames", 1},
                          {"particles", 3},
                          {"width", 106},
                          {"height", 106},
                          {"colour", "displacement"}});
  EXPECT_EQ(summary["colour_scale"][0], 0);
  EXPECT_NEAR(summary["colour_scale"][1], 0.8, 1e-12);  // four times 0.2
  EXPECT_THAT(folder_.read("run.png"), StartsWith("\x89PNG"));
  const std::string last = folder_.read("run.png");
  folder_.succeed("picture run.h5 --width 106 --frame 0 -q");
  EXPECT_NE(folder_.read("run.png"), last);
  folder_.succeed("picture run.h5 -o run.svg -q");
  EXPECT_THAT(folder_.read("run.svg"), testing::EndsWith("</svg>\n"));
  folder_.succeed("picture space.h5 --azimuth -30 --whole -q");
}

TEST_F(PictureCommand, RefusesWithOneMessage) {
  folder_.expect_refusals(
      {{"picture -q run.h5 --colour psi", 2, "--colour: 'psi' is none of orientation, species,"},
       {"picture -q space.h5 --colour psi6", 2, "psi6 are for two dimensions"},
       {"picture -q space.h5 -o x.svg", 2, "space.h5: is three-dimensional, and drawn as .png"},
       {"picture -q run.h5 -o x.gif", 2, "x.gif: a picture is called .png or, in two dimensions,"},
       {"picture -q run.h5 --elevation 10", 2, "run.h5: is two-dimensional; --azimuth,"},
       {"picture -q run.h5 --frames 1:3", 2, "selects 2 frames, but run.png shows one"},
       {"picture -q run.h5 --frames 9", 2, "has 5 frame(s)"},
       {"picture -q run.h5 --rate 10", 2, "--rate: is for films"},
       {"picture -q run.h5 -o nowhere/x.png", 3, "there is no folder"},
       {"picture -q run.h5 -o run.h5", 2, "run.h5"}});
  EXPECT_FALSE(fs::exists(folder_ / "run.png"));
}

TEST_F(PictureCommand, SaysThatFfmpegIsMissing) {
  const Path path((folder_ / "nowhere").string());
  folder_.expect_refusal(
      "picture run.h5 -o run.mp4 -q", 2,
      "films are made by the program ffmpeg, which cannot be started: No such file");
}

// Instead of a film it writes its arguments and how many bytes it got.
TEST_F(PictureCommand, GivesFfmpegAllFrames) {
  const Path path(
      path_with_ffmpeg("for word; do case $word in pipe:*) input=${word#pipe:};; esac; done\n"
                       "{ echo \"$@\"; wc -c <&$input; } > \"${word#file:}\"\n"));
  const auto summary =
      folder_.summary("picture run.h5 -o run.mp4 --width 31 --frames 1: --rate 12.5");
  EXPECT_EQ(summary["frames"], 4);
  EXPECT_EQ(summary["width"], 32);  // of which films have an even number
  const std::string film = folder_.read("run.mp4");
  EXPECT_THAT(film, HasSubstr("-video_size 32x32 -framerate 12.5 -i pipe:"));
  EXPECT_THAT(film, HasSubstr("\n" + std::to_string(4 * 3 * 32 * 32) + "\n"));
}

TEST_F(PictureCommand, AnFfmpegThatFailsLeavesTheOldFilm) {
  folder_.write("run.mp4", "old");
  const Path path(path_with_ffmpeg("exit 7\n"));
  folder_.expect_refusal("picture run.h5 -o run.mp4 -q", 3,
                         "run.mp4: cannot be written: ffmpeg ended early with the exit code 7");
  EXPECT_EQ(folder_.read("run.mp4"), "old");
}

TEST_F(PictureCommand, APictureThatDoesNotFitLeavesNothing) {
  testing_program::expect_refusal(folder_.run_with_file_limit(1000, "picture run.h5 -q"), 3,
                                  "run.png: cannot be written: File too large");
  EXPECT_FALSE(fs::exists(folder_ / "run.png"));
}

}  // namespace
}  // namespace vitrel
