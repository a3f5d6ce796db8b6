#include "analysis/structure/order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/structure/voronoi.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

/// Every particle is an origin up to 4096 of them; beyond some 30 000 the number of pairs is limited.
constexpr std::size_t max_origins = 4096, max_pairs = std::size_t{1} << 27;
constexpr double min_order_in_plane = 0.5, min_order_in_space = 0.4;  // limits of a nematic
constexpr double well_above_chance = 3;  // in units of the order that as many rotors have by chance

/// Centre and (cos 2θ, sin 2θ) of a particle that is not round.
struct Rotor {
  Vec2 position;
  Vec2 director;
};

std::vector<Rotor> rotors_of(const Configuration2& configuration) {
  std::vector<Rotor> rotors;
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const double twice = 2 * configuration.angle[i];
    if (!configuration.shape[i].is_round())
      rotors.push_back({configuration.position[i], direction(twice)});
  }
  return rotors;
}

/// Returns the distance of the nearest image.
double nearest_distance(const Vec2& lengths, const Vec2& from, const Vec2& to) {
  const Vec2 away = (to - from).cwiseAbs();
  return away.cwiseMin((lengths - away).cwiseAbs()).norm();
}

/// Returns exp(6iα) of a vector in the direction α.
std::complex<double> sixfold(const Vec2& along) {
  const double length = along.norm();
  const std::complex<double> unit{along.x() / length, along.y() / length};
  const std::complex<double> cube = unit * unit * unit;
  return cube * cube;
}

std::complex<double> hexatic_order(const VoronoiCell& cell) {
  std::complex<double> sum = 0;
  double perimeter = 0;
  for (const VoronoiEdge& edge : cell.edges) {
    sum += edge.length * sixfold(edge.to);
    perimeter += edge.length;
  }
  return sum / perimeter;
}

}  // namespace

Mat2 OrderTensor::matrix() const {
  return (Mat2() << cosine, sine, sine, -cosine).finished();
}

double OrderTensor::order() const {
  return std::hypot(cosine, sine);
}

double OrderTensor::director() const {
  return 0.5 * polar_angle(sine, cosine);
}

OrderTensor order_tensor(const Configuration2& configuration) {
  const std::vector<Rotor> rotors = rotors_of(configuration);
  if (rotors.empty()) return {};
  Vec2 sum = Vec2::Zero();
  for (const Rotor& rotor : rotors) sum += rotor.director;
  const Vec2 mean = sum / static_cast<double>(rotors.size());
  return {mean.x(), mean.y()};
}

double nematic_order(const Configuration2& configuration) {
  return order_tensor(configuration).order();
}

double nematic_order_by_chance(std::size_t rotors, int dimension) {
  using std::numbers::pi;
  const double scatter = 1 / std::sqrt(static_cast<double>(rotors));
  return scatter * (dimension == 2 ? std::sqrt(pi / 4) : 9.0 / 4 * std::sqrt(2 / (5 * pi)));
}

bool is_nematic(double order, std::size_t rotors, int dimension) {
  const double min_order = dimension == 2 ? min_order_in_plane : min_order_in_space;
  return order >=
         std::max(min_order, well_above_chance * nematic_order_by_chance(rotors, dimension));
}

std::vector<double> orientation_distribution(const Configuration2& configuration,
                                             std::size_t bins) {
  const std::size_t rotors = rotor_count(configuration);
  if (rotors == 0) return {};
  const double director = order_tensor(configuration).director();
  const double width = std::numbers::pi / static_cast<double>(bins);
  std::vector<double> density(bins, 0);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    if (configuration.shape[i].is_round()) continue;
    const double turns = (configuration.angle[i] - director) / std::numbers::pi + 0.5;
    const double place = (turns - std::floor(turns)) * static_cast<double>(bins);
    // Rounding can put a place at the very end.
    const std::size_t bin = std::min(static_cast<std::size_t>(place), bins - 1);
    density[bin] += 1 / (static_cast<double>(rotors) * width);
  }
  return density;
}

NematicCorrelation nematic_correlation(const Configuration2& configuration, double width) {
  const std::vector<Rotor> rotors = rotors_of(configuration);
  if (rotors.size() < 2) return {};
  const Vec2& lengths = configuration.box.lengths();
  const double range = 0.5 * lengths.minCoeff();
  const auto bins = static_cast<std::size_t>(std::max(1.0, std::round(range / width)));
  const double scale = static_cast<double>(bins) / range;
  std::vector<double> sum(bins, 0);
  NematicCorrelation result{{}, {}, std::vector<std::size_t>(bins, 0)};
  const std::size_t origins = std::min(max_origins, max_pairs / rotors.size() + 1);
  const std::size_t stride = (rotors.size() + origins - 1) / origins;
  for (std::size_t i = 0; i < rotors.size(); i += stride)
    for (std::size_t j = 0; j < rotors.size(); ++j) {
      const double at = scale * nearest_distance(lengths, rotors[i].position, rotors[j].position);
      // The first of two origins counts the pair.
      if (!(at < static_cast<double>(bins)) || j == i || (j < i && j % stride == 0)) continue;
      const auto bin = static_cast<std::size_t>(at);
      sum[bin] += rotors[i].director.dot(rotors[j].director);
      ++result.pairs[bin];
    }
  for (std::size_t k = 0; k < bins; ++k) {
    result.distance.push_back((static_cast<double>(k) + 0.5) / scale);
    result.value.push_back(sum[k] / static_cast<double>(result.pairs[k]));
  }
  return result;
}

double correlation_length(const NematicCorrelation& correlation) {
  const double level = std::exp(-1);
  bool last = true;
  for (std::size_t k = correlation.value.size(); k-- > 0;) {
    if (correlation.pairs[k] == 0) continue;
    if (correlation.value[k] >= level)
      return last ? std::numeric_limits<double>::infinity()
                  : correlation.distance[k] + correlation.distance[0];
    last = false;
  }
  return 0;
}

std::vector<std::complex<double>> local_hexatic_orders(const Configuration2& configuration,
                                                       int threads) {
  const Voronoi voronoi(configuration);
  std::vector<std::complex<double>> orders(configuration.size());
  each_in_parallel(orders.size(), threads, [&](std::size_t k) {
    const std::uint32_t i = voronoi.order()[k];
    orders[i] = hexatic_order(voronoi.cell(i));
  });
  return orders;
}

HexaticOrder hexatic_order(const Configuration2& configuration, int threads) {
  std::complex<double> sum = 0;
  double magnitudes = 0;
  for (const std::complex<double>& order : local_hexatic_orders(configuration, threads)) {
    sum += order;
    magnitudes += std::abs(order);
  }
  const double n = static_cast<double>(configuration.size());
  return {std::abs(sum) / n, magnitudes / n};
}

}  // namespace vitrel
