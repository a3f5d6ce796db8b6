// The contact screen against the reference: never late, whatever the axis.

#include "core/contact/contact_screen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bench/surveys/true_contact.h"
#include "core/contact/ellipse_contact_screen.h"
#include "core/contact/ellipse_gap.h"
#include "core/random/stream.h"
#include "core/tolerances.h"
#include "tests/support/screen_partners.h"

namespace vitrel {
namespace {

constexpr int lanes = ContactScreen<Ellipse>::lanes;

using bench::true_first_contact;
using Truth = bench::TrueContact::Outcome;

constexpr double pi = std::numbers::pi;

Vec2 random_direction(Stream& draw) {
  return direction(draw.uniform(0, 2 * pi));
}

struct Partner {
  Ellipse shape;
  Pose2 pose;  // relative to the first body's centre
  Motion2 motion;
  double horizon;
  Vec2 axis;
};

/// One body and as many partners as a screen takes, all of the common size.
struct Scene {
  Ellipse shape;
  Pose2 pose;
  Motion2 motion;
  CommonSize common;
  std::vector<Partner> partners;

  double contact_gap() const { return tolerance::contact_gap(10 * shape.a); }
};

Ellipse random_ellipse(Stream& draw, double largest_aspect_ratio) {
  const double b = draw.uniform(0.5, 1.5);
  return {b * std::pow(largest_aspect_ratio, draw.uniform()), b};
}

Motion2 random_motion(Stream& draw) {
  const double spin = draw.uniform() < 0.2 ? 20 : 2;
  return {{draw.normal(), draw.normal()}, spin * draw.normal()};
}

/// Half of the axes as a run would remember them, half anything.
Vec2 random_axis(Stream& draw, const Scene& scene, const Partner& partner) {
  if (draw.uniform() < 0.5) return random_direction(draw);
  const double size = scene.common.size;
  const Vec2 best =
      support_gap(scaled(scene.shape, size), scene.pose.angle, scaled(partner.shape, size),
                  partner.pose.angle, partner.pose.position)
          .normal;
  return detail::turned(best, 0.1 * draw.normal());
}

Scene random_scene(Stream& draw, double largest_aspect_ratio, double growth) {
  Scene scene;
  scene.shape = random_ellipse(draw, largest_aspect_ratio);
  scene.pose = {Vec2::Zero(), draw.uniform(-10, 10)};
  scene.motion = random_motion(draw);
  if (growth != 0) scene.common = {draw.uniform(0.3, 1.2), growth * draw.uniform(-1, 1)};
  for (int k = 0; k < lanes; ++k) {
    Partner partner;
    partner.shape = random_ellipse(draw, largest_aspect_ratio);
    const double reach = scene.common.size * (scene.shape.a + partner.shape.a);
    const double distance = draw.uniform(0.2, 1.3) * reach;
    partner.pose = {distance * random_direction(draw), draw.uniform(-10, 10)};
    partner.motion = random_motion(draw);
    // Sizes must not become negative.
    const double shrinking = std::max(-scene.common.growth_rate, 1e-3);
    partner.horizon = std::min(std::pow(10, draw.uniform(-2, 0.5)), scene.common.size / shrinking);
    partner.axis = random_axis(draw, scene, partner);
    scene.partners.push_back(partner);
  }
  return scene;
}

template <class B>
ContactScreen<B> evaluated(const Scene& scene) {
  ContactScreen<B> screen(ShapeCoefficients<Ellipse>(scene.shape),
                          flight_record<B>(scene.pose, scene.motion), 0, scene.common,
                          scene.contact_gap());
  ScreenPartners<B> partners;
  for (int k = 0; k < lanes; ++k) {
    const Partner& partner = scene.partners[k];
    partners.set(k, partner.pose, partner.motion, partner.axis, 0, partner.horizon);
    screen.set_shape(k, ShapeCoefficients<Ellipse>(partner.shape));
  }
  partners.load_into(screen);
  screen.evaluate(lanes);
  return screen;
}

bench::TrueContact truth_of(const Scene& scene, const Partner& partner) {
  const auto grown = [&](const Ellipse& shape) {
    return GrowingEllipse{shape, scene.common.size, scene.common.growth_rate};
  };
  return true_first_contact<GrowingEllipse>({grown(scene.shape), scene.pose, scene.motion},
                                            {grown(partner.shape), partner.pose, partner.motion},
                                            partner.horizon);
}

/// The time of every lane, asked for as a run does: the most urgent first.
template <class B>
std::array<double, lanes> times_of(ContactScreen<B> screen) {
  std::array<double, lanes> times;
  times.fill(detail::no_contact);
  double last = 0;
  for (int done = 0; done < lanes; ++done) {
    const auto [time, lane] = screen.earliest();
    if (time == detail::no_contact) break;
    EXPECT_GE(time, last);
    times[lane] = last = time;
    screen.discard(lane);
  }
  return times;
}

struct Class {
  double largest_aspect_ratio;
  double growth;  // 0: of ContactScreen<Ellipse>
  int scenes;
};
void PrintTo(const Class& at, std::ostream* out) {
  *out << "aspect ratios to " << at.largest_aspect_ratio << ", growth to " << at.growth;
}

/// What was seen, to know that the test has met all of it.
struct Counts {
  int contacts = 0, misses = 0, overlaps = 0;
  int settled = 0;   // misses that the screen tells at once
  int narrowed = 0;  // contacts that the screen puts off
};

// Times are compared without any allowance: the screen's floor of half a contact gap covers the
// rounding. Pairs that are undecided touch to within rounding, and either answer is right.
template <class B>
void assess(const Scene& scene, Counts& counts) {
  const std::array<double, lanes> times = times_of(evaluated<B>(scene));
  for (int k = 0; k < lanes; ++k) {
    const bench::TrueContact truth = truth_of(scene, scene.partners[k]);
    switch (truth.outcome) {
      case Truth::overlap_at_start:
        ++counts.overlaps;
        EXPECT_EQ(times[k], 0);
        break;
      case Truth::contact:
        ++counts.contacts;
        counts.narrowed += times[k] > 0;
        EXPECT_LE(times[k], truth.time) << "late";
        break;
      case Truth::none:
        ++counts.misses;
        counts.settled += times[k] == detail::no_contact;
        break;
      case Truth::undecided:
        break;
    }
  }
}

/// The same scene, with horizons shortly after the contacts: there the bound that a screen proves is
/// closest to the truth.
Scene with_close_horizons(const Scene& scene, Stream& draw) {
  Scene close = scene;
  for (Partner& partner : close.partners) {
    const bench::TrueContact truth = truth_of(scene, partner);
    if (truth.outcome == Truth::contact)
      partner.horizon = std::min(partner.horizon, static_cast<double>(truth.time) *
                                                      (1 + std::pow(10, draw.uniform(-4, 0))));
  }
  return close;
}

class ScreenAgainstTheTruth : public testing::TestWithParam<Class> {};

TEST_P(ScreenAgainstTheTruth, IsNeverLateFromWhateverAxis) {
  const Class& at = GetParam();
  Stream draw(41, Purpose::tests);
  Counts counts;
  for (int trial = 0; trial < at.scenes && !HasFailure(); ++trial) {
    const Scene scene = random_scene(draw, at.largest_aspect_ratio, at.growth);
    SCOPED_TRACE(trial);
    for (const Scene& looked_at : {scene, with_close_horizons(scene, draw)}) {
      if (at.growth == 0) assess<Ellipse>(looked_at, counts);
      assess<GrowingEllipse>(looked_at, counts);
    }
  }
  const int asked = counts.contacts + counts.misses + counts.overlaps;
  EXPECT_GT(counts.contacts, asked / 20);
  EXPECT_GT(counts.overlaps, asked / 20);
  EXPECT_GT(counts.narrowed, counts.contacts / 4);
  EXPECT_GT(counts.settled, counts.misses / 4);
}

INSTANTIATE_TEST_SUITE_P(Classes, ScreenAgainstTheTruth,
                         testing::Values(Class{2, 0, 5'000}, Class{20, 0, 5'000},
                                         Class{2, 0.3, 6'000}, Class{20, 0.3, 6'000},
                                         Class{4, 3, 6'000}));

}  // namespace
}  // namespace vitrel
