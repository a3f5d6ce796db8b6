#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/io/atomic_file.h"
#include "core/io/h5md.h"
#include "core/state/in_space.h"

namespace vitrel {
namespace fs = std::filesystem;
namespace {

const std::string all = "particles/all";
/// The z edge of the box of a two-dimensional system, which means nothing but must not be 0.
constexpr double height = 1;

/// The number of entries in a chunk of a series that has one number per frame, or a few.
constexpr std::uint64_t entries_per_chunk = 128;

/// Returns the number of frames per chunk: chunks have some hundred kilobytes, and the frames of a row of chunks take
/// no more than some ten megabytes of memory.
std::uint64_t frames_per_chunk(std::uint64_t particles) {
  constexpr std::uint64_t most_at_once = std::uint64_t{1} << 19, in_chunk = std::uint64_t{1} << 14;
  if (particles >= h5::rows_per_chunk)
    return std::clamp<std::uint64_t>(most_at_once / particles, 1, in_chunk / h5::rows_per_chunk);
  return std::min(entries_per_chunk, in_chunk / std::max<std::uint64_t>(1, particles));
}

std::string series_path(const std::string& element) {
  return all + '/' + element + "/value";
}

/// Creates a series `element`/{step, time, value} that shares the position's step and time.
template <class T>
void create_element(h5::Group& parent, const std::string& element, const h5::Shape& frame_shape,
                    std::uint64_t frames) {
  h5::Group group = parent.create_group(element);
  group.create_series<T>("value", frame_shape, frames);
  group.link("step", all + "/position/step");
  group.link("time", all + "/position/time");
}

void create_box(h5::Group& particles, int dimension) {
  h5::Group box = particles.create_group("box");
  box.set_attribute("dimension", std::int32_t{3});
  const std::array<std::string, 3> boundary{"periodic", "periodic",
                                            dimension == 3 ? "periodic" : "none"};
  box.set_attribute("boundary", boundary, 8);
  create_element<double>(box, "edges", {3, 3}, entries_per_chunk);
}

/// Creates the series of the particles, which hold real numbers of type T.
template <class T>
void create_elements(h5::Group& particles, std::uint64_t n, int dimension,
                     const TrajectoryOptions& options) {
  std::uint64_t frames = frames_per_chunk(n);
  if (options.expected_frames > 0) frames = std::min(frames, options.expected_frames);
  const bool has_angles = dimension == 2 && options.angles;
  h5::Group position = particles.create_group("position");
  position.create_series<std::int64_t>("step", {}, entries_per_chunk);
  position.create_series<double>("time", {}, entries_per_chunk);
  position.create_series<T>("value", {n, 3}, frames);
  create_box(particles, dimension);
  if (options.images) create_element<std::int16_t>(particles, "image", {n, 3}, frames);
  if (has_angles)
    create_element<T>(particles, "angle", {n}, frames);
  else
    create_element<T>(particles, "orientation", {n, 4}, frames);
  if (!options.velocities) return;
  create_element<T>(particles, "velocity", {n, 3}, frames);
  create_element<T>(particles, "angular_velocity", dimension == 2 ? h5::Shape{n} : h5::Shape{n, 3},
                    frames);
}

/// Writes a vector as three components; in two dimensions the last is 0.
template <class T, int Dim>
void put(T* row, const Eigen::Matrix<T, Dim, 1>& vector) {
  for (int k = 0; k < 3; ++k) row[k] = k < Dim ? vector[k < Dim ? k : 0] : T{0};
}

void create_close_pairs(h5::Group& particles) {
  h5::Group pairs = particles.create_group("close_pairs");
  pairs.create_series<std::int64_t>("end", {}, entries_per_chunk);
  pairs.create_series<std::int64_t>("pair", {2}, entries_per_chunk);
  pairs.create_series<std::int32_t>("lag", {3}, entries_per_chunk);
  pairs.create_series<double>("distance", {}, entries_per_chunk);
}

template <int Dim>
void create_fixed_arrays(h5::Group& particles, const Configuration<Dim>& configuration) {
  const std::uint64_t n = configuration.size();
  std::vector<std::int64_t> id(n);
  std::iota(id.begin(), id.end(), 0);
  std::vector<double> semiaxes(3 * n);
  for (std::size_t i = 0; i < n; ++i) put(&semiaxes[3 * i], configuration.shape[i].half_lengths());
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

/// Creates everything but the frames.
template <int Dim>
h5::File create_layout(const fs::path& path, const Configuration<Dim>& configuration,
                       Provenance provenance, const TrajectoryOptions& options) {
  provenance.dimension = Dim;
  const std::uint64_t n = configuration.size();
  h5::File file = h5::File::create(path);
  h5::Group root = file.root();
  create_h5md_group(root, provenance);
  h5::Group particles = root.create_group("particles").create_group("all");
  if (options.single_precision)
    create_elements<float>(particles, n, Dim, options);
  else
    create_elements<double>(particles, n, Dim, options);
  if (options.close_pairs) create_close_pairs(particles);
  create_fixed_arrays(particles, configuration);
  h5::Group observables = root.create_group("observables");
  for (const std::string& name : options.observables)
    create_element<double>(observables, name, {}, entries_per_chunk);
  h5::Group parameters = root.create_group("parameters");
  write_provenance(parameters, provenance);
  return file;
}

void refuse_existing(const fs::path& path, bool overwrite) {
  if (!overwrite && fs::exists(path))
    throw UserError(path.string() + ": the file exists already: choose another name or remove it");
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
  // The file is opened before others see it, because a file that nobody writes is taken for that of a run that has
  // ended.
  TrajectoryWriter writer = append_to(pending.partial(), 0);
  pending.commit();
  writer.file_.set_path(path);
  return writer;
}

TrajectoryWriter TrajectoryWriter::append_to(const fs::path& path, std::uint64_t frames_to_keep) {
  TrajectoryWriter writer(h5::File::open(path, h5::Access::write));
  if (writer.frames_ < frames_to_keep)
    throw FileError(path.string() + ": has only " + std::to_string(writer.frames_) +
                    " frames where " + std::to_string(frames_to_keep) +
                    " were expected: it is not the file that the checkpoint belongs to");
  writer.keep(frames_to_keep);
  writer.file_.flush();
  return writer;
}

template <class T>
TrajectoryWriter::Series<T> TrajectoryWriter::required(const std::string& name) const {
  const h5::Group root = file_.root();
  if (!root.has_dataset(name))
    throw FileError(file_.path() + ": the dataset " + name +
                    " is missing: only a trajectory that vitrel wrote can be continued");
  h5::Dataset dataset = root.dataset(name);
  if (dataset.shape().empty())
    throw FileError(file_.path() + ": the dataset " + name + " should have one entry per frame");
  return {std::move(dataset)};
}

template <class T>
std::optional<TrajectoryWriter::Series<T>> TrajectoryWriter::existing(
    const std::string& element) const {
  if (!file_.root().has_dataset(series_path(element))) return std::nullopt;
  return required<T>(series_path(element));
}

TrajectoryWriter::TrajectoryWriter(h5::File file)
    : file_(std::move(file)),
      step_(required<std::int64_t>(all + "/position/step")),
      time_(required<double>(all + "/position/time")),
      edges_(required<double>(all + "/box/edges/value")),
      position_(required<double>(series_path("position"))),
      image_(existing<std::int32_t>("image")),
      orientation_(existing<double>("orientation")),
      angle_(existing<double>("angle")),
      velocity_(existing<double>("velocity")),
      angular_velocity_(existing<double>("angular_velocity")) {
  dimension_ = read_provenance(file_.root().group("parameters")).dimension;
  const h5::Shape positions = position_.dataset.shape();
  if (positions.size() != 3 || positions[2] != 3)
    throw FileError(file_.path() + ": the dataset " + position_.dataset.name() +
                    " should have the shape frames × particles × 3");
  particles_ = positions[1];
  frames_at_once_ = std::max(frames_per_chunk(particles_), position_.dataset.frames_per_chunk());
  frames_ = step_.dataset.shape().at(0);
  if (image_)
    largest_image_ = image_->dataset.bytes_per_number() == sizeof(std::int16_t)
                         ? std::numeric_limits<std::int16_t>::max()
                         : std::numeric_limits<std::int32_t>::max();
  if (const std::string pairs = all + "/close_pairs"; file_.root().has_group(pairs))
    close_pairs_ = {required<std::int64_t>(pairs + "/end"), required<std::int64_t>(pairs + "/pair"),
                    required<std::int32_t>(pairs + "/lag"), required<double>(pairs + "/distance")};
  if (!file_.root().has_group("observables")) return;
  for (const std::string& name : file_.root().group("observables").members())
    observables_.emplace(name, required<double>("observables/" + name + "/value"));
}

TrajectoryWriter::~TrajectoryWriter() {
  if (step_.added.empty()) return;
  try {
    commit();
  } catch (const FileError&) {  // what was saved before is safe
  }
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

template <class T>
std::span<T> TrajectoryWriter::Series<T>::add_frame(std::size_t numbers) {
  ++frames;
  added.resize(added.size() + numbers);
  return std::span(added).last(numbers);
}

template <class T>
void TrajectoryWriter::Series<T>::add(std::span<const T> frame) {
  std::ranges::copy(frame, add_frame(frame.size()).begin());
}

template <class T>
void TrajectoryWriter::Series<T>::write() {
  if (frames == 0) return;
  const std::uint64_t before = dataset.shape().at(0);
  dataset.resize(before + frames);
  dataset.template write_frames<T>(before, std::exchange(frames, 0), added);
  added.clear();
}

template <class Visit>
void TrajectoryWriter::for_each_series(Visit&& visit) {
  for (Numbers* series : {&time_, &edges_, &position_}) visit(*series);
  for (std::optional<Numbers>* series : {&orientation_, &angle_, &velocity_, &angular_velocity_})
    if (*series) visit(**series);
  if (image_) visit(*image_);
  for (auto& [name, series] : observables_) visit(series);
  if (close_pairs_) visit(close_pairs_->end);
  visit(step_);
}

void TrajectoryWriter::keep(std::uint64_t frames) {
  // Extending a series that is too short would give fill values in the place of what is lost.
  for_each_series([&](const auto& series) {
    if (series.dataset.shape().at(0) < frames)
      throw FileError(fmt::format("{}: the dataset {} has fewer frames than step", file_.path(),
                                  series.dataset.name()));
  });
  for_each_series([&](auto& series) { series.dataset.resize(frames); });
  if (close_pairs_) close_pairs_->keep(frames, file_.path());
  frames_ = frames;
}

void TrajectoryWriter::ClosePairs::keep(std::uint64_t frames, const std::string& path) {
  if (frames > 0) rows = end.dataset.read_frames<std::int64_t>(frames - 1, 1, 1).front();
  const std::uint64_t present = pair.dataset.shape().at(0);
  if (rows < 0 || static_cast<std::uint64_t>(rows) > present)
    throw FileError(fmt::format("{}: {} states {} close pairs, but there are {}", path,
                                end.dataset.name(), rows, present));
  for (h5::Dataset* dataset : {&pair.dataset, &lag.dataset, &distance.dataset})
    dataset->resize(static_cast<std::uint64_t>(rows));
}

template <int Dim>
void TrajectoryWriter::write(const Configuration<Dim>& configuration, std::int64_t step,
                             const Observables& observables) {
  check(configuration, observables);
  add_particles(configuration);
  step_.add({&step, 1});
  time_.add({&configuration.time, 1});
  const Vec<Dim>& lengths = configuration.box.lengths();
  const double z = Dim == 3 ? lengths[Dim - 1] : height;
  const std::array<double, 9> edges{lengths.x(), 0, 0, 0, lengths.y(), 0, 0, 0, z};
  edges_.add(edges);
  for (const auto& [name, value] : observables) observables_.at(name).add({&value, 1});
  ++frames_;
  // A reader needs time between two commits, and a commit for every frame would cost more than writing it.
  constexpr std::chrono::milliseconds interval(500);
  if (std::chrono::steady_clock::now() - last_commit_ >= interval)
    commit();
  else if (frames_ % frames_at_once_ == 0)
    write_added();
}

/// Frames are counted by `step`, which is therefore written last.
void TrajectoryWriter::write_added() {
  if (close_pairs_) {
    close_pairs_->pair.write();
    close_pairs_->lag.write();
    close_pairs_->distance.write();
  }
  for_each_series([](auto& series) { series.write(); });
}

void TrajectoryWriter::commit() {
  write_added();
  file_.flush();
  last_commit_ = std::chrono::steady_clock::now();
}

void TrajectoryWriter::synchronize() {
  write_added();
  file_.synchronize();
}

void TrajectoryWriter::close() {
  write_added();
  file_.close();
}

template <int Dim>
void TrajectoryWriter::add_particles(const Configuration<Dim>& configuration) {
  add_places(configuration);
  if (velocity_ || angular_velocity_) add_velocities(configuration);
  if constexpr (Dim == 2)
    if (angle_) angle_->add(configuration.angle);
  if (orientation_) {
    const std::span<double> rows = orientation_->add_frame(4 * particles_);
    for (std::size_t i = 0; i < particles_; ++i) {
      const Quaternion q = orientation_in_space(configuration, i);
      std::ranges::copy(std::array{q.w(), q.x(), q.y(), q.z()}, &rows[4 * i]);
    }
  }
  if (close_pairs_) close_pairs_->add(configuration);
}

template <int Dim>
void TrajectoryWriter::add_places(const Configuration<Dim>& configuration) {
  const std::span<double> positions = position_.add_frame(3 * particles_);
  const std::span<std::int32_t> images =
      image_ ? image_->add_frame(3 * particles_) : std::span<std::int32_t>();
  std::int32_t largest = 0;
  for (std::size_t i = 0; i < particles_; ++i) {
    Vec<Dim> position = configuration.position[i];
    Shift<Dim> image = configuration.image[i];
    configuration.box.wrap_if_outside(position, image);
    put(&positions[3 * i], position);
    if (!image_) continue;
    put(&images[3 * i], image);
    largest = std::max(largest, image.cwiseAbs().maxCoeff());
  }
  if (largest > largest_image_) widen_images();
}

/// Copies all images into a dataset of 32-bit numbers.
void TrajectoryWriter::widen_images() {
  if (!image_) return;
  h5::Group group = file_.root().group(all + "/image");
  h5::Dataset wide = group.create_series<std::int32_t>("wide", {particles_, 3}, frames_at_once_);
  const std::uint64_t frames = image_->dataset.shape().at(0);
  wide.resize(frames);
  for (std::uint64_t first = 0; first < frames; first += frames_at_once_) {
    const std::uint64_t count = std::min(frames_at_once_, frames - first);
    wide.write_frames<std::int32_t>(
        first, count, image_->dataset.read_frames<std::int32_t>(first, count, 3 * particles_));
  }
  group.remove("value");
  group.link("value", all + "/image/wide");
  group.remove("wide");
  image_->dataset = std::move(wide);
  largest_image_ = std::numeric_limits<std::int32_t>::max();
}

template <int Dim>
void TrajectoryWriter::add_velocities(const Configuration<Dim>& configuration) {
  if (velocity_) {
    const std::span<double> rows = velocity_->add_frame(3 * particles_);
    const std::vector<Vec<Dim>> velocities = velocities_after_contact(configuration);
    for (std::size_t i = 0; i < particles_; ++i) put(&rows[3 * i], velocities[i]);
  }
  if (!angular_velocity_) return;
  if constexpr (Dim == 2)
    if (angular_velocity_->dataset.shape().size() == 2)
      return angular_velocity_->add(configuration.angular_velocity);
  const std::span<double> rows = angular_velocity_->add_frame(3 * particles_);
  for (std::size_t i = 0; i < particles_; ++i)
    put(&rows[3 * i], angular_velocity_in_space(configuration.angular_velocity[i]));
}

template <int Dim>
void TrajectoryWriter::ClosePairs::add(const Configuration<Dim>& configuration) {
  for (const auto& [images, closest] : configuration.close_pairs) {
    const auto& [i, j, shift] = images;
    const std::array particles{static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)};
    pair.add(particles);
    put(lag.add_frame(3).data(),
        Shift<Dim>(shift + configuration.image[i] - configuration.image[j]));
    distance.add({&closest, 1});
  }
  rows += static_cast<std::int64_t>(configuration.close_pairs.size());
  end.add({&rows, 1});
}

void TrajectoryWriter::record_wall_seconds(double seconds) {
  h5::Group parameters = file_.root().group("parameters");
  parameters.set_attribute("wall_seconds", seconds);
  commit();
}

void TrajectoryWriter::record_parameters(const std::string& toml) {
  h5::Group parameters = file_.root().group("parameters");
  replace_parameters(parameters, toml);
  commit();
}

template <int Dim>
void write_state(const fs::path& path, const Configuration<Dim>& configuration,
                 const Provenance& provenance, bool overwrite) {
  refuse_existing(path, overwrite);
  AtomicFile pending(path);
  TrajectoryWriter writer(create_layout(pending.partial(), configuration, provenance,
                                        {.velocities = true,
                                         .close_pairs = !configuration.close_pairs.empty(),
                                         .expected_frames = 1}));
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
