#include "workflow/report/packing_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "analysis/structure/packing_images.h"
#include "core/io/base64.h"
#include "core/io/json.h"
#include "workflow/report/page_parts.h"

namespace vitrel {

namespace {

constexpr double position_steps = 65'536, quaternion_steps = 32'767;
constexpr std::size_t not_shown = std::numeric_limits<std::size_t>::max();

std::uint16_t low_bits(double steps) {
  return static_cast<std::uint16_t>(std::llround(steps));
}

/// Those that meet the window.
std::vector<BodyInBox> shown_bodies(const Configuration3& packing, const Vec3& window) {
  std::vector<BodyInBox> bodies = bodies_in_box(packing);
  if (window == packing.box.lengths()) return bodies;
  const PeriodicBox<3> part(window);
  std::erase_if(bodies, [&](const BodyInBox& body) {
    Pose3 pose = packing.pose(body.particle);
    pose.position += packing.box.translation(body.shift);
    return !meets_box(packing.shape[body.particle], pose, part);
  });
  return bodies;
}

void add_particle(PackingScene& scene, const Configuration3& packing, std::size_t i) {
  scene.shape.push_back(packing.shape[i]);
  scene.species.push_back(packing.species[i]);
  const Vec3 fractions = packing.position[i].cwiseQuotient(packing.box.lengths());
  for (const double fraction : fractions)
    scene.poses.push_back(low_bits((fraction + 0.5) * position_steps));
  const Quaternion& q = packing.orientation[i];
  for (const double part : {q.w(), q.x(), q.y(), q.z()})
    scene.poses.push_back(low_bits(part * quaternion_steps));
}

}  // namespace

PackingScene packing_scene(const Configuration3& packing, const ExactCheck<3>& check,
                           std::size_t max_particles) {
  PackingScene scene;
  scene.particles = packing.size();
  scene.box = packing.box.lengths();
  const double share = static_cast<double>(max_particles) / static_cast<double>(packing.size());
  scene.window = share < 1 ? Vec3(std::cbrt(share) * scene.box) : scene.box;
  scene.species_names = packing.species_names;

  std::vector<std::size_t> place(packing.size(), not_shown);
  for (const BodyInBox& body : shown_bodies(packing, scene.window)) {
    std::size_t& shown = place[body.particle];
    if (shown == not_shown) {
      shown = scene.shape.size();
      add_particle(scene, packing, body.particle);
    }
    if (!body.shift.isZero()) scene.images.push_back({shown, body.shift});
  }

  scene.overlapping_pairs = check.overlaps.size();
  std::set<std::size_t> overlapping;
  for (const PairImage<3>& pair : check.overlaps)
    overlapping.insert({place[pair.i], place[pair.j]});
  overlapping.erase(not_shown);
  scene.overlapping.assign(overlapping.begin(), overlapping.end());
  return scene;
}

Json scene_data(const PackingScene& scene) {
  const auto sides = [](const Vec3& lengths) {
    return Json{page_number(lengths.x()), page_number(lengths.y()), page_number(lengths.z())};
  };
  Json images = Json::array();
  for (const PackingScene::Image& image : scene.images) {
    images.push_back(image.particle);
    for (const std::int32_t boxes : image.shift) images.push_back(boxes);
  }
  Json data = {{"particles", scene.particles},
               {"box", sides(scene.box)},
               {"window", sides(scene.window)},
               {"speciesNames", scene.species_names},
               {"poses", base64(std::as_bytes(std::span(scene.poses)))},
               {"images", std::move(images)},
               {"overlappingPairs", scene.overlapping_pairs},
               {"overlapping", scene.overlapping}};
  std::vector<std::vector<double>> shapes;
  for (const Ellipsoid& shape : scene.shape)
    shapes.push_back({shape.semi_axes[0], shape.semi_axes[1], shape.semi_axes[2]});
  add_shapes(data, shapes);
  if (scene.species_names.size() > 1) data["species"] = scene.species;
  return data;
}

}  // namespace vitrel
