#include "core/io/foreign/foreign_frame.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

#include "core/elementary.h"
#include "core/error.h"
#include "core/io/box_crossings.h"
#include "core/io/quantity.h"
#include "core/state/bounds.h"
#include "core/state/species.h"
#include "core/tolerances.h"

namespace vitrel {
namespace {

template <class Entry>
void require_entries(const std::vector<Entry>& entries, std::size_t particles, const char* what) {
  if (!entries.empty() && entries.size() != particles)
    throw UserError(fmt::format("has {} particles, but {} {}", particles, entries.size(), what));
}

void require_equal_numbers(const ForeignFrame& frame, std::size_t n) {
  if (n == 0) throw UserError("has no positions");
  require_entries(frame.position, n, "positions");
  require_entries(frame.unwrapped, n, "unwrapped positions");
  require_entries(frame.image, n, "images");
  require_entries(frame.angle, n, "angles");
  require_entries(frame.orientation, n, "orientations");
  require_entries(frame.half_lengths, n, "semi-axes");
  require_entries(frame.mass, n, "masses");
  require_entries(frame.velocity, n, "velocities");
  require_entries(frame.angular_velocity, n, "angular velocities");
  require_entries(frame.species, n, "species");
}

template <int Dim>
PeriodicBox<Dim> box_of(const ForeignFrame& frame, const KnownSystem& known) {
  const std::optional<Vec3>& edges = frame.box ? frame.box : known.box;
  if (!edges) throw UserError("has no box");
  const Vec<Dim> lengths = edges->template head<Dim>();
  if (!lengths.allFinite() || lengths.minCoeff() <= 0)
    throw UserError(fmt::format("has the box {}, but its edges should be finite and above 0",
                                fmt::join(lengths, " × ")));
  return PeriodicBox<Dim>(lengths);
}

const std::vector<Vec3>& places_of(const ForeignFrame& frame) {
  return frame.position.empty() ? frame.unwrapped : frame.position;
}

/// Returns how far the heights of the particles are apart.
double height_range(const std::vector<Vec3>& positions) {
  const auto height = [](const Vec3& position) { return position[2]; };
  const auto [lowest, highest] = std::ranges::minmax(positions, {}, height);
  return highest[2] - lowest[2];
}

/// Returns how far apart the heights of particles in the plane may be.
double flat_range(const ForeignFrame& frame, const KnownSystem& known) {
  const std::optional<Vec3>& box = frame.box ? frame.box : known.box;
  return tolerance::flat * (box ? box->x() : 1);
}

double longest_half_length(const ForeignFrame& frame, const KnownSystem& known) {
  double longest = 0;
  for (const Vec3& half : frame.half_lengths) longest = std::max(longest, half.maxCoeff());
  for (const KnownSpecies& species : known.species)
    if (frame.half_lengths.empty() && species.half_lengths)
      longest = std::max(longest, species.half_lengths->maxCoeff());
  return longest;
}

/// Returns the names of the frame's species in the order of their numbers: first the known species in their order, then
/// the others in alphabetical order.
std::vector<std::string> species_names(const ForeignFrame& frame, const KnownSystem& known) {
  std::vector<std::string> known_names, names;
  for (const KnownSpecies& species : known.species) known_names.push_back(species.name);
  if (frame.species.empty()) {
    if (known_names.size() > 1)
      throw UserError(fmt::format("does not say which of the species {} its particles belong to",
                                  fmt::join(known_names, ", ")));
    return known_names.empty() ? std::vector<std::string>{"A"} : known_names;
  }
  const std::set<std::string> stated(frame.species.begin(), frame.species.end());
  std::ranges::copy_if(known_names, std::back_inserter(names),
                       [&](const std::string& name) { return stated.contains(name); });
  for (const std::string& name : stated)
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

std::int32_t species_number(const std::vector<std::string>& names, const ForeignFrame& frame,
                            std::size_t i) {
  if (frame.species.empty()) return 0;
  return static_cast<std::int32_t>(std::ranges::find(names, frame.species[i]) - names.begin());
}

const KnownSpecies* known_species(const KnownSystem& known, const std::string& name) {
  const auto found = std::ranges::find(known.species, name, &KnownSpecies::name);
  return found == known.species.end() ? nullptr : &*found;
}

Vec3 half_lengths_of(const ForeignFrame& frame, const KnownSpecies* known, std::size_t i,
                     const std::string& name) {
  if (!frame.half_lengths.empty()) return frame.half_lengths[i];
  if (known && known->half_lengths) return *known->half_lengths;
  throw UserError(fmt::format(
      "has no semi-axes for species {}; give them there, or as a [[species]] whose particles all "
      "have the same",
      name));
}

double mass_of(const ForeignFrame& frame, const KnownSpecies* known, std::size_t i,
               const auto& shape) {
  const double mass = !frame.mass.empty()    ? frame.mass[i]
                      : known && known->mass ? *known->mass
                                             : shape.natural_mass();
  if (!bounds::mass.contains(mass))
    throw UserError(fmt::format("the mass of particle {} is {}, but {}", i, mass,
                                requirement(bounds::mass, mass)));
  return mass;
}

template <int Dim>
ParticleShape<Dim> shape_of_particle(std::size_t i, const Vec<Dim>& half_lengths) {
  if (const auto shape = shape_of<Dim>(half_lengths)) return *shape;
  throw UserError(fmt::format("particle {} has the semi-axes {}, but should have {}", i,
                              fmt::join(half_lengths, ", "), half_lengths_rule<Dim>()));
}

template <int Dim>
void set_particles(Configuration<Dim>& configuration, const ForeignFrame& frame,
                   const KnownSystem& known) {
  configuration.species_names = species_names(frame, known);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const std::int32_t species = species_number(configuration.species_names, frame, i);
    const std::string& name = configuration.species_names[static_cast<std::size_t>(species)];
    const KnownSpecies* const kind = known_species(known, name);
    configuration.species[i] = species;
    const Vec3 half_lengths = half_lengths_of(frame, kind, i, name);
    configuration.shape[i] = shape_of_particle<Dim>(i, half_lengths.head<Dim>());
    configuration.mass[i] = mass_of(frame, kind, i, configuration.shape[i]);
  }
}

/// Returns the whole boxes between a position and its unwrapped position.
template <int Dim>
Shift<Dim> boxes_between(const PeriodicBox<Dim>& box, const Vec<Dim>& wrapped,
                         const Vec<Dim>& unwrapped, std::size_t i) {
  const Vec<Dim> boxes = (unwrapped - wrapped).cwiseQuotient(box.lengths());
  constexpr double rounding = 1e-6;  // rounding of numbers in single precision
  for (int k = 0; k < Dim; ++k)
    if (!(std::abs(boxes[k]) <= max_box_crossings &&
          std::abs(boxes[k] - std::round(boxes[k])) < rounding))
      throw UserError(
          fmt::format("particle {} is at {}, and unwrapped at {}: they are not whole boxes apart",
                      i, fmt::join(wrapped, ", "), fmt::join(unwrapped, ", ")));
  return boxes.array().round().template cast<std::int32_t>();
}

template <int Dim>
void set_positions(Configuration<Dim>& configuration, const ForeignFrame& frame,
                   const KnownSystem& known) {
  const std::vector<Vec3>& positions = places_of(frame);
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    Vec<Dim>& position = configuration.position[i] = positions[i].template head<Dim>();
    if (!position.allFinite() ||
        (position.cwiseQuotient(configuration.box.lengths()).cwiseAbs().maxCoeff() >
         max_box_crossings))
      throw UserError(fmt::format("particle {} is at {}, but should be near the box", i,
                                  fmt::join(position, ", ")));
    if (!frame.image.empty())
      configuration.image[i] = frame.image[i].template head<Dim>();
    else if (!frame.unwrapped.empty() && !frame.position.empty())
      configuration.image[i] = boxes_between<Dim>(configuration.box, position,
                                                  frame.unwrapped[i].template head<Dim>(), i);
    configuration.box.wrap_if_outside(position, configuration.image[i]);
  }
  if (Dim == 2 && !(height_range(positions) <= flat_range(frame, known)))
    throw UserError(
        fmt::format("the system is two-dimensional, but the z of its particles differ by {:.3g}; "
                    "in a plane all are the same",
                    height_range(positions)));
}

[[noreturn]] void throw_no_orientation(std::size_t i, const char* what) {
  throw UserError(fmt::format("has no {}, but particle {} is not round", what, i));
}

void set_orientations(Configuration2& configuration, const ForeignFrame& frame) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    double& angle = configuration.angle[i];
    if (!frame.angle.empty()) {
      angle = frame.angle[i];
      if (!std::isfinite(angle))
        throw UserError(
            fmt::format("particle {} has the angle {}, but it should be finite", i, angle));
    } else if (!frame.orientation.empty()) {
      const Quaternion q = unit_quaternion(frame.orientation[i], i);
      if (q.x() != 0 || q.y() != 0)
        throw UserError(fmt::format(
            "particle {} is turned out of the plane, but the system is two-dimensional", i));
      angle = 2 * polar_angle(q.z(), q.w());
    } else if (!configuration.shape[i].is_round()) {
      throw_no_orientation(i, "angles");
    }
  }
}

