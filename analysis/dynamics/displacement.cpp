#include "analysis/dynamics/displacement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "analysis/dynamics/lag_sums.h"
#include "analysis/dynamics/like_particles.h"
#include "analysis/dynamics/tracks.h"
#include "core/error.h"
#include "core/parallel.h"

namespace vitrel {

namespace {

/// Number of particles whose paths stay in the cache.
constexpr std::size_t paths_at_once = 16;

/// Particles of one species, or all of them.
template <int Dim>
struct Members {
  std::string name;
  std::size_t particles = 0, rotors = 0;
  std::vector<LagSums<Dim>> sums = {};  ///< one per lag

  void make_room(const std::vector<Lag>& lags, const TrackQuantities<Dim>& quantities,
                 std::size_t classes) {
    for (const Lag& lag : lags) sums.emplace_back(lag, quantities, rotors > 0, classes);
  }
};

template <int Dim>
std::vector<Members<Dim>> species_of(const Configuration<Dim>& first) {
  std::vector<Members<Dim>> species;
  for (const std::string& name : first.species_names) species.push_back({name});
  for (std::size_t i = 0; i < first.size(); ++i) {
    Members<Dim>& members = species.at(static_cast<std::size_t>(first.species[i]));
    ++members.particles;
    if (!first.shape[i].is_round()) ++members.rotors;
  }
  return species;
}

/// Returns the sums of all particles from those of the species.
template <int Dim>
Members<Dim> together(const std::vector<Members<Dim>>& species, const std::vector<Lag>& lags,
                      const TrackQuantities<Dim>& quantities, std::size_t classes) {
  Members<Dim> all{"all"};
  for (const Members<Dim>& members : species) {
    all.particles += members.particles;
    all.rotors += members.rotors;
  }
  all.make_room(lags, quantities, classes);
  for (const Members<Dim>& members : species)
    for (std::size_t l = 0; l < members.sums.size(); ++l) all.sums[l].add(members.sums[l]);
  return all;
}

/// One pass over all particles, a batch of tracks at a time.
template <int Dim>
class Pass {
 public:
  Pass(Trajectory<Dim>& trajectory, const DisplacementOptions& options,
       const std::vector<Lag>& lags, const TrackQuantities<Dim>& quantities,
       const LikeParticles& alike, std::vector<Members<Dim>>& species, const ProgressReport& report)
      : trajectory_(trajectory),
        threads_(options.threads),
        lags_(lags),
        quantities_(quantities),
        alike_(alike),
        first_(trajectory.read_places(0)),
        species_(species),
        report_(report) {}

  void run(std::size_t batch) {
    for (std::size_t begin = 0; begin < first_.size(); begin += batch)
      add_batch(begin, std::min(begin + batch, first_.size()));
  }
  /// Returns the largest turn of any particle between two frames.
  double largest_turn() const { return largest_turn_; }

 private:
  /// Reports progress. Reading a batch counts as much as summing it.
  void tell(std::size_t begin, std::size_t end, double part) const {
    const double done = static_cast<double>(begin) + static_cast<double>(end - begin) * part;
    if (report_) report_({done / static_cast<double>(first_.size()), done, "particles"});
  }

  void add_batch(std::size_t begin, std::size_t end) {
    std::vector<Track<Dim>> tracks =
        read_tracks(trajectory_, begin, end, [&](double read) { tell(begin, end, 0.5 * read); });
    for (std::size_t i = begin; i < end; i += paths_at_once) {
      const std::size_t next = std::min(i + paths_at_once, end);
      add_paths(tracks, begin, i, next);
      tell(begin, end,
           0.5 + 0.5 * static_cast<double>(next - begin) / static_cast<double>(end - begin));
    }
  }

  /// Threads share the lags, so that every sum adds up its particles in their order.
  void add_paths(std::vector<Track<Dim>>& tracks, std::size_t batch, std::size_t begin,
                 std::size_t end) {
    std::vector<std::optional<Path<Dim>>> paths(end - begin);
    const std::size_t stride = lags_.empty() ? 1 : std::max<std::size_t>(1, lags_.front().stride);
    each_in_parallel(paths.size(), threads_, [&](std::size_t p) {
      paths[p].emplace(std::move(tracks[begin + p - batch]), first_.shape[begin + p],
                       quantities_.axes, stride);
    });
    for (const auto& path : paths) largest_turn_ = std::max(largest_turn_, path->largest_turn);
    each_in_parallel(lags_.size(), threads_, [&](std::size_t l) {
      for (std::size_t p = 0; p < paths.size(); ++p)
        species_[static_cast<std::size_t>(first_.species[begin + p])].sums[l].add(
            *paths[p], alike_.class_of[begin + p]);
    });
  }

