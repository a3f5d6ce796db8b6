#include "analysis/dynamics/like_particles.h"

#include <algorithm>
#include <span>
#include <utility>

namespace vitrel {

namespace {

constexpr std::size_t enough = 8;  // particles in a class
constexpr int max_halvings = 5;

template <int Dim>
class Classes {
 public:
  explicit Classes(const Configuration<Dim>& configuration) : configuration_(configuration) {
    result_.class_of.resize(configuration.size());
  }

  void add_species(std::span<std::size_t> particles) { divide(particles, 0); }
  LikeParticles result() && { return std::move(result_); }

 private:
  void divide(std::span<std::size_t> particles, int halvings) {
    if (particles.size() <= enough || halvings == max_halvings || have_one_shape(particles)) {
      for (const std::size_t i : particles) result_.class_of[i] = result_.classes;
      ++result_.classes;
      return;
    }
    // Particles that are equal in this are distinguished by their number.
    const auto key = [&](std::size_t i) {
      const ParticleShape<Dim>& shape = configuration_.shape[i];
      return std::pair(halvings % 2 == 0 ? shape.volume() : shape.circumradius(), i);
    };
    const std::size_t half = particles.size() / 2;
    std::ranges::nth_element(particles, particles.begin() + static_cast<std::ptrdiff_t>(half), {},
                             key);
    divide(particles.first(half), halvings + 1);
    divide(particles.subspan(half), halvings + 1);
  }

  bool have_one_shape(std::span<const std::size_t> particles) const {
    const ParticleShape<Dim>& first = configuration_.shape[particles.front()];
    return std::ranges::all_of(particles,
                               [&](std::size_t i) { return configuration_.shape[i] == first; });
  }

  const Configuration<Dim>& configuration_;
  LikeParticles result_;
};

}  // namespace

template <int Dim>
LikeParticles like_particles(const Configuration<Dim>& configuration) {
  std::vector<std::vector<std::size_t>> species(configuration.species_names.size());
  for (std::size_t i = 0; i < configuration.size(); ++i)
    species.at(static_cast<std::size_t>(configuration.species[i])).push_back(i);
  Classes<Dim> classes(configuration);
  for (std::vector<std::size_t>& particles : species)
    if (!particles.empty()) classes.add_species(particles);
  return std::move(classes).result();
}

template LikeParticles like_particles(const Configuration2&);
template LikeParticles like_particles(const Configuration3&);

}  // namespace vitrel
