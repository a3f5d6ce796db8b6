#include "mc/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/contact/perram_wertheim.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "mc/hard_core.h"

namespace vitrel {

namespace {

struct Sites {
  std::size_t columns, rows;

  std::size_t count() const { return columns * rows; }
};

// Columns and rows of cells of the proportion `cell_aspect` (height over width), with room for n
// sites, few of them empty, and filling a box close to the given proportion: one per cent of empty
// sites is worth as much as sides that are wrong by a factor of 1.56.
Sites choose_sites(std::size_t n, double box_aspect, double cell_aspect, bool even_rows) {
  Sites best{1, n};
  double best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t rows = even_rows ? 2 : 1; rows <= 2 * n; rows += even_rows ? 2 : 1) {
    const std::size_t columns = (n + rows - 1) / rows;
    const double sites = static_cast<double>(columns * rows);
    const double proportion =
        box_aspect * static_cast<double>(columns) / (static_cast<double>(rows) * cell_aspect);
    const double empty = sites / static_cast<double>(n) - 1;
    const double distortion = std::log(proportion);
    const double cost = distortion * distortion + 20 * empty;
    if (cost < best_cost) {
      best_cost = cost;
      best = {columns, rows};
    }
  }
  return best;
}

// Gives the box the sides of columns × rows cells of that proportion, at the same area.
void fit_box(Configuration2& configuration, const Sites& sites, double cell_aspect) {
  const double area = configuration.box.volume();
  const double aspect =
      static_cast<double>(sites.rows) * cell_aspect / static_cast<double>(sites.columns);
  const double width = std::sqrt(area / aspect);
  configuration.box = PeriodicBox<2>(Vec2(width, area / width));
}

// Site of particle i; every other row is moved by `stagger` of a cell to either side.
Vec2 site_position(const Configuration2& configuration, const Sites& sites, std::size_t i,
                   double stagger) {
  const std::size_t site = i * sites.count() / configuration.size();
  const std::size_t row = site / sites.columns;
  const double column = static_cast<double>(site % sites.columns) + 0.5;
  const Vec2 share((column + (row % 2 ? stagger : -stagger)) / static_cast<double>(sites.columns),
                   (static_cast<double>(row) + 0.5) / static_cast<double>(sites.rows));
  return (share - Vec2(0.5, 0.5)).cwiseProduct(configuration.box.lengths());
}

Sites place(Configuration2& configuration, double cell_aspect, bool staggered) {
  const Vec2 given = configuration.box.lengths();
  const Sites sites =
      choose_sites(configuration.size(), given.y() / given.x(), cell_aspect, staggered);
  fit_box(configuration, sites, cell_aspect);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] = site_position(configuration, sites, i, staggered ? 0.25 : 0);
    configuration.image[i] = Shift<2>::Zero();
  }
  return sites;
}

double stretched_cell_aspect(const Configuration2& configuration) {
  double a = 0, b = 0;
  for (const Ellipse& shape : configuration.shape) {
    a = std::max(a, shape.a);
    b = std::max(b, shape.b);
  }
  return 0.5 * std::numbers::sqrt3 * b / a;
}

void set_angles(Configuration2& configuration, const LatticeOptions& options, std::uint64_t seed) {
  for (std::size_t i = 0; i < configuration.size(); ++i)
    configuration.angle[i] =
        options.random_angles ? Stream(seed, Purpose::placement, 0, i).uniform(0, std::numbers::pi)
                              : options.angle;
}

void refuse_overlaps(const Configuration2& configuration) {
  const auto overlap = find_overlap(configuration);
  if (!overlap) return;
  const double now = packing_fraction(configuration);
  const double shrink = shrink_to_contact(configuration, 0.5);
  throw UserError("this lattice is too dense: particles " + std::to_string(overlap->first) +
                  " and " + std::to_string(overlap->second) + " overlap at a packing fraction of " +
                  std::to_string(now) + "; it reaches " + std::to_string(now / (shrink * shrink)) +
                  ", for higher densities insert and swell");
}

}  // namespace

StageReport place_on_lattice(Configuration2& configuration, const LatticeOptions& options,
                             std::uint64_t seed) {
  const bool triangular = options.arrangement == Arrangement::triangular;
  if (triangular && (options.angle != 0 || options.random_angles))
    throw UserError("a triangular lattice is stretched along x: angle must be 0, not " +
                    (options.random_angles ? "random" : std::to_string(options.angle)));
  const Sites sites = triangular ? place(configuration, stretched_cell_aspect(configuration), true)
                                 : place(configuration, 1, false);
  set_angles(configuration, options, seed);
  refuse_overlaps(configuration);
  return {StageEnd::reached,
          std::to_string(sites.columns) + " columns × " + std::to_string(sites.rows) + " rows, " +
              std::to_string(sites.count() - configuration.size()) + " sites empty"};
}

double densest_square_lattice(const Ellipse& shape, double angle) {
  // The lattice constant at which no neighbour along (i, j) touches.
  double constant = 0;
  const int far = static_cast<int>(std::ceil(shape.aspect_ratio())) + 1;
  for (int x = 0; x <= far; ++x)
    for (int y = -far; y <= far; ++y) {
      if (x == 0 && y <= 0) continue;
      const Vec2 site(x, y);
      constant =
          std::max(constant, contact_distance(shape, angle, shape, angle, site) / site.norm());
    }
  return shape.volume() / (constant * constant);
}

}  // namespace vitrel
