#include <fmt/format.h>

#include <array>

#include "analysis/observables/frame_observable.h"
#include "analysis/statistics/blocking.h"
#include "analysis/structure/pair_correlation.h"
#include "analysis/structure/structure_factor.h"

namespace vitrel {

namespace {

/// Returns the name of the column of a bin of θ: in the plane by its middle in degrees, in space by the middle of cos θ
/// in hundredths.
template <int Dim>
std::string column_of_angle(std::size_t bin) {
  if (Dim == 2) return fmt::format("g_theta_{:02}", 5 + 10 * bin);
  return fmt::format("g_cos_theta_{:02}", 95 - 10 * bin);
}

template <int Dim>
class PairCorrelationObservable final : public FrameObservable<Dim> {
 public:
  PairCorrelationObservable(const Configuration<Dim>& first, const PairCorrelationOptions& options)
      : rotors_(rotor_count(first)),
        pairs_(pair_names(first.species_names)),
        options_(options),
        partial_(pairs_.size()),
        mixing_(pairs_.size()) {}

  std::function<void()> measure(const Configuration<Dim>& frame) override {
    return [this, pairs = pair_correlation(frame, options_),
            by_angle = pair_correlation_by_angle(frame, options_)] { add(pairs, by_angle); };
  }

  std::vector<Table> tables(bool is_even) const override {
    Table table{"pair_correlation",
                fmt::format("Pair correlations by the distance r of the centres, in bins of width "
                            "{:g} around r, averaged over {} frames: g is 1 in an ideal gas, as is "
                            "g_A_B of the pairs of species A and B; g_n = {} over the pairs of "
                            "particles that are not round.",
                            options_.distance_step, frames_,
                            Dim == 2 ? "<cos n(theta_i - theta_j)>" : "<P_n(u_i.u_j)>"),
                {{"r", "length", distance_}, averaged("g", "1", g_, is_even)}};
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      Column partial =
          averaged("g_" + identifier(pairs_[k]), "1", partial_[k], is_even, mixing_[k]);
      if (!partial.value.empty()) table.columns.push_back(std::move(partial));
    }
    if (rotors_ > 1) {
      table.columns.push_back(averaged("g_2", "1", g_2_, is_even));
      table.columns.push_back(averaged("g_4", "1", g_4_, is_even));
    }
    return rotors_ == 0 ? std::vector{table} : std::vector{table, table_by_angle(is_even)};
  }

 private:
  void add(const PairCorrelation& pairs, const PairCorrelationByAngle& by_angle) {
    ++frames_;
    if (pairs.distance.size() > distance_.size()) distance_ = pairs.distance;
    g_.add(pairs.g);
    for (std::size_t k = 0; k < pairs.partial.size(); ++k) {
      partial_[k].add(pairs.partial[k]);
      mixing_[k].push_back(mean_of(pairs.partial[k]) - mean_of(pairs.g));
    }
    g_2_.add(pairs.g_2, pairs.rotor_pairs);
    g_4_.add(pairs.g_4, pairs.rotor_pairs);
    if (by_angle.distance.size() > near_.size()) near_ = by_angle.distance;
    for (std::size_t k = 0; k < by_angle.g.size(); ++k) by_angle_[k].add(by_angle.g[k]);
  }

  Table table_by_angle(bool is_even) const {
    const std::string what = fmt::format(
        "Pair correlation by the distance r of the centres, in bins of width {:g} around r, and by "
        "the angle theta, from 0 to pi/2, between their separation and the {} of the first "
        "particle, averaged over {} frames and all pairs whose first is not round: 1 in an ideal "
        "gas. {}.",
        options_.distance_step, Dim == 2 ? "long axis" : "figure axis", frames_,
        Dim == 2 ? "g_theta_05: theta from 0 to 10 degrees, and so on in steps of 10"
                 : "g_cos_theta_95: cos theta from 1 to 0.9, and so on in steps of 0.1");
    Table table{"pair_correlation_by_angle", what, {{"r", "length", near_}}};
    for (std::size_t k = 0; k < by_angle_.size(); ++k)
      table.columns.push_back(averaged(column_of_angle<Dim>(k), "1", by_angle_[k], is_even));
    return table;
  }

  std::size_t rotors_;
  std::vector<std::string> pairs_;
  PairCorrelationOptions options_;
  std::size_t frames_ = 0;
  std::vector<double> distance_, near_;
  FrameAverage g_, g_2_, g_4_;
  std::vector<FrameAverage> partial_;
  /// Mean of g_A_B − g over the distances in every frame. Pairs of species are as slow as these mix.
  std::vector<std::vector<double>> mixing_;
  std::array<FrameAverage, axis_angle_bins<Dim>> by_angle_;
};

/// Returns the curves of some bins, since there are only eight colours; the first and the last are among them.
template <int Dim>
std::vector<Curve> curves_by_angle() {
  std::vector<Curve> curves;
  for (std::size_t k = 0; k < axis_angle_bins<Dim>; k += Dim == 2 ? 2 : 3)
    curves.push_back({column_of_angle<Dim>(k), fmt::format(Dim == 2 ? "θ = {}°" : "cos θ = 0.{:02}",
                                                           Dim == 2 ? 5 + 10 * k : 95 - 10 * k)});
  return curves;
}

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
  Chart by_angle = chart;
  by_angle.heading = "Pair correlation along and across the axis";
  by_angle.symbol = "g(r, θ)";
  by_angle.curves = curves_by_angle<Dim>();
  return {{{.table = "pair_correlation",
            .what = "Pair correlations of the centres, total and of pairs of species, and of the "
                    "orientations, against the distance.",
            .columns = {{"r", "length", "distance of the centres"},
                        {"g", "1", "pairs in a bin, over those of an ideal gas", true},
                        {"g_#", "1",
                         "⟨cos n(θ_i − θ_j)⟩, in space ⟨P_n(u_i·u_j)⟩, of the pairs of rotors at r",
                         true},
                        {"g_*_*", "1", "g of a pair of species", true}},
            .needs = {.averages = true},
            .charts = {chart}},
           {.table = "pair_correlation_by_angle",
            .what = "Pair correlation against the distance, by the angle between the separation "
                    "and the axis of the first particle.",
            .columns = {{"r", "length", "distance of the centres"},
                        {Dim == 2 ? "g_theta_#" : "g_cos_theta_#", "1",
                         Dim == 2 ? "of pairs with θ around so many degrees"
                                  : "of pairs with cos θ around so many hundredths",
                         true}},
            .needs = {.rotors = true, .averages = true},
            .charts = {by_angle}}},
          [](const Configuration<Dim>& first, const StructureOptions& options) {
            return std::make_unique<PairCorrelationObservable<Dim>>(first, options.pairs);
          }};
}

template FrameObservableType<2> pair_correlation_observable();
template FrameObservableType<3> pair_correlation_observable();

}  // namespace vitrel
