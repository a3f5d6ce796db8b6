#include <fmt/format.h>

#include "analysis/observables/frame_observable.h"
#include "analysis/structure/pair_correlation.h"
#include "analysis/structure/structure_factor.h"

namespace vitrel {

namespace {

template <int Dim>
class PairCorrelationObservable final : public FrameObservable<Dim> {
 public:
  PairCorrelationObservable(const Configuration<Dim>& first, const PairCorrelationOptions& options)
      : has_rotor_pairs_(rotor_count(first) > 1),
        pairs_(pair_names(first.species_names)),
        options_(options),
        partial_(pairs_.size()) {}

  std::function<void()> measure(const Configuration<Dim>& frame) override {
    return [this, pairs = pair_correlation(frame, options_)] { add(pairs); };
  }

  std::vector<Table> tables(bool is_even) const override {
    Table table{"pair_correlation",
                fmt::format("Pair correlations by the distance r of the centres, in bins of width "
                            "{:g} around r, averaged over {} frames: g is 1 in an ideal gas, as is "
                            "g_A_B of the pairs of species A and B; g_n = {} over the pairs of "
                            "particles that are not round.",
                            options_.distance_step, frames_,
                            Dim == 2 ? "<cos n(theta_i - theta_j)>" : "<P_n(u_i.u_j)>"),
                {{"r", "length", distance_, {}}, averaged("g", "1", g_, is_even)}};
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      Column partial = averaged("g_" + identifier(pairs_[k]), "1", partial_[k], is_even);
      if (!partial.value.empty()) table.columns.push_back(std::move(partial));
    }
    if (has_rotor_pairs_) {
      table.columns.push_back(averaged("g_2", "1", g_2_, is_even));
      table.columns.push_back(averaged("g_4", "1", g_4_, is_even));
    }
    return {table};
  }

 private:
  void add(const PairCorrelation& pairs) {
    ++frames_;
    if (pairs.distance.size() > distance_.size()) distance_ = pairs.distance;
    g_.add(pairs.g);
    for (std::size_t k = 0; k < pairs.partial.size(); ++k) partial_[k].add(pairs.partial[k]);
    g_2_.add(pairs.g_2, pairs.rotor_pairs);
    g_4_.add(pairs.g_4, pairs.rotor_pairs);
  }

  bool has_rotor_pairs_;
  std::vector<std::string> pairs_;
  PairCorrelationOptions options_;
  std::size_t frames_ = 0;
  std::vector<double> distance_;
  FrameAverage g_, g_2_, g_4_;
  std::vector<FrameAverage> partial_;
};

}  // namespace

template <int Dim>
FrameObservableType<Dim> pair_correlation_observable() {
  const Chart chart{.section = Chart::Section::structure,
                    .heading = "Pair correlation",
                    .symbol = "g(r)",
                    .curves = {{"g", "g"}, {"g_#", "g#"}, {"g_*", "g *"}},
                    .scale = Chart::Scale::around_one,
                    .x = "r",
                    .x_symbol = "r",
                    .levels = {1}};
  return {{{.table = "pair_correlation",
            .what = "Pair correlations of the centres, total and of pairs of species, and of the "
                    "orientations, against the distance.",
            .needs = {.averages = true},
            .charts = {chart}}},
          [](const Configuration<Dim>& first, const StructureOptions& options) {
            return std::make_unique<PairCorrelationObservable<Dim>>(first, options.pairs);
          }};
}

template FrameObservableType<2> pair_correlation_observable();
template FrameObservableType<3> pair_correlation_observable();

}  // namespace vitrel
