#include <cstring>

#include "core/io/foreign/foreign_frame.h"
#include "core/io/h5md.h"
#include "core/state/check.h"
#include "core/state/in_space.h"
#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "workflow/analyze/analyze.h"

namespace vitrel::python {
namespace {

// ---- from arrays ------------------------------------------------------------------------------------------

template <int Dim>
std::vector<Vec3> rows_in_space(const Doubles& array, const std::string& name, std::size_t n) {
  require_rows(array, Dim, name, n);
  std::vector<Vec3> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = in_space(row<Dim>(array, i));
  return result;
}

std::vector<double> numbers(const Doubles& array, const std::string& name, std::size_t n) {
  require_rows(array, 0, name, n);
  return {array.data(), array.data() + n};
}

std::vector<Quaternion> quaternions(const Doubles& array, std::size_t n) {
  require_rows(array, 4, "orientation", n);
  std::vector<Quaternion> result;
  for (std::size_t i = 0; i < n; ++i) {
    const double* q = array.data(static_cast<py::ssize_t>(i));
    result.emplace_back(q[0], q[1], q[2], q[3]);
  }
  return result;
}

/// The arrays that Python passes. Those that are not given are empty.
struct Arrays {
  Doubles position, box, semi_axes;
  std::optional<Doubles> angle, orientation, mass, velocity, angular_velocity;
  std::optional<std::vector<std::string>> species;
  double time = 0;
};

template <int Dim>
Configuration<Dim> state_of(const Arrays& given) {
  ForeignFrame frame;
  frame.dimension = Dim;
  const std::size_t n = require_rows(given.position, Dim, "position");
  frame.position = rows_in_space<Dim>(given.position, "position", n);
  frame.half_lengths = rows_in_space<Dim>(given.semi_axes, "semi_axes", n);
  if (given.box.ndim() != 1 || given.box.shape(0) != Dim)
    throw UserError(fmt::format("box must have the shape ({},)", Dim));
  frame.box = in_space(Eigen::Map<const Vec<Dim>>(given.box.data()));
  if (given.angle) frame.angle = numbers(*given.angle, "angle", n);
  if (given.orientation) frame.orientation = quaternions(*given.orientation, n);
  if (given.mass) frame.mass = numbers(*given.mass, "mass", n);
  if (given.velocity) frame.velocity = rows_in_space<Dim>(*given.velocity, "velocity", n);
  if (given.angular_velocity) {
    if constexpr (Dim == 3) {
      frame.angular_velocity = rows_in_space<3>(*given.angular_velocity, "angular_velocity", n);
    } else {
      for (const double spin : numbers(*given.angular_velocity, "angular_velocity", n))
        frame.angular_velocity.emplace_back(0, 0, spin);
    }
  }
  if (given.species) frame.species = *given.species;
  frame.time = given.time;
  return configuration_of<Dim>(frame, {});
}

// ---- to arrays --------------------------------------------------------------------------------------------

template <int Dim>
py::array_t<double> semi_axes(Configuration<Dim>& state, py::handle owner) {
  static_assert(sizeof(ParticleShape<Dim>) == Dim * sizeof(double));
  return py::array_t<double>({state.size(), static_cast<std::size_t>(Dim)},
                             reinterpret_cast<double*>(state.shape.data()), owner);
}

/// The quaternions as w, x, y, z, the order that files have.
py::array_t<double> orientations(const Configuration3& state) {
  py::array_t<double> result({state.size(), std::size_t{4}});
  double* out = result.mutable_data();
  for (const Quaternion& q : state.orientation)
    for (const double component : {q.w(), q.x(), q.y(), q.z()}) *out++ = component;
  return result;
}

template <int Dim, class Get>
void add_view(py::class_<Configuration<Dim>>& type, const char* name, Get get) {
  type.def_property_readonly(name, [get](py::object self) {
    py::array array = get(self.cast<Configuration<Dim>&>(), self);
    array.attr("flags").attr("writeable") = false;
    return array;
  });
}

template <int Dim>
py::dict check(const Configuration<Dim>& state) {
  const ExactCheck<Dim> found = [&] {
    const Released released;
    return exact_check(state);
  }();
  std::vector<std::int64_t> pairs;
  for (const PairImage<Dim>& pair : found.overlaps) {
    pairs.push_back(static_cast<std::int64_t>(pair.i));
    pairs.push_back(static_cast<std::int64_t>(pair.j));
  }
  py::dict result;
  result["overlaps"] = owned(std::move(pairs)).attr("reshape")(-1, 2);
  result["smallest_gap"] = found.smallest_gap;
  return result;
}

// ---- pickling ---------------------------------------------------------------------------------------------

/// Calls visit(vector) for every vector that has an entry per particle, or per pair.
template <class State, class Visit>
void each_vector(State& state, Visit&& visit) {
  visit(state.position);
  visit(state.image);
  visit(state.velocity);
  visit(state.angular_velocity);
  visit(state.shape);
  visit(state.mass);
  visit(state.species);
  visit(state.releases);
  visit(state.close_pairs);
  if constexpr (requires { state.angle; })
    visit(state.angle);
  else
    visit(state.orientation);
}

/// Pickles the whole state with all bits of its numbers.
template <int Dim>
py::tuple pickled(const Configuration<Dim>& state) {
  py::list parts;
  each_vector(state, [&](const auto& vector) {
    parts.append(
        py::bytes(reinterpret_cast<const char*>(vector.data()), vector.size() * sizeof(vector[0])));
  });
  const Vec<Dim>& lengths = state.box.lengths();
  return py::make_tuple(std::vector<double>(lengths.begin(), lengths.end()), state.time,
                        state.species_names, parts);
}

template <int Dim>
Configuration<Dim> unpickled(const py::tuple& of) {
  Configuration<Dim> state;
  const auto lengths = of[0].cast<std::vector<double>>();
  state.box = PeriodicBox<Dim>(Eigen::Map<const Vec<Dim>>(lengths.data()));
  state.time = of[1].cast<double>();
  state.species_names = of[2].cast<std::vector<std::string>>();
  const auto parts = of[3].cast<py::list>();
  std::size_t next = 0;
  each_vector(state, [&]<class T>(std::vector<T>& vector) {
    const std::string_view bytes = parts[next++].cast<py::bytes>();
    vector.resize(bytes.size() / sizeof(T));
    std::memcpy(static_cast<void*>(vector.data()), bytes.data(), bytes.size());
  });
  return state;
}

template <int Dim>
void bind_state(py::module_& module, const char* name) {
  using State = Configuration<Dim>;
  py::class_<State> type(module, name);
  add_view<Dim>(type, "position", [](State& s, py::handle o) { return view(s.position, o); });
  add_view<Dim>(type, "image", [](State& s, py::handle o) { return view(s.image, o); });
  add_view<Dim>(type, "velocity", [](State& s, py::handle o) { return view(s.velocity, o); });
  add_view<Dim>(type, "angular_velocity",
                [](State& s, py::handle o) { return view(s.angular_velocity, o); });
  add_view<Dim>(type, "mass", [](State& s, py::handle o) { return view(s.mass, o); });
  add_view<Dim>(type, "species", [](State& s, py::handle o) { return view(s.species, o); });
  add_view<Dim>(type, "semi_axes", [](State& s, py::handle o) { return semi_axes(s, o); });
  if constexpr (Dim == 2)
    add_view<2>(type, "angle", [](State& s, py::handle o) { return view(s.angle, o); });
  else
    type.def_property_readonly("orientation", &orientations);
  type.def_property_readonly("box", [](const State& s) {
    const Vec<Dim>& lengths = s.box.lengths();
    return owned(std::vector<double>(lengths.begin(), lengths.end()));
  });
  type.def_readonly("species_names", &State::species_names)
      .def_readonly("time", &State::time)
      .def("__len__", &State::size)
      .def("packing_fraction", &packing_fraction<Dim>)
      .def("check", &check<Dim>)
      .def(py::pickle(&pickled<Dim>, &unpickled<Dim>))
      .def("write", [](const State& s, const std::filesystem::path& path,
                       const std::string& parameters, bool overwrite) {
        write_state(path, s, current_provenance("vitrel (Python)", parameters, 0), overwrite);
      });
}

// ---- files ------------------------------------------------------------------------------------------------

py::object read_frame(const TrajectoryReader& reader, std::uint64_t frame) {
  if (frame >= reader.frames())
    throw py::index_error(fmt::format("the file has {} frames", reader.frames()));
  if (reader.dimension() == 2) return py::cast(reader.read<2>(frame));
  return py::cast(reader.read<3>(frame));
}

}  // namespace

void bind_states(py::module_& module) {
  bind_state<2>(module, "PlaneState");
  bind_state<3>(module, "SpaceState");
  module.def("state_from_arrays",
             [](int dimension, Doubles position, Doubles box, Doubles semi_axes,
                std::optional<Doubles> angle, std::optional<Doubles> orientation,
                std::optional<Doubles> mass, std::optional<Doubles> velocity,
                std::optional<Doubles> angular_velocity,
                std::optional<std::vector<std::string>> species, double time) {
               const Arrays given{position,           box,  semi_axes, angle,
                                  orientation,        mass, velocity,  angular_velocity,
                                  std::move(species), time};
               return dimension == 2 ? py::cast(state_of<2>(given)) : py::cast(state_of<3>(given));
             });
  py::class_<TrajectoryReader>(module, "Frames")
      .def(py::init([](const std::filesystem::path& path, std::vector<std::string> overrides) {
             return TrajectoryReader(path, known_system(AnalysisChoice{{}, std::move(overrides)}));
           }),
           py::arg("path"), py::arg("overrides"))
      .def("__len__", &TrajectoryReader::frames)
      .def("__getitem__", &read_frame)
      .def_property_readonly("dimension", &TrajectoryReader::dimension)
      .def_property_readonly(
          "times",
          [](const TrajectoryReader& reader) { return owned(std::vector<double>(reader.times())); })
      .def_property_readonly(
          "parameters",
          [](const TrajectoryReader& reader) { return reader.provenance().parameters; })
      .def_property_readonly("import_report", &TrajectoryReader::import_report);
}

}  // namespace vitrel::python
