#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "workflow/pair/impact.h"
#include "workflow/pair/pair.h"

namespace vitrel::python {
namespace {

/// Rows of numbers with any strides. If one number holds for all rows, the stride may be zero.
using Rows = py::array_t<double, py::array::forcecast>;

/// Unchecked access to an array with this number of dimensions.
template <int Dimensions>
using Numbers = decltype(std::declval<const Rows&>().unchecked<Dimensions>());

template <int Dim>
Vec<Dim> row_of(const Numbers<2>& rows, std::size_t i) {
  Vec<Dim> row;
  for (int k = 0; k < Dim; ++k) row[k] = rows(static_cast<py::ssize_t>(i), k);
  return row;
}

/// N bodies in free flight. They are views of arrays that the caller owns.
template <int Dim>
class Bodies {
 public:
  Bodies(const Rows& semi_axes, const Rows& position, const Rows& orientation, const Rows& velocity,
         const Rows& angular_velocity)
      : arrays_{semi_axes, position, orientation, velocity, angular_velocity},
        size_(require_rows(semi_axes, Dim, "semi_axes")),
        semi_axes_(semi_axes.unchecked<2>()),
        position_(position.unchecked<2>()),
        velocity_(velocity.unchecked<2>()),
        orientation_(orientation.unchecked < is_plane ? 1 : 2 > ()),
        angular_velocity_(angular_velocity.unchecked < is_plane ? 1 : 2 > ()) {
    require_rows(position, Dim, "position", size_);
    require_rows(orientation, is_plane ? 0 : 4, is_plane ? "angle" : "orientation", size_);
    require_rows(velocity, Dim, "velocity", size_);
    require_rows(angular_velocity, is_plane ? 0 : 3, "angular_velocity", size_);
    for (std::size_t i = 0; i < size_; ++i) at(i);
  }

  std::size_t size() const { return size_; }

  /// Throws UserError if a number is impossible.
  Flight<ParticleShape<Dim>> at(std::size_t i) const {
    const auto k = static_cast<py::ssize_t>(i);
    const Vec<Dim> axes = row_of<Dim>(semi_axes_, i);
    if constexpr (is_plane) {
      const Flight<Ellipse> body{{axes[0], axes[1]},
                                 {row_of<2>(position_, i), orientation_(k)},
                                 {row_of<2>(velocity_, i), angular_velocity_(k)}};
      require(i, axes[0] >= axes[1], "semi_axes must be in descending order");
      require(i, std::isfinite(body.pose.angle), "angle must be finite");
      require(i, std::isfinite(body.motion.angular_velocity), "angular_velocity must be finite");
      require_finite(i, axes, body);
      return body;
    } else {
      const Quaternion turn(orientation_(k, 0), orientation_(k, 1), orientation_(k, 2),
                            orientation_(k, 3));
      const Flight<Ellipsoid> body{{axes},
                                   {row_of<3>(position_, i), turn.normalized()},
                                   {row_of<3>(velocity_, i), row_of<3>(angular_velocity_, i)}};
      require(i, body.pose.orientation.coeffs().allFinite(), "orientation must not be 0");
      require(i, body.motion.angular_velocity.allFinite(), "angular_velocity must be finite");
      require_finite(i, axes, body);
      return body;
    }
  }

 private:
  static constexpr bool is_plane = Dim == 2;
  using Turns = Numbers<is_plane ? 1 : 2>;

  static void require(std::size_t i, bool holds, const char* what) {
    if (!holds) throw UserError(fmt::format("body {}: {}", i, what));
  }
  static void require_finite(std::size_t i, const Vec<Dim>& axes,
                             const Flight<ParticleShape<Dim>>& body) {
    require(i, axes.allFinite() && axes.minCoeff() > 0, "semi_axes must be positive");
    require(i, body.pose.position.allFinite(), "position must be finite");
    require(i, body.motion.velocity.allFinite(), "velocity must be finite");
  }

