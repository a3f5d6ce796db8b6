#include "workflow/export/packing.h"

#include <utility>

namespace vitrel {
namespace {

Configuration3 shrunk(Configuration3 state, double shrink) {
  for (ParticleShape<3>& shape : state.shape) shape = scaled(shape, shrink);
  return state;
}

}  // namespace

Packing::Packing(Configuration3 state, double shrink)
    : configuration(shrunk(std::move(state), shrink)), bodies(bodies_in_box(configuration)) {}

Vec3 Packing::centre(const BodyInBox& body) const {
  return configuration.position[body.particle] + configuration.box.translation(body.shift);
}

}  // namespace vitrel
