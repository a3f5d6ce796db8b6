#include "mc/insertion.h"

#include <algorithm>
#include <iomanip>
#include <numbers>
#include <numeric>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/contact/contact_queries.h"
#include "core/contact/resting_bodies.h"
#include "core/elementary.h"
#include "core/neighbors/cell_grid.h"
#include "core/random/stream.h"
#include "core/state/figure_axis.h"
#include "mc/axis_distribution.h"
#include "mc/hard_core.h"

namespace vitrel {

namespace {

/// The share of the packing fraction reached up to which insertion is fast.
constexpr double safe_fraction = 0.9;

template <int Dim>
std::vector<std::size_t> largest_first(const Configuration<Dim>& configuration) {
  std::vector<std::size_t> order(configuration.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return configuration.shape[i].volume() > configuration.shape[j].volume();
  });
  return order;
}

Pose2 random_pose(const PeriodicBox<2>& box, bool aligned, Stream& draw) {
  // Each expression draws one number, since the language leaves open which of two is drawn first; y is drawn first.
  const double y = draw.uniform(-0.5, 0.5) * box.lengths().y();
  const double x = draw.uniform(-0.5, 0.5) * box.lengths().x();
  return {{x, y}, aligned ? 0 : draw.uniform(0, std::numbers::pi)};
}

/// The orientation is uniform over all rotations, since its quaternion is a random direction in four dimensions.
Pose3 random_pose(const PeriodicBox<3>& box, bool aligned, Stream& draw) {
  Pose3 pose;
  for (int k = 0; k < 3; ++k) pose.position[k] = draw.uniform(-0.5, 0.5) * box.lengths()[k];
  if (aligned) return pose;
  for (int k = 0; k < 4; ++k) pose.orientation.coeffs()[k] = draw.normal();
  pose.orientation = normalized(pose.orientation);
  return pose;
}

/// Turns the pose so that its axis lies along u or −u.
void turn_to(const ParticleShape<2>&, const Vec2& u, Pose2& pose) {
  pose.angle = polar_angle(u.y(), u.x());
}
/// Turns the pose by the smallest rotation, so that a random orientation stays random around u.
void turn_to(const ParticleShape<3>& shape, const Vec3& u, Pose3& pose) {
  const Vec3 axis = figure_axis(shape, pose.orientation);
  const Vec3 near = dot(axis, u) < 0 ? Vec3(-u) : u;
  const Vec3 across = axis.cross(near);
  const Quaternion turn(1 + dot(axis, near), across.x(), across.y(), across.z());
  pose.orientation = normalized(turn * pose.orientation);
}

template <int Dim>
std::optional<AxisDistribution<Dim>> axis_distribution(const std::vector<double>& tensor) {
  if (tensor.empty()) return std::nullopt;
  using Tensor = typename AxisDistribution<Dim>::Tensor;
  return AxisDistribution<Dim>(Eigen::Map<const Tensor>(tensor.data()));
}

template <int Dim>
class Insertion {
 public:
  Insertion(Configuration<Dim>& configuration, const InsertionOptions& options)
      : configuration_(configuration),
        options_(options),
        axes_(axis_distribution<Dim>(options.orientation_tensor)),
        cells_(configuration.box, 2 * largest_circumradius(configuration), configuration.size()),
        largest_(largest_circumradius(configuration)),
        margin_(hard_margin(configuration)) {}

  bool insert(std::size_t i, Stream draw) {
    // The axis is drawn once: new axes at new places would favour those that are aligned and therefore fit.
    const Vec<Dim> axis = axes_ ? (*axes_)(draw) : Vec<Dim>(Vec<Dim>::Zero());
    for (std::uint64_t attempt = 0; attempt < options_.attempts; ++attempt) {
      ++trials;
      Pose<Dim> pose = random_pose(configuration_.box, options_.aligned, draw);
      if (axes_) turn_to(configuration_.shape[i], axis, pose);
      if (!fits(i, pose)) continue;
      configuration_.set_pose(i, pose);
      configuration_.image[i] = Shift<Dim>::Zero();
      cells_.insert(i, pose.position);
      return true;
    }
    return false;
  }

  std::uint64_t trials = 0;

 private:
  bool fits(std::size_t i, const Pose<Dim>& pose) const {
    const ParticleShape<Dim>& shape = configuration_.shape[i];
    const double reach = shape.circumradius() + largest_ + margin_;
    const auto clear_of = [&](std::size_t j, const Shift<Dim>&, const Vec<Dim>& d) {
      return separated(shape, pose, configuration_.shape[j], configuration_.pose(j), d, margin_);
    };
    return cells_.for_each_near(pose.position, reach, clear_of) &&
           clear_of_periodic_images(
               configuration_.box,
               RestingBodies<ParticleShape<Dim>>::body(shape, orientation_of(pose)), margin_);
  }

  Configuration<Dim>& configuration_;
  const InsertionOptions& options_;
  std::optional<AxisDistribution<Dim>> axes_;
  CellGrid<Dim> cells_;
  double largest_, margin_;
};

std::string failure_text(std::size_t placed, std::size_t particles, double reached,
                         std::uint64_t attempts) {
  std::ostringstream text;
  text << "insertion failed: after " << placed << " of " << particles
       << " particles, at a packing fraction of " << reached << ", " << attempts
       << " attempts found no position for the next; insert at " << std::setprecision(2)
       << safe_fraction * reached << " at most, and compress by swelling or growth from there";
  return text.str();
}

}  // namespace

template <int Dim>
InsertionReport insert_particles(Configuration<Dim>& configuration, const InsertionOptions& options,
                                 std::uint64_t seed, const RunControl& control) {
  scale_to_packing_fraction(configuration, options.packing_fraction);
  Insertion insertion(configuration, options);
  std::size_t placed = 0;
  double covered = 0;
  const auto ended = [&](StageEnd end, const std::string& reason) {
    return InsertionReport{{end, reason}, insertion.trials};
  };
  for (std::size_t i : largest_first(configuration)) {
    if (control.stop_requested()) return ended(StageEnd::stopped, "insertion was stopped");
    if (!insertion.insert(i, Stream(seed, Purpose::placement, 0, i)))
      return ended(StageEnd::stalled,
                   failure_text(placed, configuration.size(), covered / configuration.box.volume(),
                                options.attempts));
    ++placed;
    covered += configuration.shape[i].volume();
    const double share = static_cast<double>(placed) / static_cast<double>(configuration.size());
    control.report_progress({share, static_cast<double>(placed), "particles"});
  }
  return ended(StageEnd::reached, "all particles inserted");
}

template InsertionReport insert_particles(Configuration2&, const InsertionOptions&, std::uint64_t,
                                          const RunControl&);
template InsertionReport insert_particles(Configuration3&, const InsertionOptions&, std::uint64_t,
                                          const RunControl&);

}  // namespace vitrel
