#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "workflow/export/frame_sink.h"
#include "workflow/export/packing.h"

namespace vitrel {
namespace {

/// The part of the script before the bodies. Bodies are affine images of a ball with four faces. The kernel's own
/// ball has a single face with a seam and poles, and if it is scaled, Gmsh often fails to mesh it. All slices of a
/// particle have the same faces, so that faces on opposite sides of the box are bounded by the same curves.
constexpr const char* macros = R"(
box = 1;
Box(box) = {-hx, -hy, -hz, 2*hx, 2*hy, 2*hz};

// A ball of a belt of two halves and of two caps, whose poles and seams are cut off.
Geometry.OCCUnionUnify = 0;
Sphere(2) = {0, 0, 0, 1, -Pi/4, Pi/4, Pi};
Sphere(3) = {0, 0, 0, 1, -Pi/4, Pi/4, Pi};
Rotate{ {0, 0, 1}, {0, 0, 0}, Pi }{ Volume{3}; }
Sphere(4) = {0, 0, 0, 1};
Rotate{ {0, 1, 0}, {0, 0, 0}, Pi/2 }{ Volume{4}; }
Box(5) = {-1, -1, Sin(Pi/4), 2, 2, 1};
cap() = BooleanIntersection{ Volume{4}; Delete; }{ Volume{5}; Delete; };
opposite() = Rotate{ {1, 0, 0}, {0, 0, 0}, Pi }{ Duplicata{ Volume{cap()}; } };
ball() = BooleanUnion{ Volume{2}; Delete; }{ Volume{3, cap(), opposite()}; Delete; };

bodies() = {};
Macro MakeParticle
  slices() = {};
  For i In {0:#x()-1}
    copy() = Duplicata{ Volume{ball()}; };
    Dilate{ {0, 0, 0}, {a, b, c} }{ Volume{copy()}; }
    Rotate{ {ux, uy, uz}, {0, 0, 0}, angle }{ Volume{copy()}; }
    Translate{ x(i), y(i), z(i) }{ Volume{copy()}; }
    slices() += copy();
  EndFor
  If (cut)
    slices() = BooleanIntersection{ Volume{slices()}; Delete; }{ Volume{box}; };
  EndIf
  whole = 0;
  For i In {0:#slices()-1}
    part = Mass Volume{slices(i)};
    whole += part;
  EndFor
  If (Fabs(whole/(4*Pi/3*a*b*c) - 1) > 0.01)
    Error("Particle %g could not be cut by the box", particle);
  EndIf
  bodies() += slices();
  inclusions() += slices();
Return

// A face on a lower side and its image, one period further, have nearly equal bounding boxes: the kernel
// approximates the curves along which it cuts.
Macro PairFaces
  For i In {0:#low()-1}
    one() = BoundingBox Surface{ low(i) };
    near() = Surface In BoundingBox{ one(0) + tx - m, one(1) + ty - m, one(2) + tz - m,
                                     one(3) + tx + m, one(4) + ty + m, one(5) + tz + m };
    image = 0;
    least = 6*m;
    For j In {0:#near()-1}
      two() = BoundingBox Surface{ near(j) };
      off = Fabs(two(0) - tx - one(0)) + Fabs(two(1) - ty - one(1)) + Fabs(two(2) - tz - one(2)) +
            Fabs(two(3) - tx - one(3)) + Fabs(two(4) - ty - one(4)) + Fabs(two(5) - tz - one(5));
      If (off < least)
        image = near(j);
        least = off;
      EndIf
    EndFor
    If (image)
      Periodic Surface{ image } = { low(i) } Translate{ tx, ty, tz };
      area = Mass Surface{ low(i) };
      curves() = Abs(Boundary{ Surface{low(i)}; });
      perimeter = 0;
      For j In {0:#curves()-1}
        length = Mass Curve{ curves(j) };
        perimeter += length;
      EndFor
      faces() += { low(i), image };
      sizes() += { area/perimeter, area/perimeter };
    Else
      Error("Surface %g has no image on the opposite side", low(i));
    EndIf
  EndFor
Return
)";

/// The part of the script after the bodies, which keep their numbers.
constexpr const char* assembly = R"(
Recursive Delete{ Volume{ball()}; }
matrix() = BooleanFragments{ Volume{box}; Delete; }{ Volume{bodies()}; Delete; };
matrix() -= bodies();
Physical Volume("matrix") = matrix();
faces() = {};
sizes() = {};

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

// A thin slice needs elements small enough to see its curvature. Points that faces share get the size of
// the smallest, by halves.
level = h;
For k In {1:12}
  level /= 2;
  For i In {0:#faces()-1}
    If (sizes(i) <= level)
      MeshSize{ PointsOf{ Surface{faces(i)}; } } = level;
    EndIf
  EndFor
EndFor

)";

/// Tolerances in units of the shortest semi-axis: how far from a side of the box a face may lie to belong to it, and
/// how well a face and its image on the opposite side must agree.
constexpr double side_tolerance = 1e-3, twin_tolerance = 0.02;

using Bodies = std::vector<BodyInBox>::const_iterator;

/// The bodies of one particle: slices of it and of its images.
struct Slices {
  Bodies begin, end;
};

std::vector<Slices> slices_of(const Packing& packing) {
  std::vector<Slices> particles;
  for (Bodies begin = packing.bodies.begin(); begin != packing.bodies.end();) {
    const Bodies end = std::find_if(begin, packing.bodies.end(), [&](const BodyInBox& body) {
      return body.particle != begin->particle;
    });
    particles.push_back({begin, end});
    begin = end;
  }
  return particles;
}

std::string coordinates(const Packing& packing, const Slices& slices, int k) {
  std::vector<double> values;
  for (Bodies body = slices.begin; body != slices.end; ++body)
    values.push_back(packing.centre(*body)[k]);
  return fmt::format("{}() = {{{}}};", "xyz"[k], fmt::join(values, ", "));
}

std::string particle(const Packing& packing, const Slices& slices) {
  const std::size_t i = slices.begin->particle;
  const Vec3& axes = packing.configuration.shape[i].half_lengths();
  const Eigen::AngleAxisd turn(packing.configuration.orientation[i]);
  return fmt::format(
      "particle = {}; cut = {};\n{}\n{}\n{}\na = {}; b = {}; c = {}; ux = {}; uy = {}; uz = {}; "
      "angle = {};\n"
      "Call MakeParticle;\n",
      i, slices.begin->is_cut ? 1 : 0, coordinates(packing, slices, 0),
      coordinates(packing, slices, 1), coordinates(packing, slices, 2), axes[0], axes[1], axes[2],
      turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle());
}

std::string head(const Configuration3& configuration, const Vec3& translation) {
  const Vec3 half = 0.5 * configuration.box.lengths();
  const double shortest = smallest_inradius(configuration);
  return fmt::format(
      "// One period of a packing of {} ellipsoids, by vitrel.\n"
      "// Coordinates are those of the packing less ({}, {}, {}), so that no body grazes the box.\n"
      "// gmsh -3 -setnumber h 0.1 <this file> makes a mesh with elements of that size.\n"
      "SetFactory(\"OpenCASCADE\");\n"
      "DefineConstant[ h = {{{}, Name \"Mesh size\"}} ];\n"
      "Mesh.MeshSizeMax = h;\n"
      "hx = {}; hy = {}; hz = {};\n"
      "e = {}; m = {};\n",
      configuration.size(), translation.x(), translation.y(), translation.z(), 0.5 * shortest,
      half.x(), half.y(), half.z(), side_tolerance * shortest, twin_tolerance * shortest);
}

/// Puts a name in quotes. The language does not allow quotes inside, so they become apostrophes.
std::string quoted(std::string name) {
  std::ranges::replace(name, '"', '\'');
  return '"' + name + '"';
}

Packing moved(Configuration3 configuration, const Vec3& translation) {
  for (std::size_t i = 0; i < configuration.size(); ++i) {
    configuration.position[i] -= translation;
    configuration.box.wrap(configuration.position[i], configuration.image[i]);
  }
  return {std::move(configuration), 1};
}

}  // namespace

void write_geo(const std::filesystem::path& path, const Packing& packing) {
  const Vec3 translation = clean_cut(packing.configuration);
  const Packing cut = moved(packing.configuration, translation);
  const Configuration3& configuration = cut.configuration;
  const std::vector<Slices> particles = slices_of(cut);
  std::string script = head(configuration, translation) + macros;
  for (std::size_t k = 0; k < configuration.species_names.size(); ++k) {
    script += "\ninclusions() = {};\n";
    for (const Slices& slices : particles)
      if (configuration.species[slices.begin->particle] == static_cast<std::int32_t>(k))
        script += particle(cut, slices);
    script += fmt::format("inclusions_{}() = inclusions();\n", k);
  }
  script += assembly;
  for (std::size_t k = 0; k < configuration.species_names.size(); ++k)
    script += fmt::format("Physical Volume({}) = inclusions_{}();\n",
                          quoted("inclusions " + configuration.species_names[k]), k);
  write_file(path, script);
}

}  // namespace vitrel
