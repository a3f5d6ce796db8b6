#include "core/io/h5md.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/io/atomic_file.h"

namespace vitrel {
namespace fs = std::filesystem;
namespace {

const std::string all = "particles/all";
/// The z edge of the box of a two-dimensional system, which means nothing but must not be 0.
constexpr double height = 1;
/// How far norms may be from 1: quaternions kept in single precision, and those of this program.
constexpr double single_precision = 1e-6, double_precision = 1e-14;

std::string series_path(const std::string& element) {
  return all + '/' + element + "/value";
}

/// A series `element`/{step, time, value} that shares the position's step and time.
template <class T>
void create_element(h5::Group& parent, const std::string& element, const h5::Shape& frame_shape,
                    bool packed) {
  h5::Group group = parent.create_group(element);
  group.create_series<T>("value", frame_shape, packed);
  group.link("step", all + "/position/step");
  group.link("time", all + "/position/time");
}

void create_position(h5::Group& particles, std::uint64_t n) {
  h5::Group position = particles.create_group("position");
  position.create_series<std::int64_t>("step", {}, false);
  position.create_series<double>("time", {}, false);
  position.create_series<double>("value", {n, 3}, true);
}

void create_box(h5::Group& particles, int dimension) {
  h5::Group box = particles.create_group("box");
  box.set_attribute("dimension", std::int32_t{3});
  const std::array<std::string, 3> boundary{"periodic", "periodic",
                                            dimension == 3 ? "periodic" : "none"};
  box.set_attribute("boundary", boundary, 8);
  create_element<double>(box, "edges", {3, 3}, false);
}

/// Adds the components of a vector, as three: in two dimensions the last is 0.
template <class T, int Dim>
void append(std::vector<T>& row, const Eigen::Matrix<T, Dim, 1>& vector) {
  row.insert(row.end(), vector.data(), vector.data() + Dim);
  row.insert(row.end(), 3 - Dim, T{0});
}
void append(std::vector<double>& row, double angular_velocity) {
  append(row, Vec3(0, 0, angular_velocity));
}
void append(std::vector<double>& row, const Ellipse& shape) {
  append(row, Vec2(shape.a, shape.b));
}
void append(std::vector<double>& row, const Ellipsoid& shape) {
  append(row, shape.semi_axes);
}
void append(std::vector<double>& row, const Quaternion& q) {
  row.insert(row.end(), {q.w(), q.x(), q.y(), q.z()});
}

Quaternion orientation(const Configuration2& configuration, std::size_t i) {
  const double half = 0.5 * configuration.angle[i];
  return {std::cos(half), 0, 0, std::sin(half)};
}
Quaternion orientation(const Configuration3& configuration, std::size_t i) {
  return configuration.orientation[i];
}

void create_close_pairs(h5::Group& particles) {
  h5::Group pairs = particles.create_group("close_pairs");
  pairs.create_series<std::int64_t>("end", {}, false);
  pairs.create_series<std::int64_t>("pair", {2}, false);
  pairs.create_series<std::int32_t>("lag", {3}, false);
  pairs.create_series<double>("distance", {}, false);
}

template <int Dim>
void create_fixed_arrays(h5::Group& particles, const Configuration<Dim>& configuration) {
  const std::uint64_t n = configuration.size();
  std::vector<std::int64_t> id(n);
  std::iota(id.begin(), id.end(), 0);
  std::vector<double> semiaxes;
  for (const Solid<Dim>& shape : configuration.shape) append(semiaxes, shape);
  particles.create_enumeration("species", configuration.species_names, configuration.species);
  particles.create_array<std::int64_t>("id", {n}, id);
  particles.create_array<double>("mass", {n}, configuration.mass);
  particles.create_array<double>("semiaxes", {n, 3}, semiaxes);
}

void create_h5md_group(h5::Group& root, const Provenance& provenance) {
  h5::Group h5md = root.create_group("h5md");
  const std::array<std::int32_t, 2> version{1, 1};
  h5md.set_attribute<std::int32_t>("version", version);
  h5md.create_group("author").set_attribute("name", provenance.author);
  h5::Group creator = h5md.create_group("creator");
  creator.set_attribute("name", std::string("vitrel"));
  creator.set_attribute("version", provenance.version);
}

/// Everything but the frames.
template <int Dim>
h5::File create_layout(const fs::path& path, const Configuration<Dim>& configuration,
                       Provenance provenance, const TrajectoryOptions& options) {
  provenance.dimension = Dim;
  const std::uint64_t n = configuration.size();
  h5::File file = h5::File::create(path);
  h5::Group root = file.root();
  create_h5md_group(root, provenance);
  h5::Group particles = root.create_group("particles").create_group("all");
  create_position(particles, n);
  create_box(particles, Dim);
  create_element<std::int32_t>(particles, "image", {n, 3}, true);
  create_element<double>(particles, "orientation", {n, 4}, true);
  if (Dim == 2) create_element<double>(particles, "angle", {n}, true);
  if (options.velocities) {
    create_element<double>(particles, "velocity", {n, 3}, true);
    create_element<double>(particles, "angular_velocity", {n, 3}, true);
  }
  if (options.close_pairs) create_close_pairs(particles);
  create_fixed_arrays(particles, configuration);
  h5::Group observables = root.create_group("observables");
  for (const std::string& name : options.observables)
    create_element<double>(observables, name, {}, false);
  h5::Group parameters = root.create_group("parameters");
  write_provenance(parameters, provenance);
  return file;
}

void refuse_existing(const fs::path& path, bool overwrite) {
  if (!overwrite && fs::exists(path))
    throw UserError(path.string() + ": the file exists already: choose another name or remove it");
}

h5::Dataset required(const h5::File& file, const std::string& name) {
  const h5::Group root = file.root();
  if (!root.has_dataset(name))
    throw FileError(file.path() + ": the dataset " + name +
                    " is missing: only a trajectory that vitrel wrote can be continued");
  return root.dataset(name);
}

std::optional<h5::Dataset> optional_dataset(const h5::File& file, const std::string& name) {
  const h5::Group root = file.root();
  if (!root.has_dataset(name)) return std::nullopt;
  return root.dataset(name);
}

/// Positions inside the box stay bit-identical.
template <int Dim>
void wrap_if_outside(const PeriodicBox<Dim>& box, Vec<Dim>& position, Shift<Dim>& image) {
  const Vec<Dim> half = 0.5 * box.lengths();
  const bool inside =
      (position.array() >= -half.array()).all() && (position.array() < half.array()).all();
  if (!inside) box.wrap(position, image);
}

}  // namespace

template <int Dim>
TrajectoryWriter TrajectoryWriter::create(const fs::path& path,
                                          const Configuration<Dim>& configuration,
                                          const Provenance& provenance,
                                          const TrajectoryOptions& options) {
  refuse_existing(path, options.overwrite);
  AtomicFile pending(path);
  create_layout(pending.partial(), configuration, provenance, options).close();
  pending.commit();
  return append_to(path, 0);
}

TrajectoryWriter TrajectoryWriter::append_to(const fs::path& path, std::uint64_t frames_to_keep) {
  TrajectoryWriter writer(h5::File::open(path, h5::Access::write));
  if (writer.frames_ < frames_to_keep)
    throw FileError(path.string() + ": has only " + std::to_string(writer.frames_) +
                    " frames where " + std::to_string(frames_to_keep) +
                    " were expected: it is not the file that the checkpoint belongs to");
  writer.resize(frames_to_keep);
  if (writer.close_pairs_) writer.close_pairs_->keep(frames_to_keep);
  writer.file_.flush();
  writer.frames_ = frames_to_keep;
  return writer;
}

TrajectoryWriter::TrajectoryWriter(h5::File file)
    : file_(std::move(file)),
      step_(required(file_, all + "/position/step")),
      time_(required(file_, all + "/position/time")),
      edges_(required(file_, all + "/box/edges/value")),
      position_(required(file_, series_path("position"))),
      image_(required(file_, series_path("image"))),
      orientation_(required(file_, series_path("orientation"))),
      angle_(optional_dataset(file_, series_path("angle"))),
      velocity_(optional_dataset(file_, series_path("velocity"))),
      angular_velocity_(optional_dataset(file_, series_path("angular_velocity"))) {
  particles_ = position_.shape().at(1);
  frames_ = step_.shape().at(0);
  if (const std::string pairs = all + "/close_pairs"; file_.root().has_group(pairs))
    close_pairs_ = {required(file_, pairs + "/end"), required(file_, pairs + "/pair"),
                    required(file_, pairs + "/lag"), required(file_, pairs + "/distance")};
  if (!file_.root().has_group("observables")) return;
  for (const std::string& name : file_.root().group("observables").members())
    observables_.emplace(name, required(file_, "observables/" + name + "/value"));
}

std::vector<std::string> TrajectoryWriter::observable_names() const {
  std::vector<std::string> names;
  for (const auto& [name, dataset] : observables_) names.push_back(name);
  return names;
}

template <int Dim>
void TrajectoryWriter::check(const Configuration<Dim>& configuration,
                             const Observables& observables) const {
  if (angle_.has_value() != (Dim == 2))
    throw UserError(
        fmt::format("{}: holds frames of the other dimension than {}, the one of the "
                    "configuration to be added",
                    file_.path(), Dim));
  if (configuration.size() != particles_)
    throw UserError(file_.path() + ": holds " + std::to_string(particles_) +
                    " particles, but the configuration to be added has " +
                    std::to_string(configuration.size()));
  const bool same =
      std::equal(observables.begin(), observables.end(), observables_.begin(), observables_.end(),
                 [](const auto& x, const auto& y) { return x.first == y.first; });
  if (same) return;
  std::string names;
  for (const std::string& name : observable_names()) names += ' ' + name;
  throw UserError(file_.path() + ": every frame needs exactly these observables:" + names);
}

void TrajectoryWriter::resize(std::uint64_t frames) {
  for (h5::Dataset* dataset : {&step_, &time_, &edges_, &position_, &image_, &orientation_})
    dataset->resize(frames);
  for (std::optional<h5::Dataset>* dataset : {&angle_, &velocity_, &angular_velocity_})
    if (*dataset) (*dataset)->resize(frames);
  for (auto& [name, dataset] : observables_) dataset.resize(frames);
  if (close_pairs_) close_pairs_->end.resize(frames);
}

void TrajectoryWriter::ClosePairs::resize(std::int64_t new_rows) {
  rows = new_rows;
  for (h5::Dataset* dataset : {&pair, &lag, &distance})
    dataset->resize(static_cast<std::uint64_t>(rows));
}

void TrajectoryWriter::ClosePairs::keep(std::uint64_t frames) {
  std::int64_t last = 0;
  if (frames > 0) end.read_frame<std::int64_t>(frames - 1, {&last, 1});
  resize(last);
}

template <int Dim>
void TrajectoryWriter::write(const Configuration<Dim>& configuration, std::int64_t step,
                             const Observables& observables) {
  check(configuration, observables);
  resize(frames_ + 1);
  write_particles(configuration);
  if (close_pairs_) close_pairs_->write(frames_, configuration);
  step_.write_frame<std::int64_t>(frames_, {&step, 1});
  time_.write_frame<double>(frames_, {&configuration.time, 1});
  const Vec<Dim>& lengths = configuration.box.lengths();
  const double z = Dim == 3 ? lengths[Dim - 1] : height;
  const std::array<double, 9> edges{lengths.x(), 0, 0, 0, lengths.y(), 0, 0, 0, z};
  edges_.write_frame<double>(frames_, edges);
  for (const auto& [name, value] : observables)
    observables_.at(name).template write_frame<double>(frames_, {&value, 1});
  file_.flush();
  ++frames_;
}

template <int Dim>
void TrajectoryWriter::write_particles(const Configuration<Dim>& configuration) {
  std::vector<double> positions, orientations, velocities, angular_velocities;
  std::vector<std::int32_t> images;
  const std::vector<Vec<Dim>> velocities_after = velocities_after_contact(configuration);
  for (std::size_t i = 0; i < particles_; ++i) {
    Vec<Dim> position = configuration.position[i];
    Shift<Dim> image = configuration.image[i];
    wrap_if_outside(configuration.box, position, image);
    append(positions, position);
    append(images, image);
    append(orientations, orientation(configuration, i));
    append(velocities, velocities_after[i]);
    append(angular_velocities, configuration.angular_velocity[i]);
  }
  position_.write_frame<double>(frames_, positions);
  image_.write_frame<std::int32_t>(frames_, images);
  orientation_.write_frame<double>(frames_, orientations);
  if constexpr (Dim == 2) angle_->write_frame<double>(frames_, configuration.angle);
  if (velocity_) velocity_->write_frame<double>(frames_, velocities);
  if (angular_velocity_) angular_velocity_->write_frame<double>(frames_, angular_velocities);
}

template <int Dim>
void TrajectoryWriter::ClosePairs::write(std::uint64_t frame,
                                         const Configuration<Dim>& configuration) {
  auto row = static_cast<std::uint64_t>(rows);
  resize(rows + static_cast<std::int64_t>(configuration.close_pairs.size()));
  for (const auto& [images, closest] : configuration.close_pairs) {
    const auto& [i, j, shift] = images;
    const std::array particles{static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)};
    std::vector<std::int32_t> between;
    append<std::int32_t, Dim>(between, shift + configuration.image[i] - configuration.image[j]);
    pair.write_frame<std::int64_t>(row, particles);
    lag.write_frame<std::int32_t>(row, between);
    distance.write_frame<double>(row, {&closest, 1});
    ++row;
  }
  end.write_frame<std::int64_t>(frame, {&rows, 1});
}

