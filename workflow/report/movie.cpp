#include "workflow/report/movie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "analysis/structure/packing_images.h"
#include "core/io/base64.h"
#include "core/io/json.h"
#include "core/parallel.h"
#include "core/state/check.h"
#include "workflow/report/page_parts.h"

namespace vitrel {

namespace {

constexpr double steps_per_turn = 65'536, quaternion_steps = 32'767;
constexpr std::size_t frames_at_a_time = 32;
constexpr std::size_t characters_per_jump = 16, characters_per_image = 12;
constexpr std::size_t not_shown = std::numeric_limits<std::size_t>::max();

/// Evenly spaced indices of frames, including the first and the last; the last alone if only one is wanted.
std::vector<std::size_t> shown_frames(std::size_t frames, std::size_t wanted) {
  if (wanted <= 1 || frames == 1) return {frames - 1};
  const std::size_t count = std::min(frames, wanted);
  std::vector<std::size_t> shown(count);
  for (std::size_t k = 0; k < count; ++k)
    shown[k] = (k * (frames - 1) + (count - 1) / 2) / (count - 1);
  return shown;
}

/// The bodies, including images, that meet the window.
std::vector<BodyInBox> shown_bodies(const Configuration3& state, const Vec3& window) {
  std::vector<BodyInBox> bodies = bodies_in_box(state);
  if (window.x() == 1) return bodies;
  const PeriodicBox<3> part(window.cwiseProduct(state.box.lengths()));
  std::erase_if(bodies, [&](const BodyInBox& body) {
    Pose3 pose = state.pose(body.particle);
    pose.position += state.box.translation(body.shift);
    return !meets_box(state.shape[body.particle], pose, part);
  });
  return bodies;
}

/// All particles, or those in the middle of the box, in ascending order.
std::vector<std::size_t> shown_particles(const Configuration2& state, const Vec2& window) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec2 fraction = state.position[i].cwiseQuotient(state.box.lengths());
    if (window.x() == 1 || (2 * fraction.cwiseAbs() - window).maxCoeff() <= 0) shown.push_back(i);
  }
  return shown;
}

std::vector<std::size_t> shown_particles(const Configuration3& state, const Vec3& window) {
  std::vector<std::size_t> shown;
  for (const BodyInBox& body : shown_bodies(state, window))
    if (shown.empty() || shown.back() != body.particle) shown.push_back(body.particle);
  return shown;
}

std::uint16_t low_bits(double steps) {
  return static_cast<std::uint16_t>(std::llround(steps));
}

void take_orientation(const Configuration2& state, std::size_t i,
                      std::vector<std::uint16_t>& poses) {
  poses.push_back(low_bits(state.angle[i] / M_PI * steps_per_turn));
}

void take_orientation(const Configuration3& state, std::size_t i,
                      std::vector<std::uint16_t>& poses) {
  const Quaternion& q = state.orientation[i];
  for (const double part : {q.w(), q.x(), q.y(), q.z()})
    poses.push_back(low_bits(part * quaternion_steps));
}

/// The size of the movie in a page, where base64 turns three bytes into four characters.
template <int Dim>
std::size_t characters(const Movie<Dim>& movie) {
  std::size_t images = 0;
  for (const auto& frame : movie.images) images += frame.size();
  return movie.poses.size() * 8 / 3 + movie.jumps.size() * characters_per_jump +
         images * characters_per_image;
}

template <int Dim>
class Camera {
 public:
  Camera(Trajectory<Dim>& trajectory, const MovieLimits& limits)
      : trajectory_(trajectory), limits_(limits) {}

  /// Chooses the particles in the first frame, then stores the poses of all frames.
  const Movie<Dim>& take(std::size_t wanted) {
    movie_ = {};
    movie_.run_frames = trajectory_.frames();
    frames_ = shown_frames(trajectory_.frames(), wanted);
    for (const std::size_t k : frames_) {
      const Configuration<Dim>& state = trajectory_.read(k);
      if (movie_.time.empty()) choose_particles(state);
      take_frame(state);
    }
    return movie_;
  }

