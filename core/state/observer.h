#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/state/configuration.h"

namespace vitrel {

/// The elements xy, xz and yz of a symmetric tensor; in the plane only the first.
using ShearElements = std::array<double, 3>;
template <int Dim>
inline constexpr std::size_t shear_elements = Dim == 2 ? 1 : 3;
inline constexpr std::array shear_element_names = {"xy", "xz", "yz"};

/// Totals of a run at the time of a frame.
struct Tally {
  std::uint64_t collisions = 0;
  double virial = 0;                  ///< Σ J n·d over all collisions, d from centre to centre
  ShearElements helfand_moment = {};  ///< see edmd/momentum_flux.h; not for soft particles
};

/// A synchronised, read-only view of the system at one sample time.
template <int Dim>
struct Frame {
  std::int64_t index;  ///< 0, 1, 2 … in the order of the schedule
  const Configuration<Dim>& configuration;
  Tally tally;
};

/// Receives every sample of a run: file writers and on-the-fly correlators are observers.
template <int Dim>
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void observe(const Frame<Dim>& frame) = 0;
};

}  // namespace vitrel
