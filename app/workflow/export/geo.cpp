#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "app/workflow/export/frame_sink.h"
#include "app/workflow/export/packing.h"

namespace vitrel {
namespace {

/// What follows the bodies. A body keeps its number through these operations, the matrix takes that of the
/// box.
constexpr const char* assembly = R"(
parts() = BooleanFragments{ Volume{box}; Delete; }{ Volume{1:box-1}; Delete; };
matrix() = parts();
matrix() -= {1:box-1};
Physical Volume("matrix") = matrix();

// Each face on a lower side and its twin, one box further, have equal bounding boxes.
Macro PairFaces
  For i In {0:#low()-1}
    one() = BoundingBox Surface{ low(i) };
    near() = Surface In BoundingBox{ one(0) + tx - e, one(1) + ty - e, one(2) + tz - e,
                                     one(3) + tx + e, one(4) + ty + e, one(5) + tz + e };
    twins = 0;
    For j In {0:#near()-1}
      two() = BoundingBox Surface{ near(j) };
      off = Fabs(two(0) - tx - one(0)) + Fabs(two(1) - ty - one(1)) + Fabs(two(2) - tz - one(2)) +
            Fabs(two(3) - tx - one(3)) + Fabs(two(4) - ty - one(4)) + Fabs(two(5) - tz - one(5));
      If (off < e)
        Periodic Surface{ near(j) } = { low(i) } Translate{ tx, ty, tz };
        twins += 1;
      EndIf
    EndFor
    If (twins != 1)
      Error("Surface %g has %g twins on the opposite side, not 1", low(i), twins);
    EndIf
  EndFor
Return

low() = Surface In BoundingBox{ -hx - e, -hy - e, -hz - e, -hx + e, hy + e, hz + e };
tx = 2*hx; ty = 0; tz = 0;
Call PairFaces;
Physical Surface("xmin") = low();
Physical Surface("xmax") = Surface In BoundingBox{ hx - e, -hy - e, -hz - e, hx + e, hy + e, hz + e };

low() = Surface In BoundingBox{ -hx - e, -hy - e, -hz - e, hx + e, -hy + e, hz + e };
tx = 0; ty = 2*hy; tz = 0;
Call PairFaces;
Physical Surface("ymin") = low();
Physical Surface("ymax") = Surface In BoundingBox{ -hx - e, hy - e, -hz - e, hx + e, hy + e, hz + e };

low() = Surface In BoundingBox{ -hx - e, -hy - e, -hz - e, hx + e, hy + e, -hz + e };
tx = 0; ty = 0; tz = 2*hz;
Call PairFaces;
Physical Surface("zmin") = low();
Physical Surface("zmax") = Surface In BoundingBox{ -hx - e, -hy - e, hz - e, hx + e, hy + e, hz + e };
)";

/// Differences of faces and their twins, over the thinnest body: above the tolerances of the kernel, and
/// below all that a mesh resolves.
constexpr double face_tolerance = 1e-3;

void append_body(fmt::memory_buffer& text, std::size_t tag, const Ellipsoid& shape,
                 const Quaternion& orientation, const Vec3& centre) {
  const auto out = std::back_inserter(text);
  const Vec3& axes = shape.semi_axes;
  const Eigen::AngleAxisd turn(orientation);
  if (shape.is_round()) {
    fmt::format_to(out, "Sphere({}) = {{0, 0, 0, {}}};", tag, axes[0]);
  } else {
    fmt::format_to(out, "Sphere({0}) = {{0, 0, 0, 1}}; ", tag);
    fmt::format_to(out, "Dilate{{{{0, 0, 0}}, {{{}, {}, {}}}}}{{ Volume{{{}}}; }} ", axes[0],
                   axes[1], axes[2], tag);
    fmt::format_to(out, "Rotate{{{{{}, {}, {}}}, {{0, 0, 0}}, {}}}{{ Volume{{{}}}; }}",
                   turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle(), tag);
  }
  fmt::format_to(out, " Translate{{{}, {}, {}}}{{ Volume{{{}}}; }}\n", centre.x(), centre.y(),
                 centre.z(), tag);
}

double shortest_semi_axis(const Configuration3& configuration) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Ellipsoid& shape : configuration.shape)
    shortest = std::min(shortest, shape.inradius());
  return shortest;
}

/// A name in quotes, which the language cannot have inside.
std::string quoted(std::string name) {
  std::ranges::replace(name, '"', '\'');
  return '"' + name + '"';
}

}  // namespace

void write_geo(const std::filesystem::path& path, const Packing& packing) {
  const Configuration3& configuration = packing.configuration;
  const Vec3 half = 0.5 * configuration.box.lengths();
  const double shortest = shortest_semi_axis(configuration);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "// One period of a packing of {} ellipsoids, by vitrel.\n"
      "// gmsh -3 -setnumber h 0.1 <this file> makes a mesh with elements of that size.\n"
      "SetFactory(\"OpenCASCADE\");\n"
      "DefineConstant[ h = {{{}, Name \"Mesh size\"}} ];\n"
      "Mesh.MeshSizeMax = h;\n"
      "hx = {}; hy = {}; hz = {};\n"
      "e = {};\n\n",
      configuration.size(), 0.5 * shortest, half.x(), half.y(), half.z(),
      face_tolerance * shortest);
  std::vector<std::size_t> cut;
  std::vector<std::vector<std::size_t>> of_species(configuration.species_names.size());
  for (std::size_t k = 0; k < packing.bodies.size(); ++k) {
    const BodyInBox& body = packing.bodies[k];
    const std::size_t tag = k + 1;
    append_body(text, tag, configuration.shape[body.particle],
                configuration.orientation[body.particle], packing.centre(body));
    if (body.is_cut) cut.push_back(tag);
    of_species[configuration.species[body.particle]].push_back(tag);
  }
  fmt::format_to(out, "\nbox = {};\nBox(box) = {{-hx, -hy, -hz, 2*hx, 2*hy, 2*hz}};\n",
                 packing.bodies.size() + 1);
  if (!cut.empty())
    fmt::format_to(out,
                   "cut() = BooleanIntersection{{ Volume{{{}}}; Delete; }}{{ Volume{{box}}; }};\n",
                   fmt::join(cut, ", "));
  fmt::format_to(out, "{}\n", assembly);
  for (std::size_t k = 0; k < of_species.size(); ++k)
    if (!of_species[k].empty())
      fmt::format_to(out, "Physical Volume({}) = {{{}}};\n",
                     quoted("inclusions " + configuration.species_names[k]),
                     fmt::join(of_species[k], ", "));
  OutputFile file(path);
  file.write({text.data(), text.size()});
  file.close();
}

}  // namespace vitrel