void set_orientations(Configuration3& configuration, const ForeignFrame& frame) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    if (!frame.orientation.empty())
      configuration.orientation[i] = unit_quaternion(frame.orientation[i], i);
    else if (!configuration.shape[i].is_round())
      throw_no_orientation(i, "orientations");
  }
}

void set_angular_velocity(double& angular_velocity, const Vec3& stated) {
  angular_velocity = stated[2];
}
void set_angular_velocity(Vec3& angular_velocity, const Vec3& stated) {
  angular_velocity = stated;
}

template <int Dim>
void set_velocities(Configuration<Dim>& configuration, const ForeignFrame& frame) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    const Vec3 v = frame.velocity.empty() ? Vec3(Vec3::Zero()) : frame.velocity[i];
    const Vec3 w = frame.angular_velocity.empty() ? Vec3(Vec3::Zero()) : frame.angular_velocity[i];
    if (!v.allFinite() || !w.allFinite())
      throw UserError(fmt::format("the velocities of particle {} should be finite", i));
    configuration.velocity[i] = v.template head<Dim>();
    set_angular_velocity(configuration.angular_velocity[i], w);
  }
}

}  // namespace

bool put_longer_axis_first(ForeignFrame& frame) {
  static const Quaternion quarter_turn(std::sqrt(0.5), 0, 0, std::sqrt(0.5));
  bool any = false;
  for (std::size_t i = 0; i < frame.half_lengths.size(); ++i) {
    Vec3& half = frame.half_lengths[i];
    if (half[0] >= half[1]) continue;
    any = true;
    std::swap(half[0], half[1]);
    if (i < frame.angle.size()) frame.angle[i] += 0.5 * std::numbers::pi;
    if (i < frame.orientation.size()) frame.orientation[i] = frame.orientation[i] * quarter_turn;
  }
  return any;
}

