#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "edmd/collision_executor.h"
#include "edmd/soft/soft_contact.h"

/// The collisions of soft particles in the event loop (soft/soft_contact.h). They are a policy, which is compiled for
/// disks and spheres only.
namespace vitrel {

/// The policy of bodies that are always hard.
template <Body B>
class NoSoftContacts {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;

  NoSoftContacts(State&, const EngineOptions&) {}

  static constexpr bool is_active() { return false; }
  void load(const Configuration<B::dimension>&) {}
  void write(Configuration<B::dimension>&) const {}
  static constexpr double release_time(Index) { return State::never; }
  void reset_clocks(double) {}
  void release(Index) {}
  static bool is_close_pair(Index, const typename State::Image&) { return false; }
  const std::vector<Index>& collide_pair(Index, const Event<B>&, CollisionExecutor<B>&,
                                         RunCounters&) {
    return none_;
  }

 private:
  std::vector<Index> none_;
};

/// Pending releases and close pairs of soft disks or spheres, if the options enable soft contacts.
template <Body B>
class SoftContacts {
 public:
  using State = SimulationState<B>;
  using Index = typename State::Index;
  using Vector = typename State::Vector;
  using Image = typename State::Image;
  static constexpr int dimension = State::dimension;

  SoftContacts(State& state, const EngineOptions& options) : state_(state), options_(options) {}

  bool is_active() const { return are_soft(options_); }
  void load(const Configuration<dimension>& configuration);
  void write(Configuration<dimension>& configuration) const;

  /// Returns the time when a particle in contact takes its velocity after the contact.
  double release_time(Index i) const { return is_active() ? releases_[i].time : State::never; }
  void release(Index i);
  /// Sets the release times back by `elapsed`, as SimulationState::reset_clocks does.
  void reset_clocks(double elapsed) {
    for (Release& release : releases_) release.time -= elapsed;
  }

  /// Returns whether the pair is separating but still closer than the sum of its radii.
  bool is_close_pair(Index i, const Image& partner) const {
    return is_active() && close_pairs_.contains(unwrapped_pair(i, partner).ascending());
  }

  /// Executes the collision of i with the partner of its event. Returns the particles to predict again.
  const std::vector<Index>& collide_pair(Index i, const Event<B>& event,
                                         CollisionExecutor<B>& executor, RunCounters& counters);

 private:
  /// These are fractions of the largest speed. Particles that approach more slowly than the first, in a grazing
  /// contact, do not collide but separate at the second. Both are far above the rounding of velocities and far below
  /// physical relevance.
  static constexpr double grazing_speed = 1e-12, separation_speed = 1e-13;

  /// The pending release of a particle in contact.
  struct Release {
    double time = State::never;
    Index partner = 0;
    Vector velocity;
  };
  /// A pair independent of periodic wrapping: `unwrapped_shift` is the shift between unwrapped positions.
  struct UnwrappedPair {
    Index i, j;
    Shift<dimension> unwrapped_shift;

    /// Returns the pair in ascending order; the particles must be distinct.
    UnwrappedPair ascending() const {
      return i < j ? *this : UnwrappedPair{j, i, -unwrapped_shift};
    }
    friend bool operator==(const UnwrappedPair&, const UnwrappedPair&) = default;
    friend bool operator<(const UnwrappedPair& one, const UnwrappedPair& two) {
      if (one.i != two.i || one.j != two.j)
        return std::pair(one.i, one.j) < std::pair(two.i, two.j);
      return std::ranges::lexicographical_compare(one.unwrapped_shift, two.unwrapped_shift);
    }
  };

