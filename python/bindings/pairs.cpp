#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "core/parallel.h"
#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "workflow/pair/impact.h"
#include "workflow/pair/pair.h"

namespace vitrel::python {
namespace {

/// N bodies in free flight, from arrays.
template <int Dim>
class Bodies {
 public:
  Bodies(Doubles semi_axes, Doubles position, Doubles orientation, Doubles velocity,
         Doubles angular_velocity)
      : semi_axes_(std::move(semi_axes)),
        position_(std::move(position)),
        orientation_(std::move(orientation)),
        velocity_(std::move(velocity)),
        angular_velocity_(std::move(angular_velocity)) {
    const std::size_t n = require_rows(semi_axes_, Dim, "semi_axes");
    require_rows(position_, Dim, "position", n);
    require_rows(orientation_, Dim == 2 ? 0 : 4, Dim == 2 ? "angle" : "orientation", n);
    require_rows(velocity_, Dim, "velocity", n);
    require_rows(angular_velocity_, Dim == 2 ? 0 : 3, "angular_velocity", n);
    for (std::size_t i = 0; i < n; ++i) require_valid(i);
  }

  std::size_t size() const { return static_cast<std::size_t>(semi_axes_.shape(0)); }

  Flight<Solid<Dim>> at(std::size_t i) const {
    const Vec<Dim> axes = row<Dim>(semi_axes_, i);
    const auto k = static_cast<py::ssize_t>(i);
    if constexpr (Dim == 2) {
      return {{axes[0], axes[1]},
              {row<2>(position_, i), *orientation_.data(k)},
              {row<2>(velocity_, i), *angular_velocity_.data(k)}};
    } else {
      const double* q = orientation_.data(k);
      return {{axes},
              {row<3>(position_, i), Quaternion(q[0], q[1], q[2], q[3]).normalized()},
              {row<3>(velocity_, i), row<3>(angular_velocity_, i)}};
    }
  }

 private:
  void require_valid(std::size_t i) const {
    const Flight<Solid<Dim>> body = at(i);
    const Vec<Dim> axes = row<Dim>(semi_axes_, i);
    const auto require = [i](bool holds, const char* what) {
      if (!holds) throw UserError(fmt::format("body {}: {}", i, what));
    };
    require(axes.allFinite() && axes.minCoeff() > 0, "semi_axes must be positive");
    if constexpr (Dim == 2) {
      require(axes[0] >= axes[1], "semi_axes must be in descending order");
      require(std::isfinite(body.pose.angle), "angle must be finite");
      require(std::isfinite(body.motion.angular_velocity), "angular_velocity must be finite");
    } else {
      require(body.pose.orientation.coeffs().allFinite(), "orientation must not be 0");
      require(body.motion.angular_velocity.allFinite(), "angular_velocity must be finite");
    }
    require(body.pose.position.allFinite(), "position must be finite");
    require(body.motion.velocity.allFinite(), "velocity must be finite");
  }

  Doubles semi_axes_, position_, orientation_, velocity_, angular_velocity_;
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

/// All pairs of bodies of the same number: calls use(i, pair) without the interpreter.
template <int Dim, class Use>
void for_each_pair(const Bodies<Dim>& one, const Bodies<Dim>& two,
                   const std::optional<Doubles>& box, double horizon, Use&& use) {
  if (one.size() != two.size())
    throw UserError(fmt::format("there are {} first and {} second bodies, but they must be as many",
                                one.size(), two.size()));
  const std::optional<PeriodicBox<Dim>> lengths = box_of<Dim>(box);
  const py::gil_scoped_release release;
  for (std::size_t i = 0; i < one.size(); ++i)
    use(i, Pair<Dim>{one.at(i), two.at(i), lengths, horizon});
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
      .def(py::init<Doubles, Doubles, Doubles, Doubles, Doubles>(), py::arg("semi_axes"),
           py::arg("position"), py::arg("orientation"), py::arg("velocity"),
           py::arg("angular_velocity"))
      .def("__len__", &Bodies<Dim>::size);
  module.def("overlap", &overlapping<Dim>, py::arg("one"), py::arg("two"), py::arg("box"));
  module.def("gap", &gaps<Dim>, py::arg("one"), py::arg("two"), py::arg("box"));
  module.def("first_contact", &contacts<Dim>, py::arg("one"), py::arg("two"), py::arg("box"),
             py::arg("horizon"));
}

/// Rows (ε_r, ε_φ, ε_t, ε_ṙ, duration in s) of impacts of soft spheres.
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
    const py::gil_scoped_release release;
    for (std::size_t i = 0; i < n; ++i) {
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
