#include <fmt/format.h>

#include "analysis/observables/frame_observable.h"
#include "analysis/structure/orientation_tensor.h"
#include "analysis/structure/two_point.h"

namespace vitrel {

namespace {

constexpr const char* path_names[] = {"lineal_path_x", "lineal_path_y", "lineal_path_z"};

class TwoPointObservable final : public FrameObservable<3> {
 public:
  explicit TwoPointObservable(const Configuration3& first)
      : grid_(first), has_rotors_(rotor_count(first) > 0) {}

  std::function<void()> measure(const Configuration3& frame) override {
    return [this, found = grid_.measure(frame), axes = orientation_tensor(frame).matrix] {
      spacing_ = found.spacing;
      distance_ = found.distance;
      probability_.add(found.probability);
      for (std::size_t k = 0; k < 3; ++k) {
        paths_[k].add(found.lineal_path[k]);
        along_[k].push_back(axes(static_cast<int>(k), static_cast<int>(k)));
      }
    };
  }

  std::vector<Table> tables(bool is_even) const override {
    Table table{
        "two_point",
        fmt::format("Probabilities that two points at the distance r lie in particles (s2, "
                    "from points {:.4g} apart) and that a segment of length r along an axis "
                    "lies in particles (lineal path, exact).",
                    spacing_),
        {{"r", "length", distance_}, averaged("s2", "1", probability_, is_even)}};
    for (std::size_t k = 0; k < 3; ++k)
      table.columns.push_back(averaged(path_names[k], "1", paths_[k], is_even,
                                       has_rotors_ ? along_[k] : std::span<const double>()));
    return {table};
  }

 private:
  TwoPointGrid grid_;
  bool has_rotors_;
  double spacing_ = 0;
  std::vector<double> distance_;
  FrameAverage probability_;
  std::array<FrameAverage, 3> paths_;
  /// ⟨w_k²⟩ of the axes w of all bodies in every frame. Paths along an axis are as slow as this.
  std::array<std::vector<double>, 3> along_;
};

}  // namespace

FrameObservableType<3> two_point_observable() {
  const Chart chart{.section = Chart::Section::structure,
                    .heading = "Two-point probability and lineal path",
                    .symbol = "S₂(r), L(r)",
                    .curves = {{"s2", "S₂"}, {"lineal_path_*", "L along *"}},
                    .scale = Chart::Scale::from_zero,
                    .x = "r",
                    .x_symbol = "r"};
  return {
      {{.table = "two_point",
        .what = "Two-point probability and lineal path of the particles, against the distance.",
        .columns = {{"r", "length", "distance"},
                    {"s2", "1",
                     "probability that two points at this distance both lie in particles", true},
                    {"lineal_path_*", "1",
                     "probability that a segment of this length along x, y or z lies in a particle",
                     true}},
        .needs = {.averages = true},
        .charts = {chart}}},
      [](const Configuration3& first, const StructureOptions&) {
        return std::make_unique<TwoPointObservable>(first);
      }};
}

}  // namespace vitrel