void TrajectoryWriter::record_wall_seconds(double seconds) {
  h5::Group parameters = file_.root().group("parameters");
  parameters.set_attribute("wall_seconds", seconds);
  file_.flush();
}

TrajectoryReader::TrajectoryReader(const fs::path& path)
    : path_(path), file_(h5::File::open(path, h5::Access::read)), root_(file_.root()) {
  if (!root_.has_group("particles")) fail("there is no group particles: it is not an H5MD file");
  const std::vector<std::string> groups = root_.group("particles").members();
  if (groups.empty()) fail("the group particles is empty: it should hold one group of particles");
  const bool has_all = std::find(groups.begin(), groups.end(), "all") != groups.end();
  group_ = "particles/" + (has_all ? "all" : groups.front());
  read_shapes();
  std::visit([this](auto& fixed) { read_masses_and_species(fixed); }, fixed_);
  read_axes();
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
  if (!root_.has_dataset(name))
    fail("the dataset " + name + " is missing: it should hold " + meaning);
  return datasets_.emplace(name, root_.dataset(name)).first->second;
}

/// Frames are counted by `step`, the last thing written of a frame; a single number is the
/// increment.
void TrajectoryReader::read_axes() {
  const h5::Dataset& position =
      dataset(group_ + "/position/value", "the positions, one frame after another");
  const h5::Dataset& step = dataset(group_ + "/position/step", "the step of every frame");
  const h5::Dataset& time = dataset(group_ + "/position/time", "the time of every frame");
  const h5::Shape shape = position.shape();
  if (shape.size() != 3 || shape[1] != particles())
    fail("the dataset " + position.name() + " should have the shape frames × " +
         std::to_string(particles()) + " particles × directions");
  const auto axis = [&](const h5::Dataset& values) {
    std::vector<double> numbers = values.read<double>();
    if (!values.shape().empty()) return numbers;
    const double increment = numbers.at(0);
    const double offset =
        values.has_attribute("offset") ? values.number_attribute<double>("offset") : 0;
    numbers.resize(shape[0]);
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = offset + increment * k;
    return numbers;
  };
  for (const double number : axis(step)) steps_.push_back(std::llround(number));
  times_ = axis(time);
  if (times_.size() < steps_.size() || shape[0] < steps_.size())
    fail("the datasets time and value of " + group_ + "/position have fewer frames than step");
  times_.resize(steps_.size());
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const bool ascends = k == 0 || times_[k] > times_[k - 1];
    const bool is_finite = std::isfinite(times_[k]);
    if (is_finite && ascends) continue;
    const std::string right = is_finite
                                  ? fmt::format("above that of the frame before, {}", times_[k - 1])
                                  : "a finite number";
    fail(fmt::format("the time of frame {} (dataset {}/position/time) is {}, but should be {}", k,
                     group_, times_[k], right));
  }
}

