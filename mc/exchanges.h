#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/random/stream.h"
#include "mc/hard_particles.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Exchanges of places: particles swap positions and orientations if all then keep the hard-core margin. In
/// polydisperse systems this relaxes dense liquids many orders of magnitude faster than motion. All particles are
/// ranked by volume, and those of equal volume by number.
///
/// **Two particles.** One of n ranked particles is picked at random, and a partner above or below it in rank by at most
/// the share `partners` of n/2. Ranks are cyclic, so a share of 1 allows any other particle. Partners close in size are
/// accepted more often, and change less. An exchange and its reverse are proposed with the same probability and
/// accepted according to the hard states alone, so detailed balance holds with respect to their uniform distribution.
///
/// **Collective exchanges.** At each step the particles of ranks r and r + 1 exchange places if both then fit, and r
/// rises by one whether they did or not; from the last rank it passes to the first, without an exchange. Seen in space,
/// a place is given larger and larger particles until one does not fit; the place where that one stays is the next to
/// be given larger ones. A chain is a fixed number of steps from a random rank.
///
/// All hard states are sampled uniformly, for the following reason. The map T_r of a step is its own inverse, since a
/// second exchange of two particles that have exchanged restores a hard state, and two that cannot exchange stay. A
/// chain T_{r+n−1} … T_{r+1} T_r is therefore a bijection of the hard states, and the uniform distribution is invariant
/// under it. The chain is not its own inverse: there is balance, but no detailed balance, as in event chains.
///
/// If each particle fits into the next one in rank, many steps can be proved at once: a particle that fits into a place
/// proves that all steps to it succeed, because the particles between are smaller and all other places receive smaller
/// particles than before. A search by doubling and bisection then finds the first step that may fail, and the result is
/// that of single steps. For round particles that step follows from the distances.
///
/// Sources: berthier2016, ninarello2017, and ghimenti2024, whose collective exchanges are made here in steps.
template <class Shape>
class Exchanges {
 public:
  static constexpr int Dim = Shape::dimension;
  using Words = Stream::Block;
  using Index = typename HardParticles<Shape>::Index;

  /// The particles must outlive this object and keep their shapes.
  Exchanges(HardParticles<Shape>& particles, const ExchangeOptions& options);

  const ExchangeOptions& options() const { return options_; }

  /// Ranks the members of each domain; to be called after the particles have been arranged.
  void rank_domains();
  std::span<const Index> ranked_members(std::size_t domain) const {
    return {ranked_.data() + domain_begin_[domain], ranked_.data() + domain_begin_[domain + 1]};
  }

  /// Tries to exchange two of these ranked particles.
  void try_two(std::span<const Index> ranked, const Words& words, ExchangeCounts& counts,
               OverlapTestCounts& tests);
  /// Makes the trials of a sweep, each with any two particles.
  void try_all(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests);

  /// Makes the collective exchanges of a sweep: one chain.
  void run_chain(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests);
  /// Makes a chain of this number of steps from this rank.
  void run_chain(std::size_t rank, std::uint64_t steps, ExchangeCounts& counts,
                 OverlapTestCounts& tests);

 private:
  std::uint64_t per_sweep(double per_particle) const;
  const ParticleShape<Dim>& shape_of_rank(std::size_t rank) const;
  bool is_nested() const;
  std::size_t sure_steps(std::size_t rank, std::size_t most, OverlapTestCounts& tests);
  std::size_t sure_round_steps(std::size_t rank, std::size_t most) const;

  HardParticles<Shape>& particles_;
  ExchangeOptions options_;
  std::vector<Index> by_rank_;
  std::vector<double> radii_;  // by rank, if all are round
  bool nested_;
  std::size_t guess_ = 1;                  // guess of the number of sure steps
  std::vector<Index> ranked_;              // ranked members, domain by domain
  std::vector<std::size_t> domain_begin_;  // begin of each domain in ranked_
};

template <class Shape>
Exchanges<Shape>::Exchanges(HardParticles<Shape>& particles, const ExchangeOptions& options)
    : particles_(particles), options_(options), by_rank_(particles.configuration().size()) {
  const auto& shapes = particles.configuration().shape;
  std::iota(by_rank_.begin(), by_rank_.end(), Index{0});
  std::ranges::stable_sort(by_rank_, {}, [&](Index i) { return shapes[i].volume(); });
  nested_ = is_nested();
  if (std::ranges::all_of(shapes, [](const auto& shape) { return shape.is_round(); }))
    for (std::size_t rank = 0; rank < by_rank_.size(); ++rank)
      radii_.push_back(shape_of_rank(rank).circumradius());
}

template <class Shape>
auto Exchanges<Shape>::shape_of_rank(std::size_t rank) const -> const ParticleShape<Dim>& {
  return particles_.configuration().shape[by_rank_[rank]];
}

template <class Shape>
bool Exchanges<Shape>::is_nested() const {
  for (std::size_t rank = 1; rank < by_rank_.size(); ++rank)
    if (!shape_of_rank(rank - 1).fits_into(shape_of_rank(rank))) return false;
  return true;
}

