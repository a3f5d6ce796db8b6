#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "analysis/dynamics/bessel_j0.h"
#include "analysis/dynamics/correlation.h"
#include "analysis/dynamics/displacement_options.h"
#include "analysis/dynamics/path.h"
#include "analysis/dynamics/time_axis.h"

/// @file
/// The inner part of displacement.h: what every particle adds at one lag.
namespace vitrel {
namespace detail {

/// Computes the polynomials Q_n of the orientational correlations ⟨Q_n(u(0)·u(t))⟩ for n = 0, 1, 2 …: Chebyshev's
/// T_n(cos Δθ) = cos nΔθ in the plane, and Legendre's P_n in space.
template <int Dim, class Chunk>
class Polynomials {
 public:
  Polynomials(const Chunk& x, std::size_t count) : x_(x), count_(count) {
    before_.fill(1);
    now_ = x;
  }

  /// Returns Q_n; n must be at least 1, and not smaller than at the call before.
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

}  // namespace detail

template <int Dim>
struct TrackQuantities {
  std::vector<double> wave_numbers, orders;
  std::size_t axes;  ///< number of axes whose directions are correlated
  double overlap_distance;
  MotionParts parts;
  DirectionAverage<Dim> direction_average = {};
};

/// Sums over particles. Their classes (LikeParticles) matter for the errors only.
template <int Dim>
class LagSums {
 public:
  /// `rotors` says whether there may be any among the particles. `lag` and `quantities` must outlive the sums.
  LagSums(const Lag& lag, const TrackQuantities<Dim>& quantities, bool rotors, std::size_t classes)
      : lag_(&lag),
        quantities_(&quantities),
        translation_(quantities.parts.displacement ? lag.origins : 0, classes),
        overlap_(quantities.parts.overlap ? lag.origins : 0, classes) {
    const CorrelationSum empty(lag.origins, classes);
    if (quantities.parts.scattering) scattering_.assign(quantities.wave_numbers.size(), empty);
    if (!rotors) return;
    const CorrelationSum moment(quantities.parts.displacement ? lag.origins : 0, classes);
    rotation_ = Rotation{moment, moment, MomentSum(moment.per_origin().size(), classes), {}};
    if (quantities.parts.orientation)
      rotation_->orientation.assign(quantities.axes * quantities.orders.size(), empty);
  }
  void add(const Path<Dim>& path, std::size_t its_class) {
    for (std::size_t begin = 0; begin < lag_->origins; begin += chunk) {
      const Part part(*lag_, path, begin);
      const MotionParts& parts = quantities_->parts;
      Chunk squares;
      if (parts.displacement || parts.scattering || parts.overlap)
        part.square_changes(squares, path.position);
      if (parts.displacement) add_displacement(part, squares);
      if (parts.overlap) add_overlap(part, squares);
      if (parts.scattering) add_scattering(part, squares);
      if (!path.is_rotor()) continue;
      if (parts.displacement) add_rotation(part, squares);
      if (parts.orientation) add_orientation(part);
    }
    finish_particle(path.is_rotor(), its_class);
  }
  void add(const LagSums& other) {
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

  struct Rotation {
    CorrelationSum parallel, perpendicular;
    MomentSum turn;
    std::vector<CorrelationSum> orientation;  ///< all orders of the first axis, of the second …
  };
  const MotionParts& parts() const { return quantities_->parts; }
  const MomentSum& translation() const { return translation_; }
  const CorrelationSum& overlap() const { return overlap_; }
  const std::vector<CorrelationSum>& scattering() const { return scattering_; }
  const Rotation& rotation() const { return *rotation_; }

  /// ⟨s²⟩ = ⟨s⟩²/c for normally distributed displacements and rotations, whose squares are s.
  static constexpr double normal_translation = Dim / (Dim + 2.0);
  static constexpr double normal_rotation = Path<Dim>::rotations / (Path<Dim>::rotations + 2.0);

 private:
  /// The number of origins worked on at a time; all that belongs to them stays in the first-level cache.
  static constexpr std::size_t chunk = 256;
  using Chunk = std::array<double, chunk>;
  /// Consecutive origins of a lag.
  class Part {
   public:
    Part(const Lag& lag, const Path<Dim>& its_path, std::size_t begin)
        : path(its_path), first(begin), count(std::min(chunk, lag.origins - begin)), lag_(lag) {}

    /// The numbers of a series at the origins, and one lag later.
    class Ends {
     public:
      Ends(const Part& part, const FrameSeries& series) {
        const Lag& lag = part.lag_;
        if (lag.pairs.empty()) {
          from = &series[part.first];
          to = &series[part.path.place(lag.frames) + part.first];
          return;
        }
        for (std::size_t k = 0; k < part.count; ++k) {
          const FramePair& pair = lag.pairs[part.first + k];
          from_[k] = series[pair.from];
          to_[k] = series[pair.to];
        }
      }
      Ends(const Ends&) = delete;
      Ends& operator=(const Ends&) = delete;

      const double* from = from_.data();
      const double* to = to_.data();

     private:
      Chunk from_, to_;
    };

    template <std::size_t Count>
    void square_changes(Chunk& squares, const std::array<FrameSeries, Count>& series) const {
      squares.fill(0);
      for (const FrameSeries& component : series) {
        const Ends ends(*this, component);
        for (std::size_t k = 0; k < count; ++k) {
          const double change = ends.to[k] - ends.from[k];
          squares[k] += change * change;
        }
      }
    }
    std::span<const double> of(const Chunk& values) const { return {values.data(), count}; }

    const Path<Dim>& path;
    const std::size_t first, count;

   private:
    const Lag& lag_;
  };
  void add_displacement(const Part& part, const Chunk& squares) {
    Chunk fourth_powers;
    for (std::size_t k = 0; k < part.count; ++k) fourth_powers[k] = squares[k] * squares[k];
    translation_.add(part.first, part.of(squares), part.of(fourth_powers));
  }
  void add_overlap(const Part& part, const Chunk& squares) {
    const double near = quantities_->overlap_distance * quantities_->overlap_distance;
    Chunk values;
    for (std::size_t k = 0; k < part.count; ++k) values[k] = squares[k] < near ? 1.0 : 0.0;
    overlap_.add(part.first, part.of(values));
  }
  void add_scattering(const Part& part, const Chunk& squares) {
    Chunk distances, values;
    for (std::size_t k = 0; k < part.count; ++k) distances[k] = std::sqrt(squares[k]);
    for (std::size_t j = 0; j < scattering_.size(); ++j) {
      const double q = quantities_->wave_numbers[j];
      for (std::size_t k = 0; k < part.count; ++k)
        values[k] = quantities_->direction_average(q * distances[k]);
      scattering_[j].add(part.first, part.of(values));
    }
  }
  void add_rotation(const Part& part, const Chunk& squares) {
    const Path<Dim>& path = part.path;
    Chunk values, others;
    values.fill(0);
    for (std::size_t d = 0; d < Dim; ++d) {
      const typename Part::Ends place(part, path.position[d]);
      const typename Part::Ends axis(part, path.directions.front()[d]);
      for (std::size_t k = 0; k < part.count; ++k)
        values[k] += axis.from[k] * (place.to[k] - place.from[k]);
    }
    for (std::size_t k = 0; k < part.count; ++k) {
      values[k] *= values[k];
      others[k] = squares[k] - values[k];
    }
    rotation_->parallel.add(part.first, part.of(values));
    rotation_->perpendicular.add(part.first, part.of(others));
    part.square_changes(values, path.turn);
    for (std::size_t k = 0; k < part.count; ++k) others[k] = values[k] * values[k];
    rotation_->turn.add(part.first, part.of(values), part.of(others));
  }
  void add_orientation(const Part& part) {
    std::size_t next = 0;
    for (const DirectionSeries<Dim>& axis : part.path.directions) {
      Chunk cosines;
      cosines.fill(0);
      for (const FrameSeries& component : axis) {
        const typename Part::Ends ends(part, component);
        for (std::size_t k = 0; k < part.count; ++k) cosines[k] += ends.from[k] * ends.to[k];
      }
      detail::Polynomials<Dim, Chunk> polynomials(cosines, part.count);
      for (const double n : quantities_->orders)
        rotation_->orientation[next++].add(part.first, part.of(polynomials.of(n)));
    }
  }
  void finish_particle(bool rotor, std::size_t its_class) {
    translation_.finish_particle(its_class);
    overlap_.finish_particle(its_class);
    for (CorrelationSum& sum : scattering_) sum.finish_particle(its_class);
    if (!rotor) return;
    rotation_->parallel.finish_particle(its_class);
    rotation_->perpendicular.finish_particle(its_class);
    rotation_->turn.finish_particle(its_class);
    for (CorrelationSum& sum : rotation_->orientation) sum.finish_particle(its_class);
  }

  const Lag* lag_;
  const TrackQuantities<Dim>* quantities_;
  MomentSum translation_;
  CorrelationSum overlap_;
  std::vector<CorrelationSum> scattering_;
  std::optional<Rotation> rotation_;
};

}  // namespace vitrel