void TrajectoryReader::read_shapes() {
  const h5::Dataset& semiaxes =
      dataset(group_ + "/semiaxes", "the semi-axes a ≥ b of every particle");
  const h5::Shape shape = semiaxes.shape();
  if (shape.size() != 2 || shape[1] < 2 || shape[1] > 3)
    fail("the dataset " + semiaxes.name() + " should have the shape particles × 3");
  const std::vector<double> values = semiaxes.read<double>();
  const bool has_third = shape[1] == 3 && !values.empty() && values[2] != 0;
  const std::optional<int> stated = stated_dimension();
  if (stated && *stated != 2 && *stated != 3)
    fail(fmt::format("is {}-dimensional: only two and three dimensions can be read", *stated));
  if (stated.value_or(has_third ? 3 : 2) == 2)
    set_shapes(fixed_.emplace<Configuration2>(), values, shape);
  else
    set_shapes(fixed_.emplace<Configuration3>(), values, shape);
}

std::optional<int> TrajectoryReader::stated_dimension() const {
  const bool states =
      root_.has_group("parameters") && root_.group("parameters").has_attribute("dimension");
  return states ? std::optional<int>(provenance().dimension) : std::nullopt;
}

void TrajectoryReader::set_shapes(Configuration2& fixed, const std::vector<double>& values,
                                  const h5::Shape& shape) const {
  fixed.resize(shape[0]);
  for (std::size_t i = 0; i < shape[0]; ++i) {
    const double a = values[shape[1] * i], b = values[shape[1] * i + 1];
    if (!(std::isfinite(a) && a >= b && b > 0))
      fail("the semi-axes of particle " + std::to_string(i) + " should be a ≥ b > 0");
    fixed.shape[i] = {a, b};
  }
}

