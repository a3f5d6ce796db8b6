// Rough spheres: equipartition if they are elastic, and the ratio of temperatures of a cooling gas.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "tests/support/runs.h"

namespace vitrel {
namespace {

Configuration3 spheres(int cells, double packing_fraction) {
  return cubic_lattice(cells, simple_cubic, packing_fraction, Ellipsoid{Vec3::Ones()});
}

struct Temperatures {
  double translation = 0, rotation = 0;
  int samples = 0;

  double ratio() const { return rotation / translation; }
};

/// The temperatures of three translations of N − 1 particles, whose momentum is 0, and of three rotations of N.
class Thermometer : public Observer<3> {
 public:
  void observe(const Frame<3>& frame) override {
    const Mechanics<3> sums = mechanics(frame.configuration);
    const auto n = static_cast<double>(frame.configuration.size());
    // Relative to the present energy, so that no sample of a cooling gas counts more than others.
    const double energy = sums.translational_energy + sums.rotational_energy;
    of.translation += sums.translational_energy / (1.5 * (n - 1)) / energy;
    of.rotation += sums.rotational_energy / (1.5 * n) / energy;
    ++of.samples;
  }

  Temperatures of;
};

/// Starts with this share of the energy in translation, and samples after the relaxation.
Temperatures run_and_measure(Configuration3 start, const ContactLaw& law, double translation,
                             double relaxation, double duration, int samples) {
  const DynamicsOptions options = with_laws(law);
  set_initial_velocities(start, 7, InitialVelocities::split, Temperature::relative, {translation},
                         contacts(options.engine));
  RunState3 state = begin_run(start, 0);
  Thermometer thermometer;
  std::vector<double> times;
  for (int k = 0; k < samples; ++k)
    times.push_back(relaxation * std::pow(1 + duration / relaxation, (k + 1.) / samples));
  run(state, options, {times, relaxation + duration, &thermometer, {}}, {});
  return thermometer.of;
}

TEST(RoughSpheres, ShareTheirEnergyEvenlyIfElastic) {
  const int cells = 8, samples = 200;
  const double n = cells * cells * cells;
  const Temperatures found =
      run_and_measure(spheres(cells, 0.1), {1, ContactLaw::no_slip, 1}, 0.9, 40, 400, samples);
  // The ratio of a sample fluctuates by √(2/f) of each of the two numbers of degrees of freedom f = 3 N. Rotations relax
  // within a few collisions, of which there are more than three between samples.
  EXPECT_NEAR(found.ratio(), 1, 4 * std::sqrt(4 / (3 * n) / (samples / 4.)));
}

// Huthmann & Zippelius, Phys. Rev. E 56, R6275 (1997): the rates of change of the two temperatures T and R,
//     Ṫ = −A T^(3/2) + B √T R,   Ṙ = B T^(3/2) − C √T R,
// with η = q (1 + β)/(2 q + 2), q = 2/5, A = (1 − e²)/4 + η (1 − η), B = η²/q and C = (η/q)(1 − η/q), lead to the ratio
// R/T = x with B x² + (C − A) x − B = 0.
double ratio_of_cooling_spheres(double e, double beta) {
  const double q = 0.4, eta = q * (1 + beta) / (2 * q + 2);
  const double a = (1 - e * e) / 4 + eta * (1 - eta), b = eta * eta / q,
               c = eta / q * (1 - eta / q);
  return (a - c + std::sqrt((a - c) * (a - c) + 4 * b * b)) / (2 * b);
}

// The ratio by an independent computation: homogeneous cooling by direct simulation Monte Carlo. Pairs and normals n are
// random and collide with a probability ∝ n·g, the approach speed; mass and radius are 1, the moment of inertia is q.
// Velocities and spins are not Gaussian and not independent here, as the closed form assumes.
class HomogeneousGas {
 public:
  HomogeneousGas(double e, double beta, double ratio) : e_(e), eta_(q * (1 + beta) / (2 * q + 2)) {
    for (Vec3& v : velocity_) v = normal_vector();
    for (Vec3& w : spin_) w = std::sqrt(ratio / q) * normal_vector();
  }

