#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "edmd/simulation.h"

/// The events of soft particles (soft/soft_contact.h), a part of the loop: included at the end of
/// simulation.h.

namespace vitrel {

// A third particle that comes to one of a pair in contact meets it as if the contact was over. Whether they
// then still approach, the predictions say.
template <Body B>
void Simulation<B>::meet_softly(Index i, const Event& event, RunCounters& counters) {
  const Index j = event.partner.other;
  if (in_contact(i) || in_contact(j)) return release_early(i, j, counters);
  bring_to_now(particles_[i]);
  bring_to_now(particles_[j]);
  soft_impact(i, event.partner, counters);
  for (const Index k : {i, j}) {
    ++version_[k];
    particles_[k].next = never;
  }
  predict(i, counters);
  predict(j, counters);
}

template <Body B>
void Simulation<B>::soft_impact(Index i, const Image& partner, RunCounters& counters) {
  const Index j = partner.other;
  const Particle &one = particles_[i], &two = particles_[j];
  const Vector d = two.position + box_.translation(partner.shift()) - one.position;
  const Vector v = two.velocity - one.velocity;
  const Vector normal = d.normalized();
  const double speed = -v.dot(normal);
  if (!(speed > grazing * fastest_)) return pass(i, j, (speed + parting * fastest_) * normal);

  ContactPair pair = contact_pair_of(i, j);
  const Images both = images(i, partner);  // in this order
  if (d.norm() >= pair.distance) close_.erase(both.ascending());
  pair.distance = std::min(pair.distance, d.norm());
  const Restitution restitution =
      options_.soft_contact->collide(pair, speed, (v + speed * normal).norm(), counters);
  const RelativeMotion<dimension> after = after_contact<dimension>({d, v}, restitution);
  const Vector shortening = d - after.position;
  if (!turn(both, share(i, j) * shortening, -share(j, i) * shortening)) {
    ++counters.refused_turns;
    impact(i, j, d, normal, -restitution.rate, counters);
    return;
  }
  counters.virial += pair.mass * (after.position.dot(after.velocity) - d.dot(v) -
                                  restitution.duration * after.velocity.squaredNorm());
  counters.dissipated += 0.5 * pair.mass * (v.squaredNorm() - after.velocity.squaredNorm());
  ++counters.collisions;
  begin_contact(both, after, now_ + restitution.duration);
}

// Slower than velocities are exact, they are let go apart, or they would meet for ever. Each time this brings
// a cluster that has lost all of its speed nearer to one in which all pairs separate, by steps of a fixed
// size: so it ends.
template <Body B>
void Simulation<B>::pass(Index i, Index j, const Vector& change) {
  particles_[i].velocity -= share(i, j) * change;
  particles_[j].velocity += share(j, i) * change;
}

// They have their places of the end, and go on with their centre of mass.
template <Body B>
void Simulation<B>::begin_contact(const Images& pair, const RelativeMotion<dimension>& after,
                                  double end) {
  const auto [i, j, lag] = pair;
  const double share1 = share(i, j), share2 = share(j, i);
  const Vector common = share2 * particles_[i].velocity + share1 * particles_[j].velocity;
  releases_[i] = {end, j, common - share1 * after.velocity};
  releases_[j] = {end, i, common + share2 * after.velocity};
  particles_[i].velocity = particles_[j].velocity = common;
  ++met_;
  const double distance = after.position.norm();
  if (distance < contact_pair_of(i, j).distance) note_close(pair, distance - contact_gap_);
}

// Moves both, unless one would be too close to a third particle.
template <Body B>
bool Simulation<B>::turn(const Images& pair, const Vector& way1, const Vector& way2) {
  shift_by(pair.i, way1);
  shift_by(pair.j, way2);
  if (has_room(pair.i, pair, way1, way2) && has_room(pair.j, pair, way1, way2)) return true;
  shift_by(pair.i, -way1);
  shift_by(pair.j, -way2);
  return false;
}

template <Body B>
void Simulation<B>::shift_by(Index i, const Vector& way) {
  Particle& particle = particles_[i];
  particle.position += way;
  const double exit = neighborhoods_->exit_time(i, particle.pose(), particle.motion(), {});
  if (!(exit > 0)) leave_neighborhood(i);
}

// Nothing but its partner is nearer than contact, or not nearer than it was before the pair's ways there. In
// a small box another image of the partner, or its own, may be.
template <Body B>
bool Simulation<B>::has_room(Index i, const Images& pair, const Vector& way1,
                             const Vector& way2) const {
  const auto way_of = [&](Index k) -> Vector {
    if (k == pair.i) return way1;
    if (k == pair.j) return way2;
    return Vector::Zero();
  };
  for (const Image& neighbor : neighborhoods_->of(i)) {
    const Index k = neighbor.other;
    if (images(i, neighbor).ascending() == pair.ascending()) continue;
    const Vector d = particles_[k].pose_at(now_).position + box_.translation(neighbor.shift()) -
                     particles_[i].position;
    const Vector before = d + way_of(i) - way_of(k);
    const double reach = shape(i).circumradius() + shape(k).circumradius() + contact_gap_;
    if (d.norm() < std::min(reach, before.norm())) return false;
  }
  return true;
}

template <Body B>
void Simulation<B>::release(Index i) {
  bring_to_now(particles_[i]);
  particles_[i].velocity = releases_[i].velocity;
  particles_[i].next = never;
  releases_[i].time = never;
  ++version_[i];
}

template <Body B>
void Simulation<B>::release_early(Index i, Index j, RunCounters& counters) {
  std::vector<Index> moved;
  if (!in_contact(i)) moved.push_back(i);
  for (const Index k : {i, j}) {
    if (!in_contact(k)) continue;
    const Index partner = releases_[k].partner;
    release(k);
    moved.push_back(k);
    ++counters.early_releases;
    if (options_.early_release == EarlyRelease::alone || !in_contact(partner) ||
        releases_[partner].partner != k)
      continue;
    release(partner);
    moved.push_back(partner);
  }
  for (const Index k : moved) predict(k, counters);
}

template <Body B>
void Simulation<B>::note_close(const Images& pair, double distance) {
  if (close_.size() >= most_close_) {
    std::erase_if(close_, [&](const auto& known) { return !is_close(known.first); });
    most_close_ = std::max<std::size_t>(2 * close_.size(), 64);
  }
  close_.insert_or_assign(pair.ascending(), distance);
}

template <Body B>
bool Simulation<B>::is_close(const Images& pair) const {
  const auto position = [&](Index i) { return Vector(particles_[i].pose_at(now_).position); };
  const Shift<dimension> shift = pair.lag - image_[pair.i] + image_[pair.j];
  const Vector d = position(pair.j) + box_.translation(shift) - position(pair.i);
  return d.norm() < shape(pair.i).circumradius() + shape(pair.j).circumradius() + contact_gap_;
}

template <Body B>
bool Simulation<B>::may_be_close(const Images& pair) const {
  return close_.contains(pair.ascending());
}

template <Body B>
void Simulation<B>::load_contacts(const Configuration<dimension>& configuration) {
  close_.clear();
  releases_.assign(particles_.size(), {});
  std::vector<Index> inner(outer_.size());
  for (Index i = 0; i < outer_.size(); ++i) inner[outer_[i]] = i;
  for (const auto& [particle, partner, time, velocity] : configuration.releases)
    releases_[inner[particle]] = {std::max(time - base_, now_), inner[partner], velocity};
  for (const auto& [pair, distance] : configuration.close_pairs) {
    const Index i = inner[pair.i], j = inner[pair.j];
    const Shift<dimension> lag =
        pair.shift + configuration.image[pair.i] - configuration.image[pair.j];
    close_.emplace(Images{i, j, lag}.ascending(), distance);
  }
}

template <Body B>
void Simulation<B>::write_contacts(Configuration<dimension>& configuration) const {
  configuration.releases.clear();
  configuration.close_pairs.clear();
  for (Index i = 0; i < particles_.size(); ++i)
    if (const Release& release = releases_[i]; release.time < never)
      configuration.releases.push_back(
          {outer_[i], outer_[release.partner], base_ + release.time, release.velocity});
  for (const auto& [pair, distance] : close_)
    if (is_close(pair)) {
      const bool ascends = outer_[pair.i] < outer_[pair.j];
      const auto [i, j] = std::minmax(outer_[pair.i], outer_[pair.j]);
      const Shift<dimension> lag = ascends ? pair.lag : Shift<dimension>(-pair.lag);
      configuration.close_pairs.push_back(
          {{i, j, lag - configuration.image[i] + configuration.image[j]}, distance});
    }
  std::ranges::sort(configuration.releases, {}, &vitrel::Release<dimension>::particle);
  std::ranges::sort(configuration.close_pairs, {}, [](const ClosePair<dimension>& close) {
    return std::pair(close.pair.i, close.pair.j);
  });
}

}  // namespace vitrel
