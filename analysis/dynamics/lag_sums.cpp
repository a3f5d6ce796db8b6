#include "analysis/dynamics/lag_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrel {

namespace {

/// Origins worked on at a time: all that belongs to them stays in the first cache.
constexpr std::size_t chunk = 256;
using Chunk = std::array<double, chunk>;

template <std::size_t Count>
double squared_change(const std::array<FrameSeries, Count>& series, std::size_t from,
                      std::size_t to) {
  double sum = 0;
  for (const FrameSeries& component : series) {
    const double change = component[to] - component[from];
    sum += change * change;
  }
  return sum;
}

/// The polynomials Q_n of the orientational correlations ⟨Q_n(u(0)·u(t))⟩, n = 0, 1, 2 … at once:
/// Chebyshev's T_n(cos Δθ) = cos nΔθ in the plane, Legendre's P_n in space.
template <int Dim>
class Polynomials {
 public:
  Polynomials(const Chunk& x, std::size_t count) : x_(x), count_(count) {
    before_.fill(1);
    now_ = x;
  }

  /// Q_n; n must not be smaller than at the call before, and at least 1.
  const Chunk& of(double n) {
    for (; order_ < n; order_ += 1)
      for (std::size_t k = 0; k < count_; ++k) {
        const double next =
            Dim == 2 ? 2 * x_[k] * now_[k] - before_[k]
                     : ((2 * order_ + 1) * x_[k] * now_[k] - order_ * before_[k]) / (order_ + 1);
        before_[k] = now_[k];
        now_[k] = next;
      }
    return now_;
  }

 private:
  const Chunk& x_;
  std::size_t count_;
  double order_ = 1;
  Chunk before_, now_;
};

}  // namespace

/// Consecutive origins of a lag.
template <int Dim>
class LagSums<Dim>::Part {
 public:
  Part(const Lag& lag, std::size_t begin)
      : first(begin), count(std::min(chunk, lag.origins - begin)), lag_(lag) {}

  /// values[k] = value(frame of origin k, frame one lag later).
  template <class Value>
  void at_frames(Chunk& values, Value&& value) const {
    if (lag_.pairs.empty()) {
      std::size_t from = first * lag_.stride;
      for (std::size_t k = 0; k < count; ++k, from += lag_.stride)
        values[k] = value(from, from + lag_.frames);
    } else {
      const FramePair* const pairs = &lag_.pairs[first];
      for (std::size_t k = 0; k < count; ++k) values[k] = value(pairs[k].from, pairs[k].to);
    }
  }
  template <class Value>
  void at_origins(Chunk& values, Value&& value) const {
    for (std::size_t k = 0; k < count; ++k) values[k] = value(k);
  }
  std::span<const double> of(const Chunk& values) const { return {values.data(), count}; }

  const std::size_t first, count;

 private:
  const Lag& lag_;
};

template <int Dim>
LagSums<Dim>::LagSums(const Lag& lag, const TrackQuantities<Dim>& quantities, bool rotors,
                      std::size_t classes)
    : lag_(&lag),
      quantities_(&quantities),
      translation_(lag.origins, classes),
      overlap_(lag.origins, classes),
      scattering_(quantities.wave_numbers.size(), CorrelationSum(lag.origins, classes)) {
  const CorrelationSum empty(lag.origins, classes);
  if (rotors)
    rotation_ =
        Rotation{empty, empty, MomentSum(lag.origins, classes),
                 std::vector<CorrelationSum>(quantities.axes * quantities.orders.size(), empty)};
}

template <int Dim>
void LagSums<Dim>::add(const Path<Dim>& path, std::size_t its_class) {
  for (std::size_t begin = 0; begin < lag_->origins; begin += chunk) {
    const Part part(*lag_, begin);
    add_translation(path, part);
    if (!path.is_rotor()) continue;
    add_rotation(path, part);
    add_orientation(path, part);
  }
  finish_particle(path.is_rotor(), its_class);
}

