#include "mc/lattice.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <numbers>
#include <string>

#include "core/elementary.h"
#include "core/error.h"
#include "core/random/stream.h"
#include "mc/hard_core.h"

namespace vitrel {

namespace {

/// A lattice as columns × rows (× layers) of sites. The parity of a site is that of its numbers along the directions
/// that alternate, added up. An odd site moves by `stagger`, and an even one by −`stagger`.
template <int Dim>
struct Lattice {
  Vec<Dim> spacing;  ///< proportions of the distances between columns, rows and layers
  Vec<Dim> stagger;  ///< in units of the spacing
  std::array<bool, Dim> alternates;  ///< directions that alternate; their site counts are even
};

template <int Dim>
using Counts = std::array<std::size_t, Dim>;

template <int Dim>
std::size_t product(const Counts<Dim>& counts) {
  std::size_t all = 1;
  for (const std::size_t count : counts) all *= count;
  return all;
}

/// Returns Σ ln² of the changes in the ratio of two sides, over all pairs of directions.
template <int Dim>
double distortion(const Vec<Dim>& box, const Vec<Dim>& spacing, const Counts<Dim>& counts) {
  Vec<Dim> change = Vec<Dim>::Zero();
  for (int k = 1; k < Dim; ++k)
    change[k] = logarithm(box[k] / box[0] * static_cast<double>(counts[0]) /
                          (static_cast<double>(counts[k]) * (spacing[k] / spacing[0])));
  double sum = 0;
  for (int k = 0; k < Dim; ++k)
    for (int l = 0; l < k; ++l) sum += (change[k] - change[l]) * (change[k] - change[l]);
  return sum;
}

/// Chooses numbers of columns, rows and layers with room for n sites, few of them empty, that fill a box close to the
/// given one. One per cent of empty sites costs as much as two sides whose ratio is wrong by a factor of 1.56.
template <int Dim>
class SiteCounts {
 public:
  SiteCounts(std::size_t n, const Vec<Dim>& box, const Lattice<Dim>& lattice)
      : n_(n), box_(box), lattice_(lattice) {
    choose(1, 1);
  }
  const Counts<Dim>& best() const { return best_; }

 private:
  /// Tries all counts in directions k and later; `others` is the product of the counts of rows (and layers) before
  /// those.
  void choose(std::size_t k, std::size_t others) {
    if (k == Dim) return consider(others);
    const std::size_t step = lattice_.alternates[k] ? 2 : 1;
    for (counts_[k] = step; counts_[k] * others <= 2 * n_ || counts_[k] == step; counts_[k] += step)
      choose(k + 1, others * counts_[k]);
  }

  void consider(std::size_t others) {
    counts_[0] = (n_ + others - 1) / others;
    const double empty = static_cast<double>(product<Dim>(counts_)) / static_cast<double>(n_) - 1;
    const double cost = distortion<Dim>(box_, lattice_.spacing, counts_) + 20 * empty;
    if (cost >= lowest_cost_) return;
    lowest_cost_ = cost;
    best_ = counts_;
  }

