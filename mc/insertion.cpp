#include "mc/insertion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/contact/pair.h"
#include "core/random/stream.h"
#include "mc/disjoint.h"

namespace vitrel {

namespace {

std::vector<std::size_t> largest_first(const Configuration2& configuration) {
  std::vector<std::size_t> order(configuration.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return configuration.shape[i].volume() > configuration.shape[j].volume();
  });
  return order;
}

class Insertion {
 public:
  Insertion(Configuration2& configuration, const InsertionOptions& options)
      : configuration_(configuration),
        options_(options),
        cells_(configuration.box, 2 * largest_circumradius(configuration), configuration.size()),
        largest_(largest_circumradius(configuration)),
        margin_(hard_margin(configuration)) {}

  bool insert(std::size_t i, Stream draw) {
    const Vec2 lengths = configuration_.box.lengths();
    for (std::uint64_t attempt = 0; attempt < options_.attempts; ++attempt) {
      const Vec2 position(draw.uniform(-0.5, 0.5) * lengths.x(),
                          draw.uniform(-0.5, 0.5) * lengths.y());
      const double angle = options_.aligned ? 0 : draw.uniform(0, std::numbers::pi);
      if (!fits(i, {position, angle})) continue;
      configuration_.position[i] = position;
      configuration_.image[i] = Shift<2>::Zero();
      configuration_.angle[i] = angle;
      cells_.insert(i, position);
      return true;
    }
    return false;
  }

 private:
  bool fits(std::size_t i, const Pose2& pose) const {
    bool free = true;
    const Ellipse& shape = configuration_.shape[i];
    for_each_candidate(configuration_, cells_, i, pose.position, largest_, margin_,
                       [&](std::size_t j, const Shift<2>&, const Vec2& d) {
                         free = free && separated(shape, pose, configuration_.shape[j],
                                                  configuration_.pose(j), d, margin_);
                       });
    return free && clear_of_own_images(shape, pose);
  }

  bool clear_of_own_images(const Ellipse& shape, const Pose2& pose) const {
    bool free = true;
    configuration_.box.for_each_image(
        Vec2::Zero(), 2 * shape.a + margin_, [&](const Shift<2>& shift, const Vec2& d) {
          if (!shift.isZero()) free = free && separated(shape, pose, shape, pose, d, margin_);
        });
    return free;
  }

  Configuration2& configuration_;
  const InsertionOptions& options_;
  CellGrid cells_;
  double largest_, margin_;
};

}  // namespace

StageReport insert_particles(Configuration2& configuration, const InsertionOptions& options,
                             std::uint64_t seed, const Budget& budget) {
  scale_to_packing_fraction(configuration, options.packing_fraction);
  Insertion insertion(configuration, options);
  std::size_t placed = 0;
  double covered = 0;
  for (std::size_t i : largest_first(configuration)) {
    if (!insertion.insert(i, Stream(seed, Purpose::placement, 0, i)))
      return {StageEnd::stuck,
              "insertion is hopeless: after " + std::to_string(placed) + " of " +
                  std::to_string(configuration.size()) + " particles, at a packing fraction of " +
                  std::to_string(covered / configuration.box.volume()) + ", " +
                  std::to_string(options.attempts) +
                  " attempts found no place for the next; insert at a lower packing fraction "
                  "(0.3, say) and swell"};
    ++placed;
    covered += configuration.shape[i].volume();
    const double share = static_cast<double>(placed) / static_cast<double>(configuration.size());
    budget.tell({share, static_cast<double>(placed), "particles"});
  }
  return {StageEnd::reached, "all particles inserted"};
}

}  // namespace vitrel