void TrajectoryReader::set_shapes(Configuration3& fixed, const std::vector<double>& values,
                                  const h5::Shape& shape) const {
  fixed.resize(shape[0]);
  for (std::size_t i = 0; i < shape[0]; ++i) {
    const Vec3 axes = shape[1] == 3 ? Vec3(&values[3 * i]) : Vec3(Vec3::Zero());
    if (!(axes.allFinite() && axes.minCoeff() > 0))
      fail("particle " + std::to_string(i) + " should have three semi-axes above 0");
    fixed.shape[i] = {axes};
  }
}

template <int Dim>
void TrajectoryReader::read_masses_and_species(Configuration<Dim>& fixed) const {
  fixed.species_names = {"A"};
  if (root_.has_dataset(group_ + "/mass"))
    fixed.mass = root_.dataset(group_ + "/mass").read<double>();
  if (root_.has_dataset(group_ + "/species")) {
    const h5::Dataset species = root_.dataset(group_ + "/species");
    fixed.species = species.read<std::int32_t>();
    fixed.species_names = species.enumeration();
  }
  if (fixed.mass.size() != fixed.size() || fixed.species.size() != fixed.size())
    fail("the datasets mass and species should have one number per particle, " +
         std::to_string(fixed.size()));
  const auto [low, high] = std::minmax_element(fixed.species.begin(), fixed.species.end());
  if (fixed.size() == 0) return;
  if (*low < 0) fail("the dataset " + group_ + "/species should count from 0");
  for (std::size_t k = fixed.species_names.size(); k <= static_cast<std::size_t>(*high); ++k)
    fixed.species_names.push_back(std::to_string(k));
}

