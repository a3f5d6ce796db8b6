// This file reads what all frames of a trajectory share: their times, and the particles.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/io/h5md.h"
#include "core/state/bounds.h"
#include "core/state/species.h"

namespace vitrel {

void TrajectoryReader::read_what_frames_share() {
  read_shapes();
  std::visit([this](auto& fixed) { read_masses_and_species(fixed); }, fixed_);
  read_axes();
}

/// Frames are counted by `step`, which is the last dataset written for a frame.
void TrajectoryReader::read_axes() {
  const h5::Shape shape = element("position", "the positions, one frame after another").shape();
  steps_ = dataset(group_ + "/position/step", "the step of every frame").read<std::int64_t>();
  times_ = dataset(group_ + "/position/time", "the time of every frame").read<double>();
  if (times_.size() < steps_.size() || shape[0] < steps_.size())
    fail("the datasets time and value of " + group_ + "/position have fewer frames than step");
  times_.resize(steps_.size());
  for (std::size_t k = 0; k < times_.size(); ++k)
    if (!std::isfinite(times_[k]))
      fail(
          fmt::format("the time of frame {} (dataset {}/position/time) is {}, but should be a "
                      "finite number",
                      k, group_, times_[k]));
}

void TrajectoryReader::read_shapes() {
  const h5::Dataset& semiaxes =
      dataset(group_ + "/semiaxes", "the semi-axes a ≥ b of every particle");
  const h5::Shape shape = semiaxes.shape();
  if (shape.size() != 2 || shape[1] < 2 || shape[1] > 3)
    fail("the dataset " + semiaxes.name() + " should have the shape particles × 3");
  const std::vector<double> values = semiaxes.read<double>();
  const bool has_third = shape[1] == 3 && !values.empty() && values[2] != 0;
  const std::optional<int> stated = stated_dimension();
  if (stated && *stated != 2 && *stated != 3)
    fail(fmt::format("is {}-dimensional: only two and three dimensions can be read", *stated));
  if (stated.value_or(has_third ? 3 : 2) == 2)
    set_shapes(fixed_.emplace<Configuration2>(), values, shape);
  else
    set_shapes(fixed_.emplace<Configuration3>(), values, shape);
}

std::optional<int> TrajectoryReader::stated_dimension() const {
  const bool states =
      root_->has_group("parameters") && root_->group("parameters").has_attribute("dimension");
  return states ? std::optional<int>(provenance().dimension) : std::nullopt;
}

void TrajectoryReader::require_size(std::size_t i, double longest, double shortest) const {
  for (const double axis : {longest, shortest})
    if (!bounds::length.contains(axis))
      fail(fmt::format("a semi-axis of particle {} is {}, but {}", i, axis,
                       requirement(bounds::length, axis)));
  if (!(longest <= max_aspect * shortest))
    fail(fmt::format(
        "the longest semi-axis of particle {} is {:.4g} times the shortest, but must be at "
        "most {} times: contacts of longer particles are not tested",
        i, longest / shortest, max_aspect));
}

template <int Dim>
void TrajectoryReader::set_shapes(Configuration<Dim>& fixed, const std::vector<double>& values,
                                  const h5::Shape& shape) const {
  fixed.resize(shape[0]);
  for (std::size_t i = 0; i < shape[0]; ++i) {
    Vec<Dim> half_lengths = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < std::min<std::size_t>(Dim, shape[1]); ++k)
      half_lengths[static_cast<int>(k)] = values[shape[1] * i + k];
    const auto found = shape_of<Dim>(half_lengths);
    if (!found)
      fail(fmt::format("particle {} has the semi-axes {}, but should have {}", i,
                       fmt::join(half_lengths, ", "), half_lengths_rule<Dim>()));
    require_size(i, found->circumradius(), found->inradius());
    fixed.shape[i] = *found;
  }
}

template <int Dim>
void TrajectoryReader::read_masses_and_species(Configuration<Dim>& fixed) const {
  fixed.species_names = {"A"};
  if (has_dataset(group_ + "/mass"))
    fixed.mass = root_->dataset(group_ + "/mass").read<double>();
  else
    std::ranges::transform(fixed.shape, fixed.mass.begin(),
                           [](const auto& shape) { return shape.natural_mass(); });
  if (has_dataset(group_ + "/species")) {
    const h5::Dataset species = root_->dataset(group_ + "/species");
    fixed.species = species.read<std::int32_t>();
    fixed.species_names = species.enumeration();
  }
  if (fixed.mass.size() != fixed.size() || fixed.species.size() != fixed.size())
    fail("the datasets mass and species should have one number per particle, " +
         std::to_string(fixed.size()));
  if (fixed.size() == 0) return;
  for (std::size_t i = 0; i < fixed.size(); ++i)
    if (!bounds::mass.contains(fixed.mass[i]))
      fail(fmt::format("the mass of particle {} is {}, but {}", i, fixed.mass[i],
                       requirement(bounds::mass, fixed.mass[i])));
  const auto [low, high] = std::minmax_element(fixed.species.begin(), fixed.species.end());
  if (*low < 0) fail("the dataset " + group_ + "/species should count from 0");
  const std::size_t most = std::max(fixed.size(), fixed.species_names.size());
  if (static_cast<std::size_t>(*high) >= most)
    fail(fmt::format("the species of particle {} is {}, but there are {} particles and {} species",
                     high - fixed.species.begin(), *high, fixed.size(),
                     fixed.species_names.size()));
  for (std::size_t k = fixed.species_names.size(); k <= static_cast<std::size_t>(*high); ++k)
    fixed.species_names.push_back(std::to_string(k));
}

}  // namespace vitrel