template <class Shape>
std::uint64_t Exchanges<Shape>::per_sweep(double per_particle) const {
  return static_cast<std::uint64_t>(
      std::llround(per_particle * static_cast<double>(by_rank_.size())));
}

template <class Shape>
void Exchanges<Shape>::rank_domains() {
  const Checkerboard<Dim>& board = particles_.board();
  domain_begin_.assign(1, 0);
  for (std::size_t domain = 0; domain < board.domains(); ++domain)
    domain_begin_.push_back(domain_begin_.back() + particles_.members(domain).size());
  std::vector<std::size_t> next(domain_begin_.begin(), domain_begin_.end() - 1);
  ranked_.resize(by_rank_.size());
  for (const Index i : by_rank_) {
    const Vec<Dim>& position = particles_.configuration().position[i];
    ranked_[next[board.domain_of(board.cell_of(position))]++] = i;
  }
}

template <class Shape>
void Exchanges<Shape>::try_two(std::span<const Index> ranked, const Words& words,
                               ExchangeCounts& counts, OverlapTestCounts& tests) {
  const std::size_t n = ranked.size();
  if (n < 2) return;
  const auto farthest = static_cast<std::size_t>(options_.partners * static_cast<double>(n / 2));
  const std::size_t first = pick(words[0], n);
  const std::size_t distance = 1 + pick(words[1], std::max<std::size_t>(1, farthest));
  const std::size_t second = (first + ((words[2] & 1) == 0 ? distance : n - distance)) % n;
  const std::size_t i = ranked[first], j = ranked[second];
  const auto& shapes = particles_.configuration().shape;
  if (shapes[i] == shapes[j]) return;
  ++counts.tried;
  counts.accepted += particles_.try_exchange(i, j, tests);
}

template <class Shape>
void Exchanges<Shape>::try_all(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests) {
  for (std::uint64_t trial = per_sweep(options_.trials); trial > 0; --trial) {
    Words words;
    draw.fill({&words, 1});
    try_two(by_rank_, words, counts, tests);
  }
}

template <class Shape>
void Exchanges<Shape>::run_chain(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests) {
  const std::uint64_t steps = per_sweep(options_.collective);
  if (steps > 0) run_chain(draw.below(by_rank_.size()), steps, counts, tests);
}

template <class Shape>
void Exchanges<Shape>::run_chain(std::size_t rank, std::uint64_t steps, ExchangeCounts& counts,
                                 OverlapTestCounts& tests) {
  const std::size_t last = by_rank_.size() - 1;
  counts.steps += steps;
  guess_ = 1;
  while (steps > 0) {
    if (rank == last) {
      rank = 0;
      --steps;
      continue;
    }
    const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(steps, last - rank));
    const std::size_t sure = sure_steps(rank, most, tests);
    for (std::size_t k = 0; k < sure; ++k, ++rank)
      particles_.exchange(by_rank_[rank], by_rank_[rank + 1]);
    steps -= sure;
    counts.accepted_steps += sure;
    if (sure == most) continue;
    counts.accepted_steps += particles_.try_exchange(by_rank_[rank], by_rank_[rank + 1], tests);
    ++rank;
    --steps;
  }
}

/// Returns a number of steps, up to `most`, that certainly succeed one after the other.
template <class Shape>
std::size_t Exchanges<Shape>::sure_steps(std::size_t rank, std::size_t most,
                                         OverlapTestCounts& tests) {
  if (!nested_) return 0;
  if (!radii_.empty()) return sure_round_steps(rank, most);
  const std::size_t active = by_rank_[rank];
  const auto& body = particles_.bodies()[active];
  const auto succeed = [&](std::size_t steps) {
    return particles_.is_clear_as(active, with_shape(body, Shape(shape_of_rank(rank + steps))),
                                  particles_.margin(), tests);
  };
  std::size_t sure = 0, not_sure = most + 1;
  for (std::size_t tried = std::min(guess_, most); sure < most && not_sure > most;
       tried = std::min(2 * tried, most))
    (succeed(tried) ? sure : not_sure) = tried;
  while (not_sure - sure > 1) {
    const std::size_t middle = std::midpoint(sure, not_sure);
    (succeed(middle) ? sure : not_sure) = middle;
  }
  guess_ = std::max<std::size_t>(1, sure);
  return sure;
}

template <class Shape>
std::size_t Exchanges<Shape>::sure_round_steps(std::size_t rank, std::size_t most) const {
  const auto own = radii_.begin() + static_cast<std::ptrdiff_t>(rank);
  const auto first_too_large = std::upper_bound(
      own + 1, own + 1 + static_cast<std::ptrdiff_t>(most), particles_.free_radius(by_rank_[rank]));
  return static_cast<std::size_t>(first_too_large - own) - 1;
}

extern template class Exchanges<ParticleShape<2>>;
extern template class Exchanges<ParticleShape<3>>;

}  // namespace vitrel