template <int Dim>
Configuration<Dim> TrajectoryReader::read(std::uint64_t frame) const {
  Configuration<Dim> configuration;
  read(frame, configuration);
  return configuration;
}

template <int Dim>
void TrajectoryReader::read(std::uint64_t frame, Configuration<Dim>& configuration) const {
  require_dimension(Dim);
  if (frame >= frames())
    fail("there is no frame " + std::to_string(frame) + ": it has " + std::to_string(frames()) +
         ", counted from 0");
  configuration = std::get<Configuration<Dim>>(fixed_);
  configuration.time = times_[frame];
  read_box(frame, configuration);
  read_positions(frame, configuration);
  read_orientations(frame, configuration);
  read_velocities(frame, configuration);
  read_close_pairs(frame, configuration);
}

/// Numbers per particle in a frame of a series.
std::size_t TrajectoryReader::columns(const h5::Dataset& values) const {
  const h5::Shape shape = values.shape();
  return shape.size() == 3 ? shape[2] : 1;
}

/// A frame of an element with at least `per_particle` numbers per particle; others are cut off.
std::vector<double> TrajectoryReader::frame_values(const std::string& element,
                                                   const std::string& meaning, std::uint64_t frame,
                                                   std::size_t per_particle) const {
  const h5::Dataset& values = dataset(group_ + '/' + element + "/value", meaning);
  const std::size_t stored = columns(values);
  std::vector<double> numbers(particles() * stored);
  values.read_frame<double>(frame, numbers);
  if (stored < per_particle)
    fail("the dataset " + values.name() + " should have " + std::to_string(per_particle) +
         " numbers per particle");
  std::vector<double> kept;
  kept.reserve(particles() * per_particle);
  for (std::size_t i = 0; i < particles(); ++i)
    kept.insert(kept.end(), &numbers[i * stored], &numbers[i * stored] + per_particle);
  if (!std::all_of(kept.begin(), kept.end(), [](double x) { return std::isfinite(x); }))
    fail("the dataset " + values.name() + " has numbers that are not finite in frame " +
         std::to_string(frame));
  return kept;
}

