#pragma once

#include "core/contact/contact_screen.h"
#include "core/contact/flight_record.h"
#include "core/contact/round_contact.h"

namespace vitrel {

/// The earliest contact of a disk or sphere with several others in free flight, in closed form and four at a time. A
/// contact is the first s ≥ 0 with |d + v s| = (R₁ + R₂) (σ + γ s) + contact gap, for approaching surfaces only.
template <RoundBody B>
class EarliestRoundContact {
  static constexpr int dimension = B::dimension;
  using Vector = Vec<dimension>;

 public:
  EarliestRoundContact(double radius, const Vector& position, const Vector& velocity, double now,
                       const CommonSize& common, double contact_gap)
      : radius_(radius), now_(now), common_(common), contact_gap_(contact_gap) {
    for (int x = 0; x < dimension; ++x) {
      position_[x] = position[x];
      velocity_[x] = velocity[x];
    }
  }

  /// Tests four partners, which get the numbers first, first + 1 … Contacts later than a partner's `known_until` do not
  /// count.
  VITREL_INLINE void test(const FlightRecord<B>* const (&partner)[simd_width],
                          const SimdBatch& radius, std::size_t first) {
    using Layout = RecordLayout<dimension>;
    SimdBatch column[Layout::translation_size];
    detail::load_columns(partner, column);
    const SimdBatch since = now_ - column[Layout::time];
    const SimdBatch horizon = column[Layout::known_until] - now_;
    SimdBatch dd(0), b(0), a(0);
    for (int x = 0; x < dimension; ++x) {
      const SimdBatch& velocity = column[Layout::velocity + x];
      const SimdBatch d = (column[Layout::position + x] + since * velocity) - position_[x];
      const SimdBatch v = velocity - velocity_[x];
      dd += d * d;
      b += d * v;
      a += v * v;
    }
    const SimdBatch radii = radius + radius_;
    SimdBatch reach = radii + contact_gap_;
    if constexpr (grows<B>) {
      const SimdBatch growth = common_.growth_rate * radii;
      reach = common_.size * radii + contact_gap_;
      b -= reach * growth;
      a -= growth * growth;
    }
    const SimdBatch c = dd - reach * reach;
    const SimdBatch discriminant = b * b - a * c;
    auto hits = b < 0 && discriminant >= 0;
    if constexpr (!grows<B>) {
      // The contact is no earlier than c/(−2 b).
      hits = hits && c < -2. * b * min(horizon, wait_);
      if (none_of(hits)) return;
    }
    const SimdBatch root = sqrt(max(discriminant, SimdBatch(0)));
    SimdBatch wait = detail::closing_time(b, c, root);
    if constexpr (grows<B>) {
      // The centres recede, but the surfaces grow faster.
      const auto overtakes = !(b < 0) && a < 0;
      wait = select(overtakes, max(detail::overtaking_time(a, b, root), SimdBatch(0)), wait);
      hits = (hits || overtakes) && discriminant >= 0;
    }
    hits = hits && wait < horizon && wait < wait_;
    wait_ = select(hits, wait, wait_);
    number_ =
        select(hits, static_cast<double>(first) + detail::lane_indices<simd_width>(), number_);
  }

  struct Contact {
    double wait;  ///< infinite if there is none, 0 for approaching pairs that touch or overlap
    std::size_t number;
  };
  Contact earliest() const {
    const double wait = hmin(wait_);
    return {wait, static_cast<std::size_t>(number_[find_first_set(wait_ == wait)])};
  }

 private:
  double radius_;
  SimdBatch position_[dimension], velocity_[dimension];
  double now_;
  CommonSize common_;
  double contact_gap_;
  SimdBatch wait_{detail::no_contact}, number_{0};
};

}  // namespace vitrel