  std::array<Rows, 5> arrays_;  ///< keep the arrays alive
  std::size_t size_;
  Numbers<2> semi_axes_, position_, velocity_;
  Turns orientation_, angular_velocity_;
};

template <int Dim>
std::optional<PeriodicBox<Dim>> box_of(const std::optional<Doubles>& lengths) {
  if (!lengths) return std::nullopt;
  if (lengths->ndim() != 1 || lengths->shape(0) != Dim)
    throw UserError(fmt::format("box must have the shape ({},)", Dim));
  const Vec<Dim> edges = Eigen::Map<const Vec<Dim>>(lengths->data());
  if (!(edges.allFinite() && edges.minCoeff() > 0)) throw UserError("box must be positive");
  return PeriodicBox<Dim>(edges);
}

/// The number of pairs between two checks for an interruption.
constexpr std::size_t pairs_between_questions = 1000;

/// Calls use(i, pair) for the i-th bodies of both sets, without the lock of the interpreter.
template <int Dim, class Use>
void for_each_pair(const Bodies<Dim>& one, const Bodies<Dim>& two,
                   const std::optional<Doubles>& box, double horizon, Use&& use) {
  if (one.size() != two.size())
    throw UserError(fmt::format("there are {} first and {} second bodies, but they must be as many",
                                one.size(), two.size()));
  const std::optional<PeriodicBox<Dim>> lengths = box_of<Dim>(box);
  const Released released;
  Interruption interruption;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (i % pairs_between_questions == 0) interruption.raise_if_requested();
    use(i, Pair<Dim>{one.at(i), two.at(i), lengths, horizon});
  }
}

template <int Dim>
py::array_t<bool> overlapping(const Bodies<Dim>& one, const Bodies<Dim>& two,
                              const std::optional<Doubles>& box) {
  py::array_t<bool> result(static_cast<py::ssize_t>(one.size()));
  bool* const out = result.mutable_data();
  for_each_pair(one, two, box, 0,
                [&](std::size_t i, const Pair<Dim>& pair) { out[i] = overlaps(pair); });
  return result;
}

template <int Dim>
py::tuple gaps(const Bodies<Dim>& one, const Bodies<Dim>& two, const std::optional<Doubles>& box) {
  std::vector<double> gap(one.size());
  std::vector<Vec<Dim>> normal(one.size()), point1(one.size()), point2(one.size());
  const Vec<Dim> none = Vec<Dim>::Constant(std::numeric_limits<double>::quiet_NaN());
  for_each_pair(one, two, box, 0, [&](std::size_t i, const Pair<Dim>& pair) {
    const PairGap<Dim> found = gap_at(pair, 0);
    gap[i] = found.gap;
    normal[i] = found.overlap ? none : found.normal;
    point1[i] = found.overlap ? none : found.point1;
    point2[i] = found.overlap ? none : found.point2;
  });
  return py::make_tuple(owned(std::move(gap)), owned<Dim>(std::move(normal)),
                        owned<Dim>(std::move(point1)), owned<Dim>(std::move(point2)));
}

template <int Dim>
py::tuple contacts(const Bodies<Dim>& one, const Bodies<Dim>& two,
                   const std::optional<Doubles>& box, double horizon) {
  if (!(horizon > 0 && std::isfinite(horizon)))
    throw UserError("horizon must be positive and finite");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> time(one.size());
  std::vector<Vec<Dim>> normal(one.size()), point(one.size());
  for_each_pair(one, two, box, horizon, [&](std::size_t i, const Pair<Dim>& pair) {
    const Prediction<Dim> found = first_contact(pair).prediction;
    const bool touches = found.outcome == Outcome::contact;
    time[i] = touches                             ? found.time
              : found.outcome == Outcome::overlap ? nan
                                                  : std::numeric_limits<double>::infinity();
    normal[i] = touches ? found.normal : Vec<Dim>::Constant(nan);
    point[i] = touches ? found.point : Vec<Dim>::Constant(nan);
  });
  return py::make_tuple(owned(std::move(time)), owned<Dim>(std::move(normal)),
                        owned<Dim>(std::move(point)));
}

template <int Dim>
void bind(py::module_& module, const char* name) {
  py::class_<Bodies<Dim>>(module, name)
      .def(py::init<const Rows&, const Rows&, const Rows&, const Rows&, const Rows&>(),
           py::arg("semi_axes"), py::arg("position"), py::arg("orientation"), py::arg("velocity"),
           py::arg("angular_velocity"))
      .def("__len__", &Bodies<Dim>::size);
  module.def("overlap", &overlapping<Dim>, py::arg("one"), py::arg("two"), py::arg("box"));
  module.def("gap", &gaps<Dim>, py::arg("one"), py::arg("two"), py::arg("box"));
  module.def("first_contact", &contacts<Dim>, py::arg("one"), py::arg("two"), py::arg("box"),
             py::arg("horizon"));
}

/// The coefficients of impacts of soft spheres as rows (ε_r, ε_φ, ε_t, ε_ṙ, duration in s).
py::array_t<double> restitution(const std::filesystem::path& file,
                                const std::vector<std::string>& overrides, const Doubles& speed,
                                const Doubles& impact_parameter,
                                const std::optional<Doubles>& second_radius) {
  const std::size_t n = require_rows(speed, 0, "speed");
  require_rows(impact_parameter, 0, "impact_parameter", n);
  if (second_radius) require_rows(*second_radius, 0, "second_radius", n);
  Impact impact = load_impact({file, overrides, "", "", ""});
  std::vector<double> rows;
  rows.reserve(5 * n);
  {
    const Released released;
    Interruption interruption;
    for (std::size_t i = 0; i < n; ++i) {
      interruption.raise_if_requested();
      const auto k = static_cast<py::ssize_t>(i);
      impact.speed = *speed.data(k);
      impact.impact_parameter = *impact_parameter.data(k);
      if (second_radius) impact.second_radius = *second_radius->data(k);
      validate(impact);
      const Restitution found = integrated(impact);
      rows.insert(rows.end(), {found.distance, found.angle, found.duration, found.rate,
                               found.duration * impact.scales().time});
    }
  }
  return owned(std::move(rows)).attr("reshape")(-1, 5);
}

}  // namespace

void bind_pairs(py::module_& module) {
  bind<2>(module, "Ellipses");
  bind<3>(module, "Ellipsoids");
  module.def("restitution", &restitution, py::arg("file"), py::arg("overrides"), py::arg("speed"),
             py::arg("impact_parameter"), py::arg("second_radius"));
}

}  // namespace vitrel::python
