#include "analysis/correlation.h"

#include <array>
#include <limits>

namespace vitrel {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// In eight partial sums, which processors add at once.
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

}  // namespace

void CorrelationSum::add(std::size_t first_origin, std::span<const double> values) {
  double* const sums = per_origin_.data() + first_origin;
  for (std::size_t k = 0; k < values.size(); ++k) sums[k] += values[k];
  particle_ += sum_of(values);
}

double CorrelationSum::finish_particle() {
  const double mean = particle_ / static_cast<double>(per_origin_.size());
  sum_ += mean;
  squares_ += mean * mean;
  particle_ = 0;
  return mean;
}

void CorrelationSum::add(const CorrelationSum& other) {
  for (std::size_t k = 0; k < per_origin_.size(); ++k) per_origin_[k] += other.per_origin_[k];
  sum_ += other.sum_;
  squares_ += other.squares_;
}

Estimate CorrelationSum::estimate(const Lag& lag, std::size_t particles) const {
  Estimate estimate = block_average(means(*this, particles), lag.shortest_block());
  if (estimate.blocks == 0) estimate.error = independent_average(particles, sum_, squares_).error;
  return estimate;
}

void MomentSum::add(std::size_t first_origin, std::span<const double> squares,
                    std::span<const double> fourth_powers) {
  square.add(first_origin, squares);
  quartic.add(first_origin, fourth_powers);
}

void MomentSum::finish_particle() {
  const double mean = square.finish_particle();
  mixed_ += mean * quartic.finish_particle();
}

void MomentSum::add(const MomentSum& other) {
  square.add(other.square);
  quartic.add(other.quartic);
  mixed_ += other.mixed_;
}

Estimate MomentSum::non_gaussian(double c, const Lag& lag, std::size_t particles) const {
  const std::vector<double> squares = means(square, particles);
  std::vector<double> line = means(quartic, particles);
  const double origins = static_cast<double>(line.size());
  const double m2 = sum_of(squares) / origins, m4 = sum_of(line) / origins;
  if (!(m2 > 0)) return {none, none, 0};
  const double by_m4 = c / (m2 * m2), by_m2 = -2 * c * m4 / (m2 * m2 * m2);
  for (std::size_t k = 0; k < line.size(); ++k) line[k] = by_m4 * line[k] + by_m2 * squares[k];
  Estimate estimate = block_average(line, lag.shortest_block());
  if (estimate.blocks == 0)
    estimate.error =
        independent_average(particles, by_m4 * quartic.sum_ + by_m2 * square.sum_,
                            by_m4 * by_m4 * quartic.squares_ + 2 * by_m4 * by_m2 * mixed_ +
                                by_m2 * by_m2 * square.squares_)
            .error;
  estimate.mean = c * m4 / (m2 * m2) - 1;
  return estimate;
}

Estimate susceptibility(const CorrelationSum& sum, const Lag& lag, std::size_t particles) {
  std::vector<double> series = means(sum, particles);
  const Estimate overlap = block_average(series, lag.shortest_block());
  const double n = static_cast<double>(particles);
  for (double& q : series) q = n * (q - overlap.mean) * (q - overlap.mean);
  const Estimate variance = block_average(series, lag.shortest_block());
  if (overlap.blocks == 0 || variance.blocks == 0) return {none, none, 0};
  const double uncertainty = overlap.error / student_factor(overlap.blocks - 1);
  return {variance.mean + n * uncertainty * uncertainty, variance.error, variance.blocks};
}

}  // namespace vitrel
