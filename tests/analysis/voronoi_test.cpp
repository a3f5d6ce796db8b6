#include "analysis/structure/voronoi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/support/particles_of.h"
#include "tests/support/random_gas.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

std::vector<VoronoiCell> cells_of(const Configuration2& c) {
  const Voronoi voronoi(c);
  std::vector<VoronoiCell> cells;
  for (std::size_t i = 0; i < c.size(); ++i) cells.push_back(voronoi.cell(i));
  return cells;
}

double total_area(const Configuration2& c) {
  double area = 0;
  for (const VoronoiCell& cell : cells_of(c)) area += cell.area;
  return area;
}

// By all corners: the circumcentre of the point and two others is a corner of its cell if no point
// lies nearer. Area from the fan of corners in the order of their angles.
double slow_area(const Configuration2& c, std::size_t i) {
  std::vector<Vec2> others;
  for (std::size_t j = 0; j < c.size(); ++j)
    c.box.for_each_image(c.position[j] - c.position[i], 3 * c.box.lengths().maxCoeff(),
                         [&](const Shift<2>&, const Vec2& d) {
                           if (d.squaredNorm() > 0) others.push_back(d);
                         });
  std::vector<Vec2> corners;
  for (std::size_t p = 0; p < others.size(); ++p)
    for (std::size_t q = p + 1; q < others.size(); ++q) {
      const Vec2 &u = others[p], &v = others[q];
      if (std::abs(cross(u, v)) < 1e-12) continue;
      const Vec2 centre =
          (u.squaredNorm() * perpendicular(-v) + v.squaredNorm() * perpendicular(u)) /
          (2 * cross(u, v));
      const double radius = centre.squaredNorm() * (1 - 1e-12);
      const auto is_outside = [&](const Vec2& w) { return (w - centre).squaredNorm() >= radius; };
      if (std::ranges::all_of(others, is_outside)) corners.push_back(centre);
    }
  std::ranges::sort(corners, {}, [](const Vec2& p) { return std::atan2(p.y(), p.x()); });
  double area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    area += 0.5 * cross(corners[k], corners[(k + 1) % corners.size()]);
  return area;
}

struct Gas {
  std::size_t n;
  Vec2 lengths;
};
const Gas gases[] = {{2, {1, 1.3}}, {3, {1, 1}},    {8, {1, 4}},
                     {40, {10, 1}}, {5, {1, 1000}}, {500, {20, 20}}};

// Euler: cells on a torus have six edges on the average, exactly, if no four meet in a point.
TEST(Voronoi, CellsFillTheBoxWithSixNeighboursOnTheAverage) {
  for (const auto& [n, lengths] : gases)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const Configuration2 c = random_gas(n, lengths, seed);
      std::size_t edges = 0;
      for (const VoronoiCell& cell : cells_of(c)) {
        edges += cell.edges.size();
        // The cell closes: Σ length × normal = 0.
        Vec2 around = Vec2::Zero();
        for (const VoronoiEdge& edge : cell.edges) around += edge.length * edge.to.normalized();
        EXPECT_LT(around.norm(), 1e-12 * lengths.maxCoeff());
      }
      EXPECT_NEAR(total_area(c), lengths.prod(), 1e-12 * lengths.prod());
      EXPECT_EQ(edges, 6 * n);
    }
}

// An edge is the same seen from either side.
TEST(Voronoi, NeighboursShareTheirEdge) {
  for (const auto& [n, lengths] : gases) {
    const Configuration2 c = random_gas(n, lengths, 77);
    std::map<std::pair<long, long>, std::vector<double>> edges;  // by |d|, up to its sign
    for (const VoronoiCell& cell : cells_of(c))
      for (const VoronoiEdge& edge : cell.edges) {
        const Vec2 d =
            edge.to.x() < 0 || (edge.to.x() == 0 && edge.to.y() < 0) ? Vec2(-edge.to) : edge.to;
        edges[{std::lround(1e8 * d.x()), std::lround(1e8 * d.y())}].push_back(edge.length);
      }
    for (auto& [d, seen] : edges) {
      ASSERT_EQ(seen.size() % 2, 0u);
      std::ranges::sort(seen);
      for (std::size_t k = 0; k < seen.size(); k += 2)
        EXPECT_NEAR(seen[k], seen[k + 1], 1e-11 * c.box.lengths().maxCoeff());
    }
  }
}

TEST(Voronoi, AgreesWithTheSlowConstruction) {
  for (const Vec2& lengths : {Vec2(1, 1), Vec2(1, 4), Vec2(2, 1.3), Vec2(12, 1)})
    for (const std::size_t n : {2u, 3u, 8u}) {
      const Configuration2 c = random_gas(n, lengths, 5);
      const std::vector<VoronoiCell> cells = cells_of(c);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(cells[i].area, slow_area(c, i), 1e-10 * lengths.prod());
    }
}

// A lone particle has the whole box.
TEST(Voronoi, ALoneParticleIsItsOwnNeighbour) {
  const VoronoiCell cell = Voronoi(particles_of<2>({{1, 1}}, {2, 3})).cell(0);
  EXPECT_DOUBLE_EQ(cell.area, 6);
  EXPECT_EQ(cell.edges.size(), 4u);
}

// All cells of a dense cluster reach far into the void beside it.
TEST(Voronoi, AClusterInAVoidFillsTheBox) {
  Configuration2 c = random_gas(50, Vec2(1, 1), 3);
  c.box = PeriodicBox<2>(Vec2(100, 100));
  EXPECT_NEAR(total_area(c), 1e4, 1e-8);
}

// In a box that is long and narrow, the reach of a cell holds many images, few of which matter.
TEST(Voronoi, OfALongAndNarrowBox) {
  for (const Vec2& lengths : {Vec2(1e12, 1), Vec2(1, 1e12)})
    EXPECT_NEAR(total_area(random_gas(12, lengths, 4)), lengths.prod(), 1e-9 * lengths.prod());
}

// Poisson points: the mean perimeter is 4/√ρ (Meijering 1953). The standard error is taken from
// twenty systems; 5 of them in a normal distribution: a false alarm in 10⁶.
TEST(Voronoi, TheMeanPerimeterOfRandomPoints) {
  std::vector<double> perimeters;
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    double sum = 0;
    for (const VoronoiCell& cell : cells_of(random_gas(1000, Vec2(20, 50), seed)))
      for (const VoronoiEdge& edge : cell.edges) sum += edge.length;
    perimeters.push_back(sum / 1000);
  }
  const Estimate mean = estimate(perimeters);
  EXPECT_LT(mean.error, 0.01);
  EXPECT_NEAR(mean.mean, 4, 5 * mean.error);
}

}  // namespace
}  // namespace vitrel
