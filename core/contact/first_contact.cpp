#include "core/contact/first_contact.h"

#include <type_traits>

#include "core/contact/axis_search.h"
#include "core/contact/ellipse_pair_in_flight.h"
#include "core/contact/ellipsoid_pair_in_flight.h"
#include "core/contact/round_contact.h"

namespace vitrel {

namespace {

Vec2 axis_from(const Vec2& n) {
  return n;
}
Axis3 axis_from(const Vec3& n) {
  return completed(components(n));
}
Vec2 direction_of(const Vec2& axis) {
  return axis;
}
Vec3 direction_of(const Axis3& axis) {
  return vector(axis.n);
}

template <class B>
using PairInFlight =
    std::conditional_t<B::dimension == 2, EllipsePairInFlight<B>, EllipsoidPairInFlight<B>>;

template <class B>
Prediction<B::dimension> search(const Flight<B>& one, const Flight<B>& two, double horizon,
                                double contact_gap, const SearchStart<B::dimension>* start) {
  using Pair = PairInFlight<B>;
  AxisSearch<Pair> pair(one, two, contact_gap);
  typename Pair::Axis likely;
  if (start) likely = axis_from(start->axis);
  const auto [outcome, steps] =
      pair.run(start ? start->time : 0, horizon, start ? &likely : nullptr);
  if (steps == 0) return {};
  Prediction<B::dimension> found{outcome, pair.time(), direction_of(pair.axis()),
                                 Vec<B::dimension>::Zero(), steps};
  if (outcome == Outcome::contact)
    found.point =
        one.pose.position + one.motion.velocity * found.time + pair.flight().arm1(pair.axis());
  return found;
}

template <class B>
Prediction<B::dimension> contact_of(const Flight<B>& one, const Flight<B>& two, double horizon,
                                    double contact_gap, const SearchStart<B::dimension>* start) {
  if constexpr (!RoundBody<B>)
    if (!detail::is_round(one.body) || !detail::is_round(two.body))
      return search(one, two, horizon, contact_gap, start);
  return detail::round_contact(one, detail::as_round(one.body), two, detail::as_round(two.body),
                               horizon, contact_gap);
}

}  // namespace

template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap) {
  return contact_of(one, two, horizon, contact_gap, nullptr);
}

template <Body B>
Prediction<B::dimension> first_contact(const Flight<B>& one, const Flight<B>& two, double horizon,
                                       double contact_gap, const SearchStart<B::dimension>& start) {
  return contact_of(one, two, horizon, contact_gap, &start);
}

template Prediction2 first_contact(const Flight<Disk>&, const Flight<Disk>&, double, double);
template Prediction2 first_contact(const Flight<Ellipse>&, const Flight<Ellipse>&, double, double);
template Prediction2 first_contact(const Flight<GrowingEllipse>&, const Flight<GrowingEllipse>&,
                                   double, double);
template Prediction3 first_contact(const Flight<GrowingSphere>&, const Flight<GrowingSphere>&,
                                   double, double);
template Prediction3 first_contact(const Flight<Sphere>&, const Flight<Sphere>&, double, double);
template Prediction3 first_contact(const Flight<Ellipsoid>&, const Flight<Ellipsoid>&, double,
                                   double);
template Prediction3 first_contact(const Flight<GrowingEllipsoid>&, const Flight<GrowingEllipsoid>&,
                                   double, double);
template Prediction3 first_contact(const Flight<TumblingEllipsoid>&,
                                   const Flight<TumblingEllipsoid>&, double, double);
template Prediction2 first_contact(const Flight<Ellipse>&, const Flight<Ellipse>&, double, double,
                                   const SearchStart<2>&);
template Prediction2 first_contact(const Flight<GrowingEllipse>&, const Flight<GrowingEllipse>&,
                                   double, double, const SearchStart<2>&);
template Prediction3 first_contact(const Flight<Ellipsoid>&, const Flight<Ellipsoid>&, double,
                                   double, const SearchStart<3>&);
template Prediction3 first_contact(const Flight<GrowingEllipsoid>&, const Flight<GrowingEllipsoid>&,
                                   double, double, const SearchStart<3>&);
template Prediction3 first_contact(const Flight<TumblingEllipsoid>&,
                                   const Flight<TumblingEllipsoid>&, double, double,
                                   const SearchStart<3>&);

}  // namespace vitrel
