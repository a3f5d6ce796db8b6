#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "analysis/observables/frame_observable.h"
#include "analysis/structure/order.h"
#include "analysis/structure/orientation_tensor.h"

namespace vitrel {

namespace {

/// Bins of the angles from the director are about 2° wide each; one of them has the director in its middle.
constexpr std::size_t angle_bins = 91;

/// Observes, in the plane, the density of the angles from the director.
class AngleDistribution final : public FrameObservable<2> {
 public:
  explicit AngleDistribution(const Configuration2& first) : rotors_(rotor_count(first)) {}

  std::function<void()> measure(const Configuration2& frame) override {
    return [this, density = orientation_distribution(frame, angle_bins)] {
      ++frames_;
      density_.add(density);
    };
  }

  std::vector<Table> tables(bool is_even) const override {
    std::vector<double> angle, by_chance;
    const double width = std::numbers::pi / static_cast<double>(angle_bins);
    const double order = nematic_order_by_chance(rotors_, 2);
    for (std::size_t k = 0; k < angle_bins; ++k) {
      angle.push_back((static_cast<double>(k) + 0.5) * width - std::numbers::pi / 2);
      by_chance.push_back((1 + 2 * order * std::cos(2 * angle.back())) / std::numbers::pi);
    }
    return {{"orientation_distribution",
             fmt::format("Density of the angles from the director of each frame, averaged over {} "
                         "frames; by_chance: without order, (1 + 2 S cos(2 angle))/pi, with the S "
                         "of a finite system, about sqrt(pi/(4 R)) = {:.3g}.",
                         frames_, order),
             {{"angle", "rad", std::move(angle)},
              averaged("density", "1/rad", density_, is_even),
              {"by_chance", "1/rad", std::move(by_chance)}}}};
  }

 private:
  std::size_t rotors_, frames_ = 0;
  FrameAverage density_;
};

/// Observes, in space, the orientation tensor.
class TensorAverage final : public FrameObservable<3> {
 public:
  std::function<void()> measure(const Configuration3& frame) override {
    return [this, tensor = orientation_tensor(frame)] {
      ++frames_;
      axes_ = tensor.axes;
      // The rows are x, y and z of the columns x, y and z.
      tensor_.add(std::span(tensor.matrix.data(), 9));
    };
  }

  std::vector<Table> tables(bool is_even) const override {
    const Averages averages = tensor_.averages(is_even);
    const Mat3 mean(averages.mean.data());
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(mean);
    const Vec3& values = solver.eigenvalues();
    const Mat3& vectors = solver.eigenvectors();
    Table table{
        "orientation_tensor",
        fmt::format("T = <w w^T> of the axes w of the {} bodies that are not round: of symmetry, "
                    "of scalene bodies the longest; averaged over {} frames. t_x, t_y, t_z: a row "
                    "of T per line; beside it an eigenvalue, ascending, and its eigenvector.",
                    axes_, frames_),
        {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto rows = [k](const std::vector<double>& matrix) {
        return std::vector(matrix.begin() + 3 * static_cast<std::ptrdiff_t>(k),
                           matrix.begin() + 3 * static_cast<std::ptrdiff_t>(k) + 3);
      };
      table.columns.push_back(
          {fmt::format("t_{}", "xyz"[k]), "1", rows(averages.mean), rows(averages.error)});
    }
    table.columns.push_back({"eigenvalue", "1", {values[0], values[1], values[2]}});
    for (int k = 0; k < 3; ++k)
      table.columns.push_back({fmt::format("eigenvector_{}", "xyz"[k]),
                               "1",
                               {vectors(k, 0), vectors(k, 1), vectors(k, 2)},
                               {}});
    return {table};
  }

 private:
  std::size_t axes_ = 0, frames_ = 0;
  FrameAverage tensor_;
};

}  // namespace

template <int Dim>
FrameObservableType<Dim> orientation_observable();

template <>
FrameObservableType<2> orientation_observable() {
  const Chart chart{.section = Chart::Section::structure,
                    .heading = "Orientations about the director",
                    .symbol = "density",
                    .curves = {{"density", "density"}},
                    .scale = Chart::Scale::from_zero,
                    .x = "angle",
                    .x_symbol = "θ − θ of the director",
                    .references = {{"by_chance", "by chance"}}};
  return {
      {{.table = "orientation_distribution",
        .what = "Density of the angles of the long axes from the director of their frame.",
        .columns = {{"angle", "rad", "from the director"},
                    {"density", "1/rad", "density of the angles", true},
                    {"by_chance", "1/rad", "(1 + 2S cos(2 angle))/π, S of as many random angles"}},
        .needs = {.rotors = true, .averages = true},
        .charts = {chart}}},
      [](const Configuration2& first, const StructureOptions&) {
        return std::make_unique<AngleDistribution>(first);
      }};
}

template <>
FrameObservableType<3> orientation_observable() {
  return {{{.table = "orientation_tensor",
            .what = "Mean second-rank tensor of the axes, with its eigenvalues and eigenvectors.",
            .columns = {{"t_*", "1", "T = ⟨w wᵀ⟩, one row per line", true},
                        {"eigenvalue", "1", "of T, ascending"},
                        {"eigenvector_*", "1", "of T"}},
            .needs = {.rotors = true, .averages = true}}},
          [](const Configuration3&, const StructureOptions&) {
            return std::make_unique<TensorAverage>();
          }};
}

}  // namespace vitrel
