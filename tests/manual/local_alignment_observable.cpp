// The example of docs/tutorials/new-observable.md.

#include "tests/manual/local_alignment_observable.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/neighbors/pairs.h"

namespace vitrel {

namespace {

/// Centres closer than this are neighbours.
constexpr double reach = 2.5;

/// The mean of cos 2(θ_i − θ_j) over pairs of neighbours.
double local_alignment(const Configuration2& frame) {
  const double scale = reach / (2 * largest_circumradius(frame));
  double sum = 0, pairs = 0;
  for_each_pair(frame, std::max(scale, 1.0), [&](std::size_t i, std::size_t j, const Vec2& d) {
    if (i == j || d.squaredNorm() >= reach * reach) return;
    sum += std::cos(2 * (frame.angle[i] - frame.angle[j]));
    ++pairs;
  });
  return sum / pairs;
}

class LocalAlignment final : public FrameObservable<2> {
 public:
  std::function<void()> measure(const Configuration2& frame) override {
    return [this, time = frame.time, value = local_alignment(frame)] {
      time_.push_back(time);
      value_.push_back(value);
    };
  }

  std::vector<Table> tables(bool) const override {
    return {{"local_alignment",
             "Alignment of neighbours: the mean of cos 2(theta_i - theta_j) over pairs of centres "
             "closer than 2.5.",
             {{"time", "time", time_, {}}, {"alignment", "1", value_, {}}}}};
  }

 private:
  std::vector<double> time_, value_;
};

}  // namespace

FrameObservableType<2> local_alignment_observable() {
  const Chart course{.section = Chart::Section::course,
                     .heading = "Local alignment",
                     .symbol = "⟨cos 2(θᵢ − θⱼ)⟩",
                     .curves = {{"alignment", "neighbours"}}};
  return {{{.table = "local_alignment",
            .what = "Alignment of neighbouring particles in single frames.",
            .needs = {.rotors = true},
            .charts = {course}}},
          [](const Configuration2&, const StructureOptions&) {
            return std::make_unique<LocalAlignment>();
          }};
}

}  // namespace vitrel
