#include "workflow/analyze/structure_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "analysis/structure/frame_average.h"
#include "analysis/structure/order.h"
#include "core/parallel.h"

namespace vitrel {
namespace {

/// Of the angles from the director: about 2° each, one of them in the middle around it.
constexpr std::size_t angle_bins = 91;
/// Frames shared by the threads at a time.
constexpr std::size_t frames_at_once = 32;

/// One frame, and all that is measured in it.
struct Measured {
  Configuration2 configuration;
  std::shared_ptr<const ScatteringShells<2>> shells;

  StructureFactor scattering;
  PairCorrelation pairs;
  std::vector<double> orientations;
  OrderTensor order;
  double hexatic = 0;

  void measure(const StructureOptions& options) {
    scattering = shells->structure_factor(configuration);
    pairs = pair_correlation(configuration, options.pairs);
    orientations = orientation_distribution(configuration, angle_bins);
    order = order_tensor(configuration);
    hexatic = hexatic_order(configuration).global;
  }
};

/// What the tables are made of.
class StructureAverages {
 public:
  explicit StructureAverages(const StructureOptions& options) : options_(options) {}

  void add(const Measured& frame) {
    last_ = frame.configuration;
    time_.push_back(frame.configuration.time);
    add_scattering(frame.scattering);
    add_pairs(frame.pairs);
    orientations_.add(frame.orientations);
    nematic_.push_back(frame.order.order());
    director_.push_back(frame.order.director());
    hexatic_.push_back(frame.hexatic);
  }

  std::vector<Table> tables() const {
    std::vector<Table> tables{scattering_table(), pair_table()};
    if (rotor_count(last_) > 0) tables.push_back(orientation_table());
    tables.push_back(order_table());
    return tables;
  }

 private:
  void add_scattering(const StructureFactor& s) {
    wave_numbers_.add(s.q, s.modes);
    modes_.add(s.modes);
    total_.add(s.total, s.modes);
    partial_.resize(s.partial.size());
    for (std::size_t k = 0; k < s.partial.size(); ++k) partial_[k].add(s.partial[k], s.modes);
    if (!s.orientation.empty()) orientation_.add(s.orientation, s.modes);
  }

  void add_pairs(const PairCorrelation& pairs) {
    if (pairs.distance.size() > distance_.size()) distance_ = pairs.distance;
    g_.add(pairs.g);
    g_2_.add(pairs.g_2, pairs.rotor_pairs);
    g_4_.add(pairs.g_4, pairs.rotor_pairs);
  }

  Column column(const std::string& name, const std::string& unit, const FrameAverage& of) const {
    Averages averages = of.averages(evenly_spaced(time_));
    return {name, unit, std::move(averages.mean), std::move(averages.error)};
  }

  Table scattering_table() const {
    Table table{"structure_factor",
                fmt::format("Structure factors averaged over the wave vectors of a shell of wave "
                            "numbers q and over {} frames: s = <|sum_a rho_a(q)|^2>/N; of species, "
                            "s_A_B = Re <rho_A(q) rho_B(-q)>/sqrt(N_A N_B); s_orientation that of "
                            "the field exp(2 i theta) over the R particles that are not round, per "
                            "R; modes is the number of wave vectors, q and -q counted once.",
                            time_.size()),
                {}};
    table.columns = {{"q", "1/length", column("q", "", wave_numbers_).value, {}},
                     column("s", "1", total_)};
    const std::vector<std::string> names = pair_names(last_.species_names);
    for (std::size_t k = 0; k < partial_.size(); ++k)
      table.columns.push_back(column("s_" + identifier(names[k]), "1", partial_[k]));
    if (rotor_count(last_) > 0) table.columns.push_back(column("s_orientation", "1", orientation_));
    table.columns.push_back({"modes", "1", column("modes", "", modes_).value, {}});
    drop_empty_shells(table);
    return table;
  }

