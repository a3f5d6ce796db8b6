#include "workflow/pair/pair_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/state/species.h"
#include "workflow/configuration/sections.h"
#include "workflow/rules.h"

namespace vitrel {
namespace {

void describe_body(BodyParameters& p, FieldVisitor& visit) {
  visit.field({"semi_axes", "length",
               "[a, b] with a ≥ b of an ellipse, [a, b, c] of an ellipsoid along its own x, y and "
               "z axes."},
              p.semi_axes);
  const bool in_space = p.semi_axes.size() == 3;
  visit.field({"position", "length", "Centre."}, p.position);
  visit.when(!in_space, "two semi-axes", [&](FieldVisitor& in) {
    in.field({"angle", "rad", "Direction of the semi-axis a, counter-clockwise from x."}, p.angle);
  });
  visit.when(in_space, "three semi-axes", [&](FieldVisitor& in) {
    in.field({"orientation", "",
              "Quaternion [w, x, y, z] that turns the own axes into those of space. It is "
              "normalised."},
             p.orientation);
  });
  visit.field({"velocity", "length/time", "Velocity of the centre."}, p.velocity);
  visit.number_or_numbers(
      {"angular_velocity", "rad/time",
       "Counter-clockwise; in space [ω_x, ω_y, ω_z], of a spheroid that of its axis: L/I⊥."},
      p.angular_velocity);
}

void describe_pair(PairParameters& p, FieldVisitor& visit) {
  visit.optional({"box", "length",
                  "Sides of a periodic box, in which the second body has images. Without it there "
                  "are none."},
                 p.box, std::vector<double>{10, 10});
  visit.field({"horizon", "time", "A contact is searched for until then."}, p.horizon);
  visit.field({"rotation", "",
               "Free rotation of ellipsoids with three different semi-axes: by Euler's equations "
               "(euler), or about a constant angular velocity (constant)."},
              p.rotation, rotation_names);
  visit.list({"body", "", "The two bodies."}, p.body, describe_body);
}

/// Fourth powers of lengths and velocities must not overflow, and fourth powers of semi-axes must not underflow to
/// zero.
constexpr double largest_value = 1e50, smallest_value = 1e-50;

void require_finite(std::span<const double> values, const std::string& key, const Rules& rules) {
  rules.require(
      std::ranges::all_of(values, [](double x) { return std::abs(x) <= largest_value; }), key,
      fmt::format("is {}, but must be finite, at most {:g}", to_toml(values), largest_value));
}

/// Requires that the vector is finite and of the right dimension; an empty one stands for zero.
void validate_components(const std::vector<double>& vector, std::size_t dimension,
                         const std::string& key, const Rules& rules) {
  rules.require(vector.empty() || vector.size() == dimension, key,
                fmt::format("is {}, but must have {} components, like semi_axes", to_toml(vector),
                            dimension));
  require_finite(vector, key, rules);
}

void validate_semi_axes(const std::vector<double>& axes, const Rules& rules) {
  rules.require(!axes.empty(), "semi_axes",
                "is missing; give [a, b] of an ellipse or [a, b, c] of an ellipsoid");
  require_finite(axes, "semi_axes", rules);
  const bool is_positive = std::ranges::min(axes) > 0;
  const bool fits = axes.size() == 3 || (axes.size() == 2 && axes[0] >= axes[1]);
  rules.require(is_positive && fits, "semi_axes",
                fmt::format("is {}, but must be [a, b] with a ≥ b > 0, or [a, b, c], all above 0",
                            to_toml(axes)));
  const double aspect = std::ranges::max(axes) / std::ranges::min(axes);
  rules.require(aspect <= max_aspect, "semi_axes",
                fmt::format("is {}, but the longest may be at most {} times the shortest",
                            to_toml(axes), max_aspect));
  rules.require(std::ranges::min(axes) >= smallest_value, "semi_axes",
                fmt::format("is {}, but must not be below {:g}; choose a smaller unit of length",
                            to_toml(axes), smallest_value));
}

void validate_orientation(const std::array<double, 4>& quaternion, const Rules& rules) {
  double square = 0;
  for (const double x : quaternion) square += x * x;
  rules.require(std::isnormal(square), "orientation",
                fmt::format("is {}, but must be a rotation, such as [1.0, 0.0, 0.0, 0.0]",
                            to_toml(quaternion)));
}

void validate_body(const BodyParameters& p, const Rules& rules) {
  validate_semi_axes(p.semi_axes, rules);
  const std::size_t dimension = p.semi_axes.size();
  validate_components(p.position, dimension, "position", rules);
  validate_components(p.velocity, dimension, "velocity", rules);
  require_finite({&p.angle, 1}, "angle", rules);
  validate_orientation(p.orientation, rules);
  const std::vector<double>& omega = p.angular_velocity;
  const bool is_zero = omega.size() == 1 && omega[0] == 0;
  rules.require(is_zero || omega.size() == (dimension == 2 ? 1u : 3u), "angular_velocity",
                fmt::format("is {}, but must be {}", to_toml(omega),
                            dimension == 2 ? "one number" : "[ω_x, ω_y, ω_z]"));
  require_finite(omega, "angular_velocity", rules);
}

/// An upper bound of how far the bodies get from the origin.
double longest_path(const PairParameters& p) {
  double path = 0;
  for (const BodyParameters& body : p.body) {
    for (const double x : body.position) path += std::abs(x);
    for (const double v : body.velocity) path += std::abs(v) * p.horizon;
  }
  return path;
}

void validate_box(const std::vector<double>& box, const PairParameters& p) {
  constexpr double farthest = 1e6;  // in box lengths, so that coordinates keep ten digits
  const Rules rules("");
  rules.require(box.size() == p.dimension(), "box",
                fmt::format("is {}, but must have {} sides", to_toml(box), p.dimension()));
  for (const double side : box) rules.positive(side, "box");
  const double shortest = std::ranges::min(box);
  for (const BodyParameters& body : p.body) {
    const double length = 2 * std::ranges::max(body.semi_axes);
    rules.require(
        shortest >= length, "box",
        fmt::format("is {}, but no side may be shorter than {}, so that no body meets its "
                    "own images",
                    to_toml(box), show(length)));
  }
  rules.require(longest_path(p) <= farthest * shortest, "horizon",
                fmt::format("is {}, by which the bodies may be more than {:g} times the shortest "
                            "side of the box away; lower it, or move them closer",
                            show(p.horizon), farthest));
}

void validate_pair(const PairParameters& p) {
  const Rules rules("");
  rules.require(p.body.size() == 2, "body",
                fmt::format("must have two entries, one for each body, not {}", p.body.size()));
  for (std::size_t i = 0; i < 2; ++i) validate_body(p.body[i], Rules(fmt::format("body.{}", i)));
  Rules("body.1").require(p.body[1].semi_axes.size() == p.dimension(), "semi_axes",
                          fmt::format("has {} entries, but body.0.semi_axes {}; give two ellipses "
                                      "or two ellipsoids",
                                      p.body[1].semi_axes.size(), p.dimension()));
  rules.not_negative(p.horizon, "horizon");
  if (p.box) validate_box(*p.box, p);
}

PairParameters read(const TomlNode& root) {
  PairParameters pair;
  read_parameters(
      root, [&](FieldVisitor& visit) { describe_pair(pair, visit); }, [&] { validate_pair(pair); });
  return pair;
}

/// Puts several numbers, separated by commas, into the brackets of a TOML array.
std::string as_array(const std::string& value) {
  const bool is_list = value.find(',') != std::string::npos && !value.starts_with('[');
  return is_list ? "[" + value + "]" : value;
}

/// Sets the keys of a body from a line of assignments that are separated by blanks.
void add_body(TomlNode& root, const std::string& line, std::size_t index) {
  const std::string option = "--body '" + line + "'";
  std::istringstream words(line);
  std::string word;
  words >> word;  // word is empty if the line is
  do {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UserError(
          fmt::format("{}: '{}' is not key=value; write, for example, --body "
                      "'semi_axes=2,1 position=3,0 angle=0.5'",
                      option, word));
    apply_override(root,
                   fmt::format("body.{}.{}={}", index, word.substr(0, equals),
                               as_array(word.substr(equals + 1))),
                   option);
  } while (words >> word);
}

void apply_option(TomlNode& root, const std::string& key, const std::string& value) {
  if (!value.empty())
    apply_override(root, key + "=" + as_array(value), fmt::format("--{} {}", key, value));
}

}  // namespace

PairParameters load_pair(const PairSource& source) {
  if (source.file.empty() == source.bodies.empty())
    throw UserError(
        "give two bodies, --body 'semi_axes=2,1' --body 'semi_axes=2,1 position=3,0 angle=0.5', or "
        "a file with both (vitrel params pair prints one)");
  TomlNode root;
  root.where = "--body";
  if (!source.file.empty()) root = read_toml_file(source.file);
  for (std::size_t i = 0; i < source.bodies.size(); ++i) add_body(root, source.bodies[i], i);
  apply_option(root, "box", source.box);
  apply_option(root, "horizon", source.horizon);
  apply_option(root, "rotation", source.rotation);
  for (const std::string& assignment : source.overrides)
    apply_override(root, assignment, "--set " + assignment);
  return read(root);
}

PairParameters parse_pair(const std::string& text, const std::string& name) {
  return read(parse_toml(text, name));
}

std::string pair_text(const PairParameters& pair) {
  PairParameters copy = pair;
  return write_parameters([&](FieldVisitor& visit) { describe_pair(copy, visit); });
}

std::string pair_template() {
  PairParameters pair;
  pair.body.resize(2);
  for (BodyParameters& body : pair.body)
    body.semi_axes = {2, 1}, body.position = body.velocity = {0, 0};
  pair.body[1].position = {3, 2};
  pair.body[1].velocity = {-1, 0};
  pair.body[1].angular_velocity = {0.5};
  return "# Two bodies for `vitrel pair`.\n\n" +
         parameter_template([&](FieldVisitor& visit) { describe_pair(pair, visit); });
}

}  // namespace vitrel
