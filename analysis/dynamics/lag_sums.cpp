#include "analysis/dynamics/lag_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrel {

namespace {

/// Origins worked on at a time: all that belongs to them stays in the first cache.
constexpr std::size_t chunk = 256;
using Chunk = std::array<double, chunk>;

}  // namespace

Phase::Phase(const std::vector<double>& angle, double n) {
  for (const double theta : angle) {
    cosine.push_back(std::cos(n * theta));
    sine.push_back(std::sin(n * theta));
  }
}

Path::Path(const Track& its_track, bool is_rotor, const std::vector<double>& orders)
    : track(&its_track) {
  if (!is_rotor) return;
  axis.emplace(track->angle, 1);
  for (const double n : orders) phases.emplace_back(track->angle, n);
}

/// Consecutive origins of a lag.
class LagSums::Part {
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

LagSums::LagSums(const Lag& lag, const TrackQuantities& quantities, bool rotors)
    : lag_(&lag),
      quantities_(&quantities),
      translation_(lag.origins),
      overlap_(lag.origins),
      scattering_(quantities.wave_numbers.size(), CorrelationSum(lag.origins)) {
  const CorrelationSum empty(lag.origins);
  if (rotors)
    rotation_ = Rotation{empty, empty, MomentSum(lag.origins),
                         std::vector<CorrelationSum>(quantities.orders.size(), empty)};
}

void LagSums::add(const Path& path) {
  for (std::size_t begin = 0; begin < lag_->origins; begin += chunk) {
    const Part part(*lag_, begin);
    add_translation(*path.track, part);
    if (path.axis) add_rotation(path, part);
  }
  finish_particle(path.axis.has_value());
}

void LagSums::add_translation(const Track& track, const Part& part) {
  Chunk squares, values;
  part.at_frames(squares, [&](std::size_t from, std::size_t to) {
    const double dx = track.x[to] - track.x[from], dy = track.y[to] - track.y[from];
    return dx * dx + dy * dy;
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
    part.at_origins(values, [&](std::size_t k) { return quantities_->bessel(q * distances[k]); });
    scattering_[j].add(part.first, part.of(values));
  }
}

void LagSums::add_rotation(const Path& path, const Part& part) {
  const Track& track = *path.track;
  const Phase& axis = *path.axis;
  Chunk values, fourth_powers;
  part.at_frames(values, [&](std::size_t from, std::size_t to) {
    const double along = axis.cosine[from] * (track.x[to] - track.x[from]) +
                         axis.sine[from] * (track.y[to] - track.y[from]);
    return along * along;
  });
  rotation_->parallel.add(part.first, part.of(values));
  part.at_frames(values, [&](std::size_t from, std::size_t to) {
    const double across = axis.cosine[from] * (track.y[to] - track.y[from]) -
                          axis.sine[from] * (track.x[to] - track.x[from]);
    return across * across;
  });
  rotation_->perpendicular.add(part.first, part.of(values));
  part.at_frames(values, [&](std::size_t from, std::size_t to) {
    const double turn = track.angle[to] - track.angle[from];
    return turn * turn;
  });
  part.at_origins(fourth_powers, [&](std::size_t k) { return values[k] * values[k]; });
  rotation_->turn.add(part.first, part.of(values), part.of(fourth_powers));
  for (std::size_t j = 0; j < path.phases.size(); ++j) {
    const Phase& phase = path.phases[j];
    part.at_frames(values, [&](std::size_t from, std::size_t to) {
      return phase.cosine[from] * phase.cosine[to] + phase.sine[from] * phase.sine[to];
    });
    rotation_->orientation[j].add(part.first, part.of(values));
  }
}

void LagSums::finish_particle(bool rotor) {
  translation_.finish_particle();
  overlap_.finish_particle();
  for (CorrelationSum& sum : scattering_) sum.finish_particle();
  if (!rotor) return;
  rotation_->parallel.finish_particle();
  rotation_->perpendicular.finish_particle();
  rotation_->turn.finish_particle();
  for (CorrelationSum& sum : rotation_->orientation) sum.finish_particle();
}

void LagSums::add(const LagSums& other) {
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

}  // namespace vitrel
