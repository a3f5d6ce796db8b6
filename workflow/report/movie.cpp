#include "workflow/report/movie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "core/io/base64.h"
#include "core/io/json.h"
#include "core/parallel.h"
#include "core/state/check.h"
#include "workflow/report/page_parts.h"

namespace vitrel {

namespace {

constexpr double steps_per_turn = 65'536;
constexpr std::size_t frames_at_a_time = 32;
constexpr std::size_t characters_per_pose = 8;
constexpr std::size_t characters_per_jump = 16;

/// Evenly spaced indices into `frames`, the first and the last included.
std::vector<std::size_t> shown_frames(std::size_t frames, std::size_t wanted) {
  if (wanted <= 1 || frames == 1) return {frames - 1};
  const std::size_t count = std::min(frames, wanted);
  std::vector<std::size_t> shown(count);
  for (std::size_t k = 0; k < count; ++k)
    shown[k] = (k * (frames - 1) + (count - 1) / 2) / (count - 1);
  return shown;
}

/// All particles, or those in the middle of the box.
std::vector<std::size_t> shown_particles(const Configuration2& state, const Vec2& window) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec2 fraction = state.position[i].cwiseQuotient(state.box.lengths());
    if (window.x() == 1 || (2 * fraction.cwiseAbs() - window).maxCoeff() <= 0) shown.push_back(i);
  }
  return shown;
}

class Camera {
 public:
  Camera(Trajectory2& trajectory, const MovieLimits& limits)
      : trajectory_(trajectory), limits_(limits) {}

  /// Chooses the particles in the first frame, then takes the poses of all.
  const Movie& take(std::size_t wanted) {
    movie_ = {};
    movie_.run_frames = trajectory_.frames();
    frames_ = shown_frames(trajectory_.frames(), wanted);
    for (const std::size_t k : frames_) {
      const Configuration2& state = trajectory_.read(k);
      if (movie_.time.empty()) choose_particles(state);
      take_frame(state);
    }
    return movie_;
  }

  /// Checks what was taken, a few frames at a time on all cores.
  Movie checked() {
    for (std::size_t first = 0; first < frames_.size(); first += frames_at_a_time) {
      std::vector<Configuration2> states;
      for (std::size_t k = first; k < std::min(first + frames_at_a_time, frames_.size()); ++k)
        states.push_back(trajectory_.read(frames_[k]));
      std::vector<std::vector<PairImage<2>>> overlaps(states.size());
      in_parallel(states.size(), all_cores, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) overlaps[k] = exact_check(states[k]).overlaps;
      });
      for (const std::vector<PairImage<2>>& pairs : overlaps) mark(pairs);
    }
    return std::move(movie_);
  }

 private:
  void choose_particles(const Configuration2& state) {
    movie_.run_particles = state.size();
    const double share = static_cast<double>(limits_.particles) /
                         static_cast<double>(std::max<std::size_t>(1, state.size()));
    movie_.window = Vec2::Constant(std::sqrt(std::min(1.0, share)));
    shown_ = shown_particles(state, movie_.window);
    movie_.species_names = state.species_names;
    for (const std::size_t i : shown_) {
      movie_.shape.push_back(state.shape[i]);
      movie_.species.push_back(state.species[i]);
    }
    steps_.assign(shown_.size(), {});
  }

  void take_frame(const Configuration2& state) {
    movie_.time.push_back(state.time);
    movie_.box.push_back(state.box.lengths());
    for (std::size_t n = 0; n < shown_.size(); ++n) take_pose(state, n);
  }

  void mark(const std::vector<PairImage<2>>& pairs) {
    std::set<std::size_t> overlapping;
    for (const PairImage<2>& pair : pairs) overlapping.insert({pair.i, pair.j});
    movie_.overlapping_pairs.push_back(pairs.size());
    movie_.overlapping.emplace_back();
    for (std::size_t n = 0; n < shown_.size(); ++n)
      if (overlapping.contains(shown_[n])) movie_.overlapping.back().push_back(n);
  }

  void take_pose(const Configuration2& state, std::size_t n) {
    const std::size_t i = shown_[n];
    Shift<2> jump = Shift<2>::Zero();
    for (int axis = 0; axis < 2; ++axis) {
      const double fraction = state.position[i][axis] / state.box.lengths()[axis] + 0.5;
      const std::int64_t step = std::llround(fraction * steps_per_turn) +
                                static_cast<std::int64_t>(state.image[i][axis]) * 65'536;
      const std::int64_t travelled = step - steps_[n][axis];
      const auto shortest = static_cast<std::int16_t>(travelled);
      jump[axis] = static_cast<int>((travelled - shortest) / 65'536);
      steps_[n][axis] = step;
      movie_.poses.push_back(static_cast<std::uint16_t>(step));
    }
    movie_.poses.push_back(
        static_cast<std::uint16_t>(std::llround(state.angle[i] / M_PI * steps_per_turn)));
    if (limits_.images_known && movie_.frames() > 1 && !jump.isZero())
      movie_.jumps.push_back({movie_.frames() - 1, n, jump});
  }

  Trajectory2& trajectory_;
  MovieLimits limits_;
  Movie movie_;
  std::vector<std::size_t> frames_, shown_;
  std::vector<std::array<std::int64_t, 2>> steps_;  // of the frame before, unwrapped
};

bool fits(const Movie& movie, const MovieLimits& limits) {
  const std::size_t poses = movie.particles() * movie.frames();
  return 10 * (poses * characters_per_pose + movie.jumps.size() * characters_per_jump) <=
         11 * limits.poses * characters_per_pose;
}

}  // namespace

Movie film(Trajectory2& trajectory, const MovieLimits& limits) {
  Camera camera(trajectory, limits);
  const std::size_t particles = std::max<std::size_t>(1, camera.take(1).particles());
  std::size_t wanted = std::min(limits.frames, limits.poses / particles);
  while (wanted > 1 && !fits(camera.take(wanted), limits)) wanted /= 2;
  if (wanted == 1) camera.take(1);
  return camera.checked();
}

Json movie_data(const Movie& movie) {
  if (movie.particles() == 0) return nullptr;
  Json boxes = Json::array(), jumps = Json::array(), times = Json::array();
  for (const Vec2& box : movie.box) boxes.push_back({page_number(box.x()), page_number(box.y())});
  for (const double time : movie.time) times.push_back(page_number(time));
  for (const Movie::Jump& jump : movie.jumps)
    jumps.push_back({jump.frame, jump.particle, jump.shift.x(), jump.shift.y()});
  if (std::equal(boxes.begin() + 1, boxes.end(), boxes.begin())) boxes = {boxes.front()};
  Json data = {{"runParticles", movie.run_particles},
               {"runFrames", movie.run_frames},
               {"particles", movie.particles()},
               {"window", {movie.window.x(), movie.window.y()}},
               {"time", std::move(times)},
               {"box", std::move(boxes)},
               {"speciesNames", movie.species_names},
               {"poses", base64(std::as_bytes(std::span(movie.poses)))},
               {"jumps", std::move(jumps)},
               {"overlappingPairs", movie.overlapping_pairs},
               {"overlapping", movie.overlapping}};
  std::vector<std::vector<double>> shapes;
  for (const Ellipse& shape : movie.shape) shapes.push_back({shape.a, shape.b});
  add_shapes(data, shapes);
  if (movie.species_names.size() > 1) data["species"] = movie.species;
  return data;
}

}  // namespace vitrel
