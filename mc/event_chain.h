#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/random/stream.h"
#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/lane_cells.h"
#include "mc/step_size.h"

namespace vitrel {

/// Straight event chains for hard ellipses, with local rotations. On one thread.
class EventChain {
 public:
  EventChain(Configuration2& configuration, std::uint64_t seed, std::uint64_t first_sweep = 0);

  struct Plan {
    double length = 10;           ///< of a chain
    std::uint64_t chains = 10;    ///< in a sweep
    std::uint64_t rotations = 0;  ///< in a sweep
  };
  void set_plan(const Plan& plan) { plan_ = plan; }
  const Plan& plan() const { return plan_; }

  void sweep();
  /// Adapts the rotation step towards an acceptance of 0.35.
  void tune();
  double rotation_step() const { return rotation_.size(); }

  struct Counts {
    std::uint64_t contacts = 0, crossings = 0, alone = 0;
    std::uint64_t rotations_tried = 0, rotations_accepted = 0;
    double length = 0, virial = 0;
  };
  const Counts& counts() const { return counts_; }
  /// Z = 1 + Σ d·e/length over the contacts, d between the centres, e the direction.
  double compressibility() const { return 1 + counts_.virial / counts_.length; }

 private:
  struct Path {
    double length;
    std::uint32_t next;
    double between;  // centres along the chain at the contact
  };
  struct Candidates;

  void arrange();
  template <int axis>
  void run_chain(std::size_t i);
  template <int axis>
  Path free_path_round(std::size_t i, double remaining) const;
  template <int axis>
  Path free_path(std::size_t i, double remaining);
  template <int axis>
  void advance(std::size_t i, double length);
  void rotate(std::size_t i, std::uint64_t word);
  bool clear_of_others(std::size_t i, const OverlapLook& look, const Vec2& position) const;

  Configuration2& configuration_;
  double largest_, largest_swing_, margin_;
  Vec2 half_box_;
  bool all_round_;
  std::vector<Vec2> axis_;
  std::optional<Checkerboard> board_;
  LaneCells cells_;
  LaneCells::Spare spare_{LaneCells::none};
  Plan plan_;
  StepSize rotation_{0.1};
  std::uint64_t seed_, sweep_;
  Counts counts_;
};

}  // namespace vitrel