  /// Checks the stored frames for overlaps, a few at a time on all cores.
  Movie<Dim> checked() {
    for (std::size_t first = 0; first < frames_.size(); first += frames_at_a_time) {
      std::vector<Configuration<Dim>> states;
      for (std::size_t k = first; k < std::min(first + frames_at_a_time, frames_.size()); ++k)
        states.push_back(trajectory_.read(frames_[k]));
      std::vector<std::vector<PairImage<Dim>>> overlaps(states.size());
      each_in_parallel(states.size(), all_cores,
                       [&](std::size_t k) { overlaps[k] = exact_check(states[k]).overlaps; });
      for (const std::vector<PairImage<Dim>>& pairs : overlaps) mark(pairs);
    }
    return std::move(movie_);
  }

 private:
  void choose_particles(const Configuration<Dim>& state) {
    movie_.run_particles = state.size();
    const double share =
        std::min(1.0, static_cast<double>(limits_.particles) /
                          static_cast<double>(std::max<std::size_t>(1, state.size())));
    movie_.window = Vec<Dim>::Constant(Dim == 2 ? std::sqrt(share) : std::cbrt(share));
    shown_ = shown_particles(state, movie_.window);
    place_.assign(state.size(), not_shown);
    movie_.species_names = state.species_names;
    for (std::size_t n = 0; n < shown_.size(); ++n) {
      place_[shown_[n]] = n;
      movie_.shape.push_back(state.shape[shown_[n]]);
      movie_.species.push_back(state.species[shown_[n]]);
    }
    steps_.assign(shown_.size(), {});
  }

  void take_frame(const Configuration<Dim>& state) {
    movie_.time.push_back(state.time);
    movie_.box.push_back(state.box.lengths());
    for (std::size_t n = 0; n < shown_.size(); ++n) take_pose(state, n);
    if constexpr (Dim == 3) take_images(state);
  }

  void mark(const std::vector<PairImage<Dim>>& pairs) {
    std::set<std::size_t> overlapping;
    for (const PairImage<Dim>& pair : pairs) overlapping.insert({place_[pair.i], place_[pair.j]});
    overlapping.erase(not_shown);
    movie_.overlapping_pairs.push_back(pairs.size());
    movie_.overlapping.emplace_back(overlapping.begin(), overlapping.end());
  }

