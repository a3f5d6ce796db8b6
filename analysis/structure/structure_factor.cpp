#include "analysis/structure/structure_factor.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace vitrel {

namespace {

/// Number of nodes of a grid, few enough for the caches and enough for some hundred wave vectors per shell.
constexpr double max_nodes = 1 << 18;

/// The fields of the modes: the density of every species, and the orientations.
struct Fields {
  template <int Dim>
  explicit Fields(const Configuration<Dim>& c)
      : species(std::max<std::size_t>(1, c.species_names.size())), members(species, 0) {
    weights.assign(species, Weights(c.size(), 0.0));
    for (std::size_t i = 0; i < c.size(); ++i) {
      const auto kind = static_cast<std::size_t>(c.species[i]);
      weights[kind][i] = 1;
      members[kind] += 1;
    }
    if constexpr (Dim == 2) add_orientations(c);
  }

  std::size_t species;
  std::vector<double> members;
  std::size_t rotors = 0;
  std::vector<Weights> weights;

 private:
  void add_orientations(const Configuration2& c) {
    rotors = rotor_count(c);
    if (rotors == 0) return;
    weights.resize(species + 2, Weights(c.size(), 0.0));
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (c.shape[i].is_round()) continue;
      weights[species][i] = std::cos(2 * c.angle[i]);
      weights[species + 1][i] = std::sin(2 * c.angle[i]);
    }
  }
};

/// Sums over the wave vectors of every shell.
class ShellSums {
 public:
  ShellSums(const Fields& fields, std::size_t shells) : fields_(fields) {
    sums_.modes.assign(shells, 0);
    sums_.q.assign(shells, 0);
    sums_.total.assign(shells, 0);
    const std::size_t n = fields.species;
    if (n > 1) sums_.partial.assign(n * (n + 1) / 2, std::vector<double>(shells, 0));
    if (fields.rotors > 0) sums_.orientation.assign(shells, 0);
  }

  /// Adds wave vector k of these modes.
  void add(std::size_t shell, double wave_number, const std::vector<Modes>& modes, std::size_t k) {
    sums_.modes[shell] += 1;
    sums_.q[shell] += wave_number;
    std::complex<double> density = 0;
    std::size_t pair = 0;
    for (std::size_t a = 0; a < fields_.species; ++a) {
      density += modes[a][k];
      if (fields_.species == 1) continue;
      for (std::size_t b = a; b < fields_.species; ++b)
        sums_.partial[pair++][shell] += dot(modes[a][k], modes[b][k]);
    }
    sums_.total[shell] += std::norm(density);
    if (fields_.rotors > 0)
      sums_.orientation[shell] +=
          std::norm(modes[fields_.species][k]) + std::norm(modes[fields_.species + 1][k]);
  }

  StructureFactor averages(std::size_t particles) && {
    divide(sums_.q, 1);
    divide(sums_.total, static_cast<double>(particles));
    divide(sums_.orientation, static_cast<double>(fields_.rotors));
    std::size_t pair = 0;
    for (std::size_t a = 0; a < fields_.species && !sums_.partial.empty(); ++a)
      for (std::size_t b = a; b < fields_.species; ++b)
        divide(sums_.partial[pair++], std::sqrt(fields_.members[a] * fields_.members[b]));
    return std::move(sums_);
  }

 private:
  static double dot(const std::complex<double>& u, const std::complex<double>& v) {
    return u.real() * v.real() + u.imag() * v.imag();
  }

  void divide(std::vector<double>& sums, double norm) const {
    for (std::size_t shell = 0; shell < sums.size(); ++shell)
      sums[shell] /= norm * sums_.modes[shell];
  }

  const Fields& fields_;
  StructureFactor sums_;
};

}  // namespace

template <int Dim>
ScatteringShells<Dim>::ScatteringShells(const Vec<Dim>& lengths, const ShellOptions& options)
    : step_(options.wave_number_step) {
  // A quotient that rounding leaves just above a whole number makes no further shell.
  shells_ = static_cast<std::size_t>(std::ceil(options.wave_number_max / step_ * (1 - 1e-12)));
  const auto end_of = [&](std::size_t shell) {
    return std::min(static_cast<double>(shell + 1) * step_, options.wave_number_max);
  };
  Vec<Dim> folded = lengths;
  for (std::size_t first = 0; first < shells_;) {
    while (DensityGrid<Dim>::nodes(folded, end_of(first)) > max_nodes) {
      const double longest = folded.maxCoeff();
      for (int k = 0; k < Dim; ++k)
        if (folded[k] > 0.5 * longest) folded[k] *= 0.5;
    }
    std::size_t end = first + 1;
    while (end < shells_ && DensityGrid<Dim>::nodes(folded, end_of(end)) <= max_nodes) ++end;
    const double from = static_cast<double>(first) * step_;
    levels_.push_back({folded, DensityGrid<Dim>(folded, from, end_of(end - 1)), first, end});
    first = end;
  }
}

template <int Dim>
StructureFactor ScatteringShells<Dim>::averaged(const Configuration<Dim>& configuration,
                                                bool direct) const {
  const Fields fields(configuration);
  ShellSums sums(fields, shells_);
  for (const Level& level : levels_) {
    const std::vector<WaveVector<Dim>>& waves = level.grid.wave_vectors();
    const std::vector<Modes> modes =
        direct ? direct_modes(level.lengths, waves, configuration.position, fields.weights)
               : level.grid.modes(configuration.position, fields.weights);
    for (std::size_t k = 0; k < waves.size(); ++k) {
      const auto shell = static_cast<std::size_t>(waves[k].wave_number / step_);
      // Rounding can put an end of the range into the next shell.
      sums.add(std::clamp(shell, level.first_shell, level.end_shell - 1), waves[k].wave_number,
               modes, k);
    }
  }
  return std::move(sums).averages(configuration.size());
}

template <int Dim>
StructureFactor ScatteringShells<Dim>::structure_factor(
    const Configuration<Dim>& configuration) const {
  return averaged(configuration, configuration.size() <= max_summed_directly);
}

template <int Dim>
StructureFactor ScatteringShells<Dim>::transformed_structure_factor(
    const Configuration<Dim>& configuration) const {
  return averaged(configuration, false);
}

template <int Dim>
StructureFactor ScatteringShells<Dim>::direct_structure_factor(
    const Configuration<Dim>& configuration) const {
  return averaged(configuration, true);
}

template class ScatteringShells<2>;
template class ScatteringShells<3>;

std::vector<std::string> pair_names(const std::vector<std::string>& species_names) {
  std::vector<std::string> names;
  for (std::size_t a = 0; a < species_names.size(); ++a)
    for (std::size_t b = a; b < species_names.size(); ++b)
      names.push_back(species_names[a] + '_' + species_names[b]);
  return names;
}

}  // namespace vitrel
