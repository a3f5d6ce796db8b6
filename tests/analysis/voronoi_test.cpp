#include "analysis/structure/voronoi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/random/stream.h"

namespace vitrel {
namespace {

/// n points at random places.
Configuration2 gas(std::size_t n, const Vec2& lengths, std::uint64_t seed) {
  Configuration2 c;
  c.resize(n);
  c.box = PeriodicBox<2>(lengths);
  Stream draw(seed, Purpose::tests);
  for (Vec2& r : c.position)
    r = {lengths.x() * draw.uniform(-0.5, 0.5), lengths.y() * draw.uniform(-0.5, 0.5)};
  return c;
}

std::vector<VoronoiCell> cells_of(const Configuration2& c) {
  const Voronoi voronoi(c);
  std::vector<VoronoiCell> cells;
  for (std::size_t i = 0; i < c.size(); ++i) cells.push_back(voronoi.cell(i));
  return cells;
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
      if (std::all_of(others.begin(), others.end(),
                      [&](const Vec2& w) { return (w - centre).squaredNorm() >= radius; }))
        corners.push_back(centre);
    }
  std::sort(corners.begin(), corners.end(), [](const Vec2& p, const Vec2& q) {
    return std::atan2(p.y(), p.x()) < std::atan2(q.y(), q.x());
  });
  double area = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    area += 0.5 * cross(corners[k], corners[(k + 1) % corners.size()]);
  return area;
}

class Boxes : public testing::TestWithParam<std::pair<std::size_t, Vec2>> {};

// Euler: cells on a torus have six edges on the average, exactly, if no four meet in a point.
TEST_P(Boxes, CellsFillTheBoxWithSixNeighboursOnTheAverage) {
  const auto& [n, lengths] = GetParam();
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    double area = 0;
    std::size_t edges = 0;
    for (const VoronoiCell& cell : cells_of(gas(n, lengths, seed))) {
      area += cell.area;
      edges += cell.edges.size();
      // The cell closes: Σ length × normal = 0.
      Vec2 around = Vec2::Zero();
      for (const VoronoiEdge& edge : cell.edges) around += edge.length * edge.to.normalized();
      EXPECT_LT(around.norm(), 1e-12 * lengths.maxCoeff());
    }
    EXPECT_NEAR(area, lengths.prod(), 1e-12 * lengths.prod());
    EXPECT_EQ(edges, 6 * n);
  }
}

// An edge is the same seen from either side.
TEST_P(Boxes, NeighboursShareTheirEdge) {
  const auto& [n, lengths] = GetParam();
  const Configuration2 c = gas(n, lengths, 77);
  std::map<std::pair<long, long>, std::vector<double>> edges;  // by |d|, up to its sign
  for (const VoronoiCell& cell : cells_of(c))
    for (const VoronoiEdge& edge : cell.edges) {
      const Vec2 d =
          edge.to.x() < 0 || (edge.to.x() == 0 && edge.to.y() < 0) ? Vec2(-edge.to) : edge.to;
      edges[{std::lround(1e8 * d.x()), std::lround(1e8 * d.y())}].push_back(edge.length);
    }
  for (const auto& [d, lengths_seen] : edges) {
    ASSERT_EQ(lengths_seen.size() % 2, 0u);
    std::vector<double> sorted = lengths_seen;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 0; k < sorted.size(); k += 2)
      EXPECT_NEAR(sorted[k], sorted[k + 1], 1e-11 * c.box.lengths().maxCoeff());
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Boxes,
                         testing::Values(std::pair<std::size_t, Vec2>{2, {1, 1.3}},
                                         std::pair<std::size_t, Vec2>{3, {1, 1}},
                                         std::pair<std::size_t, Vec2>{8, {1, 4}},
                                         std::pair<std::size_t, Vec2>{40, {10, 1}},
                                         std::pair<std::size_t, Vec2>{5, {1, 1000}},
                                         std::pair<std::size_t, Vec2>{500, {20, 20}}));

TEST(Voronoi, AgreesWithTheSlowConstruction) {
  for (const Vec2& lengths : {Vec2(1, 1), Vec2(1, 4), Vec2(2, 1.3), Vec2(12, 1)})
    for (const std::size_t n : {2u, 3u, 8u}) {
      const Configuration2 c = gas(n, lengths, 5);
      const std::vector<VoronoiCell> cells = cells_of(c);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(cells[i].area, slow_area(c, i), 1e-10 * lengths.prod());
    }
}

// A lone particle has the whole box.
TEST(Voronoi, ALoneParticleIsItsOwnNeighbour) {
  Configuration2 c;
  c.resize(1);
  c.box = PeriodicBox<2>(Vec2(2, 3));
  const VoronoiCell cell = Voronoi(c).cell(0);
  EXPECT_DOUBLE_EQ(cell.area, 6);
  EXPECT_EQ(cell.edges.size(), 4u);
}

// All cells of a dense cluster reach far into the void beside it.
TEST(Voronoi, AClusterInAVoidFillsTheBox) {
  Configuration2 c = gas(50, Vec2(1, 1), 3);
  c.box = PeriodicBox<2>(Vec2(100, 100));
  double area = 0;
  for (const VoronoiCell& cell : cells_of(c)) area += cell.area;
  EXPECT_NEAR(area, 1e4, 1e-8);
}

// In a box that is long and narrow, the reach of a cell holds many images, few of which matter.
TEST(Voronoi, OfALongAndNarrowBox) {
  for (const Vec2& lengths : {Vec2(1e12, 1), Vec2(1, 1e12)}) {
    double area = 0;
    for (const VoronoiCell& cell : cells_of(gas(12, lengths, 4))) area += cell.area;
    EXPECT_NEAR(area, lengths.prod(), 1e-9 * lengths.prod());
  }
}

// Poisson points: the mean perimeter is 4/√ρ (Meijering 1953). The standard error is taken from
// twenty systems; 5 of them in a normal distribution: a false alarm in 10⁶.
TEST(Voronoi, TheMeanPerimeterOfRandomPoints) {
  std::vector<double> perimeters;
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    double sum = 0;
    for (const VoronoiCell& cell : cells_of(gas(1000, Vec2(20, 50), seed)))
      for (const VoronoiEdge& edge : cell.edges) sum += edge.length;
    perimeters.push_back(sum / 1000);
  }
  double mean = 0, square = 0;
  for (const double p : perimeters) mean += p / 20;
  for (const double p : perimeters) square += (p - mean) * (p - mean) / (19.0 * 20);
  EXPECT_LT(std::sqrt(square), 0.01);
  EXPECT_NEAR(mean, 4, 5 * std::sqrt(square));
}

}  // namespace
}  // namespace vitrel
