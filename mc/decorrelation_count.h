#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/state/configuration.h"
#include "mc/place_correlation.h"

namespace vitrel {

/// A plain value, together with the configuration sufficient to go on counting.
struct DecorrelationState {
  std::uint64_t count = 0;
  // Since the first of the present configurations:
  bool places = false, orientations = false, sizes = false;  ///< these have decorrelated
  std::uint64_t begin = 0, next = 0;  ///< sweeps at it, and at the next comparison
  std::vector<double> first;          ///< position, image and orientation of every particle
};

/// Counts how often a sampled configuration has decorrelated: places, orientations and sizes, each place by place
/// (place_correlation.h), have all fallen to 1/e at some time since the first configuration. Then the next configuration
/// is the first one. They are compared after numbers of sweeps that grow by a tenth.
template <int Dim>
class DecorrelationCount {
 public:
  /// Begins with this configuration, or goes on from `state`; both must outlive this object.
  DecorrelationCount(const Configuration<Dim>& configuration, DecorrelationState& state,
                     std::uint64_t sweeps);

  /// After every sweep, with the number of all sweeps so far.
  void update(std::uint64_t sweeps);

 private:
  void begin(std::uint64_t sweeps);
  void compare();

  const Configuration<Dim>& configuration_;
  DecorrelationState& state_;
  std::optional<PlaceCorrelation<Dim>> correlation_;
};

}  // namespace vitrel
