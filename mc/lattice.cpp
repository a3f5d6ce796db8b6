#include "mc/lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/contact/perram_wertheim.h"
#include "core/error.h"
#include "mc/disjoint.h"

namespace vitrel {

namespace {

struct Sites {
  std::size_t columns, rows;
};

// Columns and rows with room for n sites, few of them empty, and cells as close as possible to the
// proportion `cell_aspect` (height over width) in a box of the given proportion.
Sites choose_sites(std::size_t n, double box_aspect, double cell_aspect, bool even_rows) {
  Sites best{1, n};
  double best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t rows = even_rows ? 2 : 1; rows <= 2 * n; rows += even_rows ? 2 : 1) {
    const std::size_t columns = (n + rows - 1) / rows;
    const double sites = static_cast<double>(columns * rows);
    const double proportion =
        box_aspect * static_cast<double>(columns) / (static_cast<double>(rows) * cell_aspect);
    const double empty = sites / static_cast<double>(n) - 1;
    const double cost = std::abs(std::log(proportion)) + 40 * empty;
    if (cost < best_cost) {
      best_cost = cost;
      best = {columns, rows};
    }
  }
  return best;
}

void put(Configuration2& configuration, std::size_t i, const Vec2& position, double angle) {
  configuration.position[i] = position;
  configuration.image[i] = Shift<2>::Zero();
  configuration.box.wrap(configuration.position[i], configuration.image[i]);
  configuration.image[i] = Shift<2>::Zero();
  configuration.angle[i] = angle;
}

void place_square(Configuration2& configuration, double angle) {
  const Vec2 lengths = configuration.box.lengths();
  const Sites sites = choose_sites(configuration.size(), lengths.y() / lengths.x(), 1.0, false);
  const Vec2 cell(lengths.x() / static_cast<double>(sites.columns),
                  lengths.y() / static_cast<double>(sites.rows));
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec2 site(static_cast<double>(i % sites.columns) + 0.5,
                    static_cast<double>(i / sites.columns) + 0.5);
    put(configuration, i, site.cwiseProduct(cell) - 0.5 * lengths, angle);
  }
}

void place_triangular(Configuration2& configuration) {
  double a = 0, b = 0;
  for (const Ellipse& shape : configuration.shape) {
    a = std::max(a, shape.a);
    b = std::max(b, shape.b);
  }
  const double cell_aspect = 0.5 * std::numbers::sqrt3 * b / a;
  const Vec2 given = configuration.box.lengths();
  const Sites sites = choose_sites(configuration.size(), given.y() / given.x(), cell_aspect, true);
  const double columns = static_cast<double>(sites.columns);
  const double rows = static_cast<double>(sites.rows);
  // Same area, sides in the proportion of the lattice.
  const double aspect = rows * cell_aspect / columns;
  const double width = std::sqrt(configuration.box.volume() / aspect);
  configuration.box = PeriodicBox<2>(Vec2(width, configuration.box.volume() / width));
  const Vec2 lengths = configuration.box.lengths();
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const std::size_t row = i / sites.columns;
    const Vec2 site(static_cast<double>(i % sites.columns) + (row % 2 ? 0.75 : 0.25),
                    static_cast<double>(row) + 0.5);
    put(configuration, i,
        site.cwiseQuotient(Vec2(columns, rows)).cwiseProduct(lengths) - 0.5 * lengths, 0);
  }
}

}  // namespace

void place_on_lattice(Configuration2& configuration, const LatticeOptions& options) {
  if (options.arrangement == Arrangement::square) {
    place_square(configuration, options.angle);
  } else {
    if (options.angle != 0)
      throw UserError("a triangular lattice is stretched along x: angle must be 0, not " +
                      std::to_string(options.angle));
    place_triangular(configuration);
  }
  const auto overlap = find_overlap(configuration);
  if (!overlap) return;
  const double now = packing_fraction(configuration);
  const double shrink = shrink_to_contact(configuration, 0.5);
  throw UserError("this lattice is too dense: particles " + std::to_string(overlap->first) +
                  " and " + std::to_string(overlap->second) + " overlap at a packing fraction of " +
                  std::to_string(now) + "; it reaches " + std::to_string(now / (shrink * shrink)) +
                  ", beyond that insert and swell");
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
