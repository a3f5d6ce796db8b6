#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/state/configuration.h"
#include "mc/checkerboard.h"
#include "mc/simd_cells.h"
#include "mc/sweep_state.h"
#include "mc/trial.h"

namespace vitrel {

/// The particles of a configuration, sorted into the cells of a checkerboard, and the moves that change them: each is
/// made if all particles then keep the hard-core margin (hard_core.h) to each other, and otherwise leaves everything as
/// it is. Whoever proposes moves with the right probabilities samples hard states.
///
/// Cells have no capacity limit. Overlaps are decided by proofs (ellipse_overlap_batch.h, ellipsoid_overlap_batch.h)
/// that depend on the state only, to the rounding of the margin.
template <int Dim>
class HardParticles {
 public:
  using Body = OrientedBody<Dim>;
  using Cells = SimdCells<Dim>;
  using Cell = typename Checkerboard<Dim>::Cell;
  using Index = typename Cells::Index;
  using FreeList = typename Cells::FreeList;

  /// Gap, in margins, at which event chains stop: so far above one that rounding does not matter.
  static constexpr double contact_margins = 1.25;

  /// The configuration must be hard, with wrapped positions, and outlive this object. Meanwhile nothing else may move
  /// particles, or change shapes except to smaller ones.
  explicit HardParticles(Configuration<Dim>& configuration);

  /// Sorts all particles into cells, in the order of their numbers. Shapes must not have shrunk since construction.
  void arrange();
  /// The same, on this number of threads, with free groups for each domain: particles then may not leave their domain.
  void arrange_by_domain(int threads);

  Configuration<Dim>& configuration() { return configuration_; }
  const Configuration<Dim>& configuration() const { return configuration_; }
  Checkerboard<Dim>& board() { return *board_; }
  const Checkerboard<Dim>& board() const { return *board_; }
  Cells& cells() { return cells_; }
  const Cells& cells() const { return cells_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  double margin() const { return margin_; }
  /// The largest semi-axis of all.
  double largest() const { return largest_; }
  const Vec<Dim>& half_box() const { return half_box_; }
  /// The particles that a domain held when they were arranged by domain.
  std::span<const Index> members(std::size_t domain) const {
    return {order_.data() + domain_begin_[domain], order_.data() + domain_begin_[domain + 1]};
  }
  /// The free groups of a domain, or of all together (0).
  FreeList& free_list(std::size_t domain) { return free_lists_[domain]; }

  /// The body of particle i from where it is read fastest.
  decltype(auto) body_of(std::size_t i) const {
    if constexpr (Dim == 2)  // the cells hold it
      return cells_[cells_.group_index(i)].body(cells_.lane_of(i));
    else
      return (bodies_[i]);
  }

  /// Whether particle i keeps the margin to all others at this position in this cell. Its own images move along.
  bool is_clear_at(std::size_t i, const Vec<Dim>& position, const Cell& cell,
                   OverlapTestCounts& tests) const {
    return clear_of_others(*board_, cells_, i, body_of(i), bodies_, margin_, position, cell, tests);
  }
  /// Whether particle i would keep this margin to all others and its own images with this body, where it is.
  bool is_clear_as(std::size_t i, const Body& body, double margin, OverlapTestCounts& tests) const;

  /// If all particles are round: a radius with which particle i keeps the margin where it is, the largest one to rounding.
  double free_radius(std::size_t i) const;

  /// Moves particle i to a wrapped position in this cell, which has crossed the borders of the box so often.
  void move(std::size_t i, const Vec<Dim>& position, const Shift<Dim>& crossed, std::size_t cell,
            FreeList& free_list) {
    configuration_.position[i] = position;
    configuration_.image[i] += crossed;
    if (auto& group = cells_.group_of(i); group.cell == cell)
      group.move(cells_.lane_of(i), position);
    else
      change_cell(i, position, cell, free_list);
  }
  /// Turns particle i by an angle (the first component), in space by a vector in its own frame.
  bool try_turn(std::size_t i, const Vec<Dim>& turn, OverlapTestCounts& tests);
  /// Exchanges the positions and orientations of particles i and j; with domains, of one.
  bool try_exchange(std::size_t i, std::size_t j, OverlapTestCounts& tests);
  /// The same without a test.
  void exchange(std::size_t i, std::size_t j);
  /// Replaces the shape of particle i if it then keeps twice the margin to all others (twice, so that a later scaling of
  /// all lengths keeps the margin in spite of rounding).
  bool try_reshape(std::size_t i, const ParticleShape<Dim>& shape, OverlapTestCounts& tests);
  /// Scales the sides of the box and all positions by these factors; shapes and orientations stay. Tests every pair
  /// twice, on this number of threads.
  bool try_rescale(const Vec<Dim>& factors, int threads, OverlapTestCounts& tests);

 private:
  void sort();
  void fill_domain(std::size_t domain);
  void fit_box();
  void fit_board();
  void change_cell(std::size_t i, const Vec<Dim>& position, std::size_t cell, FreeList& free_list) {
    const Body body = body_of(i);
    cells_.remove(i, free_list);
    cells_.insert(i, cell, body, position, free_list);
  }
  bool fits(std::size_t i, OverlapTestCounts& tests) const;
  bool is_hard(int threads, OverlapTestCounts& tests) const;

  Configuration<Dim>& configuration_;
  const double smallest_;  // inradius
  double largest_, margin_;
  Vec<Dim> half_box_;
  double shortest_side_;
  std::vector<Body> bodies_;
  std::optional<Checkerboard<Dim>> board_;
  Cells cells_;
  std::vector<Index> order_;               // particles, domain by domain and cell by cell
  std::vector<Index> cell_of_;             // of every particle, while sorting
  std::vector<Index> begin_;               // of every cell in order_, while sorting
  std::vector<std::size_t> domain_begin_;  // of every domain in order_
  std::vector<FreeList> free_lists_;       // of every domain
};

}  // namespace vitrel