Quaternion unit_quaternion(const Quaternion& q, std::size_t particle) {
  const double excess = std::abs(norm(q) - 1);
  if (!(excess <= tolerance::norm_in_single_precision))
    throw UserError(fmt::format("the orientation of particle {} has the norm {}, but should have 1",
                                particle, norm(q)));
  return excess > tolerance::norm_in_double_precision ? normalized(q) : q;
}

std::optional<int> dimension_of_boundaries(const std::array<bool, 3>& periodic,
                                           const std::string& statement) {
  for (std::size_t k = 0; k < 2; ++k)
    if (!periodic[k])
      throw UserError(
          fmt::format("{}: the box is not periodic along {}, but vitrel's boxes are; only a plane "
                      "needs no period along z",
                      statement, "xyz"[k]));
  return periodic[2] ? std::nullopt : std::optional(2);
}

namespace {

bool is_same_unit(const std::string& one, const std::string& other) {
  if (one == other) return true;
  const std::optional<double> ratio = quantity("1 " + one, other);
  return ratio && std::abs(*ratio - 1) < 1e-9;
}

}  // namespace

FileUnits require_agreement(const StatedUnits& units) {
  const StatedUnits::Named* length = nullptr;
  for (const StatedUnits::Named& one : units.lengths) {
    if (one.second.empty()) continue;
    if (length && one.second != length->second)
      throw UserError(fmt::format("{} is in {}, but {} in {}; lengths should have one unit",
                                  length->first, length->second, one.first, one.second));
    length = &one;
  }
  for (const auto& [name, unit] : units.angles)
    if (!unit.empty() && !is_same_unit(unit, "rad"))
      throw UserError(fmt::format("{} is in {}, but should be in radians", name, unit));
  const FileUnits agreed{length ? length->second : "", units.time};
  if (!length || units.time.empty()) return agreed;
  const std::string speed = length->second + "/" + units.time;
  for (const auto& [name, unit] : units.velocities)
    if (!unit.empty() && !is_same_unit(unit, speed))
      throw UserError(fmt::format("{} is in {}, but should be in {}, as positions and times are",
                                  name, unit, speed));
  return agreed;
}

int dimension_of(const ForeignFrame& frame, const KnownSystem& known, const std::string& plane) {
  if (frame.dimension) return *frame.dimension;
  if (known.dimension) return *known.dimension;
  if (!frame.angle.empty()) return 2;
  const std::optional<Vec3>& box = frame.box ? frame.box : known.box;
  const std::vector<Vec3>& positions = places_of(frame);
  const bool is_flat = positions.size() > 1 && height_range(positions) <= flat_range(frame, known);
  if (box && is_flat && box->z() < 4 * longest_half_length(frame, known))
    throw UserError(fmt::format(
        "all particles have the same z, in a box of height {}: they may be particles in the plane, "
        "which {} says, or in space (import.dimension = 3)",
        box->z(), plane));
  return 3;
}

template <int Dim>
Configuration<Dim> configuration_of(const ForeignFrame& frame, const KnownSystem& known) {
  if (known.dimension && *known.dimension != Dim)
    throw UserError(fmt::format("is {}-dimensional, but should be {}-dimensional",
                                Dim == 2 ? "two" : "three", Dim == 2 ? "three" : "two"));
  const std::size_t n = std::max(frame.position.size(), frame.unwrapped.size());
  require_equal_numbers(frame, n);
  Configuration<Dim> configuration;
  configuration.resize(n);
  configuration.time = frame.time.value_or(static_cast<double>(frame.step.value_or(0)));
  configuration.box = box_of<Dim>(frame, known);
  set_particles(configuration, frame, known);
  set_positions(configuration, frame, known);
  set_orientations(configuration, frame);
  set_velocities(configuration, frame);
  return configuration;
}

template Configuration2 configuration_of<2>(const ForeignFrame&, const KnownSystem&);
template Configuration3 configuration_of<3>(const ForeignFrame&, const KnownSystem&);

}  // namespace vitrel
