#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/contact/round_free_path_batch.h"
#include "core/random/stream.h"
#include "core/state/configuration.h"

/// Scenes for the free paths of event chains, and what a path in them must be.
namespace vitrel {

/// The gap at which the paths declare contact.
constexpr double free_path_gap = 1e-9;

struct FreePathClass {
  double largest_aspect_ratio, largest_size_ratio;
};
inline void PrintTo(const FreePathClass& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio
       << ", sizes to 1:" << at.largest_size_ratio;
}

template <int Dim>
struct PlacedBody {
  ParticleShape<Dim> shape;
  Pose<Dim> pose;  // from the centre of the one that moves
};

/// One body at the origin, among others that it does not touch.
template <int Dim>
struct FreePathScene {
  PlacedBody<Dim> moving;
  std::vector<PlacedBody<Dim>> others;

  auto gap_to(const PlacedBody<Dim>& other, const Vec<Dim>& d) const {
    return support_gap(moving.shape, moving.pose, other.shape, other.pose, d);
  }
  double aspect_ratio() const { return moving.shape.circumradius() / moving.shape.inradius(); }
};

/// A quarter of the others are at 10⁻¹ … 10⁻⁸ of their size from the first. `body` draws a body at the origin, and
/// `direction` a direction.
template <int Dim, class BodyMaker, class DirectionMaker>
FreePathScene<Dim> random_scene(Stream& draw, std::size_t count, const BodyMaker& body,
                                const DirectionMaker& direction) {
  FreePathScene<Dim> scene{body(), {}};
  while (scene.others.size() < count) {
    PlacedBody<Dim> other = body();
    const double reach = scene.moving.shape.circumradius() + other.shape.circumradius();
    Vec<Dim>& position = other.pose.position;
    position = draw.uniform(0, 2) * reach * direction();
    const auto now = scene.gap_to(other, position);
    if (draw.below(4) == 0)
      position += (reach * std::pow(10, -draw.uniform(1, 8)) - now.gap) * now.normal;
    if (scene.gap_to(other, position).gap > scene.aspect_ratio() * 2 * free_path_gap)
      scene.others.push_back(other);
  }
  return scene;
}

struct FreePathTally {
  int partner = 0, free = 0;
};

/// Free all the way, by the contact search, and then either of the wanted length or in contact.
template <int Dim>
void check_free_path(const FreePathScene<Dim>& scene, const FreePath& end, int along,
                     double max_length, FreePathTally& tally) {
  const Vec<Dim> e = Vec<Dim>::Unit(along);
  ASSERT_GE(end.length, 0);
  ASSERT_LE(end.length, max_length);
  for (const PlacedBody<Dim>& other : scene.others) {
    const Motion<Dim> motion{e}, rest{Vec<Dim>::Zero()};
    const auto met = first_contact(
        Flight<ParticleShape<Dim>>{scene.moving.shape, scene.moving.pose, motion},
        Flight<ParticleShape<Dim>>{other.shape, other.pose, rest}, end.length, 0.5 * free_path_gap);
    ASSERT_EQ(met.outcome, Outcome::none) << "after " << met.time << " of " << end.length;
  }
  if (end.partner == FreePath::none) {
    ++tally.free;
    ASSERT_EQ(end.length, max_length);
    return;
  }
  ++tally.partner;
  const PlacedBody<Dim>& other = scene.others[end.partner];
  const Vec<Dim> d = other.pose.position - end.length * e;
  const auto now = scene.gap_to(other, d);
  const double rounding =
      1e-14 * (scene.moving.shape.circumradius() + other.shape.circumradius() + max_length);
  ASSERT_GT(now.gap, free_path_gap - rounding);
  ASSERT_LT(now.gap, (scene.aspect_ratio() + 0.25) * free_path_gap + rounding);
  ASSERT_GT(now.normal.dot(e), 0);
  ASSERT_NEAR(end.offset_at_contact, d[along], rounding);
}

}  // namespace vitrel