  bool in_contact(Index i) const { return releases_[i].time < State::never; }
  UnwrappedPair unwrapped_pair(Index i, const Image& partner) const {
    return {i, partner.other, partner.shift() + state_.image[i] - state_.image[partner.other]};
  }
  double sum_of_radii(Index i, Index j) const {
    return state_.shape(i).circumradius() + state_.shape(j).circumradius();
  }
  ContactPair contact_pair_of(Index i, Index j) const {
    return contact_pair(state_.shape(i).circumradius(), 1 / state_.type(i).inertia.inverse_mass,
                        state_.shape(j).circumradius(), 1 / state_.type(j).inertia.inverse_mass);
  }
  /// Returns the share of i in a change of the relative motion: the reduced mass over its own mass.
  double share(Index i, Index j) const {
    const double mine = state_.type(i).inertia.inverse_mass;
    return mine / (mine + state_.type(j).inertia.inverse_mass);
  }

  void begin_collision(Index i, const Image& partner, CollisionExecutor<B>& executor,
                       RunCounters& counters);
  void separate_grazing(Index i, Index j, const Vector& change);
  void begin_contact(const UnwrappedPair& pair, const RelativeMotion<dimension>& after, double end);
  bool try_displace(const UnwrappedPair& pair, const Vector& displacement1,
                    const Vector& displacement2);
  void displace(Index i, const Vector& displacement);
  bool has_clearance(Index i, const UnwrappedPair& pair, const Vector& displacement1,
                     const Vector& displacement2) const;
  void release_early(Index i, Index j, RunCounters& counters);
  void add_close_pair(const UnwrappedPair& pair, double distance);
  bool is_still_close(const UnwrappedPair& pair) const;

