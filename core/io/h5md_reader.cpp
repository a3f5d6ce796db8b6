#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "core/elementary.h"
#include "core/error.h"
#include "core/io/box_crossings.h"
#include "core/io/foreign/foreign_file.h"
#include "core/io/h5md.h"
#include "core/state/bounds.h"
#include "core/tolerances.h"

namespace vitrel {
namespace fs = std::filesystem;

TrajectoryReader::TrajectoryReader(const fs::path& path, const KnownSystem& known)
    : path_(path), import_(open_as_h5md(path, known)) {
  consistently([this] { read_what_frames_share(); });
  if (import_.file.is_being_written()) report_progress();
}

/// Returns the result of `read`, which sees the content of one commit (h5::read_consistently). A call within another
/// such reading is a part of that reading, which begins again as a whole.
template <class Read>
std::invoke_result_t<Read> TrajectoryReader::consistently(Read&& read) const {
  if (is_reading_) return read();
  struct Reading {
    bool& is_reading;
    explicit Reading(bool& flag) : is_reading(flag) { is_reading = true; }
    ~Reading() { is_reading = false; }
  };
  const Reading reading(is_reading_);
  return h5::read_consistently(
      import_.file,
      [&] {
        if (!root_) root_ = import_.file.root();
        return read();
      },
      [this] {
        datasets_.clear();
        blocks_.clear();
        root_.reset();
      });
}

void TrajectoryReader::report_progress() {
  std::string text = "another process is writing it; it has no whole frame yet";
  if (frames() > 0)
    text = fmt::format("another process is writing it; read up to the time {:.10g} ({} {})",
                       times_.back(), frames(), frames() == 1 ? "frame" : "frames");
  import_.report.emplace_back(in_progress, text);
}

std::size_t TrajectoryReader::particles() const {
  return std::visit([](const auto& fixed) { return fixed.size(); }, fixed_);
}

const std::vector<std::string>& TrajectoryReader::species_names() const {
  return std::visit(
      [](const auto& fixed) -> const auto& { return fixed.species_names; }, fixed_);
}

void TrajectoryReader::require_dimension(int wanted) const {
  if (dimension() != wanted)
    fail(fmt::format("is {}-dimensional, but what is asked of it is there for {} dimensions only",
                     dimension() == 2 ? "two" : "three", wanted == 2 ? "two" : "three"));
}

void TrajectoryReader::fail(const std::string& what) const {
  throw FileError(path_.string() + ": " + what);
}

const h5::Dataset& TrajectoryReader::dataset(const std::string& name,
                                             const std::string& meaning) const {
  const auto open = datasets_.find(name);
  if (open != datasets_.end()) return open->second;
  if (!has_dataset(name)) fail("the dataset " + name + " is missing: it should hold " + meaning);
  return datasets_.emplace(name, root_->dataset(name)).first->second;
}

template <int Dim>
Configuration<Dim> TrajectoryReader::read(std::uint64_t frame) const {
  Configuration<Dim> configuration;
  read(frame, configuration);
  return configuration;
}

template <int Dim>
void TrajectoryReader::read(std::uint64_t frame, Configuration<Dim>& configuration) const {
  consistently([&] {
    read_places(frame, configuration);
    read_velocities(frame, configuration);
    read_close_pairs(frame, configuration);
  });
}

template <int Dim>
void TrajectoryReader::read_places(std::uint64_t frame, Configuration<Dim>& configuration) const {
  require_dimension(Dim);
  if (frame >= frames())
    fail("there is no frame " + std::to_string(frame) + ": it has " + std::to_string(frames()) +
         ", counted from 0");
  if (configuration.size() != particles()) configuration = std::get<Configuration<Dim>>(fixed_);
  consistently([&] {
    configuration.time = times_[frame];
    read_box(frame, configuration);
    read_positions(frame, configuration);
    read_orientations(frame, configuration);
  });
}

bool TrajectoryReader::has_dataset(const std::string& name) const {
  const auto known = present_.find(name);
  if (known != present_.end()) return known->second;
  return present_.emplace(name, root_->has_dataset(name)).first->second;
}

const h5::Dataset& TrajectoryReader::element(const std::string& name,
                                             const std::string& meaning) const {
  const h5::Dataset& values = dataset(group_ + '/' + name + "/value", meaning);
  const h5::Shape shape = values.shape();
  if (shape.size() < 2 || shape.size() > 3 || shape[1] != particles())
    fail(fmt::format("the dataset {} should have the shape frames × {} particles × numbers",
                     values.name(), particles()));
  return values;
}

/// Reads the frames of the chunk that holds `frame`, and requires their numbers to be finite.
void TrajectoryReader::load(Block& block, const h5::Dataset& values, std::uint64_t frame) const {
  constexpr std::uint64_t most_numbers = std::uint64_t{1}
                                         << 22;  // limit in memory for chunks of other programs
  const h5::Shape shape = values.shape();
  if (shape.at(0) < frames()) fail("the dataset " + values.name() + " has fewer frames than step");
  block.frames = 0;
  block.numbers =
      std::accumulate(shape.begin() + 1, shape.end(), std::size_t{1}, std::multiplies());
  const std::uint64_t most = most_numbers / std::max<std::size_t>(1, block.numbers) + 1;
  const std::uint64_t together = std::min(values.frames_per_chunk(), most);
  block.first = frame / together * together;
  const std::uint64_t count = std::min(together, frames() - block.first);
  block.values = {};  // freed first, so that there are never two
  block.values = values.read_frames<double>(block.first, count, block.numbers);
  const auto strange =
      std::ranges::find_if_not(block.values, [](double x) { return std::isfinite(x); });
  if (strange != block.values.end())
    fail("the dataset " + values.name() + " has numbers that are not finite in frame " +
         std::to_string(block.first +
                        static_cast<std::size_t>(strange - block.values.begin()) / block.numbers));
  block.frames = count;
}

/// Returns the block that holds the frame. `open` checks and returns the dataset; it is called only if the frame is not
/// in memory.
template <class Open>
const TrajectoryReader::Block& TrajectoryReader::block_with(const std::string& name,
                                                            std::uint64_t frame,
                                                            Open&& open) const {
  Block& block = blocks_[name];
  if (frame < block.first || frame >= block.first + block.frames) load(block, open(), frame);
  return block;
}

/// Returns the rows of an element, which must have at least `numbers` numbers per particle.
TrajectoryReader::Rows TrajectoryReader::rows(const std::string& name, const std::string& meaning,
                                              std::uint64_t frame, std::size_t numbers) const {
  const Block& block = block_with(name, frame, [&]() -> const h5::Dataset& {
    const h5::Dataset& values = element(name, meaning);
    const h5::Shape shape = values.shape();
    if ((shape.size() == 3 ? shape.back() : 1) < numbers)
      fail("the dataset " + values.name() + " should have " + std::to_string(numbers) +
           " numbers per particle");
    return values;
  });
  if (particles() == 0) return {};
  return {block.at(frame), block.numbers / particles()};
}

template <int Dim>
void TrajectoryReader::read_box(std::uint64_t frame, Configuration<Dim>& configuration) const {
  const Block& block = block_with("box/edges", frame, [&]() -> const h5::Dataset& {
    const h5::Dataset& edges = dataset(group_ + "/box/edges/value", "the box lengths");
    const h5::Shape shape = edges.shape();
    if (shape.size() != 3 || shape[1] != 3 || shape[2] != 3)
      fail("the dataset " + edges.name() + " should hold three cell vectors per frame");
    return edges;
  });
  Vec<Dim> lengths;
  for (std::size_t k = 0; k < Dim; ++k) lengths[k] = block.at(frame)[4 * k];
  if (lengths.minCoeff() <= 0)
    fail(fmt::format("the box of frame {} is {}, but its edges should be finite and above 0", frame,
                     fmt::join(lengths, " × ")));
  configuration.box = PeriodicBox<Dim>(lengths);
  require_room(frame, configuration);
}

/// Throws FileError for boxes and semi-axes with which a search for pairs would not come to an end.
template <int Dim>
void TrajectoryReader::require_room(std::uint64_t frame,
                                    const Configuration<Dim>& configuration) const {
  constexpr double max_proportion = 1e6;  // largest ratio of the sides
  const Vec<Dim>& lengths = configuration.box.lengths();
  if (!(lengths.maxCoeff() <= max_proportion * lengths.minCoeff()))
    fail(
        fmt::format("in frame {} the box is {}; its sides should not differ by more than a factor "
                    "of {:g}",
                    frame, fmt::join(lengths, " × "), max_proportion));
  const double longest = largest_circumradius(configuration);
  const double fraction = packing_fraction(configuration);
  if (!(longest <= tolerance::max_box_lengths * lengths.minCoeff()))
    fail(
        fmt::format("in frame {} the longest semi-axis is {}, and the box {}; it should not exceed "
                    "{} box lengths",
                    frame, longest, fmt::join(lengths, " × "), tolerance::max_box_lengths));
  if (configuration.size() > 0 && !bounds::packing_fraction.contains(fraction))
    fail(fmt::format("in frame {} the packing fraction is {}, but {}; box or semi-axes are wrong",
                     frame, fraction, requirement(bounds::packing_fraction, fraction)));
  if (!(fraction <= tolerance::densest))
    fail(
        fmt::format("in frame {} the particles would fill the box {:.4g} times; box or semi-axes "
                    "are wrong",
                    frame, fraction));
}

template <int Dim>
void TrajectoryReader::require_near_box(std::uint64_t frame, std::size_t i,
                                        const Configuration<Dim>& configuration) const {
  const Vec<Dim>& position = configuration.position[i];
  const Vec<Dim> boxes = position.cwiseQuotient(configuration.box.lengths());
  if (!(boxes.cwiseAbs().maxCoeff() <= max_box_crossings))
    fail(fmt::format("in frame {} particle {} is at {}, but should be near the box", frame, i,
                     fmt::join(position, ", ")));
}

template <int Dim>
void TrajectoryReader::read_positions(std::uint64_t frame,
                                      Configuration<Dim>& configuration) const {
  const Rows positions = rows("position", "the coordinates", frame, 3);
  const bool has_images = has("image");
  const Rows images = has_images ? rows("image", "the box crossings", frame, Dim) : Rows{};
  for (std::size_t i = 0; i < particles(); ++i) {
    if (Dim == 2 && positions[i][2] != 0)
      fail("particle " + std::to_string(i) + " has z ≠ 0, but the system is two-dimensional");
    configuration.position[i] = Vec<Dim>(positions[i]);
    require_near_box(frame, i, configuration);
    std::optional<Shift<Dim>> image = Shift<Dim>(Shift<Dim>::Zero());
    if (has_images) image = box_crossings<Dim>(Vec<Dim>(images[i]));
    if (!image)
      fail("the dataset " + group_ + "/image/value has impossible numbers in frame " +
           std::to_string(frame));
    configuration.image[i] = *image;
    configuration.box.wrap_if_outside(configuration.position[i], configuration.image[i]);
  }
}

/// Returns whether the file has no orientations and needs none, because all particles are round.
template <int Dim>
bool TrajectoryReader::has_no_orientations(const Configuration<Dim>& configuration) const {
  return !has("angle") && !has("orientation") && rotor_count(configuration) == 0;
}

void TrajectoryReader::read_orientations(std::uint64_t frame, Configuration2& configuration) const {
  if (has_no_orientations(configuration)) return;
  if (has("angle") || !has("orientation")) {
    const Rows angles = rows("angle", "the angle of every particle in radians", frame, 1);
    for (std::size_t i = 0; i < particles(); ++i) configuration.angle[i] = *angles[i];
    return;
  }
  const Rows quaternions = rows("orientation", "quaternions", frame, 4);
  for (std::size_t i = 0; i < particles(); ++i) {
    const double* q = quaternions[i];
    if (q[1] != 0 || q[2] != 0)
      fail("particle " + std::to_string(i) +
           " is turned out of the plane, but the system is two-dimensional");
    configuration.angle[i] = 2 * polar_angle(q[3], q[0]);
  }
}

void TrajectoryReader::read_orientations(std::uint64_t frame, Configuration3& configuration) const {
  if (has_no_orientations(configuration)) return;
  const Rows quaternions = rows("orientation", "quaternions", frame, 4);
  for (std::size_t i = 0; i < particles(); ++i) {
    const double* q = quaternions[i];
    try {
      configuration.orientation[i] = unit_quaternion(Quaternion(q[0], q[1], q[2], q[3]), i);
    } catch (const UserError& error) {
      fail(error.what());
    }
  }
}

template <int Dim>
void TrajectoryReader::read_velocities(std::uint64_t frame,
                                       Configuration<Dim>& configuration) const {
  if (has("velocity")) {
    const Rows v = rows("velocity", "the velocities", frame, Dim);
    for (std::size_t i = 0; i < particles(); ++i) configuration.velocity[i] = Vec<Dim>(v[i]);
  }
  if (!has("angular_velocity")) return;
  const Rows w = rows("angular_velocity", "the angular velocities", frame, Dim == 2 ? 1 : 3);
  for (std::size_t i = 0; i < particles(); ++i) {
    if constexpr (Dim == 2)
      configuration.angular_velocity[i] = w[i][w.numbers - 1];  // about z, the last of three
    else
      configuration.angular_velocity[i] = Vec3(w[i]);
  }
}

template <int Dim>
void TrajectoryReader::read_close_pairs(std::uint64_t frame,
                                        Configuration<Dim>& configuration) const {
  const std::string group = group_ + "/close_pairs/";
  if (!has_dataset(group + "end")) return;
  const auto column = [&](const char* name) -> const h5::Dataset& {
    return dataset(group + name, "the close pairs of every frame");
  };
  configuration.close_pairs.clear();
  const auto end = [&](std::uint64_t at) {
    return column("end").template read_frames<std::int64_t>(at, 1, 1).front();
  };
  const std::int64_t first = frame > 0 ? end(frame - 1) : 0, last = end(frame);
  if (first < 0 || last < first)
    fail(
        fmt::format("{}end should count the pairs up to the end of every frame, but goes from {} "
                    "to {} in frame {}",
                    group, first, last, frame));
  if (last == first) return;
  const auto begin = static_cast<std::uint64_t>(first),
             count = static_cast<std::uint64_t>(last - first);
  const auto pairs = column("pair").template read_frames<std::int64_t>(begin, count, 2);
  const auto lags = column("lag").template read_frames<std::int32_t>(begin, count, 3);
  const auto distances = column("distance").template read_frames<double>(begin, count, 1);
  for (std::size_t k = 0; k < count; ++k) {
    const std::int64_t* const pair = &pairs[2 * k];
    const auto n = static_cast<std::int64_t>(particles());
    if (pair[0] < 0 || pair[0] > pair[1] || pair[1] >= n || !(distances[k] > 0))
      fail(
          fmt::format("row {} of {}pair should be two particles, i ≤ j < {}, at a distance above 0",
                      begin + k, group, n));
    const auto i = static_cast<std::size_t>(pair[0]), j = static_cast<std::size_t>(pair[1]);
    Shift<Dim> shift;
    for (int axis = 0; axis < Dim; ++axis) {
      const std::int64_t boxes = std::int64_t{lags[3 * k + static_cast<std::size_t>(axis)]} -
                                 configuration.image[i][axis] + configuration.image[j][axis];
      if (static_cast<double>(std::abs(boxes)) > 2 * tolerance::max_box_lengths)
        fail(fmt::format("row {} of {}lag should be the shift between two particles that are close",
                         begin + k, group));
      shift[axis] = static_cast<std::int32_t>(boxes);
    }
    configuration.close_pairs.push_back({{i, j, shift}, distances[k]});
  }
}

bool TrajectoryReader::has_single_precision() const {
  return consistently([this] {
    return element("position", "the coordinates").bytes_per_number() == sizeof(float);
  });
}

bool TrajectoryReader::has(const std::string& name) const {
  return consistently([&] { return has_dataset(group_ + '/' + name + "/value"); });
}

/// Returns the first frame whose box is not that of frame 0, or the number of frames.
std::uint64_t TrajectoryReader::first_other_box() const {
  const h5::Dataset& edges = dataset(group_ + "/box/edges/value", "the box lengths");
  const h5::Shape shape = edges.shape();
  if (shape.empty() || shape[0] < frames())
    fail("the dataset " + edges.name() + " has fewer frames than step");
  const std::vector<double> values = edges.read<double>();
  const std::size_t numbers = values.size() / shape[0];
  for (std::size_t k = numbers; k < frames() * numbers; ++k)
    if (values[k] != values[k % numbers]) return k / numbers;
  return frames();
}

std::string TrajectoryReader::obstacle_to_motion() const {
  if (frames() < 2) return "a single frame";
  if (!has("image"))
    return fmt::format(
        "box crossings are unknown: it has no {}; if no particle moves by more than half a box "
        "length between frames, import.unwrap = \"nearest\" counts them",
        import_.box_crossings);
  for (std::size_t k = 1; k < times_.size(); ++k)
    if (!(times_[k] > times_[k - 1]))
      return fmt::format(
          "frame {} has the time {}, which is not above that of the frame before, {}", k, times_[k],
          times_[k - 1]);
  if (const auto frame = consistently([this] { return first_other_box(); }); frame < frames())
    return fmt::format("the box of frame {} differs from that of the first", frame);
  return "";
}

std::vector<std::string> TrajectoryReader::observable_names() const {
  return consistently([this] {
    return root_->has_group("observables") ? root_->group("observables").members()
                                           : std::vector<std::string>();
  });
}

bool TrajectoryReader::has_observable(const std::string& name) const {
  const std::vector<std::string> names = observable_names();
  return std::ranges::find(names, name) != names.end();
}

std::vector<double> TrajectoryReader::observable(const std::string& name) const {
  return consistently([&] {
    const h5::Dataset& values = dataset("observables/" + name + "/value", "one number per frame");
    std::vector<double> numbers = values.read<double>();
    if (values.shape().size() != 1 || numbers.size() < frames())
      fail("the dataset " + values.name() + " should have one number per frame, " +
           std::to_string(frames()));
    numbers.resize(frames());
    return numbers;
  });
}

Provenance TrajectoryReader::provenance() const {
  return consistently([this] {
    return root_->has_group("parameters") ? read_provenance(root_->group("parameters"))
                                          : Provenance();
  });
}

template <int Dim>
Configuration<Dim> read_state(const TrajectoryReader& reader) {
  if (reader.frames() == 0)
    throw FileError(reader.path().string() +
                    ": has no frames: a state is the last frame of a trajectory");
  return reader.read<Dim>(reader.frames() - 1);
}

template <int Dim>
Configuration<Dim> read_state(const fs::path& path) {
  return read_state<Dim>(TrajectoryReader(path));
}

template Configuration2 TrajectoryReader::read(std::uint64_t) const;
template Configuration3 TrajectoryReader::read(std::uint64_t) const;
template void TrajectoryReader::read(std::uint64_t, Configuration2&) const;
template void TrajectoryReader::read(std::uint64_t, Configuration3&) const;
template void TrajectoryReader::read_places(std::uint64_t, Configuration2&) const;
template void TrajectoryReader::read_places(std::uint64_t, Configuration3&) const;
template Configuration2 read_state<2>(const TrajectoryReader&);
template Configuration3 read_state<3>(const TrajectoryReader&);
template Configuration2 read_state<2>(const fs::path&);
template Configuration3 read_state<3>(const fs::path&);

}  // namespace vitrel
