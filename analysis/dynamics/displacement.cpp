#include "analysis/dynamics/displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "analysis/dynamics/lag_sums.h"
#include "analysis/dynamics/tracks.h"
#include "core/error.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Tracks taken apart into phases at a time.
constexpr std::size_t paths_at_once = 16;

/// Particles of one species, or all of them.
struct Members {
  std::string name;
  std::size_t particles = 0, rotors = 0;
  std::vector<LagSums> sums;  ///< one per lag

  void make_room(const std::vector<Lag>& lags, const TrackQuantities& quantities) {
    for (const Lag& lag : lags) sums.emplace_back(lag, quantities, rotors > 0);
  }
};

std::vector<Members> species_of(const Configuration2& first) {
  std::vector<Members> species;
  for (const std::string& name : first.species_names) species.push_back({name, 0, 0, {}});
  for (std::size_t i = 0; i < first.size(); ++i) {
    Members& members = species.at(static_cast<std::size_t>(first.species[i]));
    ++members.particles;
    if (!first.shape[i].is_round()) ++members.rotors;
  }
  return species;
}

/// Sums of all particles from those of the species.
Members together(const std::vector<Members>& species, const std::vector<Lag>& lags,
                 const TrackQuantities& quantities) {
  Members all{"all", 0, 0, {}};
  for (const Members& members : species) {
    all.particles += members.particles;
    all.rotors += members.rotors;
  }
  all.make_room(lags, quantities);
  for (const Members& members : species)
    for (std::size_t l = 0; l < members.sums.size(); ++l) all.sums[l].add(members.sums[l]);
  return all;
}

/// One pass over all particles, a batch of tracks at a time.
class Pass {
 public:
  Pass(Trajectory& trajectory, const DisplacementOptions& options, const std::vector<Lag>& lags,
       const TrackQuantities& quantities, std::vector<Members>& species,
       const ProgressReport& report)
      : trajectory_(trajectory),
        threads_(options.threads),
        lags_(lags),
        quantities_(quantities),
        first_(trajectory.read(0)),
        species_(species),
        report_(report) {}

  void run(std::size_t batch) {
    for (std::size_t begin = 0; begin < first_.size(); begin += batch)
      add_batch(begin, std::min(begin + batch, first_.size()));
  }

 private:
  /// Reading a batch counts as much as summing it.
  void tell(std::size_t begin, std::size_t end, double part) const {
    const double done = static_cast<double>(begin) + static_cast<double>(end - begin) * part;
    if (report_) report_({done / static_cast<double>(first_.size()), done, "particles"});
  }

  void add_batch(std::size_t begin, std::size_t end) {
    const std::vector<Track> tracks =
        read_tracks(trajectory_, begin, end, [&](double read) { tell(begin, end, 0.5 * read); });
    for (std::size_t i = begin; i < end; i += paths_at_once) {
      add_paths(tracks, begin, i, std::min(i + paths_at_once, end));
      tell(begin, end,
           0.5 + 0.5 * static_cast<double>(i - begin) / static_cast<double>(end - begin));
    }
  }

  /// Threads share the lags, so that every sum adds up its particles in their order.
  void add_paths(const std::vector<Track>& tracks, std::size_t batch, std::size_t begin,
                 std::size_t end) {
    std::vector<std::optional<Path>> paths(end - begin);
    in_parallel(paths.size(), threads_, [&](std::size_t from, std::size_t to) {
      for (std::size_t p = from; p < to; ++p)
        paths[p].emplace(tracks[begin + p - batch], !first_.shape[begin + p].is_round(),
                         quantities_.orders);
    });
    in_parallel(lags_.size(), threads_, [&](std::size_t from, std::size_t to) {
      for (std::size_t l = from; l < to; ++l)
        for (std::size_t p = 0; p < paths.size(); ++p)
          species_[static_cast<std::size_t>(first_.species[begin + p])].sums[l].add(*paths[p]);
    });
  }

  Trajectory& trajectory_;
  int threads_;
  const std::vector<Lag>& lags_;
  const TrackQuantities& quantities_;
  const Configuration2 first_;
  std::vector<Members>& species_;
  const ProgressReport& report_;
};

