#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random/stream.h"
#include "mc/hard_particles.h"
#include "mc/options.h"
#include "mc/sweep_state.h"

namespace vitrel {

/// Exchanges of places: particles swap positions and orientations if all then keep the hard-core margin. In polydisperse
/// systems this relaxes dense liquids many orders of magnitude faster than motion. All particles are ranked by volume,
/// equal ones by number.
///
/// **Two particles.** One of n ranked particles is picked at random, and a partner above or below it in rank by at most
/// the share `partners` of n/2, ranks counted round from the last to the first: with a share of 1, any other. Partners
/// close in size are accepted more often, and change less. An exchange and its reverse are proposed with the same
/// probability and accepted according to the hard states alone: detailed balance with respect to their uniform
/// distribution.
///
/// **Collective exchanges.** At each step the particles of ranks r and r + 1 exchange places if both then fit, and r rises
/// by one whether they did or not; from the last rank it passes to the first, without an exchange. Followed in space, a
/// place is given larger and larger particles until one does not fit; the place where that one stays is the next. A chain
/// is a fixed number of steps from a random rank.
///
/// Uniform sampling of all hard states: the map T_r of a step is its own inverse, since the exchange of two that have
/// exchanged restores a hard state, and two that cannot exchange stay. A chain T_{r+n−1} … T_{r+1} T_r is therefore a
/// bijection of the hard states, and the uniform distribution is invariant under it. It is not its own inverse: there is
/// balance, but no detailed balance, as in event chains.
///
/// If each particle fits into the next one in rank, a particle that fits into a place proves that all steps to it succeed:
/// those between are smaller, and the others only shrink. A search by doubling and bisection then finds the first step
/// that may fail, and the result is that of single steps. For round particles it follows from the distances.
///
/// Sources: berthier2016, ninarello2017; the collective exchanges are those of ghimenti2024, in steps.
template <int Dim>
class Exchanges {
 public:
  using Words = Stream::Block;
  using Index = typename HardParticles<Dim>::Index;

  /// The particles must outlive this object and keep their shapes.
  Exchanges(HardParticles<Dim>& particles, const ExchangeOptions& options);

  const ExchangeOptions& options() const { return options_; }

  /// Ranks the members of each domain, after the particles were arranged.
  void rank_domains();
  std::span<const Index> ranked_members(std::size_t domain) const {
    return {ranked_.data() + domain_begin_[domain], ranked_.data() + domain_begin_[domain + 1]};
  }

  /// A trial of two of these ranked particles.
  void try_two(std::span<const Index> ranked, const Words& words, ExchangeCounts& counts,
               OverlapTestCounts& tests);
  /// The trials of a sweep, of any two particles.
  void try_all(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests);

  /// The collective exchanges of a sweep: one chain.
  void run_chain(Stream& draw, ExchangeCounts& counts, OverlapTestCounts& tests);
  /// A chain of this number of steps from this rank.
  void run_chain(std::size_t rank, std::uint64_t steps, ExchangeCounts& counts,
                 OverlapTestCounts& tests);

 private:
  std::uint64_t per_sweep(double per_particle) const;
  const ParticleShape<Dim>& shape_of_rank(std::size_t rank) const;
  bool is_nested() const;
  std::size_t sure_steps(std::size_t rank, std::size_t most, OverlapTestCounts& tests);
  std::size_t sure_round_steps(std::size_t rank, std::size_t most) const;

  HardParticles<Dim>& particles_;
  ExchangeOptions options_;
  std::vector<Index> by_rank_;
  std::vector<double> radii_;  // by rank, if all are round
  bool nested_;
  std::size_t guess_ = 1;                  // of sure steps
  std::vector<Index> ranked_;              // domain by domain
  std::vector<std::size_t> domain_begin_;  // in ranked_
};

}  // namespace vitrel
