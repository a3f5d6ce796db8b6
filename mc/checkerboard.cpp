#include "mc/checkerboard.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace vitrel {

namespace {

/// With wider domains fewer moves end at a border. With narrower ones a small system has more parallelism, and a domain
/// fits into the first-level cache.
constexpr std::size_t min_cells_per_domain = 4;

/// Widens cells so that rounding of positions does not matter.
constexpr double rounding_margin = 1 + 1e-9;

template <int Dim>
std::size_t count_cells(double length, double reach, std::size_t particles) {
  // Many more cells than particles would be useless.
  const double max_cells = std::ceil(root(4 * static_cast<double>(particles), Dim)) + 1;
  return static_cast<std::size_t>(std::clamp(std::floor(length / reach), 1.0, max_cells));
}

std::size_t count_domains(std::size_t cells) {
  const std::size_t pairs = cells / (2 * min_cells_per_domain);
  return pairs > 0 ? 2 * pairs : 1;
}

}  // namespace

template <int Dim>
Checkerboard<Dim>::Line::Line(double length, double reach, std::size_t particles)
    : half_(0.5 * length),
      domain_of_(count_cells<Dim>(length, rounding_margin * reach, particles)) {
  const int count = static_cast<int>(cells());
  cells_per_length_ = count / length;
  last_ = count - 1;
  domains_ = count_domains(cells());
  const int layers = static_cast<int>(std::ceil(rounding_margin * reach * cells_per_length_));
  images_ = 2 * static_cast<std::size_t>(layers) + 1;
  const auto add = [&](int cell, int away) {
    const int unwrapped = cell + away;
    const int boxes = static_cast<int>(std::floor(static_cast<double>(unwrapped) / count));
    near_.push_back({unwrapped - boxes * count, boxes * length, away * width()});
  };
  for (int cell = 0; cell < count; ++cell) {
    add(cell, 0);
    for (int away = 1; away <= layers; ++away) add(cell, away), add(cell, -away);
  }
  set_origin(0);
}

template <int Dim>
void Checkerboard<Dim>::Line::set_origin(std::size_t first) {
  origin_ = first;
  for (std::size_t domain = 0; domain < domains_; ++domain)
    for (std::size_t cell = begin(domain); cell < begin(domain + 1); ++cell)
      domain_of_[static_cast<std::size_t>(shifted(cell))] = domain;
}

template <int Dim>
Checkerboard<Dim>::Checkerboard(const PeriodicBox<Dim>& box, double reach, std::size_t particles)
    : lines_(make_lines(box, reach, particles)) {
  const auto parities = [](const Line& line) { return line.domains() > 1 ? 2u : 1u; };
  colours_.resize(product(parities));
  for (std::size_t domain = 0; domain < domains(); ++domain) {
    // The colour is the parity along each direction.
    std::size_t colour = 0, unit = 1, rest = domain;
    for (int k = Dim; k-- > 0; rest /= lines_[k].domains(), unit *= parities(lines_[k]))
      colour += rest % lines_[k].domains() % parities(lines_[k]) * unit;
    colours_[colour].push_back(domain);
  }
}

template <int Dim>
void Checkerboard<Dim>::shift(Stream& draw) {
  for (Line& line : lines_) line.set_origin(draw.below(line.cells()));
}

template class Checkerboard<2>;
template class Checkerboard<3>;

}  // namespace vitrel