  void take_pose(const Configuration<Dim>& state, std::size_t n) {
    const std::size_t i = shown_[n];
    Shift<Dim> jump = Shift<Dim>::Zero();
    for (int axis = 0; axis < Dim; ++axis) {
      const double fraction = state.position[i][axis] / state.box.lengths()[axis] + 0.5;
      const std::int64_t step = std::llround(fraction * steps_per_turn) +
                                static_cast<std::int64_t>(state.image[i][axis]) * 65'536;
      const std::int64_t travelled = step - steps_[n][axis];
      const auto shortest = static_cast<std::int16_t>(travelled);
      jump[axis] = static_cast<int>((travelled - shortest) / 65'536);
      steps_[n][axis] = step;
      movie_.poses.push_back(static_cast<std::uint16_t>(step));
    }
    take_orientation(state, i, movie_.poses);
    if (limits_.images_known && movie_.frames() > 1 && !jump.isZero())
      movie_.jumps.push_back({movie_.frames() - 1, n, jump});
  }

  void take_images(const Configuration3& state) {
    movie_.images.emplace_back();
    for (const BodyInBox& body : shown_bodies(state, movie_.window))
      if (!body.shift.isZero() && place_[body.particle] != not_shown)
        movie_.images.back().push_back({place_[body.particle], body.shift});
  }

  Trajectory<Dim>& trajectory_;
  MovieLimits limits_;
  Movie<Dim> movie_;
  std::vector<std::size_t> frames_, shown_;
  std::vector<std::size_t> place_;  // index of every particle among the shown ones
  std::vector<std::array<std::int64_t, Dim>> steps_;  // unwrapped coordinates in the previous frame
};

Json rounded(const auto& numbers) {
  Json array = Json::array();
  for (const double number : numbers) array.push_back(page_number(number));
  return array;
}

/// The boxes of all frames, or a single box if it does not change.
Json boxes_data(const auto& boxes) {
  Json data = Json::array();
  for (const auto& box : boxes) data.push_back(rounded(box));
  if (std::equal(data.begin() + 1, data.end(), data.begin())) data = {data.front()};
  return data;
}

/// Adds "shapes", which lists all different semi-axes, and "shape", the index in it for every particle.
template <class Shape>
void add_shapes(Json& data, const std::vector<Shape>& bodies) {
  std::map<std::vector<double>, std::size_t> known;
  Json shapes = Json::array(), shape = Json::array();
  for (const Shape& body : bodies) {
    const auto axes = body.half_lengths();
    const auto [place, added] =
        known.emplace(std::vector<double>(axes.begin(), axes.end()), known.size());
    if (added) shapes.push_back(rounded(axes));
    shape.push_back(place->second);
  }
  data["shapes"] = std::move(shapes);
  data["shape"] = std::move(shape);
}

/// Lists the frame, particle and shift of each jump.
template <int Dim>
Json jumps_data(const Movie<Dim>& movie) {
  Json data = Json::array();
  for (const auto& jump : movie.jumps) {
    Json& numbers = data.emplace_back(Json{jump.frame, jump.particle});
    for (const std::int32_t boxes : jump.shift) numbers.push_back(boxes);
  }
  return data;
}

/// Lists, for every frame, the particle and shift of each image, one after another.
Json images_data(const Movie3& movie) {
  Json data = Json::array();
  for (const std::vector<Movie3::Image>& images : movie.images) {
    Json& numbers = data.emplace_back(Json::array());
    for (const Movie3::Image& image : images) {
      numbers.push_back(image.particle);
      for (const std::int32_t boxes : image.shift) numbers.push_back(boxes);
    }
  }
  return data;
}

template <int Dim>
Json data_of(const Movie<Dim>& movie) {
  if (movie.particles() == 0) return nullptr;
  Json data = {{"runParticles", movie.run_particles},
               {"runFrames", movie.run_frames},
               {"particles", movie.particles()},
               {"window", rounded(movie.window)},
               {"time", rounded(movie.time)},
               {"box", boxes_data(movie.box)},
               {"speciesNames", movie.species_names},
               {"poses", base64(std::as_bytes(std::span(movie.poses)))},
               {"jumps", jumps_data(movie)},
               {"overlappingPairs", movie.overlapping_pairs},
               {"overlapping", movie.overlapping}};
  if constexpr (Dim == 3) data["images"] = images_data(movie);
  add_shapes(data, movie.shape);
  if (movie.species_names.size() > 1) data["species"] = movie.species;
  return data;
}

}  // namespace

template <int Dim>
Movie<Dim> film(Trajectory<Dim>& trajectory, const MovieLimits& limits) {
  Camera<Dim> camera(trajectory, limits);
  const std::size_t per_frame = std::max<std::size_t>(1, characters(camera.take(1)));
  std::size_t wanted = std::min(limits.frames, limits.characters / per_frame);
  const auto fits = [&](const Movie<Dim>& movie) {
    return 10 * characters(movie) <= 11 * limits.characters;
  };
  while (wanted > 1 && !fits(camera.take(wanted))) wanted /= 2;
  if (wanted == 1) camera.take(1);
  return camera.checked();
}

template Movie2 film(Trajectory2&, const MovieLimits&);
template Movie3 film(Trajectory3&, const MovieLimits&);

Json movie_data(const AnyMovie& movie) {
  return std::visit([](const auto& any) { return data_of(any); }, movie);
}

}  // namespace vitrel