template <int Dim>
void LagSums<Dim>::add_translation(const Path<Dim>& path, const Part& part) {
  Chunk squares, values;
  part.at_frames(squares, [&](std::size_t from, std::size_t to) {
    return squared_change(path.track->position, from, to);
  });
  part.at_origins(values, [&](std::size_t k) { return squares[k] * squares[k]; });
  translation_.add(part.first, part.of(squares), part.of(values));
  const double near = quantities_->overlap_distance * quantities_->overlap_distance;
  part.at_origins(values, [&](std::size_t k) { return squares[k] < near ? 1.0 : 0.0; });
  overlap_.add(part.first, part.of(values));
  Chunk distances;
  part.at_origins(distances, [&](std::size_t k) { return std::sqrt(squares[k]); });
  for (std::size_t j = 0; j < scattering_.size(); ++j) {
    const double q = quantities_->wave_numbers[j];
    part.at_origins(
        values, [&](std::size_t k) { return quantities_->direction_average(q * distances[k]); });
    scattering_[j].add(part.first, part.of(values));
  }
}

template <int Dim>
void LagSums<Dim>::add_rotation(const Path<Dim>& path, const Part& part) {
  const auto& position = path.track->position;
  const DirectionSeries<Dim>& axis = path.directions.front();
  Chunk values, fourth_powers;
  part.at_frames(values, [&](std::size_t from, std::size_t to) {
    double along = 0;
    for (std::size_t d = 0; d < Dim; ++d)
      along += axis[d][from] * (position[d][to] - position[d][from]);
    return along * along;
  });
  rotation_->parallel.add(part.first, part.of(values));
  Chunk squares;
  part.at_frames(squares, [&](std::size_t from, std::size_t to) {
    return squared_change(position, from, to);
  });
  part.at_origins(values, [&](std::size_t k) { return squares[k] - values[k]; });
  rotation_->perpendicular.add(part.first, part.of(values));
  part.at_frames(values, [&](std::size_t from, std::size_t to) {
    return squared_change(path.turn, from, to);
  });
  part.at_origins(fourth_powers, [&](std::size_t k) { return values[k] * values[k]; });
  rotation_->turn.add(part.first, part.of(values), part.of(fourth_powers));
}

template <int Dim>
void LagSums<Dim>::add_orientation(const Path<Dim>& path, const Part& part) {
  std::size_t next = 0;
  for (const DirectionSeries<Dim>& axis : path.directions) {
    Chunk cosines;
    part.at_frames(cosines, [&](std::size_t from, std::size_t to) {
      double cosine = 0;
      for (std::size_t d = 0; d < Dim; ++d) cosine += axis[d][from] * axis[d][to];
      return cosine;
    });
    Polynomials<Dim> polynomials(cosines, part.count);
    for (const double n : quantities_->orders)
      rotation_->orientation[next++].add(part.first, part.of(polynomials.of(n)));
  }
}

template <int Dim>
void LagSums<Dim>::finish_particle(bool rotor, std::size_t its_class) {
  translation_.finish_particle(its_class);
  overlap_.finish_particle(its_class);
  for (CorrelationSum& sum : scattering_) sum.finish_particle(its_class);
  if (!rotor) return;
  rotation_->parallel.finish_particle(its_class);
  rotation_->perpendicular.finish_particle(its_class);
  rotation_->turn.finish_particle(its_class);
  for (CorrelationSum& sum : rotation_->orientation) sum.finish_particle(its_class);
}

template <int Dim>
void LagSums<Dim>::add(const LagSums& other) {
  translation_.add(other.translation_);
  overlap_.add(other.overlap_);
  for (std::size_t j = 0; j < scattering_.size(); ++j) scattering_[j].add(other.scattering_[j]);
  if (!other.rotation_) return;
  rotation_->parallel.add(other.rotation_->parallel);
  rotation_->perpendicular.add(other.rotation_->perpendicular);
  rotation_->turn.add(other.rotation_->turn);
  for (std::size_t j = 0; j < rotation_->orientation.size(); ++j)
    rotation_->orientation[j].add(other.rotation_->orientation[j]);
}

template class LagSums<2>;
template class LagSums<3>;

}  // namespace vitrel
