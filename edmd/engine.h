#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <memory>

#include "core/state/configuration.h"

namespace vitrel {

class SoftContact;

/// What to do with a pair found overlapping: a hard run never produces one, so `stop` throws
/// InvariantError; `correct` applies the thesis's correction move (collision_rule.h) and counts it.
enum class OnOverlap { stop, correct };

/// Whether a soft particle that is hit while in contact is released from it alone, or together with its
/// partner (soft/soft_contact.h).
enum class EarlyRelease { alone, together };

struct EngineOptions {
  double restitution = 1;
  OnOverlap on_overlap = OnOverlap::stop;
  /// From `load` on all semi-axes are those loaded times 1 + growth_rate · time. Masses are constant,
  /// moments of inertia those of the axes at the time, angular velocities constant in flight.
  double growth_rate = 0;
  /// If given, the particles are soft: round, not growing. `restitution` is then of no effect.
  std::shared_ptr<SoftContact> soft_contact;
  EarlyRelease early_release = EarlyRelease::alone;
  /// For predictions that are made all at once; results do not depend on it.
  int threads = 1;
};

/// Counts and sums over everything since the start of a run.
struct RunCounters {
  std::uint64_t events = 0;  ///< everything taken from the calendar
  std::uint64_t collisions = 0;
  std::uint64_t predictions = 0;   ///< pairs asked about
  std::uint64_t searches = 0;      ///< of these, pairs that the first look did not settle
  std::uint64_t steps = 0;         ///< steps along separating axes, over all searches
  std::uint64_t list_updates = 0;  ///< neighbour lists renewed because a particle left its own
  std::uint64_t correction_moves = 0;
  std::uint64_t blocked_rotations =
      0;                             ///< soft collisions as of hard particles, without room to turn
  std::uint64_t early_releases = 0;  ///< soft particles hit while in contact
  std::uint64_t integrations = 0;    ///< contacts that no table had, or where there is none
  /// Σ J n·d over collisions, d from centre to centre; of soft contacts what takes its place
  /// (soft/soft_contact.h).
  double virial = 0;
  double dissipated = 0;  ///< energy lost in inelastic collisions

  /// Adds the counts that predictions make.
  void add_predictions(const RunCounters& other) {
    predictions += other.predictions;
    searches += other.searches;
    steps += other.steps;
  }
};

/// Event-driven dynamics of N hard bodies, or soft round ones, in a periodic box: the run-time face
/// of Simulation<Body>.
///
/// Events run in blocks of a fixed count, or of the time in which the fastest particle crosses half
/// the box. `load` begins a block: everything the engine knows is derived anew from the
/// configuration, so that a run continued from a configuration written at a block's end equals the
/// uninterrupted one bit by bit. Virtual calls are per block, sample or Brownian step, never per
/// event.
template <int Dim>
class Engine {
 public:
  static constexpr double never = std::numeric_limits<double>::infinity();

  virtual ~Engine() = default;

  /// Begins a block from this configuration. Predictions do not look past `horizon`: no later than
  /// at that simulated time comes another `load`, or `set_velocities`.
  virtual void load(const Configuration<Dim>& configuration, double horizon = never) = 0;

  enum class Stop { time, block_end };
  /// Processes events up to simulated time `until`, no later than the horizon, or to the end of the
  /// block if that comes first.
  virtual Stop advance(double until, RunCounters& counters) = 0;

  /// Writes all particles as of now into `configuration` (positions wrapped; shapes, if they grow),
  /// which otherwise must be the one loaded. The engine's own state does not change.
  virtual void write(Configuration<Dim>& configuration) const = 0;

  /// Replaces all velocities, at the present time; `horizon` as for `load`.
  virtual void set_velocities(const Configuration<Dim>& configuration, double horizon,
                              RunCounters& counters) = 0;

  /// Which model runs and why it is exact for this scene, in one sentence.
  virtual std::string description() const = 0;
};

using Engine2 = Engine<2>;
using Engine3 = Engine<3>;

/// The simplest model that is exact for the scene. Growing bodies if there is growth, otherwise static
/// ones; disks (spheres) without orientation if every particle is round, otherwise ellipses (ellipsoids;
/// a round pair among them meets in closed form). Growing disks run as growing ellipses.
std::unique_ptr<Engine2> make_engine(const Configuration2& configuration,
                                     const EngineOptions& options);
std::unique_ptr<Engine3> make_engine(const Configuration3& configuration,
                                     const EngineOptions& options);

}  // namespace vitrel