  /// Mean ratio of temperatures between these numbers of collisions per particle.
  double ratio_between(int first, int last) {
    double sum = 0;
    for (int k = 0; k < last; ++k) {
      rescale();
      for (std::size_t collisions = 0; collisions < size / 2;) collisions += collide_two();
      if (k >= first) sum += q * mean_square(spin_) / mean_square(velocity_);
    }
    return sum / (last - first);
  }

 private:
  static constexpr std::size_t size = 20000;
  static constexpr double q = 0.4;
  static constexpr double max_speed = 10;  // of approach, in thermal speeds: never reached

  Vec3 normal_vector() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  static double mean_square(const std::vector<Vec3>& values) {
    double sum = 0;
    for (const Vec3& value : values) sum += value.squaredNorm();
    return sum / size;
  }

  /// To a translational temperature of 1 and no momentum, whose rounding would grow.
  void rescale() {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& v : velocity_) mean += v / size;
    for (Vec3& v : velocity_) v -= mean;
    const double factor = 1 / std::sqrt(mean_square(velocity_) / 3);
    for (Vec3& v : velocity_) v *= factor;
    for (Vec3& w : spin_) w *= factor;
  }

  bool collide_two() {
    const std::size_t i = random_() % size, j = random_() % size;
    const Vec3 n = normal_vector().normalized(), g = velocity_[i] - velocity_[j];
    const double approach = g.dot(n);
    if (i == j || approach < max_speed * uniform_(random_)) return false;
    const Vec3 tangential = g - approach * n + (spin_[i] + spin_[j]).cross(n);
    const Vec3 impulse = (1 + e_) / 2 * approach * n + eta_ * tangential;
    velocity_[i] -= impulse;
    velocity_[j] += impulse;
    for (const std::size_t k : {i, j}) spin_[k] -= n.cross(eta_ * tangential) / q;
    return true;
  }

  const double e_, eta_;
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  std::vector<Vec3> velocity_ = std::vector<Vec3>(size), spin_ = std::vector<Vec3>(size);
};

class CoolingRoughSpheres : public testing::TestWithParam<double> {};

TEST_P(CoolingRoughSpheres, HaveTheRatioOfTemperaturesOfTheBoltzmannEquation) {
  const double e = 0.9, beta = GetParam();
  const double closed_form = ratio_of_cooling_spheres(e, beta);
  const double expected = HomogeneousGas{e, beta, closed_form}.ratio_between(25, 50);
  // About 20 collisions of a particle before the samples, and 30 during them, well before clusters form.
  const double translation = 1 / (1 + closed_form);
  const Temperatures found = run_and_measure(spheres(22, 0.01), {e, ContactLaw::no_slip, beta},
                                             translation, 500, 2500, 20);
  RecordProperty("measured", std::to_string(found.ratio()));
  RecordProperty("boltzmann", std::to_string(expected));
  RecordProperty("closed_form", std::to_string(closed_form));
  // Over eight seeds of both, at β = −0.5, the quotient is 1.0125 on average (the gas has a density, the equation none),
  // with a standard deviation of 0.0094: 3.5 of these, which one run in 4000 exceeds.
  EXPECT_NEAR(found.ratio() / expected, 1, 0.0125 + 3.5 * 0.0094);
  // The closed form neglects that they are not Gaussian, which lowers the ratio.
  EXPECT_GT(expected / closed_form, 0.94);
  EXPECT_LT(expected / closed_form, 0.99);
}

INSTANTIATE_TEST_SUITE_P(Beta, CoolingRoughSpheres, testing::Values(-0.5, 0., 0.5));

}  // namespace
}  // namespace vitrel