template <int Dim>
void TrajectoryReader::read_box(std::uint64_t frame, Configuration<Dim>& configuration) const {
  const std::string path = group_ + "/box/edges";
  const bool fixed = root_.has_dataset(path);
  const h5::Dataset& edges = dataset(fixed ? path : path + "/value", "the box lengths");
  h5::Shape shape = edges.shape();
  if (!fixed && !shape.empty()) shape.erase(shape.begin());
  const std::size_t d = shape.empty() ? 0 : shape[0];
  if (d < Dim || d > 3 || shape.size() > 2)
    fail("the dataset " + edges.name() + " should hold " + (Dim == 2 ? "2 or 3" : "3") +
         " lengths, or as many cell vectors");
  std::vector<double> values(shape.size() == 2 ? d * d : d);
  if (fixed)
    values = edges.read<double>();
  else
    edges.read_frame<double>(frame, values);

  Vec<Dim> lengths;
  bool slanted = false;
  for (std::size_t k = 0; k < Dim; ++k) {
    lengths[k] = values[shape.size() == 2 ? k * d + k : k];
    for (std::size_t l = 0; shape.size() == 2 && l < Dim; ++l)
      slanted = slanted || (l != k && values[k * d + l] != 0);
  }
  if (slanted || !lengths.allFinite() || lengths.minCoeff() <= 0)
    fail("the box of frame " + std::to_string(frame) +
         (Dim == 2 ? " should be a rectangle with sides along x and y"
                   : " should be a cuboid with edges along x, y and z"));
  configuration.box = PeriodicBox<Dim>(lengths);
}

