#include "analysis/structure/contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/random/stream.h"
#include "core/state/check.h"
#include "edmd/growth.h"
#include "tests/support/scenes.h"

namespace vitrel {
namespace {

constexpr double gap = 1e-6;

/// Columns × (2 half_rows) disks of radius 1 on the triangular lattice, `gap` apart; stretched
/// along x into ellipses.
Configuration2 triangular_lattice(int columns, int half_rows, double stretch) {
  const double spacing = 2 + gap;
  Configuration2 c;
  c.box = PeriodicBox<2>(Vec2(columns * spacing * stretch, half_rows * std::sqrt(3.0) * spacing));
  c.resize(static_cast<std::size_t>(columns) * 2 * half_rows);
  std::size_t i = 0;
  for (int row = 0; row < 2 * half_rows; ++row)
    for (int column = 0; column < columns; ++column, ++i) {
      c.shape[i] = {stretch, 1};
      c.position[i] = spacing * Vec2(stretch * (column + 0.5 * (row % 2)), std::sqrt(0.75) * row);
      c.box.wrap(c.position[i], c.image[i]);
    }
  return c;
}

Configuration2 square_lattice_of_disks(int side) {
  Configuration2 c = square_lattice(side, 0.5, 0, [](std::size_t) { return Ellipse{1, 1}; });
  const double factor = side * (2 + gap) / c.box.lengths().x();
  c.box = PeriodicBox<2>(factor * c.box.lengths());
  for (Vec2& r : c.position) r *= factor;
  return c;
}

/// Spheres of radius 1 on a cubic lattice whose neighbours are `separation` sides of a cell apart: they are
/// `gap` apart.
Configuration3 lattice_of_spheres(int cells, const std::vector<Vec3>& basis, double separation) {
  const Ellipsoid sphere{Vec3::Ones()};
  const double side = (2 + gap) / separation;
  const double volume = sphere.volume() * static_cast<double>(basis.size());
  return cubic_lattice(cells, basis, volume / (side * side * side), sphere);
}

Configuration3 fcc_lattice() {
  return lattice_of_spheres(3, face_centred_cubic, std::sqrt(0.5));
}

/// Everything stretched along the axes; spheres become ellipsoids that still touch.
Configuration3 stretched(Configuration3 c, const Vec3& by) {
  c.box = PeriodicBox<3>(c.box.lengths().cwiseProduct(by));
  for (Vec3& r : c.position) r = r.cwiseProduct(by);
  for (Ellipsoid& shape : c.shape) shape.semi_axes = shape.semi_axes.cwiseProduct(by);
  return c;
}

template <int Dim>
void remove_last(Configuration<Dim>& c) {
  c.resize(c.size() - 1);
}

TEST(Contacts, AreThePairsCloserThanTheTolerance) {
  Configuration2 c;
  c.box = PeriodicBox<2>(Vec2(20, 20));
  c.resize(3);
  c.shape = {{2, 1}, {1, 1}, {1, 1}};
  c.angle = {std::numbers::pi / 2, 0, 0};
  c.position = {{0, 0}, {0, 3.01}, {-2.5, 0}};
  ASSERT_EQ(contacts(c, 0.02).size(), 1u);
  const Contact contact = contacts(c, 0.02).front();
  EXPECT_EQ(contact.i, 0u);
  EXPECT_EQ(contact.j, 1u);
  EXPECT_NEAR(contact.gap, 0.01, 1e-14);
  EXPECT_NEAR(contact.normal.y(), 1, 1e-14);
  EXPECT_EQ(contacts(c, 0.00999).size(), 0u);
  EXPECT_EQ(contacts(c, 0.501).size(), 2u);
}

TEST(Contacts, AParticleTouchesItsOwnImages) {
  Configuration2 c;
  c.box = PeriodicBox<2>(Vec2(2 + gap, 2 + gap));
  c.resize(1);
  EXPECT_EQ(contacts(c, 2 * gap).size(), 2u);
  const Backbone all = backbone(c, 2 * gap);
  EXPECT_EQ(all.rattlers, 0u);
  EXPECT_EQ(all.contact_number, 4);
}

TEST(Backbone, OfLatticesIsTheWholeLattice) {
  const Backbone disks = backbone(triangular_lattice(6, 4, 1), 2 * gap);
  EXPECT_EQ(disks.rattlers, 0u);
  EXPECT_EQ(disks.contacts, 3u * 48);
  EXPECT_EQ(disks.contact_number, 6);
  EXPECT_EQ(disks.isostatic_number, 4);
  const Backbone ellipses = backbone(triangular_lattice(6, 4, 1.7), 2 * gap);
  EXPECT_EQ(ellipses.contact_number, 6);
  EXPECT_EQ(ellipses.isostatic_number, 6);
  EXPECT_EQ(backbone(square_lattice_of_disks(5), 2 * gap).contact_number, 4);
}

TEST(Backbone, OfASmallDiskInACageIsTheCage) {
  Configuration2 c = triangular_lattice(6, 4, 1);
  c.shape[20] = {0.9, 0.9};
  const Backbone cage = backbone(c, 2 * gap);
  EXPECT_EQ(cage.rattlers, 1u);
  EXPECT_EQ(cage.contacts, 3u * 48 - 6);
  EXPECT_DOUBLE_EQ(cage.contact_number, 2.0 * (3 * 48 - 6) / 47);
}

// The six outer disks have three contacts each, all on one side; then the inner one has none. Whichever
// is judged first, all come loose.
TEST(Backbone, OfAHexagonInTheVoidIsNothing) {
  for (const std::size_t inner : {0u, 6u}) {
    Configuration2 c;
    c.box = PeriodicBox<2>(Vec2(30, 30));
    c.resize(7);
    for (std::size_t k = 0; k < 6; ++k) {
      const double angle = static_cast<double>(k) * std::numbers::pi / 3;
      c.position[k + (inner == 0 ? 1 : 0)] = (2 + gap) * Vec2(std::cos(angle), std::sin(angle));
    }
    EXPECT_EQ(contacts(c, 2 * gap).size(), 12u);
    const Backbone none = backbone(c, 2 * gap);
    EXPECT_EQ(none.rattlers, 7u);
    EXPECT_EQ(none.contacts, 0u);
    EXPECT_TRUE(std::isnan(none.contact_number));
  }
}

// The neighbours of a vacancy in the square lattice can step into it: their other contacts leave
// exactly a half-plane. One after the other all come loose.
TEST(Backbone, AVacancyUndoesTheSquareLatticeButNotTheTriangularOne) {
  Configuration2 square = square_lattice_of_disks(5);
  remove_last(square);
  EXPECT_EQ(backbone(square, 2 * gap).rattlers, 24u);
  Configuration2 triangular = triangular_lattice(6, 4, 1);
  remove_last(triangular);
  EXPECT_EQ(backbone(triangular, 2 * gap).rattlers, 0u);
}

TEST(Backbone, OfTheCubicLatticesIsTheWholeLattice) {
  const Backbone spheres = backbone(fcc_lattice(), 2 * gap);
  EXPECT_EQ(spheres.rattlers, 0u);
  EXPECT_EQ(spheres.contact_number, 12);
  EXPECT_EQ(spheres.isostatic_number, 6);
  const Backbone simple = backbone(lattice_of_spheres(3, simple_cubic, 1), 2 * gap);
  EXPECT_EQ(simple.rattlers, 0u);
  EXPECT_EQ(simple.contact_number, 6);
}

TEST(Backbone, OfStretchedLatticesCountsTheRotations) {
  const Backbone spheroids = backbone(stretched(fcc_lattice(), {1.7, 1, 1}), 2 * gap);
  EXPECT_EQ(spheroids.contact_number, 12);
  EXPECT_EQ(spheroids.isostatic_number, 10);
  const Backbone scalene = backbone(stretched(fcc_lattice(), {1.7, 1, 0.8}), 2 * gap);
  EXPECT_EQ(scalene.contact_number, 12);
  EXPECT_EQ(scalene.isostatic_number, 12);
}

// As in the plane.
TEST(Backbone, AVacancyUndoesTheSimpleCubicLatticeButNotTheFaceCentredOne) {
  Configuration3 simple = lattice_of_spheres(3, simple_cubic, 1);
  remove_last(simple);
  EXPECT_EQ(backbone(simple, 2 * gap).rattlers, 26u);
  Configuration3 dense = fcc_lattice();
  remove_last(dense);
  const Backbone held = backbone(dense, 2 * gap);
  EXPECT_EQ(held.rattlers, 0u);
  EXPECT_EQ(held.contacts, 6u * 108 - 12);
}

// Six contacts of each, but all in one plane.
TEST(Backbone, OfALayerInSpaceIsNothing) {
  const Configuration2 layer = triangular_lattice(6, 4, 1);
  Configuration3 c;
  c.box = PeriodicBox<3>(Vec3(layer.box.lengths().x(), layer.box.lengths().y(), 10));
  c.resize(layer.size());
  for (std::size_t i = 0; i < c.size(); ++i)
    c.position[i] = Vec3(layer.position[i].x(), layer.position[i].y(), 0);
  EXPECT_EQ(contacts(c, 2 * gap).size(), 3u * 48);
  EXPECT_EQ(backbone(c, 2 * gap).rattlers, 48u);
}

TEST(JammedBackbone, HasTheToleranceOfItsPressure) {
  EXPECT_NEAR(jammed_backbone(triangular_lattice(6, 4, 1), 1e6).tolerance, 2e-3, 1e-12);
  Configuration2 mixture = triangular_lattice(6, 4, 1);
  mixture.shape[3] = {0.5, 0.5};
  EXPECT_NEAR(jammed_backbone(mixture, 1e6).tolerance, 2e-3 * (47.5 / 48), 1e-12);
}

// Disks on the square lattice at φ = 0.75 are 2 √(π/3) − 2 = 0.047 apart: the tolerance is doubled
// from 0.002 to 0.064. At φ = 0.5 they are 0.5 apart, more than a tenth of their diameter.
TEST(JammedBackbone, WidensTheToleranceUntilHalfOfTheParticlesAreHeld) {
  const auto lattice = [](double phi) {
    return square_lattice(6, phi, 0, [](std::size_t) { return Ellipse{1, 1}; });
  };
  const JammedBackbone wide = jammed_backbone(lattice(0.75), 1e6);
  EXPECT_NEAR(wide.tolerance, 0.064, 1e-12);
  EXPECT_EQ(wide.contact_number, 4);
  const JammedBackbone none = jammed_backbone(lattice(0.5), 1e6);
  EXPECT_EQ(none.rattlers, 36u);
  EXPECT_NEAR(none.tolerance, 0.128, 1e-12);
}

/// A packing grown from a lattice that melts on the way, and its reduced pressure.
template <int Dim>
std::pair<Configuration<Dim>, double> grown(Configuration<Dim> c, double rate, double pressure) {
  GrowthOptions options;
  options.growth_rate = rate;
  options.reduced_pressure = pressure;
  GrowthState state;
  EXPECT_EQ(grow(c, options, state, {}).end, StageEnd::reached);
  EXPECT_TRUE(exact_check(c).clean());
  return {c, state.reduced_pressure};
}

std::pair<Configuration2, double> jammed(const std::function<Ellipse(std::size_t)>& shape_of) {
  return grown(square_lattice(12, 0.4, 0, shape_of), 2e-3, 1e7);
}

// A jammed packing of n disks in a fixed box has 2n − 1 contacts, one more than its 2n − 2 degrees
// of freedom (donev2005pair). Packings of other seeds were within 1.5 % of it, or 3.3 % where the
// tolerance was doubled: 5 %.
TEST(JammedBackbone, OfDisksIsIsostatic) {
  const auto [c, pressure] = jammed([](std::size_t i) {
    const double radius = Stream(1, Purpose::tests, 0, i).below(2) == 1 ? 1 : 1.4;
    return Ellipse{radius, radius};
  });
  const JammedBackbone held = jammed_backbone(c, pressure);
  const double wanted = 2 * static_cast<double>(c.size() - held.rattlers) - 1;
  EXPECT_GT(held.rattlers, 0u);
  EXPECT_LT(held.rattlers, c.size() / 5);
  EXPECT_NEAR(static_cast<double>(held.contacts), wanted, 0.05 * wanted);
  EXPECT_EQ(held.isostatic_number, 4);
}

// Ellipses have a little fewer than six, far more than disks, and hardly any rattlers (donev2007).
TEST(JammedBackbone, OfEllipsesIsALittleHypostatic) {
  const auto [c, pressure] = jammed([](std::size_t) { return of_aspect_ratio(1.4); });
  const JammedBackbone held = jammed_backbone(c, pressure);
  EXPECT_LT(held.rattlers, c.size() / 20);
  EXPECT_LT(held.contact_number, 6);
  EXPECT_GT(held.contact_number, 5.4);
  EXPECT_EQ(held.isostatic_number, 6);
}

// As of disks, with 3n − 2 contacts of n spheres. Packings of three seeds were within 0.5 % of it, or 3.5 %
// where the tolerance was doubled: 5 %. At this size slower growth orders some of them.
TEST(JammedBackbone, OfSpheresIsIsostatic) {
  const auto [c, pressure] = grown(cubic_lattice(6, simple_cubic, 0.3, {Vec3::Ones()}), 3e-3, 1e7);
  const JammedBackbone held = jammed_backbone(c, pressure);
  const double wanted = 3 * static_cast<double>(c.size() - held.rattlers) - 2;
  EXPECT_GT(held.rattlers, 0u);
  EXPECT_LT(held.rattlers, c.size() / 10);
  EXPECT_NEAR(static_cast<double>(held.contacts), wanted, 0.05 * wanted);
  EXPECT_EQ(held.isostatic_number, 6);
}

// Spheroids have fewer than ten, but far more than spheres, and hardly any rattlers (donev2007).
TEST(JammedBackbone, OfSpheroidsIsHypostatic) {
  const auto [c, pressure] =
      grown(cubic_lattice(6, simple_cubic, 0.2, {Vec3(1.5, 1, 1)}), 1e-2, 1e7);
  const JammedBackbone held = jammed_backbone(c, pressure);
  EXPECT_LT(held.rattlers, c.size() / 20);
  EXPECT_LT(held.contact_number, 10);
  EXPECT_GT(held.contact_number, 8);
  EXPECT_EQ(held.isostatic_number, 10);
}

}  // namespace
}  // namespace vitrel
