#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "edmd/simulation.h"

/// @file
/// The events of soft particles (soft/soft_contact.h), a part of the event loop: included at the end of
/// simulation.h.

namespace vitrel {

// A third particle that hits one of a pair in contact collides with it as if the contact were over. New
// predictions decide whether they still approach.
template <Body B>
void Simulation<B>::execute_soft_collision(Index i, const Event& event, RunCounters& counters) {
  const Index j = event.partner.other;
  if (in_contact(i) || in_contact(j)) return release_early(i, j, counters);
  advance_to_now(particles_[i]);
  advance_to_now(particles_[j]);
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
  if (!(speed > grazing_speed * fastest_))
    return separate_grazing(i, j, (speed + separation_speed * fastest_) * normal);

  ContactPair pair = contact_pair_of(i, j);
  const UnwrappedPair unwrapped = unwrapped_pair(i, partner);  // not sorted
  if (d.norm() >= pair.distance) close_pairs_.erase(unwrapped.ascending());
  pair.distance = std::min(pair.distance, d.norm());
  const Restitution restitution =
      options_.soft_contact->collide(pair, speed, (v + speed * normal).norm(), counters);
  const RelativeMotion<dimension> after = after_contact<dimension>({d, v}, restitution);
  const Vector shortening = d - after.position;
  if (!try_displace(unwrapped, share(i, j) * shortening, -share(j, i) * shortening)) {
    ++counters.blocked_rotations;
    impact(i, j, d, normal, -restitution.rate, counters);
    return;
  }
  counters.virial += pair.mass * (after.position.dot(after.velocity) - d.dot(v) -
                                  restitution.duration * after.velocity.squaredNorm());
  counters.dissipated += 0.5 * pair.mass * (v.squaredNorm() - after.velocity.squaredNorm());
  ++counters.collisions;
  begin_contact(unwrapped, after, now_ + restitution.duration);
}

// Approach speeds below the accuracy of velocities: the pair is forced to separate, since otherwise it would collide
// forever. Each such event moves a cluster that has lost all its speed by a fixed step towards a state in which all
// pairs separate, so the sequence ends.
template <Body B>
void Simulation<B>::separate_grazing(Index i, Index j, const Vector& change) {
  particles_[i].velocity -= share(i, j) * change;
  particles_[j].velocity += share(j, i) * change;
}

// Both are already at their final positions of the contact and move with their centre of mass.
template <Body B>
void Simulation<B>::begin_contact(const UnwrappedPair& pair, const RelativeMotion<dimension>& after,
                                  double end) {
  const auto [i, j, unwrapped_shift] = pair;
  const double share1 = share(i, j), share2 = share(j, i);
  const Vector common = share2 * particles_[i].velocity + share1 * particles_[j].velocity;
  releases_[i] = {end, j, common - share1 * after.velocity};
  releases_[j] = {end, i, common + share2 * after.velocity};
  particles_[i].velocity = particles_[j].velocity = common;
  ++collisions_;
  const double distance = after.position.norm();
  if (distance < contact_pair_of(i, j).distance) add_close_pair(pair, distance - contact_gap_);
}

// Displaces both particles, unless one would be too close to a third particle.
template <Body B>
bool Simulation<B>::try_displace(const UnwrappedPair& pair, const Vector& displacement1,
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
void Simulation<B>::displace(Index i, const Vector& displacement) {
  Particle& particle = particles_[i];
  particle.position += displacement;
  const double exit = neighborhoods_->exit_time(i, particle.pose(), particle.motion(), {});
  if (!(exit > 0)) leave_neighborhood(i);
}

// No third particle is closer than contact, or closer than before the displacement. In a small box this includes
// other images of the partner and own images.
template <Body B>
bool Simulation<B>::has_clearance(Index i, const UnwrappedPair& pair, const Vector& displacement1,
                                  const Vector& displacement2) const {
  const auto displacement_of = [&](Index k) -> Vector {
    if (k == pair.i) return displacement1;
    if (k == pair.j) return displacement2;
    return Vector::Zero();
  };
  for (const Image& neighbor : neighborhoods_->of(i)) {
    const Index k = neighbor.other;
    if (unwrapped_pair(i, neighbor).ascending() == pair.ascending()) continue;
    const Vector d = particles_[k].pose_at(now_).position + box_.translation(neighbor.shift()) -
                     particles_[i].position;
    const Vector before = d + displacement_of(i) - displacement_of(k);
    const double reach = shape(i).circumradius() + shape(k).circumradius() + contact_gap_;
    if (d.norm() < std::min(reach, before.norm())) return false;
  }
  return true;
}

template <Body B>
void Simulation<B>::release(Index i) {
  advance_to_now(particles_[i]);
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
void Simulation<B>::add_close_pair(const UnwrappedPair& pair, double distance) {
  if (close_pairs_.size() >= close_pairs_limit_) {
    std::erase_if(close_pairs_, [&](const auto& known) { return !is_still_close(known.first); });
    close_pairs_limit_ = std::max<std::size_t>(2 * close_pairs_.size(), 64);
  }
  close_pairs_.insert_or_assign(pair.ascending(), distance);
}

template <Body B>
bool Simulation<B>::is_still_close(const UnwrappedPair& pair) const {
  const auto position = [&](Index i) { return Vector(particles_[i].pose_at(now_).position); };
  const Shift<dimension> shift = pair.unwrapped_shift - image_[pair.i] + image_[pair.j];
  const Vector d = position(pair.j) + box_.translation(shift) - position(pair.i);
  return d.norm() < shape(pair.i).circumradius() + shape(pair.j).circumradius() + contact_gap_;
}

template <Body B>
bool Simulation<B>::is_close_pair(const UnwrappedPair& pair) const {
  return close_pairs_.contains(pair.ascending());
}

template <Body B>
void Simulation<B>::load_contacts(const Configuration<dimension>& configuration) {
  close_pairs_.clear();
  releases_.assign(particles_.size(), {});
  std::vector<Index> internal_id(external_id_.size());
  for (Index i = 0; i < external_id_.size(); ++i) internal_id[external_id_[i]] = i;
  for (const auto& [particle, partner, time, velocity] : configuration.releases)
    releases_[internal_id[particle]] = {std::max(time - base_, now_), internal_id[partner],
                                        velocity};
  for (const auto& [pair, distance] : configuration.close_pairs) {
    const Index i = internal_id[pair.i], j = internal_id[pair.j];
    const Shift<dimension> unwrapped_shift =
        pair.shift + configuration.image[pair.i] - configuration.image[pair.j];
    close_pairs_.emplace(UnwrappedPair{i, j, unwrapped_shift}.ascending(), distance);
  }
}

template <Body B>
void Simulation<B>::write_contacts(Configuration<dimension>& configuration) const {
  configuration.releases.clear();
  configuration.close_pairs.clear();
  for (Index i = 0; i < particles_.size(); ++i)
    if (const Release& release = releases_[i]; release.time < never)
      configuration.releases.push_back(
          {external_id_[i], external_id_[release.partner], base_ + release.time, release.velocity});
  for (const auto& [pair, distance] : close_pairs_)
    if (is_still_close(pair)) {
      const bool ascends = external_id_[pair.i] < external_id_[pair.j];
      const auto [i, j] = std::minmax(external_id_[pair.i], external_id_[pair.j]);
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
