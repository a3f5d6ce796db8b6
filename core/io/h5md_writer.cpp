#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/elementary.h"
#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5md.h"

namespace vitrel {
namespace fs = std::filesystem;
namespace {

const std::string all = "particles/all";
/// The z edge of the box of a two-dimensional system, which means nothing but must not be 0.
constexpr double height = 1;

constexpr auto shared = h5::SeriesStorage::shared_chunks;
constexpr auto plain = h5::SeriesStorage::plain_chunks;
constexpr auto compressed = h5::SeriesStorage::compressed_chunks;

std::string series_path(const std::string& element) {
  return all + '/' + element + "/value";
}

/// A series `element`/{step, time, value} that shares the position's step and time.
template <class T>
void create_element(h5::Group& parent, const std::string& element, const h5::Shape& frame_shape,
                    h5::SeriesStorage storage) {
  h5::Group group = parent.create_group(element);
  group.create_series<T>("value", frame_shape, storage);
  group.link("step", all + "/position/step");
  group.link("time", all + "/position/time");
}

void create_position(h5::Group& particles, std::uint64_t n) {
  h5::Group position = particles.create_group("position");
  position.create_series<std::int64_t>("step", {}, shared);
  position.create_series<double>("time", {}, shared);
  position.create_series<double>("value", {n, 3}, plain);
}

void create_box(h5::Group& particles, int dimension) {
  h5::Group box = particles.create_group("box");
  box.set_attribute("dimension", std::int32_t{3});
  const std::array<std::string, 3> boundary{"periodic", "periodic",
                                            dimension == 3 ? "periodic" : "none"};
  box.set_attribute("boundary", boundary, 8);
  create_element<double>(box, "edges", {3, 3}, shared);
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
  const auto [cosine, sine] = cosine_and_sine(half);
  return {cosine, 0, 0, sine};
}
Quaternion orientation(const Configuration3& configuration, std::size_t i) {
  return configuration.orientation[i];
}

void create_close_pairs(h5::Group& particles) {
  h5::Group pairs = particles.create_group("close_pairs");
  pairs.create_series<std::int64_t>("end", {}, shared);
  pairs.create_series<std::int64_t>("pair", {2}, shared);
  pairs.create_series<std::int32_t>("lag", {3}, shared);
  pairs.create_series<double>("distance", {}, shared);
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
  if (options.images) create_element<std::int32_t>(particles, "image", {n, 3}, compressed);
  create_element<double>(particles, "orientation", {n, 4}, plain);
  if (Dim == 2 && options.angles) create_element<double>(particles, "angle", {n}, plain);
  if (options.velocities) {
    create_element<double>(particles, "velocity", {n, 3}, plain);
    create_element<double>(particles, "angular_velocity", {n, 3}, Dim == 2 ? compressed : plain);
  }
  if (options.close_pairs) create_close_pairs(particles);
  create_fixed_arrays(particles, configuration);
  h5::Group observables = root.create_group("observables");
  for (const std::string& name : options.observables)
    create_element<double>(observables, name, {}, shared);
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
      orientation_(required(file_, series_path("orientation"))),
      image_(optional_dataset(file_, series_path("image"))),
      angle_(optional_dataset(file_, series_path("angle"))),
      velocity_(optional_dataset(file_, series_path("velocity"))),
      angular_velocity_(optional_dataset(file_, series_path("angular_velocity"))) {
  dimension_ = read_provenance(file_.root().group("parameters")).dimension;
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
  if (dimension_ != Dim)
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
  for (h5::Dataset* dataset : {&step_, &time_, &edges_, &position_, &orientation_})
    dataset->resize(frames);
  for (std::optional<h5::Dataset>* dataset : {&image_, &angle_, &velocity_, &angular_velocity_})
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
  ++frames_;
  // A reader needs time between two commits, and a commit for every frame would cost more than writing it.
  constexpr std::chrono::milliseconds interval(500);
  if (std::chrono::steady_clock::now() - last_commit_ >= interval) commit();
}

void TrajectoryWriter::commit() {
  file_.flush();
  last_commit_ = std::chrono::steady_clock::now();
}

template <int Dim>
void TrajectoryWriter::write_particles(const Configuration<Dim>& configuration) {
  std::vector<double> positions, orientations, velocities, angular_velocities;
  std::vector<std::int32_t> images;
  const std::vector<Vec<Dim>> velocities_after = velocities_after_contact(configuration);
  for (std::size_t i = 0; i < particles_; ++i) {
    Vec<Dim> position = configuration.position[i];
    Shift<Dim> image = configuration.image[i];
    configuration.box.wrap_if_outside(position, image);
    append(positions, position);
    append(images, image);
    append(orientations, orientation(configuration, i));
    append(velocities, velocities_after[i]);
    append(angular_velocities, configuration.angular_velocity[i]);
  }
  position_.write_frame<double>(frames_, positions);
  orientation_.write_frame<double>(frames_, orientations);
  if (image_) image_->write_frame<std::int32_t>(frames_, images);
  if constexpr (Dim == 2)
    if (angle_) angle_->write_frame<double>(frames_, configuration.angle);
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

void TrajectoryWriter::record_parameters(const std::string& toml) {
  h5::Group parameters = file_.root().group("parameters");
  replace_parameters(parameters, toml);
  file_.flush();
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

template TrajectoryWriter TrajectoryWriter::create(const fs::path&, const Configuration2&,
                                                   const Provenance&, const TrajectoryOptions&);
template TrajectoryWriter TrajectoryWriter::create(const fs::path&, const Configuration3&,
                                                   const Provenance&, const TrajectoryOptions&);
template void TrajectoryWriter::write(const Configuration2&, std::int64_t, const Observables&);
template void TrajectoryWriter::write(const Configuration3&, std::int64_t, const Observables&);
template void write_state(const fs::path&, const Configuration2&, const Provenance&, bool);
template void write_state(const fs::path&, const Configuration3&, const Provenance&, bool);

}  // namespace vitrel
