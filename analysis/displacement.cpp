#include "analysis/displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/blocking.h"
#include "core/error.h"

namespace vitrel {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Sums behind one curve, for every lag.
class SquareSum {
 public:
  explicit SquareSum(const std::vector<Lag>& lags)
      : lags_(lags), sum_(lags.size()), sum_of_squares_(lags.size()) {
    for (const Lag& lag : lags) per_origin_.emplace_back(lag.origins, 0.0);
  }

  /// The squares of one more particle, one for every origin.
  void add(std::size_t lag, const std::vector<double>& squares) {
    double total = 0;
    for (std::size_t k = 0; k < squares.size(); ++k) {
      per_origin_[lag][k] += squares[k];
      total += squares[k];
    }
    const double mean = total / static_cast<double>(squares.size());
    sum_[lag] += mean;
    sum_of_squares_[lag] += mean * mean;
  }

  MeanSquare result(std::size_t particles) {
    MeanSquare square;
    if (particles == 0) return square;
    for (std::size_t lag = 0; lag < per_origin_.size(); ++lag) {
      for (double& value : per_origin_[lag]) value /= static_cast<double>(particles);
      Estimate estimate = block_average(per_origin_[lag], lags_[lag].shortest_block());
      square.value.push_back(estimate.mean);
      square.blocks.push_back(estimate.blocks);
      if (estimate.blocks == 0)
        estimate = independent_average(particles, sum_[lag], sum_of_squares_[lag]);
      square.error.push_back(estimate.error);
    }
    return square;
  }

 private:
  std::vector<Lag> lags_;
  std::vector<std::vector<double>> per_origin_;  ///< summed over particles
  std::vector<double> sum_, sum_of_squares_;     ///< of the particles' means over origins
};

struct Group {
  Group(const std::string& name, const std::vector<Lag>& lags) : translation(lags), rotation(lags) {
    result.name = name;
  }
  DisplacementGroup result;
  SquareSum translation, rotation;
};

std::vector<Group> make_groups(const Configuration2& first, const std::vector<Lag>& lags) {
  std::vector<std::size_t> members(first.species_names.size());
  for (const std::int32_t species : first.species) ++members.at(species);
  std::vector<Group> groups;
  groups.emplace_back("all", lags);
  if (std::count_if(members.begin(), members.end(), [](std::size_t n) { return n > 0; }) > 1)
    for (const std::string& name : first.species_names) groups.emplace_back(name, lags);
  return groups;
}

/// The unwrapped path of one particle.
struct Track {
  std::vector<Vec2> position;
  std::vector<double> angle;
};

std::vector<Track> read_tracks(Trajectory& trajectory, std::size_t begin, std::size_t end) {
  const std::size_t samples = trajectory.frames();
  std::vector<Track> tracks(end - begin);
  for (Track& track : tracks) {
    track.position.resize(samples);
    track.angle.resize(samples);
  }
  for (std::size_t k = 0; k < samples; ++k) {
    const Configuration2& frame = trajectory.read(k);
    for (std::size_t i = begin; i < end; ++i) {
      tracks[i - begin].position[k] = frame.unwrapped(i);
      tracks[i - begin].angle[k] = frame.angle[i];
    }
  }
  return tracks;
}

template <class Square>
void squares_at(const Lag& lag, std::vector<double>& squares, Square&& square) {
  squares.resize(lag.origins);
  for (std::size_t k = 0; k < lag.origins; ++k) {
    const std::size_t origin = k * lag.stride;
    squares[k] = square(origin, origin + lag.frames);
  }
}

/// Adds one particle to all the groups it belongs to.
void add_track(const Track& track, bool rotor, const std::vector<Lag>& lags,
               const std::vector<Group*>& groups) {
  std::vector<double> squares;
  for (std::size_t l = 0; l < lags.size(); ++l) {
    squares_at(lags[l], squares, [&](std::size_t from, std::size_t to) {
      return (track.position[to] - track.position[from]).squaredNorm();
    });
    for (Group* group : groups) group->translation.add(l, squares);
    if (!rotor) continue;
    squares_at(lags[l], squares, [&](std::size_t from, std::size_t to) {
      const double turn = track.angle[to] - track.angle[from];
      return turn * turn;
    });
    for (Group* group : groups) group->rotation.add(l, squares);
  }
  for (Group* group : groups) {
    ++group->result.particles;
    if (rotor) ++group->result.rotors;
  }
}

std::size_t interpolation_start(const std::vector<double>& lag, double at) {
  const auto above = std::upper_bound(lag.begin() + 1, lag.end() - 1, at);
  return static_cast<std::size_t>(above - lag.begin()) - 1;
}

/// Mean square at a time difference between two lags, linearly in between, with the larger error.
Diffusion square_at(const std::vector<double>& lag, const MeanSquare& square, double at) {
  const std::size_t k = interpolation_start(lag, at);
  const double w = (at - lag[k]) / (lag[k + 1] - lag[k]);
  return {(1 - w) * square.value[k] + w * square.value[k + 1],
          std::max(square.error[k], square.error[k + 1])};
}

/// Diffusion coefficient from the slope between two time differences.
Diffusion slope(const std::vector<double>& lag, const MeanSquare& square, double from, double to,
                int dimension) {
  const Diffusion low = square_at(lag, square, from);
  const Diffusion high = square_at(lag, square, to);
  const double scale = 1 / (2 * dimension * (to - from));
  return {scale * (high.value - low.value), scale * std::hypot(low.error, high.error)};
}

}  // namespace

