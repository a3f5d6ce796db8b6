#include "python/bindings/arrays.h"
#include "python/bindings/bindings.h"
#include "python/bindings/interruption.h"
#include "workflow/picture/colours.h"
#include "workflow/picture/ray_caster.h"

namespace vitrel::python {
namespace {

using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

Bytes array_of(const std::vector<Colour>& colours) {
  return Bytes({colours.size(), std::size_t{3}},
               reinterpret_cast<const std::uint8_t*>(colours.data()));
}

/// An empty name stands for the default colouring.
template <int Dim>
Bytes named_colours(const Configuration<Dim>& state, const std::string& name) {
  std::optional<ColourScale> scale;
  return array_of(particle_colours(state, name.empty() ? default_colouring(state) : name, scale));
}

Bytes number_colours(const std::vector<double>& numbers) {
  return array_of(sequential_colours(numbers, range_of(numbers)));
}

std::vector<Colour> colours_of(const Bytes& array, std::size_t n) {
  require_rows(array, 3, "colours", n);
  const auto* first = reinterpret_cast<const Colour*>(array.data());
  return {first, first + n};
}

Bytes picture(int width, auto&& scene_of) {
  const Image image = [&] {
    const Released released;
    const Scene scene = scene_of();
    return cast_rays(scene, width, height_of(scene, width));
  }();
  return Bytes({image.height, image.width, 3}, image.pixels.data());
}

}  // namespace

void bind_pictures(py::module_& module) {
  module.def("particle_colours", &named_colours<2>);
  module.def("particle_colours", &named_colours<3>);
  module.def("number_colours", &number_colours);
  module.def("picture", [](const Configuration2& state, const Bytes& array, int width) {
    const std::vector<Colour> colours = colours_of(array, state.size());
    return picture(width, [&] { return scene_of(state, colours); });
  });
  module.def("picture", [](const Configuration3& state, const Bytes& array, int width,
                           double azimuth, double elevation, bool whole) {
    const std::vector<Colour> colours = colours_of(array, state.size());
    return picture(width, [&] {
      return scene_of(state, colours, View{azimuth, elevation, whole});
    });
  });
}

}  // namespace vitrel::python