  Trajectory<Dim>& trajectory_;
  int threads_;
  const std::vector<Lag>& lags_;
  const TrackQuantities<Dim>& quantities_;
  const LikeParticles& alike_;
  const Configuration<Dim> first_;
  std::vector<Members<Dim>>& species_;
  const ProgressReport& report_;
  double largest_turn_ = 0;
};

template <int Dim>
void evaluate_rotation(DisplacementGroup& group, const LagSums<Dim>& all_sums, const Lag& lag) {
  const typename LagSums<Dim>::Rotation& sums = all_sums.rotation();
  const std::size_t n = group.rotors;
  for (std::size_t j = 0; j < group.orientation.size(); ++j)
    group.orientation[j].push_back(sums.orientation[j].estimate_of_decay(lag, n));
  if (!all_sums.parts().displacement) return;
  group.parallel.push_back(sums.parallel.estimate(lag, n));
  group.perpendicular.push_back(sums.perpendicular.estimate(lag, n));
  group.rotation.push_back(sums.turn.square.estimate(lag, n));
  group.quartic_rotation.push_back(sums.turn.quartic.estimate(lag, n));
  group.non_gaussian_rotation.push_back(
      sums.turn.non_gaussian(LagSums<Dim>::normal_rotation, lag, n));
}

template <int Dim>
DisplacementGroup evaluate(const Members<Dim>& members, const std::vector<Lag>& lags,
                           const TrackQuantities<Dim>& quantities) {
  DisplacementGroup group;
  group.name = members.name;
  group.particles = members.particles;
  group.rotors = members.rotors;
  if (quantities.parts.scattering) group.self_scattering.resize(quantities.wave_numbers.size());
  if (group.rotors > 0 && quantities.parts.orientation)
    group.orientation.resize(quantities.axes * quantities.orders.size());
  for (std::size_t l = 0; l < lags.size(); ++l) {
    const LagSums<Dim>& sums = members.sums[l];
    const std::size_t n = group.particles;
    for (std::size_t j = 0; j < group.self_scattering.size(); ++j)
      group.self_scattering[j].push_back(sums.scattering()[j].estimate_of_decay(lags[l], n));
    if (group.rotors > 0) evaluate_rotation(group, sums, lags[l]);
    if (!quantities.parts.displacement) continue;
    group.translation.push_back(sums.translation().square.estimate(lags[l], n));
    group.quartic.push_back(sums.translation().quartic.estimate(lags[l], n));
    group.non_gaussian.push_back(
        sums.translation().non_gaussian(LagSums<Dim>::normal_translation, lags[l], n));
  }
  return group;
}

/// Returns the curves of the frames begin … end − 1 alone, for an evenly sampled run.
template <int Dim>
HalfOfRun evaluate_half(const Members<Dim>& all, const std::vector<Lag>& lags, double longest_lag,
                        std::size_t begin, std::size_t end) {
  HalfOfRun half;
  for (std::size_t l = 0; l < lags.size(); ++l) {
    const Lag& lag = lags[l];
    if (static_cast<double>(lag.frames) >
        std::max(1.0, longest_lag * static_cast<double>(end - begin - 1)))
      break;
    const std::size_t from = (begin + lag.stride - 1) / lag.stride;
    const std::size_t to = std::min((end - lag.frames - 1) / lag.stride + 1, lag.origins);
    if (to <= from) break;
    const LagSums<Dim>& sums = all.sums[l];
    half.lag.push_back(lag.time);
    const auto add_all = [&](std::vector<Correlation>& curves,
                             const std::vector<CorrelationSum>& of, std::size_t n) {
      curves.resize(of.size());
      for (std::size_t j = 0; j < of.size(); ++j)
        curves[j].push_back(of[j].of_origins(from, to).estimate_of_decay(lag, n));
    };
    if (sums.parts().displacement)
      half.translation.push_back(
          sums.translation().square.of_origins(from, to).estimate(lag, all.particles));
    add_all(half.self_scattering, sums.scattering(), all.particles);
    if (all.rotors > 0) add_all(half.orientation, sums.rotation().orientation, all.rotors);
  }
  return half;
}

void forget_rotation(DisplacementGroup& group) {
  group.rotation = group.quartic_rotation = group.non_gaussian_rotation = {};
}

std::vector<double> orders_or_default(std::vector<double> given, int dimension) {
  if (given.empty()) given = dimension == 2 ? std::vector{2.0, 4.0} : std::vector{1.0, 2.0};
  return given;
}

}  // namespace

template <int Dim>
Displacements displacements(Trajectory<Dim>& trajectory, const DisplacementOptions& options,
                            const ProgressReport& report) {
  const std::vector<double>& times = trajectory.times();
  if (times.size() < 2)
    throw UserError("displacements: the run holds " + std::to_string(times.size()) +
                    " frame(s); a displacement needs at least two");
  const Configuration<Dim>& first = trajectory.read_places(0);
  TimeAxisOptions axis = options.axis;
  axis.max_origins = origins_for(first.size(), axis.max_origins);
  const std::vector<Lag> lags = time_axis_of_motion(trajectory, axis);
  const TrackQuantities<Dim> quantities{wave_numbers_or_main(options.wave_numbers, first),
                                        orders_or_default(options.orders, Dim), axis_count(first),
                                        options.overlap_distance, options.parts};
  std::vector<Members<Dim>> species = species_of(first);
  const LikeParticles alike = like_particles(first);
  for (Members<Dim>& members : species)
    if (members.particles > 0) members.make_room(lags, quantities, alike.classes);
  const std::size_t batch = options.memory / track_bytes<Dim>(times.size());
  Pass<Dim> pass(trajectory, options, lags, quantities, alike, species, report);
  const MotionParts& parts = options.parts;
  if (parts.displacement || parts.scattering || parts.orientation || parts.overlap)
    pass.run(std::max<std::size_t>(1, batch));

  Displacements result;
  result.dimension = Dim;
  result.parts = options.parts;
  result.wave_numbers = quantities.wave_numbers;
  result.orders = quantities.orders;
  result.axes = quantities.axes;
  result.overlap_distance = quantities.overlap_distance;
  const Members<Dim> all = together(species, lags, quantities, alike.classes);
  for (std::size_t l = 0; l < lags.size(); ++l) {
    result.lag.push_back(lags[l].time);
    result.origins.push_back(lags[l].origins);
    if (!options.parts.overlap) continue;
    const CorrelationSum& overlap = all.sums[l].overlap();
    result.overlap.push_back(overlap.estimate(lags[l], all.particles));
    result.susceptibility.push_back(susceptibility(overlap, lags[l], all.particles));
  }
  result.groups.push_back(evaluate(all, lags, quantities));
  if (const std::size_t middle = times.size() / 2; middle >= 2 && evenly_spaced(times))
    for (const auto& [begin, end] : {std::pair(std::size_t{0}, middle), {middle, times.size()}})
      result.halves.push_back(evaluate_half(all, lags, options.axis.longest_lag, begin, end));
  std::erase_if(species, [](const Members<Dim>& members) { return members.particles == 0; });
  if (species.size() > 1)
    for (const Members<Dim>& members : species)
      result.groups.push_back(evaluate(members, lags, quantities));
  if (!turns_are_known(pass.largest_turn())) {
    result.unknown_turns =
        "some particles turn by about half a turn (directors: a quarter) between two frames, which "
        "cannot be told from a turn the other way; sample more often";
    for (DisplacementGroup& group : result.groups) forget_rotation(group);
  }
  return result;
}

template <int Dim>
double main_wave_number(const Configuration<Dim>& configuration) {
  using std::numbers::pi;
  const double density = static_cast<double>(configuration.size()) / configuration.box.volume();
  return Dim == 2 ? 2 * pi * std::sqrt(2 * density / std::sqrt(3.0))
                  : 2 * pi * std::sqrt(3.0) * std::cbrt(density / 4);
}

template Displacements displacements(Trajectory2&, const DisplacementOptions&,
                                     const ProgressReport&);
template Displacements displacements(Trajectory3&, const DisplacementOptions&,
                                     const ProgressReport&);
template double main_wave_number(const Configuration2&);
template double main_wave_number(const Configuration3&);

}  // namespace vitrel