void evaluate_rotation(DisplacementGroup& group, const LagSums::Rotation& sums, const Lag& lag) {
  const std::size_t n = group.rotors;
  group.parallel.push_back(sums.parallel.estimate(lag, n));
  group.perpendicular.push_back(sums.perpendicular.estimate(lag, n));
  group.rotation.push_back(sums.turn.square.estimate(lag, n));
  group.quartic_rotation.push_back(sums.turn.quartic.estimate(lag, n));
  group.non_gaussian_rotation.push_back(sums.turn.non_gaussian(1.0 / 3, lag, n));
  for (std::size_t j = 0; j < sums.orientation.size(); ++j)
    group.orientation[j].push_back(sums.orientation[j].estimate(lag, n));
}

DisplacementGroup evaluate(const Members& members, const std::vector<Lag>& lags,
                           const TrackQuantities& quantities) {
  DisplacementGroup group;
  group.name = members.name;
  group.particles = members.particles;
  group.rotors = members.rotors;
  group.self_scattering.resize(quantities.wave_numbers.size());
  if (group.rotors > 0) group.orientation.resize(quantities.orders.size());
  for (std::size_t l = 0; l < lags.size(); ++l) {
    const LagSums& sums = members.sums[l];
    const std::size_t n = group.particles;
    group.translation.push_back(sums.translation().square.estimate(lags[l], n));
    group.quartic.push_back(sums.translation().quartic.estimate(lags[l], n));
    group.non_gaussian.push_back(sums.translation().non_gaussian(1.0 / 2, lags[l], n));
    for (std::size_t j = 0; j < group.self_scattering.size(); ++j)
      group.self_scattering[j].push_back(sums.scattering()[j].estimate(lags[l], n));
    if (group.rotors > 0) evaluate_rotation(group, sums.rotation(), lags[l]);
  }
  return group;
}

}  // namespace

Displacements displacements(Trajectory& trajectory, const DisplacementOptions& options,
                            const ProgressReport& report) {
  const std::vector<double>& times = trajectory.times();
  if (times.size() < 2)
    throw UserError("displacements: the run holds " + std::to_string(times.size()) +
                    " frame(s); a displacement needs at least two");
  const std::vector<Lag> lags = time_axis(times, options.axis);
  const Configuration2& first = trajectory.read(0);
  const TrackQuantities quantities{wave_numbers_or_main(options.wave_numbers, first),
                                   options.orders,
                                   options.overlap_distance,
                                   {}};
  std::vector<Members> species = species_of(first);
  for (Members& members : species)
    if (members.particles > 0) members.make_room(lags, quantities);
  const std::size_t batch = options.memory / track_bytes(times.size());
  Pass(trajectory, options, lags, quantities, species, report).run(std::max<std::size_t>(1, batch));

  Displacements result;
  result.wave_numbers = quantities.wave_numbers;
  result.orders = quantities.orders;
  result.overlap_distance = quantities.overlap_distance;
  const Members all = together(species, lags, quantities);
  for (std::size_t l = 0; l < lags.size(); ++l) {
    result.lag.push_back(lags[l].time);
    result.origins.push_back(lags[l].origins);
    const CorrelationSum& overlap = all.sums[l].overlap();
    result.overlap.push_back(overlap.estimate(lags[l], all.particles));
    result.susceptibility.push_back(susceptibility(overlap, lags[l], all.particles));
  }
  result.groups.push_back(evaluate(all, lags, quantities));
  std::erase_if(species, [](const Members& members) { return members.particles == 0; });
  if (species.size() > 1)
    for (const Members& members : species)
      result.groups.push_back(evaluate(members, lags, quantities));
  return result;
}

double main_wave_number(const Configuration2& configuration) {
  const Vec2& lengths = configuration.box.lengths();
  const double density = static_cast<double>(configuration.size()) / (lengths.x() * lengths.y());
  return 2 * std::numbers::pi * std::sqrt(2 * density / std::sqrt(3.0));
}

std::vector<double> wave_numbers_or_main(std::vector<double> wanted,
                                         const Configuration2& configuration) {
  if (wanted.empty()) wanted = {main_wave_number(configuration)};
  return wanted;
}

}  // namespace vitrel
