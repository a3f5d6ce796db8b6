#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "core/state/configuration.h"
#include "core/state/observer.h"
#include "edmd/options.h"

namespace vitrel {

class SoftContact;

/// Counters and sums since the start of a run.
struct RunCounters {
  std::uint64_t events = 0;  ///< events taken from the calendar
  std::uint64_t collisions = 0;
  std::uint64_t predictions = 0;   ///< pairs screened
  std::uint64_t searches = 0;      ///< pairs that the contact screen leaves undecided
  std::uint64_t steps = 0;         ///< steps along separating axes, over all searches
  std::uint64_t list_updates = 0;  ///< neighbour lists renewed because a particle left its own
  std::uint64_t correction_moves = 0;
  /// Soft collisions executed as hard ones because a neighbour blocks the rotation.
  std::uint64_t blocked_rotations = 0;
  std::uint64_t early_releases = 0;  ///< soft particles hit while in contact
  std::uint64_t integrations = 0;    ///< soft contacts that no table contains
  /// Σ J n·d over collisions, where d runs from centre to centre; soft contacts add an equivalent term
  /// (soft/soft_contact.h).
  double virial = 0;
  ShearElements helfand_moment = {};  ///< momentum_flux.h; hard particles only
  double dissipated = 0;              ///< energy lost in inelastic collisions
  std::uint64_t short_flights = 0;    ///< collisions that the contact-time model made elastic
  double spared = 0;                  ///< normal energy that the short flights would have lost
  /// Energy given to surfaces that would have stayed together.
  double added = 0;
  double supplied = 0;  ///< energy gained by kicks (brownian.h)

  /// Adds the counters that predictions change.
  void add_predictions(const RunCounters& other) {
    predictions += other.predictions;
    searches += other.searches;
    steps += other.steps;
  }
};

/// Event-driven dynamics of N hard bodies, or soft round ones, in a periodic box: the run-time interface of
/// Simulation<Body>.
///
/// Events run in blocks of a fixed count. If the bodies grow, a block also ends when the fastest surface may have moved
/// as far as the coordinates extend. `load` begins a block and derives all internal state from the configuration: a run
/// continued from a configuration written at the end of a block is bit-identical to the uninterrupted one. Virtual
/// calls are per block, sample or Brownian step, never per event.
template <int Dim>
class Engine {
 public:
  static constexpr double never = std::numeric_limits<double>::infinity();

  virtual ~Engine() = default;

  /// Begins a block from this configuration. Predictions end at `horizon`: another `load` or `set_velocities` must
  /// follow by that simulated time.
  virtual void load(const Configuration<Dim>& configuration, double horizon = never) = 0;

  enum class Stop { time, block_end };
  /// Processes events up to simulated time `until` ≤ horizon, or to the end of the block if that comes first.
  virtual Stop advance(double until, RunCounters& counters) = 0;

  /// Writes the current state of all particles into `configuration`, which must be the one loaded. Positions are
  /// wrapped; shapes are written if they grow. The state of the engine does not change.
  virtual void write(Configuration<Dim>& configuration) const = 0;

  /// Replaces all velocities at the current time; `horizon` means the same as for `load`.
  virtual void set_velocities(const Configuration<Dim>& configuration, double horizon,
                              RunCounters& counters) = 0;

  /// Returns the model and the reason why it is exact for this system, in one sentence.
  virtual std::string description() const = 0;
};

using Engine2 = Engine<2>;
using Engine3 = Engine<3>;

/// Makes an engine with the simplest model that is exact for the system: growing bodies if the growth rate is not 0;
/// disks (spheres) without orientation if all particles are round; otherwise ellipses (ellipsoids), whose round pairs
/// collide in closed form. Growing disks run as growing ellipses.
std::unique_ptr<Engine2> make_engine(const Configuration2& configuration,
                                     const EngineOptions& options);
std::unique_ptr<Engine3> make_engine(const Configuration3& configuration,
                                     const EngineOptions& options);

}  // namespace vitrel
