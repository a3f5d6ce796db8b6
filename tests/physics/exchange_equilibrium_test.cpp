// Local moves alone and all kinds of exchanges of places sample the same states of a polydisperse liquid: pressure,
// structure factor and correlation of the sizes of neighbours.

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <numbers>
#include <vector>

#include "core/neighbors/pairs.h"
#include "core/state/check.h"
#include "mc/contact_pressure.h"
#include "mc/event_chain.h"
#include "mc/sampler.h"
#include "mc/swelling.h"
#include "tests/support/polydisperse.h"
#include "tests/support/statistics.h"

namespace vitrel {
namespace {

template <int Dim>
Configuration<Dim> liquid(double aspect_ratio, double packing_fraction) {
  Configuration<Dim> c = polydisperse<Dim>(aspect_ratio, 100, 0.2);
  SwellingState swelling;
  swell(c, {packing_fraction}, 1, swelling, {});
  return c;
}

/// |Σ exp(i k·r)|²/N, averaged over the wave vectors along the axes from the second to the eighth.
template <int Dim>
double structure_factor(const Configuration<Dim>& c) {
  constexpr int first = 2, last = 8;
  double sum = 0;
  for (int axis = 0; axis < Dim; ++axis)
    for (int n = first; n <= last; ++n) {
      const double k = 2 * std::numbers::pi * n / c.box.lengths()[axis];
      std::complex<double> amplitude = 0;
      for (const Vec<Dim>& position : c.position) amplitude += std::polar(1., k * position[axis]);
      sum += std::norm(amplitude);
    }
  return sum / (Dim * (last - first + 1) * static_cast<double>(c.size()));
}

/// Σ δ_i δ_j over neighbours, per particle and relative to the variance; δ the deviation of the size from the mean.
template <int Dim>
double size_correlation(const Configuration<Dim>& c) {
  constexpr double neighbor = 1.2;  // circumcircles of this size overlap
  const auto n = static_cast<double>(c.size());
  double mean = 0, square = 0, sum = 0;
  for (const ParticleShape<Dim>& shape : c.shape) mean += shape.circumradius() / n;
  const auto deviation = [&](std::size_t i) { return c.shape[i].circumradius() - mean; };
  for (std::size_t i = 0; i < c.size(); ++i) square += deviation(i) * deviation(i);
  for_each_pair(c, neighbor, [&](std::size_t i, std::size_t j, const Vec<Dim>& distance) {
    if (distance.norm() < neighbor * (c.shape[i].circumradius() + c.shape[j].circumradius()))
      sum += deviation(i) * deviation(j);
  });
  return sum / square;
}

using Estimates = std::array<Estimate, 3>;

/// By any sampler, in blocks of samples that are so many sweeps apart. Blocks must be much longer than it takes local moves to
/// mix sizes: about 1000 sweeps at the densities of these tests.
template <int Dim, class AnySampler>
Estimates measured(Configuration<Dim>& c, AnySampler& sampler, int sweeps_per_sample) {
  constexpr int tuning = 1000, blocks = 20, samples = 100, sweeps_per_pressure = 2;
  for (int sweep = 1; sweep <= tuning; ++sweep) {
    sampler.sweep();
    if (sweep % 20 == 0) sampler.tune();
  }
  std::array<std::vector<double>, 3> values;
  ContactPressure pressure;
  for (int block = 0; block < blocks; ++block) {
    double structure = 0, sizes = 0;
    for (int sample = 0; sample < samples; ++sample) {
      for (int sweep = 0; sweep < sweeps_per_sample; ++sweep) {
        sampler.sweep();
        if (sweep % sweeps_per_pressure == 0) pressure.add(c);
      }
      structure += structure_factor(c) / samples;
      sizes += size_correlation(c) / samples;
    }
    values[0].push_back(pressure.compressibility());
    values[1].push_back(structure);
    values[2].push_back(sizes);
    pressure.clear();
  }
  EXPECT_TRUE(exact_check(c).clean());
  return {estimate(values[0]), estimate(values[1]), estimate(values[2])};
}

/// Within four standard errors, which are small enough to matter: of Z 0.6 %, of S and the correlation 5 % of one.
void expect_same(const Estimates& one, const Estimates& other) {
  EXPECT_LT(one[0].error, 0.006 * one[0].mean);
  for (std::size_t k = 0; k < one.size(); ++k) {
    if (k > 0) {
      EXPECT_LT(one[k].error, 0.05);
    }
    EXPECT_NEAR(one[k].mean, other[k].mean, 4 * std::hypot(one[k].error, other[k].error)) << k;
  }
}

template <int Dim>
void expect_same_liquid(double aspect_ratio, double packing_fraction) {
  const Configuration<Dim> start = liquid<Dim>(aspect_ratio, packing_fraction);
  Configuration<Dim> c = start;
  Sampler plain(c, 3);
  const Estimates expected = measured(c, plain, 40);
  for (const ExchangeOptions& exchanges :
       {ExchangeOptions{.trials = 0.3, .partners = 0.2}, ExchangeOptions{.collective = 1}}) {
    c = start;
    Sampler sampler(c, 4);
    sampler.set_exchanges(exchanges);
    expect_same(measured(c, sampler, 10), expected);
    c = start;
    EventChain chains(c, {.exchanges = exchanges}, 5);
    expect_same(measured(c, chains, 4), expected);
  }
}

TEST(ExchangeEquilibrium, OfPolydisperseDisks) {
  expect_same_liquid<2>(1, 0.55);
}

TEST(ExchangeEquilibrium, OfPolydisperseEllipses) {
  expect_same_liquid<2>(2, 0.5);
}

TEST(ExchangeEquilibrium, OfPolydisperseSpheres) {
  expect_same_liquid<3>(1, 0.3);
}

}  // namespace
}  // namespace vitrel
