#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/parameters.h"
#include "edmd/options.h"

/// Two bodies as a user gives them: in a TOML file, or each as a line "semi_axes=2,1 position=3,0 angle=0.5" with the
/// same keys. Any consistent units of length and time will do.
namespace vitrel {

/// A body; an empty vector stands for zero.
struct BodyParameters {
  std::vector<double> semi_axes;  ///< [a, b] with a ≥ b for an ellipse, [a, b, c] for an ellipsoid
  std::vector<double> position;
  double angle = 0;  ///< of an ellipse, in rad
  /// Orientation of an ellipsoid: a quaternion w, x, y, z of any norm.
  std::array<double, 4> orientation{1, 0, 0, 0};
  std::vector<double> velocity;
  std::vector<double> angular_velocity{0};  ///< a single number in the plane
};

struct PairParameters {
  std::optional<std::vector<double>> box;
  double horizon = 100;
  FreeRotation rotation = FreeRotation::euler;
  std::vector<BodyParameters> body;

  /// The dimension of the bodies: 2 for ellipses, 3 for ellipsoids.
  std::size_t dimension() const { return body.at(0).semi_axes.size(); }
};

/// Where a pair comes from: a file, or a line for each body. An empty text means that the value is not given.
struct PairSource {
  std::filesystem::path file;
  std::vector<std::string> bodies;
  std::string box, horizon, rotation;
  std::vector<std::string> overrides;  ///< "key=value"
};

/// Reads and validates a pair. Throws UserError or FileError.
PairParameters load_pair(const PairSource& source);
/// Parses a text that pair_text wrote. `name` stands for its source in messages.
PairParameters parse_pair(const std::string& text, const std::string& name);
/// All values as TOML.
std::string pair_text(const PairParameters& pair);
/// A TOML file with comments that explain its keys.
std::string pair_template();

}  // namespace vitrel