template <int Dim>
void TrajectoryReader::read_positions(std::uint64_t frame,
                                      Configuration<Dim>& configuration) const {
  const std::string meaning = "the coordinates";
  const std::size_t stored = columns(dataset(group_ + "/position/value", meaning));
  const std::size_t d = Dim == 2 && stored <= 2 ? 2 : 3;
  const std::vector<double> positions = frame_values("position", meaning, frame, d);
  std::vector<double> images(particles() * Dim);
  if (has("image")) images = frame_values("image", "the box crossings", frame, Dim);
  for (std::size_t i = 0; i < particles(); ++i) {
    if (Dim == 2 && d == 3 && positions[3 * i + 2] != 0)
      fail("particle " + std::to_string(i) + " has z ≠ 0, but the system is two-dimensional");
    configuration.position[i] = Vec<Dim>(&positions[d * i]);
    configuration.image[i] = Vec<Dim>(&images[Dim * i]).template cast<std::int32_t>();
    wrap_if_outside(configuration.box, configuration.position[i], configuration.image[i]);
  }
}

void TrajectoryReader::read_orientations(std::uint64_t frame, Configuration2& configuration) const {
  if (has("angle") || !has("orientation")) {
    configuration.angle = frame_values("angle", "the angle of every particle in radians", frame, 1);
    return;
  }
  const std::vector<double> quaternions = frame_values("orientation", "quaternions", frame, 4);
  for (std::size_t i = 0; i < particles(); ++i) {
    const double* q = &quaternions[4 * i];
    if (q[1] != 0 || q[2] != 0)
      fail("particle " + std::to_string(i) +
           " is turned out of the plane, but the system is two-dimensional");
    configuration.angle[i] = 2 * std::atan2(q[3], q[0]);
  }
}

void TrajectoryReader::read_orientations(std::uint64_t frame, Configuration3& configuration) const {
  const std::vector<double> quaternions = frame_values("orientation", "quaternions", frame, 4);
  for (std::size_t i = 0; i < particles(); ++i) {
    const double* q = &quaternions[4 * i];
    configuration.orientation[i] = Quaternion(q[0], q[1], q[2], q[3]);
    const double excess = std::abs(configuration.orientation[i].norm() - 1);
    if (excess > single_precision)
      fail(fmt::format("the orientation of particle {} has the norm {}, but should have 1", i,
                       configuration.orientation[i].norm()));
    if (excess > double_precision) configuration.orientation[i].normalize();
  }
}

template <int Dim>
void TrajectoryReader::read_velocities(std::uint64_t frame,
                                       Configuration<Dim>& configuration) const {
  if (has("velocity")) {
    const std::vector<double> v = frame_values("velocity", "the velocities", frame, Dim);
    for (std::size_t i = 0; i < particles(); ++i) configuration.velocity[i] = Vec<Dim>(&v[Dim * i]);
  }
  if (!has("angular_velocity")) return;
  const std::vector<double> w =
      frame_values("angular_velocity", "the angular velocities", frame, 3);
  for (std::size_t i = 0; i < particles(); ++i) {
    if constexpr (Dim == 2)
      configuration.angular_velocity[i] = w[3 * i + 2];
    else
      configuration.angular_velocity[i] = Vec3(&w[3 * i]);
  }
}