  std::size_t n_;
  const Vec<Dim>& box_;
  const Lattice<Dim>& lattice_;
  Counts<Dim> counts_{}, best_{};
  double lowest_cost_ = std::numeric_limits<double>::infinity();
};

/// Gives the box the sides of this number of cells, at the same volume.
template <int Dim>
void fit_box(PeriodicBox<Dim>& box, const Counts<Dim>& counts, const Vec<Dim>& spacing) {
  const double volume = box.volume();
  Vec<Dim> aspect = Vec<Dim>::Ones();
  for (int k = 1; k < Dim; ++k)
    aspect[k] =
        static_cast<double>(counts[k]) * (spacing[k] / spacing[0]) / static_cast<double>(counts[0]);
  const double cube = volume / prod(aspect);
  Vec<Dim> lengths = root(cube, Dim) * aspect;
  lengths[Dim - 1] = volume / prod(lengths.template head<Dim - 1>());
  box = PeriodicBox<Dim>(lengths);
}

/// Returns the place of a site, in units of the sides of the box.
template <int Dim>
Vec<Dim> relative_position(std::size_t site, const Counts<Dim>& counts,
                           const Lattice<Dim>& lattice) {
  Vec<Dim> place;
  std::size_t parity = 0;
  for (std::size_t k = 0; k < Dim; ++k) {
    const std::size_t index = site % counts[k];
    site /= counts[k];
    place[k] = static_cast<double>(index) + 0.5;
    if (lattice.alternates[k]) parity += index;
  }
  place += parity % 2 ? lattice.stagger : Vec<Dim>(-lattice.stagger);
  for (std::size_t k = 0; k < Dim; ++k) place[k] = place[k] / static_cast<double>(counts[k]) - 0.5;
  return place;
}

/// Places all particles. Returns the number of columns, rows and layers.
template <int Dim>
Counts<Dim> place(Configuration<Dim>& configuration, const Lattice<Dim>& lattice) {
  const std::size_t n = configuration.size();
  const Counts<Dim> counts = SiteCounts<Dim>(n, configuration.box.lengths(), lattice).best();
  fit_box<Dim>(configuration.box, counts, lattice.spacing);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<Dim> share = relative_position<Dim>(i * product<Dim>(counts) / n, counts, lattice);
    configuration.position[i] = share.cwiseProduct(configuration.box.lengths());
    configuration.image[i] = Shift<Dim>::Zero();
  }
  return counts;
}

/// Returns the longest semi-axis of any particle along each direction.
template <int Dim>
Vec<Dim> largest_half_lengths(const Configuration<Dim>& configuration) {
  Vec<Dim> largest = Vec<Dim>::Zero();
  for (const ParticleShape<Dim>& shape : configuration.shape)
    largest = largest.cwiseMax(shape.half_lengths());
  return largest;
}

Lattice<2> lattice_of(Arrangement arrangement, const Configuration2& configuration) {
  if (arrangement == Arrangement::square) return {{1, 1}, {0, 0}, {false, false}};
  const Vec2 axes = largest_half_lengths(configuration);
  return {{1, 0.5 * std::numbers::sqrt3 * axes.y() / axes.x()}, {0.25, 0}, {false, true}};
}

Lattice<3> lattice_of(Arrangement arrangement, const Configuration3& configuration) {
  const Vec3 axes = largest_half_lengths(configuration);
  const auto stretched = [&](const Vec3& spacing) -> Vec3 { return spacing.cwiseProduct(axes); };
  switch (arrangement) {
    case Arrangement::face_centred:
      return {stretched({1, 0.5, 0.5}), {0.25, 0, 0}, {false, true, true}};
    case Arrangement::body_centred:
      return {stretched({1, 1, 0.5}), {0.25, 0.25, 0}, {false, false, true}};
    default:
      return {stretched({1, 1, 1}), {0, 0, 0}, {false, false, false}};
  }
}

void orient(Configuration2& configuration, const LatticeOptions& options, std::uint64_t seed) {
  for (std::size_t i = 0; i < configuration.size(); ++i)
    configuration.angle[i] =
        options.random_angles ? Stream(seed, Purpose::placement, 0, i).uniform(0, std::numbers::pi)
                              : options.angle;
}

void orient(Configuration3& configuration, const LatticeOptions&, std::uint64_t) {
  std::ranges::fill(configuration.orientation, Quaternion::Identity());
}

template <int Dim>
void refuse_overlaps(const Configuration<Dim>& configuration) {
  const auto overlap = find_overlap(configuration);
  if (!overlap) return;
  const double now = packing_fraction(configuration);
  const double shrink = shrink_to_contact(configuration, 0.5);
  throw UserError("this lattice is too dense: particles " + std::to_string(overlap->first) +
                  " and " + std::to_string(overlap->second) + " overlap at a packing fraction of " +
                  std::to_string(now) + "; it reaches " + std::to_string(now / power(shrink, Dim)) +
                  ", for higher densities insert and swell");
}

template <int Dim>
std::string sites_text(const Counts<Dim>& counts, std::size_t particles) {
  std::string text =
      std::to_string(counts[0]) + " columns × " + std::to_string(counts[1]) + " rows";
  if constexpr (Dim == 3) text += " × " + std::to_string(counts[2]) + " layers";
  return text + ", " + std::to_string(product<Dim>(counts) - particles) + " sites empty";
}

}  // namespace

template <int Dim>
StageReport place_on_lattice(Configuration<Dim>& configuration, const LatticeOptions& options,
                             std::uint64_t seed) {
  assert(has_dimension(options.arrangement, Dim));
  if (options.arrangement != Arrangement::square && (options.angle != 0 || options.random_angles))
    throw UserError("a stretched lattice needs particles along its axes: angle must be 0, not " +
                    (options.random_angles ? "random" : std::to_string(options.angle)));
  const Counts<Dim> counts = place(configuration, lattice_of(options.arrangement, configuration));
  orient(configuration, options, seed);
  refuse_overlaps(configuration);
  return {StageEnd::reached, sites_text<Dim>(counts, configuration.size())};
}

template StageReport place_on_lattice(Configuration2&, const LatticeOptions&, std::uint64_t);
template StageReport place_on_lattice(Configuration3&, const LatticeOptions&, std::uint64_t);

}  // namespace vitrel
