#pragma once

#include <cstdint>
#include <vector>

#include "core/neighbors/cell_grid.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "core/state/stage.h"

namespace vitrel {

/// Monte Carlo of hard ellipses at constant N, box and temperature (Metropolis et al., 1953).
///
/// One sweep is N trials. A trial picks a particle at random and, if it is not round, translation
/// or rotation with equal chance; the displacement is uniform in a square of half side
/// `translation`, the turn uniform within ± `rotation`. It is accepted if the particle then keeps
/// the hard margin (disjoint.h) to all others. Trial k of sweep s draws from the stream (seed,
/// trial_moves, s, k). The proposal is symmetric, so detailed balance holds for fixed step sizes;
/// they change only in `tune`, which belongs to equilibration.
class Sampler {
 public:
  /// The configuration must be hard, with wrapped positions, and outlive the sampler; nobody else
  /// may move particles meanwhile, nor change shapes but to smaller ones.
  Sampler(Configuration2& configuration, std::uint64_t seed, std::uint64_t first_sweep = 0);

  void sweep();

  /// Adapts both step sizes towards an acceptance of 0.35, by the trials since the last adaptation;
  /// waits for more if they are too few to tell.
  void tune();

  /// Gives particle i another shape where it is, if it then keeps twice the hard margin to all
  /// others (twice, so that scaling all lengths afterwards cannot cost it the margin by rounding).
  bool reshape(std::size_t i, const Ellipse& shape);

  double translation_step() const { return translation_; }
  double rotation_step() const { return rotation_; }
  void set_steps(double translation, double rotation);

  /// The number of the next sweep.
  std::uint64_t next_sweep() const { return sweep_; }
  /// Trials and acceptances since construction.
  const StageReport& counts() const { return counts_; }

 private:
  void translate(std::size_t i, Stream& draw);
  void rotate(std::size_t i, Stream& draw);
  bool clear_of_others(std::size_t i, const Ellipse& shape, const Vec2& position, const Vec2& axis,
                       double margin) const;

  Configuration2& configuration_;
  CellGrid<> cells_;
  std::vector<Vec2> axis_;  // unit major axes
  double largest_, margin_;
  double translation_, rotation_;
  std::uint64_t seed_, sweep_;
  StageReport counts_, tuned_at_;
};

}  // namespace vitrel
