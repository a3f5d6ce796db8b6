#include <fmt/format.h>

#include "analysis/observables/frame_observable.h"
#include "analysis/structure/order.h"
#include "analysis/structure/orientation_tensor.h"

namespace vitrel {

namespace {

/// Observes, in the plane, nematic order and director of the particles that are not round, and hexatic order of all.
class PlaneOrder final : public FrameObservable<2> {
 public:
  explicit PlaneOrder(const Configuration2& first) : rotors_(rotor_count(first)) {}

  std::function<void()> measure(const Configuration2& frame) override {
    return [this, time = frame.time, tensor = order_tensor(frame),
            hexatic = hexatic_order(frame).global] {
      time_.push_back(time);
      nematic_.push_back(tensor.order());
      director_.push_back(tensor.director());
      hexatic_.push_back(hexatic);
    };
  }

  std::vector<Table> tables(bool) const override {
    Table table{"order",
                "Order of single frames: hexatic = |<psi>|, neighbours by Voronoi cells.",
                {{"time", "time", time_}}};
    if (rotors_ > 0) {
      table.description = fmt::format(
          "Order of single frames: nematic = |<exp(2 i theta)>|, about sqrt(pi/(4 R)) = {:.3g} for "
          "the {} rotors without any order; director, its angle from -pi/2 to pi/2; hexatic = "
          "|<psi>|, neighbours by Voronoi cells.",
          nematic_order_by_chance(rotors_, 2), rotors_);
      table.columns.push_back({"nematic", "1", nematic_});
      table.columns.push_back({"director", "rad", director_});
    }
    table.columns.push_back({"hexatic", "1", hexatic_});
    return {table};
  }

  void add_order(OrderSeries& order) const override {
    if (rotors_ > 0) order.nematic = nematic_;
    order.hexatic = hexatic_;
  }

 private:
  std::size_t rotors_;
  std::vector<double> time_, nematic_, director_, hexatic_;
};

/// Observes, in space, nematic order and director of the bodies that are not round.
class SpaceOrder final : public FrameObservable<3> {
 public:
  explicit SpaceOrder(const Configuration3& first) : rotors_(rotor_count(first)) {}

  std::function<void()> measure(const Configuration3& frame) override {
    return [this, time = frame.time, tensor = orientation_tensor(frame)] {
      time_.push_back(time);
      nematic_.push_back(tensor.nematic_order());
      follow(tensor.director());
    };
  }

  std::vector<Table> tables(bool) const override {
    Table table{
        "order",
        fmt::format(
            "Order of single frames: nematic = (3 lambda - 1)/2 with the largest eigenvalue "
            "lambda of the orientation tensor, about {:.3g} for the {} axes without any "
            "order; director: its eigenvector, either of two opposite ones.",
            nematic_order_by_chance(rotors_, 3), rotors_),
        {{"time", "time", time_}, {"nematic", "1", nematic_}}};
    for (std::size_t k = 0; k < 3; ++k)
      table.columns.push_back({fmt::format("director_{}", "xyz"[k]), "1", director_[k]});
    return {table};
  }

  void add_order(OrderSeries& order) const override { order.nematic = nematic_; }

 private:
  /// Takes the one of the two directions that is nearer to the direction of the frame before.
  void follow(Vec3 director) {
    if (director.dot(before_) < 0) director = -director;
    for (std::size_t k = 0; k < 3; ++k) director_[k].push_back(director[static_cast<int>(k)]);
    before_ = director;
  }

  std::size_t rotors_;
  Vec3 before_ = Vec3::Zero();
  std::vector<double> time_, nematic_;
  std::array<std::vector<double>, 3> director_;
};

Observable order_table(Needs needs, std::vector<ColumnKind> columns, std::vector<Curve> curves,
                       Chart director) {
  columns.insert(columns.begin(), frame_time_column());
  const Chart order{.section = Chart::Section::course,
                    .heading = "Order",
                    .symbol = "order parameter",
                    .curves = std::move(curves),
                    .scale = Chart::Scale::from_zero};
  return {.table = "order",
          .what = "Nematic order and director of single frames; in the plane also hexatic order.",
          .columns = std::move(columns),
          .needs = needs,
          .charts = {order, std::move(director)}};
}

}  // namespace

template <int Dim>
FrameObservableType<Dim> order_observable();

template <>
FrameObservableType<2> order_observable() {
  const Chart director{.section = Chart::Section::course,
                       .heading = "Director",
                       .symbol = "angle of the director, continued beyond ±π/2",
                       .curves = {{"director", "director"}},
                       .is_angle_of_axis = true};
  return {{order_table({},
                       {{"nematic", "1", "S = |⟨exp(2iθ)⟩|"},
                        {"director", "rad", "its angle"},
                        {"hexatic", "1", "|⟨ψ₆⟩|, neighbours by Voronoi cells"}},
                       {{"nematic", "nematic"}, {"hexatic", "hexatic"}}, director)},
          [](const Configuration2& first, const StructureOptions&) {
            return std::make_unique<PlaneOrder>(first);
          }};
}

template <>
FrameObservableType<3> order_observable() {
  const Chart director{.section = Chart::Section::course,
                       .heading = "Director",
                       .symbol = "components of the director",
                       .curves = {{"director_x", "x"}, {"director_y", "y"}, {"director_z", "z"}}};
  return {{order_table({.rotors = true},
                       {{"nematic", "1", "S = (3λ − 1)/2, λ the largest eigenvalue of ⟨u uᵀ⟩"},
                        {"director_*", "1", "its eigenvector"}},
                       {{"nematic", "nematic"}}, director)},
          [](const Configuration3& first, const StructureOptions&) {
            return std::make_unique<SpaceOrder>(first);
          }};
}

}  // namespace vitrel
