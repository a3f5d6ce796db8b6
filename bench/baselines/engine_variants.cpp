#include "bench/baselines/engine_variants.h"

#include "bench/baselines/no_lower_bound.h"
#include "edmd/simulation.h"

namespace vitrel::bench {
namespace {

// Ellipse types, each of which the engine treats differently.
struct SearchedEllipse : Ellipse {};
struct UnlimitedEllipse : Ellipse {};

struct RoundListedEllipse : Ellipse {
  RoundListedEllipse() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): the same ellipse, listed otherwise
  RoundListedEllipse(const Ellipse& ellipse) : Ellipse(ellipse) {}
  double max_support_rate() const { return 0; }  // of its neighbourhood
};

}  // namespace
}  // namespace vitrel::bench

namespace vitrel {

template <>
struct ShapeOf<bench::SearchedEllipse> : ShapeOf<Ellipse> {};
template <>
struct ShapeOf<bench::UnlimitedEllipse> : ShapeOf<Ellipse> {};

template <>
class ContactScreen<bench::SearchedEllipse> : public bench::NoLowerBound<bench::SearchedEllipse> {
 public:
  using NoLowerBound<bench::SearchedEllipse>::NoLowerBound;
};

template <>
class ContactScreen<bench::UnlimitedEllipse> : public ContactScreen<Ellipse> {
 public:
  using ContactScreen<Ellipse>::ContactScreen;
};

template <>
class ContactScreen<bench::RoundListedEllipse> : public ContactScreen<Ellipse> {
 public:
  using ContactScreen<Ellipse>::ContactScreen;
};

template <>
struct ShapeCoefficients<bench::RoundListedEllipse> : ShapeCoefficients<Ellipse> {
  using ShapeCoefficients<Ellipse>::ShapeCoefficients;
};

/// The axis is that of the ellipses, the gap that of their circumcircles.
template <>
class GapBatch<bench::RoundListedEllipse> : public GapBatch<Ellipse> {
 public:
  GapBatch(const Ellipse& shape, double angle, double limit)
      : GapBatch<Ellipse>(shape, angle, limit), radius_(shape.a) {}
  void set(int k, const Ellipse& shape, double angle, const Vec2& d) {
    round_gap_[k] = d.norm() - radius_ - shape.a;
    GapBatch<Ellipse>::set(k, shape, angle, d);
  }
  double gap(int k) const { return round_gap_[k]; }

 private:
  double radius_;
  double round_gap_[lanes] = {};
};

// The margin of lists shaped like the particles.
template <>
double Neighborhoods<bench::RoundListedEllipse>::choose_gap(double target) {
  const std::vector<Ellipse> shapes(shapes_.begin(), shapes_.end());
  std::vector<Pose2> poses;
  for (const Reference& reference : references_)
    poses.push_back({reference.position, reference.orientation()});
  return 2 * Neighborhoods<Ellipse>(box_, shapes, type_index_, poses, target).margin();
}

// As for every body, but what the partners know is no limit.
template <>
template <>
void NeighborBatch<bench::UnlimitedEllipse, ContactScreen<bench::UnlimitedEllipse>::lanes>::load<
    PredictionScope::all_neighbors>(SimulationState<bench::UnlimitedEllipse>& state,
                                    std::uint32_t /*i*/,
                                    std::span<const Neighbor<bench::UnlimitedEllipse>> neighbors,
                                    std::size_t first) {
  constexpr std::size_t lanes = ContactScreen<bench::UnlimitedEllipse>::lanes;
  count = static_cast<int>(std::min(lanes, neighbors.size() - first));
  tested = static_cast<std::uint64_t>(count);
  for (std::size_t k = 0; k < lanes; ++k) {
    const auto& neighbor = neighbors[std::min(first + k, neighbors.size() - 1)];
    copy_[k] = state.particles[neighbor.other];
    copy_[k].position += state.box.translation(neighbor.shift());
    copy_[k].known_until = std::numeric_limits<double>::infinity();
    partner[k] = &copy_[k];
    warm_start[k] = &neighbor.warm_start;
    other[k] = neighbor.other;
  }
}

}  // namespace vitrel

namespace vitrel::bench {
namespace {

template <class B>
Flight<Ellipse> plain(const Flight<B>& flight) {
  return {flight.body, flight.pose, flight.motion};
}

// The event loop calls these instead of the predictor for ellipses.
Prediction2 first_contact(const Flight<SearchedEllipse>& one, const Flight<SearchedEllipse>& two,
                          double horizon, double contact_gap, double /*screened_until*/,
                          const WarmStart<SearchedEllipse>& /*warm_start*/) {
  return vitrel::first_contact(plain(one), plain(two), horizon, contact_gap);
}

template <class B>
requires std::same_as<B, UnlimitedEllipse> || std::same_as<B, RoundListedEllipse> Prediction2
first_contact(const Flight<B>& one, const Flight<B>& two, double horizon, double contact_gap,
              double screened_until, const WarmStart<Ellipse>& warm_start) {
  return vitrel::first_contact(plain(one), plain(two), horizon, contact_gap,
                               {screened_until, warm_start.axis});
}

}  // namespace

std::unique_ptr<Engine2> make_engine_without_lower_bound() {
  return std::make_unique<Simulation<SearchedEllipse>>(EngineOptions{},
                                                       "without the contact screen");
}
std::unique_ptr<Engine2> make_engine_without_horizon() {
  return std::make_unique<Simulation<UnlimitedEllipse>>(EngineOptions{}, "without the horizon");
}
std::unique_ptr<Engine2> make_engine_with_round_lists() {
  return std::make_unique<Simulation<RoundListedEllipse>>(EngineOptions{}, "with round lists");
}

}  // namespace vitrel::bench
