// The earliest contact of disks and spheres, growing or not, against the quadratic equation in extended precision.

#include "core/contact/round_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random/stream.h"
#include "core/special_values.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

template <class B>
class RoundContacts : public testing::Test {
 protected:
  static constexpr int dimension = B::dimension;
  using Vector = Vec<dimension>;

  struct Partner {
    double radius;
    FlightRecord<B> record;

    Vector position_at(double time) const { return record.pose_at(time).position; }
  };

  static Vector random_direction(Stream& draw) {
    Vector n;
    for (int k = 0; k < dimension; ++k) n[k] = draw.normal();
    return n.normalized();
  }
  static Partner at(double radius, const Vector& position, const Vector& velocity, double time,
                    double known_until) {
    Pose<dimension> pose;
    Motion<dimension> motion;
    pose.position = position;
    motion.velocity = velocity;
    return {radius, flight_record<B>(pose, motion, time, known_until)};
  }
};
using Bodies = testing::Types<Disk, Sphere, GrowingSphere>;
TYPED_TEST_SUITE(RoundContacts, Bodies);

/// The first s ≥ 0 with |d + v s| = reach + γ s. `height`: of the discriminant over b², small for a graze, which
/// rounding may turn into a miss.
struct Truth {
  long double time = infinity, height = 1;
};
template <class Vector>
Truth truth(const Vector& d, const Vector& v, double reach, double growth) {
  using Real = long double;
  Real a = -Real(growth) * growth, b = -Real(reach) * growth, c = -Real(reach) * reach;
  for (int k = 0; k < d.size(); ++k) {
    a += Real(v[k]) * v[k];
    b += Real(d[k]) * v[k];
    c += Real(d[k]) * d[k];
  }
  const Real discriminant = b * b - a * c;
  const Real height = std::abs(discriminant) / (b * b);
  if (discriminant < 0 || (b >= 0 && a >= 0)) return {infinity, height};
  const Real root = std::sqrt(discriminant);
  return {b < 0 ? c / (root - b) : (b + root) / -a, height};
}

// Rounding leaves 3 ε d² of the sum in c = d² − reach², and as much of the products in the discriminant;
// near a graze, at a height η of the discriminant, that makes the relative error ~ 8 ε (d²/c + 1/η). Positions at the
// present are rounded to ε (|r| + |v| t).
TYPED_TEST(RoundContacts, TellTheEarliestAndItsTime) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr int groups = 3, count = groups * simd_width;
  using Position = typename TestFixture::Vector;
  Stream draw(31, Purpose::tests);
  const double contact_gap = tolerance::contact_gap(20), now = 1.7;
  const CommonSize common = grows<TypeParam> ? CommonSize{1.2, 0.3} : CommonSize{};
  int met = 0, none = 0, limited = 0;
  for (int trial = 0; trial < 40'000; ++trial) {
    const double radius = draw.uniform(0.5, 1.5);
    const Position mine = 3 * this->random_direction(draw), velocity = this->random_direction(draw);
    EarliestRoundContact<TypeParam> earliest(radius, mine, velocity, now, common, contact_gap);
    typename RoundContacts<TypeParam>::Partner partners[count];
    Truth first;
    double relative = 0;
    bool grazes = false;
    for (auto& partner : partners) {
      const double other = draw.uniform(0.1, 3);
      const double reach = common.size * (radius + other) + contact_gap;
      const double speed = draw.normal();
      const Position v = speed * this->random_direction(draw);
      const double time = now - draw.uniform();
      const double distance = reach * (1 + std::pow(10, draw.uniform(-5, 1)));
      const Position d = distance * this->random_direction(draw);
      const double known_until = draw.uniform() < 0.5 ? infinity : now + draw.uniform(0, 5);
      partner = this->at(other, mine + d - (now - time) * v, v, time, known_until);
      const Position there = partner.position_at(now) - mine;
      const Truth contact =
          truth<Position>(there, v - velocity, reach, common.growth_rate * (radius + other));
      grazes = grazes || contact.height < 1e-7;
      if (contact.time < known_until - now && contact.time < first.time) {
        first = contact;
        const double c = there.squaredNorm() - reach * reach;
        relative =
            16 * epsilon *
            ((there.squaredNorm() + 10) / std::abs(c) + 1 / static_cast<double>(contact.height));
      } else {
        limited += contact.time < infinity && contact.time >= known_until - now;
      }
    }
    if (grazes) continue;
    for (int g = 0; g < groups; ++g) {
      const FlightRecord<TypeParam>* record[simd_width];
      SimdBatch radii(0);
      for (int k = 0; k < simd_width; ++k) {
        record[k] = &partners[simd_width * g + k].record;
        radii.set(k, partners[simd_width * g + k].radius);
      }
      earliest.test(record, radii, simd_width * static_cast<std::size_t>(g));
    }
    const auto [wait, number] = earliest.earliest();
    if (first.time == infinity) {
      ++none;
      EXPECT_EQ(wait, infinity);
      continue;
    }
    ++met;
    EXPECT_NEAR(wait, static_cast<double>(first.time),
                relative * static_cast<double>(first.time) + 1e-15);
    const auto& partner = partners[number];
    const Position d = partner.position_at(now + wait) - (mine + wait * velocity);
    EXPECT_NEAR(d.norm(), (common.size + common.growth_rate * wait) * (radius + partner.radius),
                1e-6);
  }
  EXPECT_GT(met, 5'000);
  if (!grows<TypeParam>) {
    EXPECT_GT(none, 100);
  }
  EXPECT_GT(limited, 1'000);
}

TYPED_TEST(RoundContacts, APairThatTouchesMeetsAtOnceIfItApproachesAndNeverIfItRecedes) {
  using Position = typename TestFixture::Vector;
  const double contact_gap = tolerance::contact_gap(10);
  const auto wait_of = [&](double gap, double along) {
    Position d = Position::Zero(), v = Position::Zero();
    d[0] = 2 + gap;
    v[0] = along;
    v[1] = along == 0 ? 0 : 0.2;
    EarliestRoundContact<TypeParam> earliest(1, Position::Zero(), Position::Zero(), 0, {},
                                             contact_gap);
    const auto partner = this->at(1, d, v, 0, infinity);
    earliest.test({&partner.record, &partner.record, &partner.record, &partner.record},
                  SimdBatch(1), 0);
    return earliest.earliest().wait;
  };
  for (const double gap : {1.2 * contact_gap, 0.8 * contact_gap, 0.0, -1e-9, -0.5}) {
    EXPECT_GE(wait_of(gap, -0.1), 0);
    EXPECT_LE(wait_of(gap, -0.1), gap > contact_gap ? 10 * 0.2 * contact_gap + 1e-15 : 0);
    EXPECT_EQ(wait_of(gap, 0.1), infinity);
    EXPECT_EQ(wait_of(gap, 0), infinity);
  }
}

}  // namespace
}  // namespace vitrel