  /// Narrow shells of small boxes have no wave vectors.
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

  Table pair_table() const {
    Table table{"pair_correlation",
                fmt::format("Pair correlations by the distance r of the centres, in bins of width "
                            "{:g} around r, averaged over {} frames: g is 1 in an ideal gas; g_n = "
                            "<cos n(theta_i - theta_j)> over the pairs of particles that are not "
                            "round.",
                            options_.pairs.distance_step, time_.size()),
                {{"r", "length", distance_, {}}, column("g", "1", g_)}};
    if (rotor_count(last_) > 1) {
      table.columns.push_back(column("g_2", "1", g_2_));
      table.columns.push_back(column("g_4", "1", g_4_));
    }
    return table;
  }

  Table orientation_table() const {
    std::vector<double> angle;
    const double width = std::numbers::pi / static_cast<double>(angle_bins);
    for (std::size_t k = 0; k < angle_bins; ++k)
      angle.push_back((static_cast<double>(k) + 0.5) * width - std::numbers::pi / 2);
    return {"orientation_distribution",
            fmt::format("Density of the angles from the director of each frame, averaged over {} "
                        "frames; without order it is (1 + 2 S cos(2 angle))/pi, with the S of a "
                        "finite system, about sqrt(pi/(4 R)) = {:.3g}.",
                        time_.size(), nematic_order_by_chance(rotor_count(last_))),
            {{"angle", "rad", std::move(angle), {}}, column("density", "1/rad", orientations_)}};
  }

  Table order_table() const {
    const std::size_t rotors = rotor_count(last_);
    Table table{"order",
                "Order of single frames: hexatic = |<psi>|, neighbours by Voronoi cells.",
                {{"time", "time", time_, {}}}};
    if (rotors > 0) {
      table.description = fmt::format(
          "Order of single frames: nematic = |<exp(2 i theta)>|, about sqrt(pi/(4 R)) = {:.3g} for "
          "the {} rotors without any order; director, its angle from -pi/2 to pi/2; hexatic = "
          "|<psi>|, neighbours by Voronoi cells.",
          nematic_order_by_chance(rotors), rotors);
      table.columns.push_back({"nematic", "1", nematic_, {}});
      table.columns.push_back({"director", "rad", director_, {}});
    }
    table.columns.push_back({"hexatic", "1", hexatic_, {}});
    return table;
  }

  StructureOptions options_;
  Configuration2 last_;
  std::vector<double> time_, distance_, nematic_, director_, hexatic_;
  FrameAverage wave_numbers_, modes_, total_, orientation_, g_, g_2_, g_4_, orientations_;
  std::vector<FrameAverage> partial_;
};

}  // namespace

std::vector<Table> structure_tables(Trajectory& trajectory, const StructureOptions& options,
                                    int threads, const ProgressReport& report) {
  StructureAverages averages(options);
  const std::size_t stride = (trajectory.frames() + options.max_frames - 1) / options.max_frames;
  std::shared_ptr<const ScatteringShells<2>> shells;
  Vec2 lengths = Vec2::Zero();
  for (std::size_t next = 0; next < trajectory.frames();) {
    std::vector<Measured> batch;
    for (; next < trajectory.frames() && batch.size() < frames_at_once; next += stride) {
      Measured& frame = batch.emplace_back();
      frame.configuration = trajectory.read(next);
      if (frame.configuration.box.lengths() != lengths) {
        lengths = frame.configuration.box.lengths();
        shells = std::make_shared<const ScatteringShells<2>>(lengths, options.shells);
      }
      frame.shells = shells;
    }
    in_parallel(batch.size(), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) batch[k].measure(options);
    });
    for (const Measured& frame : batch) averages.add(frame);
    const auto done = static_cast<double>(std::min(next, trajectory.frames()));
    if (report) report({done / static_cast<double>(trajectory.frames()), done, "frames"});
  }
  return averages.tables();
}

}  // namespace vitrel