  State& state_;
  const EngineOptions& options_;
  std::vector<Release> releases_;
  std::map<UnwrappedPair, double> close_pairs_;  // minimum distances; some pairs may have separated
  std::size_t close_pairs_limit_ = 0;            // size that triggers a clean-up
  std::vector<Index> changed_;                   // particles changed by the current event
};

template <Body B>
using SoftContactPolicy = std::conditional_t<std::same_as<B, Disk> || std::same_as<B, Sphere>,
                                             SoftContacts<B>, NoSoftContacts<B>>;

// ---------------------------------------------------------------------------------------------------

// If a third particle hits one of a pair in contact, the contact ends early, and new predictions decide whether the two
// still approach.
template <Body B>
auto SoftContacts<B>::collide_pair(Index i, const Event<B>& event, CollisionExecutor<B>& executor,
                                   RunCounters& counters) -> const std::vector<Index>& {
  const Index j = event.partner.other;
  changed_.clear();
  if (in_contact(i) || in_contact(j)) {
    release_early(i, j, counters);
    return changed_;
  }
  state_.advance_to_now(i);
  state_.advance_to_now(j);
  begin_collision(i, event.partner, executor, counters);
  for (const Index k : {i, j}) ++state_.version[k];
  changed_ = {i, j};
  return changed_;
}

template <Body B>
void SoftContacts<B>::begin_collision(Index i, const Image& partner, CollisionExecutor<B>& executor,
                                      RunCounters& counters) {
  const Index j = partner.other;
  const Vector d = state_.separation(i, partner);
  const Vector v = state_.particles[j].velocity - state_.particles[i].velocity;
  const Vector normal = normalized(d);
  const double speed = -dot(v, normal);
  if (!(speed > grazing_speed * state_.fastest))
    return separate_grazing(i, j, (speed + separation_speed * state_.fastest) * normal);

  ContactPair pair = contact_pair_of(i, j);
  const UnwrappedPair unwrapped = unwrapped_pair(i, partner);  // not sorted
  if (norm(d) >= pair.distance) close_pairs_.erase(unwrapped.ascending());
  pair.distance = std::min(pair.distance, norm(d));
  const Restitution restitution = state_.of_pair(options_.soft_contact, i, j)
                                      ->collide(pair, speed, norm(v + speed * normal), counters);
  const RelativeMotion<dimension> after = after_contact<dimension>({d, v}, restitution);
  const Vector shortening = d - after.position;
  if (!try_displace(unwrapped, share(i, j) * shortening, -share(j, i) * shortening)) {
    ++counters.blocked_rotations;
    executor.collide_soft_pair(i, j, d, normal, -restitution.rate, restitution.duration, counters);
    return;
  }
  counters.virial += pair.mass * (dot(after.position, after.velocity) - dot(d, v) -
                                  restitution.duration * squared_norm(after.velocity));
  counters.dissipated += 0.5 * pair.mass * (squared_norm(v) - squared_norm(after.velocity));
  ++counters.collisions;
  begin_contact(unwrapped, after, state_.now + restitution.duration);
}

// The approach speed is below the accuracy of velocities. The pair is forced to separate, since otherwise it would
// collide forever. Each such event moves a cluster that has lost all its speed by a fixed step towards a state in which
// all pairs separate, so the sequence ends.
template <Body B>
void SoftContacts<B>::separate_grazing(Index i, Index j, const Vector& change) {
  state_.particles[i].velocity -= share(i, j) * change;
  state_.particles[j].velocity += share(j, i) * change;
}

// Both particles are already at their positions at the end of the contact and move with their centre of mass.
template <Body B>
void SoftContacts<B>::begin_contact(const UnwrappedPair& pair,
                                    const RelativeMotion<dimension>& after, double end) {
  const auto [i, j, unwrapped_shift] = pair;
  const double share1 = share(i, j), share2 = share(j, i);
  const Vector common =
      share2 * state_.particles[i].velocity + share1 * state_.particles[j].velocity;
  releases_[i] = {end, j, common - share1 * after.velocity};
  releases_[j] = {end, i, common + share2 * after.velocity};
  state_.particles[i].velocity = state_.particles[j].velocity = common;
  ++state_.collisions;
  const double distance = norm(after.position);
  if (distance < contact_pair_of(i, j).distance)
    add_close_pair(pair, distance - state_.contact_gap);
}

// Displaces both particles, unless one would be too close to a third particle.
template <Body B>
bool SoftContacts<B>::try_displace(const UnwrappedPair& pair, const Vector& displacement1,
                                   const Vector& displacement2) {
  displace(pair.i, displacement1);
  displace(pair.j, displacement2);
  if (has_clearance(pair.i, pair, displacement1, displacement2) &&
      has_clearance(pair.j, pair, displacement1, displacement2))
    return true;
  displace(pair.i, -displacement1);
  displace(pair.j, -displacement2);
  return false;
}

template <Body B>
void SoftContacts<B>::displace(Index i, const Vector& displacement) {
  state_.particles[i].position += displacement;
  while (!(state_.next_exit(i) > state_.now)) state_.leave_neighborhood(i);
}

// Returns whether every third particle is at least as far away as contact, or at least as far as before the
// displacement. In a small box third particles include other images of the partner and images of the particle itself.
template <Body B>
bool SoftContacts<B>::has_clearance(Index i, const UnwrappedPair& pair, const Vector& displacement1,
                                    const Vector& displacement2) const {
  const auto displacement_of = [&](Index k) -> Vector {
    if (k == pair.i) return displacement1;
    if (k == pair.j) return displacement2;
    return Vector::Zero();
  };
  return std::ranges::all_of(state_.neighbors(i), [&](const Image& neighbor) {
    const Index k = neighbor.other;
    if (unwrapped_pair(i, neighbor).ascending() == pair.ascending()) return true;
    const Vector d = state_.pose_now(k).position + state_.box.translation(neighbor.shift()) -
                     state_.particles[i].position;
    const Vector before = d + displacement_of(i) - displacement_of(k);
    return norm(d) >= std::min(sum_of_radii(i, k) + state_.contact_gap, norm(before));
  });
}

template <Body B>
void SoftContacts<B>::release(Index i) {
  state_.advance_to_now(i);
  state_.particles[i].velocity = releases_[i].velocity;
  state_.particles[i].known_until = State::never;
  releases_[i].time = State::never;
  ++state_.version[i];
}

template <Body B>
void SoftContacts<B>::release_early(Index i, Index j, RunCounters& counters) {
  if (!in_contact(i)) changed_.push_back(i);
  for (const Index k : {i, j}) {
    if (!in_contact(k)) continue;
    const Index partner = releases_[k].partner;
    release(k);
    changed_.push_back(k);
    ++counters.early_releases;
    if (options_.early_release == EarlyRelease::alone || !in_contact(partner) ||
        releases_[partner].partner != k)
      continue;
    release(partner);
    changed_.push_back(partner);
  }
}

template <Body B>
void SoftContacts<B>::add_close_pair(const UnwrappedPair& pair, double distance) {
  if (close_pairs_.size() >= close_pairs_limit_) {
    std::erase_if(close_pairs_, [&](const auto& known) { return !is_still_close(known.first); });
    close_pairs_limit_ = std::max<std::size_t>(2 * close_pairs_.size(), 64);
  }
  close_pairs_.insert_or_assign(pair.ascending(), distance);
}

template <Body B>
bool SoftContacts<B>::is_still_close(const UnwrappedPair& pair) const {
  const Shift<dimension> shift = pair.unwrapped_shift - state_.image[pair.i] + state_.image[pair.j];
  const Vector d = state_.pose_now(pair.j).position + state_.box.translation(shift) -
                   state_.pose_now(pair.i).position;
  return norm(d) < sum_of_radii(pair.i, pair.j) + state_.contact_gap;
}

template <Body B>
void SoftContacts<B>::load(const Configuration<dimension>& configuration) {
  if (!is_active()) return;
  close_pairs_.clear();
  releases_.assign(state_.size(), {});
  std::vector<Index> internal_id(state_.size());
  for (Index i = 0; i < state_.size(); ++i) internal_id[state_.external_id[i]] = i;
  for (const auto& [particle, partner, time, velocity] : configuration.releases) {
    releases_[internal_id[particle]] = {std::max(time - state_.base, state_.now),
                                        internal_id[partner], velocity};
    state_.fastest = std::max(state_.fastest, norm(velocity));
  }
  for (const auto& [pair, distance] : configuration.close_pairs) {
    const Index i = internal_id[pair.i], j = internal_id[pair.j];
    const Shift<dimension> unwrapped_shift =
        pair.shift + configuration.image[pair.i] - configuration.image[pair.j];
    close_pairs_.emplace(UnwrappedPair{i, j, unwrapped_shift}.ascending(), distance);
  }
}

template <Body B>
void SoftContacts<B>::write(Configuration<dimension>& configuration) const {
  if (!is_active()) return;
  const std::vector<Index>& external_id = state_.external_id;
  configuration.releases.clear();
  configuration.close_pairs.clear();
  for (Index i = 0; i < state_.size(); ++i)
    if (const Release& release = releases_[i]; release.time < State::never)
      configuration.releases.push_back({external_id[i], external_id[release.partner],
                                        state_.base + release.time, release.velocity});
  for (const auto& [pair, distance] : close_pairs_)
    if (is_still_close(pair)) {
      const bool ascends = external_id[pair.i] < external_id[pair.j];
      const auto [i, j] = std::minmax(external_id[pair.i], external_id[pair.j]);
      const Shift<dimension> unwrapped_shift =
          ascends ? pair.unwrapped_shift : Shift<dimension>(-pair.unwrapped_shift);
      configuration.close_pairs.push_back(
          {{i, j, unwrapped_shift - configuration.image[i] + configuration.image[j]}, distance});
    }
  std::ranges::sort(configuration.releases, {}, &vitrel::Release<dimension>::particle);
  std::ranges::sort(configuration.close_pairs, {}, [](const ClosePair<dimension>& close) {
    return std::pair(close.pair.i, close.pair.j);
  });
}

}  // namespace vitrel
