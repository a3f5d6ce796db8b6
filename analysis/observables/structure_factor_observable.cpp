#include <fmt/format.h>

#include <mutex>

#include "analysis/observables/frame_observable.h"
#include "analysis/structure/structure_factor.h"

namespace vitrel {

namespace {

/// The wave vectors of the present box. Threads share them, but only one at a time makes or destroys them.
template <int Dim>
class SharedShells {
 public:
  using Shells = ScatteringShells<Dim>;

  explicit SharedShells(const ShellOptions& options) : options_(options) {}

  StructureFactor structure_factor(const Configuration<Dim>& frame) {
    std::shared_ptr<const Shells> shells = of(frame.box.lengths());
    StructureFactor found = shells->structure_factor(frame);
    const std::lock_guard lock(mutex_);
    shells.reset();
    return found;
  }

 private:
  std::shared_ptr<const Shells> of(const Vec<Dim>& lengths) {
    const std::lock_guard lock(mutex_);
    if (!shells_ || lengths != lengths_)
      shells_ = std::make_shared<const Shells>(lengths, options_);
    lengths_ = lengths;
    return shells_;
  }

  ShellOptions options_;
  std::mutex mutex_;
  Vec<Dim> lengths_ = Vec<Dim>::Zero();
  std::shared_ptr<const Shells> shells_;
};

template <int Dim>
class StructureFactorObservable final : public FrameObservable<Dim> {
 public:
  StructureFactorObservable(const Configuration<Dim>& first, const ShellOptions& options)
      : pairs_(pair_names(first.species_names)), shells_(options) {}

  std::function<void()> measure(const Configuration<Dim>& frame) override {
    return [this, found = shells_.structure_factor(frame)] { add(found); };
  }

  std::vector<Table> tables(bool is_even) const override {
    Table table{"structure_factor", description(), {}};
    const auto column = [&](const std::string& name, const char* unit, const FrameAverage& rows) {
      table.columns.push_back(averaged(name, unit, rows, is_even));
    };
    column("q", "1/length", wave_numbers_);
    table.columns.back().error.clear();
    column("s", "1", total_);
    for (std::size_t k = 0; k < partial_.size(); ++k)
      column("s_" + identifier(pairs_[k]), "1", partial_[k]);
    if (has_orientation_) column("s_orientation", "1", orientation_);
    column("modes", "1", modes_);
    table.columns.back().error.clear();
    drop_empty_shells(table);
    return {table};
  }

 private:
  void add(const StructureFactor& s) {
    ++frames_;
    wave_numbers_.add(s.q, s.modes);
    modes_.add(s.modes);
    total_.add(s.total, s.modes);
    partial_.resize(s.partial.size());
    for (std::size_t k = 0; k < s.partial.size(); ++k) partial_[k].add(s.partial[k], s.modes);
    has_orientation_ = !s.orientation.empty();
    if (has_orientation_) orientation_.add(s.orientation, s.modes);
  }

  std::string description() const {
    return fmt::format(
        "Structure factors averaged over the wave vectors of a shell of wave numbers q and over {} "
        "frames: s = <|sum_a rho_a(q)|^2>/N; of species, s_A_B = Re <rho_A(q) rho_B(-q)>/"
        "sqrt(N_A N_B); {}modes is the number of wave vectors, q and -q counted once.",
        frames_,
        Dim == 2 ? "s_orientation that of the field exp(2 i theta) over the R particles that are "
                   "not round, per R; "
                 : "");
  }

  /// Drops shells without wave vectors, which are narrow shells of small boxes.
  static void drop_empty_shells(Table& table) {
    const std::vector<double> modes = table.columns.back().value;
    const auto drop = [&](std::vector<double>& values) {
      std::size_t kept = 0;
      for (std::size_t k = 0; k < values.size(); ++k)
        if (modes[k] > 0) values[kept++] = values[k];
      values.resize(kept);
    };
    for (Column& column : table.columns) {
      drop(column.value);
      drop(column.error);
    }
  }

  std::vector<std::string> pairs_;
  SharedShells<Dim> shells_;
  std::size_t frames_ = 0;
  bool has_orientation_ = false;
  FrameAverage wave_numbers_, modes_, total_, orientation_;
  std::vector<FrameAverage> partial_;
};

}  // namespace

template <int Dim>
FrameObservableType<Dim> structure_factor_observable() {
  Chart chart{.section = Chart::Section::structure,
              .heading = "Structure factor",
              .symbol = "S(q)",
              .curves = {{"s", "S"}, {"s_*", "S *"}},
              .scale = Chart::Scale::around_one,
              .x = "q",
              .x_symbol = "q",
              .levels = {1}};
  if (Dim == 2)
    chart.curves.insert(chart.curves.begin() + 1, {"s_orientation", "S of orientations"});
  return {
      {{.table = "structure_factor",
        .what = "Structure factors against the wave number, total and of pairs of species; in the "
                "plane also that of the orientations.",
        .columns = {{"q", "1/length", "wave number of the shell"},
                    {"modes", "1", "wave vectors, q and −q counted once"},
                    {"s", "1", "⟨|Σ exp(iq·r_j)|²⟩/N", true},
                    {"s_*_*", "1", "Re⟨ρ_A(q) ρ_B(−q)⟩/√(N_A N_B)", true},
                    {"s_orientation", "1", "⟨|Σ exp(2iθ_j + iq·r_j)|²⟩/R (in the plane)", true}},
        .needs = {.averages = true},
        .charts = {chart}}},
      [](const Configuration<Dim>& first, const StructureOptions& options) {
        return std::make_unique<StructureFactorObservable<Dim>>(first, options.shells);
      }};
}

template FrameObservableType<2> structure_factor_observable();
template FrameObservableType<3> structure_factor_observable();

}  // namespace vitrel
