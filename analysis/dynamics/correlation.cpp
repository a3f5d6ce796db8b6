#include "analysis/dynamics/correlation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/special_values.h"

namespace vitrel {

namespace {

/// Adds in eight partial sums, which processors compute at once.
double sum_of(std::span<const double> values) {
  std::array<double, 8> parts{};
  std::size_t k = 0;
  for (; k + parts.size() <= values.size(); k += parts.size())
    for (std::size_t p = 0; p < parts.size(); ++p) parts[p] += values[k + p];
  for (; k < values.size(); ++k) parts[0] += values[k];
  return ((parts[0] + parts[1]) + (parts[2] + parts[3])) +
         ((parts[4] + parts[5]) + (parts[6] + parts[7]));
}

std::vector<double> means(const CorrelationSum& sum, std::size_t particles) {
  std::vector<double> series(sum.per_origin().begin(), sum.per_origin().end());
  for (double& value : series) value /= static_cast<double>(particles);
  return series;
}

double mean_of(const CorrelationSum& sum, std::size_t particles) {
  const std::vector<double> series = means(sum, particles);
  return sum_of(series) / static_cast<double>(series.size());
}

/// The part of the correlations (1 − s/lag)² that blocks of two time differences show.
constexpr double seen_of_diffusion = 7.0 / 8;

/// Returns the mean over a series of origins that have the correlations of diffusion.
Estimate over_origins(std::span<const double> series, const Lag& lag) {
  const Estimate plateau = block_average(series, lag.shortest_block());
  const auto two_lags = static_cast<std::size_t>(std::ceil(lag.shortest_block() / 2));
  return plateau.blocks > 0 || two_lags == 1
             ? plateau
             : known_block_average(series, two_lags, seen_of_diffusion);
}

double without_student(const Estimate& estimate) {
  return estimate.blocks == 0 ? unknown : estimate.error / student_factor(estimate.blocks - 1);
}

/// Number of points at the long end that show how many particles move together.
constexpr std::size_t last_points = 16;

}  // namespace

void Correlation::push_back(const Estimate& estimate) {
  value.push_back(estimate.mean);
  error.push_back(estimate.error);
  blocks.push_back(estimate.blocks);
}

void Correlation::push_back(const PointEstimate& point) {
  push_back(point.by_blocks);
  const double quotient = without_student(point.by_blocks) / point.spread;
  if (blocks.back() == 0)
    error.back() = point.spread * cooperation();
  else if (std::isfinite(quotient))
    squared_quotients_.push_back(quotient * quotient);
}

double Correlation::cooperation() const {
  if (squared_quotients_.empty()) return 1;
  const std::size_t count = std::min(last_points, squared_quotients_.size());
  return std::max(1.0, std::sqrt(mean_of(std::span(squared_quotients_).last(count))));
}

void CorrelationSum::add(std::size_t first_origin, std::span<const double> values) {
  double* const sums = per_origin_.data() + first_origin;
  for (std::size_t k = 0; k < values.size(); ++k) sums[k] += values[k];
  particle_ += sum_of(values);
}

double CorrelationSum::finish_particle(std::size_t its_class) {
  const double mean = particle_ / static_cast<double>(per_origin_.size());
  classes_[its_class].add(mean);
  particle_ = 0;
  return mean;
}

void CorrelationSum::add_origin(std::size_t origin, std::span<const double> values,
                                std::span<double> particle_sums) {
  per_origin_[origin] += sum_of(values);
  for (std::size_t i = 0; i < values.size(); ++i) particle_sums[i] += values[i];
}

void CorrelationSum::finish_particles(std::span<const double> particle_sums,
                                      std::span<const std::size_t> classes) {
  for (std::size_t i = 0; i < particle_sums.size(); ++i)
    classes_[classes[i]].add(particle_sums[i] / static_cast<double>(per_origin_.size()));
}

void CorrelationSum::add(const CorrelationSum& other) {
  for (std::size_t k = 0; k < per_origin_.size(); ++k) per_origin_[k] += other.per_origin_[k];
  for (std::size_t c = 0; c < classes_.size(); ++c) classes_[c].add(other.classes_[c]);
}

CorrelationSum CorrelationSum::of_origins(std::size_t begin, std::size_t end) const {
  CorrelationSum part(0, 0);
  part.per_origin_.assign(per_origin_.begin() + static_cast<std::ptrdiff_t>(begin),
                          per_origin_.begin() + static_cast<std::ptrdiff_t>(end));
  return part;
}

PointEstimate CorrelationSum::estimate(const Lag& lag, std::size_t particles) const {
  return {over_origins(means(*this, particles), lag), independent_average(classes_).error};
}

PointEstimate CorrelationSum::estimate_of_decay(const Lag& lag, std::size_t particles) const {
  return {average_of_decay(means(*this, particles), lag), independent_average(classes_).error};
}

PointEstimate CorrelationSum::estimate_with_plateau(const Lag& lag, std::size_t particles) const {
  return {block_average(means(*this, particles), lag.shortest_block()),
          independent_average(classes_).error};
}

Estimate average_of_decay(std::span<const double> series, const Lag& lag) {
  const Estimate blocks = block_average(series, lag.shortest_block());
  return blocks.blocks > 0 ? blocks : slow_average(series);
}

void MomentSum::add(std::size_t first_origin, std::span<const double> squares,
                    std::span<const double> fourth_powers) {
  square.add(first_origin, squares);
  quartic.add(first_origin, fourth_powers);
}

void MomentSum::finish_particle(std::size_t its_class) {
  const double mean = square.finish_particle(its_class);
  mixed_[its_class] += mean * quartic.finish_particle(its_class);
}

void MomentSum::add(const MomentSum& other) {
  square.add(other.square);
  quartic.add(other.quartic);
  for (std::size_t c = 0; c < mixed_.size(); ++c) mixed_[c] += other.mixed_[c];
}

std::vector<double> MomentSum::line(double by_quartic, double by_square,
                                    std::size_t particles) const {
  const std::vector<double> squares = means(square, particles);
  std::vector<double> line = means(quartic, particles);
  for (std::size_t k = 0; k < line.size(); ++k)
    line[k] = by_quartic * line[k] + by_square * squares[k];
  return line;
}

double MomentSum::spread(double by_quartic, double by_square) const {
  std::vector<ValueSums> line_of_classes;
  for (std::size_t k = 0; k < mixed_.size(); ++k) {
    const ValueSums &s = square.classes_[k], &q = quartic.classes_[k];
    line_of_classes.push_back({s.count, by_quartic * q.sum + by_square * s.sum,
                               by_quartic * by_quartic * q.squares +
                                   2 * by_quartic * by_square * mixed_[k] +
                                   by_square * by_square * s.squares});
  }
  return independent_average(line_of_classes).error;
}

PointEstimate MomentSum::non_gaussian(double c, const Lag& lag, std::size_t particles) const {
  const double m2 = mean_of(square, particles), m4 = mean_of(quartic, particles);
  if (!(m2 > 0)) return {{unknown, unknown, 0}, unknown};
  const double by_m4 = c / (m2 * m2), by_m2 = -2 * c * m4 / (m2 * m2 * m2);
  Estimate estimate = over_origins(line(by_m4, by_m2, particles), lag);
  estimate.mean = c * m4 / (m2 * m2) - 1;
  return {estimate, spread(by_m4, by_m2)};
}

PointEstimate MomentSum::ratio(const Lag& lag, std::size_t particles) const {
  const double x = mean_of(square, particles), y = mean_of(quartic, particles);
  if (!(x > 0)) return {{unknown, unknown, 0}, unknown};
  Estimate estimate = average_of_decay(line(1 / x, -y / (x * x), particles), lag);
  estimate.mean = y / x;
  return {estimate, spread(1 / x, -y / (x * x))};
}

Estimate susceptibility(const CorrelationSum& sum, const Lag& lag, std::size_t particles) {
  std::vector<double> series = means(sum, particles);
  const Estimate overlap = over_origins(series, lag);
  const double n = static_cast<double>(particles);
  for (double& q : series) q = n * (q - overlap.mean) * (q - overlap.mean);
  const Estimate variance = over_origins(series, lag);
  if (overlap.blocks == 0 || variance.blocks == 0) return {unknown, unknown, 0};
  const double uncertainty = without_student(overlap);
  return {variance.mean + n * uncertainty * uncertainty, variance.error, variance.blocks};
}

}  // namespace vitrel