template <int Dim>
void TrajectoryReader::read_close_pairs(std::uint64_t frame,
                                        Configuration<Dim>& configuration) const {
  const std::string group = group_ + "/close_pairs/";
  if (!root_.has_dataset(group + "end")) return;
  const auto column = [&](const char* name) -> const h5::Dataset& {
    return dataset(group + name, "the close pairs of every frame");
  };
  const h5::Dataset &end = column("end"), &pairs = column("pair"), &lags = column("lag"),
                    &distances = column("distance");
  std::int64_t row = 0, last = 0;
  if (frame > 0) end.read_frame<std::int64_t>(frame - 1, {&row, 1});
  end.read_frame<std::int64_t>(frame, {&last, 1});
  for (; row < last; ++row) {
    const auto k = static_cast<std::uint64_t>(row);
    std::array<std::int64_t, 2> pair;
    std::array<std::int32_t, 3> lag;
    double distance;
    pairs.read_frame<std::int64_t>(k, pair);
    lags.read_frame<std::int32_t>(k, lag);
    distances.read_frame<double>(k, {&distance, 1});
    const auto n = static_cast<std::int64_t>(particles());
    if (pair[0] < 0 || pair[0] > pair[1] || pair[1] >= n || !(distance > 0))
      fail(
          fmt::format("row {} of {}pair should be two particles, i ≤ j < {}, at a distance above 0",
                      row, group, n));
    const auto i = static_cast<std::size_t>(pair[0]), j = static_cast<std::size_t>(pair[1]);
    const Shift<Dim> shift =
        Shift<Dim>(lag.data()) - configuration.image[i] + configuration.image[j];
    configuration.close_pairs.push_back({{i, j, shift}, distance});
  }
}

bool TrajectoryReader::has(const std::string& element) const {
  return root_.has_dataset(group_ + '/' + element + "/value");
}

void TrajectoryReader::require(const std::string& element, const std::string& purpose) const {
  if (!has(element))
    fail("the dataset " + group_ + '/' + element + "/value is missing: it is needed for " +
         purpose);
}

std::vector<std::string> TrajectoryReader::observable_names() const {
  return root_.has_group("observables") ? root_.group("observables").members()
                                        : std::vector<std::string>();
}

bool TrajectoryReader::has_observable(const std::string& name) const {
  const std::vector<std::string> names = observable_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<double> TrajectoryReader::observable(const std::string& name) const {
  const h5::Dataset& values = dataset("observables/" + name + "/value", "one number per frame");
  std::vector<double> numbers = values.read<double>();
  if (values.shape().size() != 1 || numbers.size() < frames())
    fail("the dataset " + values.name() + " should have one number per frame, " +
         std::to_string(frames()));
  numbers.resize(frames());
  return numbers;
}

Provenance TrajectoryReader::provenance() const {
  return root_.has_group("parameters") ? read_provenance(root_.group("parameters")) : Provenance();
}

template <int Dim>
void write_state(const fs::path& path, const Configuration<Dim>& configuration,
                 const Provenance& provenance, bool overwrite) {
  refuse_existing(path, overwrite);
  AtomicFile pending(path);
  TrajectoryWriter writer(
      create_layout(pending.partial(), configuration, provenance,
                    {.velocities = true, .close_pairs = !configuration.close_pairs.empty()}));
  writer.write(configuration, 0);
  writer.close();
  pending.commit();
}

template <int Dim>
Configuration<Dim> read_state(const fs::path& path) {
  const TrajectoryReader reader(path);
  if (reader.frames() == 0)
    throw FileError(path.string() + ": has no frames: a state is the last frame of a trajectory");
  return reader.read<Dim>(reader.frames() - 1);
}

template TrajectoryWriter TrajectoryWriter::create(const fs::path&, const Configuration2&,
                                                   const Provenance&, const TrajectoryOptions&);
template TrajectoryWriter TrajectoryWriter::create(const fs::path&, const Configuration3&,
                                                   const Provenance&, const TrajectoryOptions&);
template void TrajectoryWriter::write(const Configuration2&, std::int64_t, const Observables&);
template void TrajectoryWriter::write(const Configuration3&, std::int64_t, const Observables&);
template Configuration2 TrajectoryReader::read(std::uint64_t) const;
template Configuration3 TrajectoryReader::read(std::uint64_t) const;
template void TrajectoryReader::read(std::uint64_t, Configuration2&) const;
template void TrajectoryReader::read(std::uint64_t, Configuration3&) const;
template void write_state(const fs::path&, const Configuration2&, const Provenance&, bool);
template void write_state(const fs::path&, const Configuration3&, const Provenance&, bool);
template Configuration2 read_state<2>(const fs::path&);
template Configuration3 read_state<3>(const fs::path&);

}  // namespace vitrel
