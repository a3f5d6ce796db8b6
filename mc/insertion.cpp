#include "mc/insertion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "core/contact/pair.h"
#include "core/neighbors/cell_grid.h"
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
      ++places_tried;
      const Vec2 position(draw.uniform(-0.5, 0.5) * lengths.x(),
                          draw.uniform(-0.5, 0.5) * lengths.y());
      const double angle = options_.aligned ? 0 : draw.uniform(0, std::numbers::pi);
      if (!fits(i, {position, angle})) continue;
      configuration_.position[i] = position;
      configuration_.image[i] = Shift<2>::Zero();
      configuration_.angle[i] = angle;
      cells_.insert(i, {position});
      return true;
    }
    return false;
  }

  std::uint64_t places_tried = 0;

 private:
  bool fits(std::size_t i, const Pose2& pose) const {
    const Ellipse& shape = configuration_.shape[i];
    const double reach = shape.circumradius() + largest_ + margin_;
    const auto clear_of = [&](std::size_t j, const Shift<2>&, const Vec2& d) {
      return separated(shape, pose, configuration_.shape[j], configuration_.pose(j), d, margin_);
    };
    return cells_.for_each_near(pose.position, reach, clear_of) &&
           clear_of_own_images(configuration_.box, shape, direction(pose.angle), margin_);
  }

  Configuration2& configuration_;
  const InsertionOptions& options_;
  CellGrid<2> cells_;
  double largest_, margin_;
};

std::string hopeless(std::size_t placed, std::size_t particles, double reached,
                     std::uint64_t attempts) {
  // Nine tenths of what was reached, in whole per cent, is found fast.
  const int per_cent = static_cast<int>(90 * reached);
  return "insertion is hopeless: after " + std::to_string(placed) + " of " +
         std::to_string(particles) + " particles, at a packing fraction of " +
         std::to_string(reached) + ", " + std::to_string(attempts) +
         " attempts found no place for the next; insert at " + std::to_string(per_cent) +
         " % at most and swell from there";
}

}  // namespace

InsertionReport insert_particles(Configuration2& configuration, const InsertionOptions& options,
                                 std::uint64_t seed, const Budget& budget) {
  scale_to_packing_fraction(configuration, options.packing_fraction);
  Insertion insertion(configuration, options);
  std::size_t placed = 0;
  double covered = 0;
  const auto ended = [&](StageEnd end, const std::string& reason) {
    return InsertionReport{{end, reason}, insertion.places_tried};
  };
  for (std::size_t i : largest_first(configuration)) {
    if (budget.stop_requested()) return ended(StageEnd::stopped, "insertion was stopped");
    if (!insertion.insert(i, Stream(seed, Purpose::placement, 0, i)))
      return ended(StageEnd::stuck,
                   hopeless(placed, configuration.size(), covered / configuration.box.volume(),
                            options.attempts));
    ++placed;
    covered += configuration.shape[i].volume();
    const double share = static_cast<double>(placed) / static_cast<double>(configuration.size());
    budget.tell({share, static_cast<double>(placed), "particles"});
  }
  return ended(StageEnd::reached, "all particles inserted");
}

}  // namespace vitrel