Displacements displacements(Trajectory& trajectory, const DisplacementOptions& options) {
  const std::vector<double>& times = trajectory.times();
  const std::size_t samples = times.size();
  if (samples < 2)
    throw UserError("displacements: the run holds " + std::to_string(samples) +
                    " frame(s); a displacement needs at least two");
  const std::vector<Lag> lags = time_axis(times, options.axis);

  const Configuration2 first = trajectory.read(0);
  std::vector<Group> groups = make_groups(first, lags);
  const std::size_t track_bytes = samples * (sizeof(Vec2) + sizeof(double));
  const std::size_t batch = std::max<std::size_t>(1, options.memory / track_bytes);
  for (std::size_t begin = 0; begin < first.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, first.size());
    const std::vector<Track> tracks = read_tracks(trajectory, begin, end);
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<Group*> members{&groups.front()};
      if (groups.size() > 1) members.push_back(&groups[1 + first.species[i]]);
      add_track(tracks[i - begin], !first.shape[i].is_round(), lags, members);
    }
  }

  Displacements result;
  for (const Lag& lag : lags) {
    result.lag.push_back(times[lag.frames] - times[0]);
    result.origins.push_back(lag.origins);
  }
  for (Group& group : groups) {
    if (group.result.particles == 0) continue;
    group.result.translation = group.translation.result(group.result.particles);
    group.result.rotation = group.rotation.result(group.result.rotors);
    result.groups.push_back(std::move(group.result));
  }
  return result;
}

double main_wave_number(const Configuration2& configuration) {
  const Vec2& lengths = configuration.box.lengths();
  const double density = static_cast<double>(configuration.size()) / (lengths.x() * lengths.y());
  return 2 * std::numbers::pi * std::sqrt(2 * density / std::sqrt(3.0));
}

Diffusion long_time_diffusion(const std::vector<double>& lag, const MeanSquare& square,
                              int dimension) {
  if (square.value.size() < 2 || lag.front() > lag.back() / 9) return {none, none};
  if (!(square.value.back() >= 1)) return {none, none};
  const double longest = lag.back();
  const Diffusion late = slope(lag, square, longest / 3, longest, dimension);
  const Diffusion early = slope(lag, square, longest / 9, longest / 3, dimension);
  const double change = std::abs(late.value - early.value);
  const double chance = 3 * std::hypot(late.error, early.error);
  if (!(change <= std::max(0.1 * late.value, chance))) return {none, none};
  return {late.value, std::max(late.error, change)};
}

}  // namespace vitrel
