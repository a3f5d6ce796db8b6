#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/io/foreign/foreign_file.h"
#include "core/io/h5.h"
#include "core/io/provenance.h"
#include "core/state/configuration.h"
#include "core/state/observer.h"

/// @file
/// Trajectories in H5MD 1.1 (de Buyl, Colberg & Höfling, Comput. Phys. Commun. 185, 1546, 2014).
/// The file is always three-dimensional, because readers of two-dimensional files are rare:
/// ellipses lie in the plane z = 0, their third semi-axis is stored as 0, and the box is 1 high and
/// not periodic in z. Ellipsoids, in three dimensions, fill all of it. `parameters` tells which.
///
///     particles/all/
///       position, image             wrapped, box centred at the origin;
///                                   unwrapped = position + image · edges
///       angle                       in 2-D: θ, unwrapped, radians
///       orientation                 in 3-D: quaternion w, x, y, z; in 2-D, as (cos θ/2, 0, 0, sin θ/2), where
///                                   turns are not counted, and in files up to version 0.2
///       velocity, angular_velocity  if asked for, both in the axes of space; in 2-D ω is one number (up to
///                                   version 0.2 three)
///       box/edges                   rows are the cell vectors
///       species, id, mass, semiaxes the same in all frames
///     observables/<name>            one number per frame
///     particles/all/close_pairs/    of soft particles, if asked for; those of frame k are the rows from
///                                   end[k − 1], or 0, to end[k]:
///       pair, lag, distance         (i, j); the shift of j's image, between unwrapped positions; how
///                                   close they may be
///     parameters                    provenance
///
/// Velocities of soft particles in contact are those of after it: a run that starts from a frame finds
/// no contacts under way, but the pairs that are still close.
///
/// Every {step, time} is one dataset under many names. Numbers are stored as they are in memory, so a wrapped
/// configuration read back is bit-identical; in single precision they have 24 bits, of which an unwrapped angle also
/// needs some for its turns. Images have 16 bits until a particle needs 32. Several frames, and up to 1024 particles,
/// lie together in a chunk.
namespace vitrel {

using Observables = std::map<std::string, double>;

struct TrajectoryOptions {
  bool velocities = false;                    ///< store velocity and angular velocity
  bool close_pairs = false;                   ///< of soft particles
  bool images = true, angles = true;          ///< false where a file of another program has none
  bool single_precision = false;              ///< of all numbers of particles: half the size
  std::uint64_t expected_frames = 0;          ///< chunks hold no more; 0: unknown
  std::vector<std::string> observables = {};  ///< names of the numbers that come with every frame
  bool overwrite = false;                     ///< replace an existing file instead of refusing
};

/// One frame with velocities, complete under its name or not there at all.
template <int Dim>
void write_state(const std::filesystem::path& path, const Configuration<Dim>& configuration,
                 const Provenance& provenance, bool overwrite = false);

/// Writes a trajectory frame by frame. Frames are collected until they fill chunks of the file. `write` saves all
/// frames that are not in the file yet if half a second has passed since it last did; they reach the file whole or not
/// at all. A process killed at any moment, or a full disk, leaves the frames that were saved. Other processes may read
/// the file meanwhile. Throws FileError if the file cannot be written.
///
/// Memory for up to 16 frames, fewer above 32 768 particles.
class TrajectoryWriter {
 public:
  /// A new file without frames; it appears under its name only when it is readable. `configuration`
  /// gives what all frames share: number, shapes, masses and species of the particles.
  /// UserError if the file exists and may not be overwritten.
  template <int Dim>
  static TrajectoryWriter create(const std::filesystem::path& path,
                                 const Configuration<Dim>& configuration,
                                 const Provenance& provenance,
                                 const TrajectoryOptions& options = {});
  TrajectoryWriter(TrajectoryWriter&&) = default;
  TrajectoryWriter& operator=(TrajectoryWriter&&) = delete;  // it would lose frames
  /// Closes too, but cannot report a failure.
  ~TrajectoryWriter();
  /// Continues a file after its first `frames_to_keep` frames; later ones are dropped. FileError if
  /// it has fewer.
  static TrajectoryWriter append_to(const std::filesystem::path& path,
                                    std::uint64_t frames_to_keep);

  /// Adds a frame at time configuration.time. `observables` must have exactly the names of the
  /// file.
  template <int Dim>
  void write(const Configuration<Dim>& configuration, std::int64_t step,
             const Observables& observables = {});
  /// The time spent on this file by all processes so far, for its provenance.
  void record_wall_seconds(double seconds);
  /// The parameters of a run that goes on with others.
  void record_parameters(const std::string& toml);
  /// Saves all frames against a kill of the process.
  void commit();
  /// Waits until the disk has all frames: a checkpoint that counts them may then be saved.
  void synchronize();
  /// The same, and closes.
  void close();

  std::uint64_t frames() const { return frames_; }
  std::vector<std::string> observable_names() const;

 private:
  explicit TrajectoryWriter(h5::File file);
  template <int Dim>
  friend void write_state(const std::filesystem::path& path,
                          const Configuration<Dim>& configuration, const Provenance& provenance,
                          bool overwrite);

  /// A series and what is to be added to it.
  template <class T>
  struct Series {
    h5::Dataset dataset;
    std::vector<T> added = {};
    std::uint64_t frames = 0;  ///< of those

    /// Room for the numbers of one more frame.
    std::span<T> add_frame(std::size_t numbers);
    void add(std::span<const T> frame);
    /// Puts what was added behind what the file has.
    void write();
  };
  using Numbers = Series<double>;

  /// A frame has a row for each of its close pairs, after the rows of the frames before.
  struct ClosePairs {
    Series<std::int64_t> end, pair;
    Series<std::int32_t> lag;
    Numbers distance;
    std::int64_t rows = 0;

    /// Those of the first frames. Throws FileError with the path if there are fewer than `end` says.
    void keep(std::uint64_t frames, const std::string& path);
    template <int Dim>
    void add(const Configuration<Dim>& configuration);
  };

  template <class T>
  Series<T> required(const std::string& name) const;
  template <class T>
  std::optional<Series<T>> existing(const std::string& element) const;
  template <int Dim>
  void check(const Configuration<Dim>& configuration, const Observables& observables) const;
  void keep(std::uint64_t frames);
  template <int Dim>
  void add_particles(const Configuration<Dim>& configuration);
  template <int Dim>
  void add_places(const Configuration<Dim>& configuration);
  template <int Dim>
  void add_velocities(const Configuration<Dim>& configuration);
  void widen_images();
  void write_added();
  /// Calls visit(series) for all that have one entry per frame.
  template <class Visit>
  void for_each_series(Visit&& visit);

  h5::File file_;
  std::chrono::steady_clock::time_point last_commit_;
  std::size_t particles_ = 0;
  std::uint64_t frames_ = 0, frames_at_once_ = 1;
  int dimension_ = 0;
  Series<std::int64_t> step_;
  Numbers time_, edges_, position_;
  std::optional<Series<std::int32_t>> image_;
  std::int32_t largest_image_ = 0;  ///< that the file can hold
  std::optional<Numbers> orientation_, angle_, velocity_, angular_velocity_;
  std::optional<ClosePairs> close_pairs_;
  std::map<std::string, Numbers> observables_;
};

/// Writes every frame it is shown, with the observables that `measure` gives for it.
template <int Dim>
class TrajectoryObserver : public Observer<Dim> {
 public:
  using Measure = std::function<Observables(const Frame<Dim>&)>;
  explicit TrajectoryObserver(TrajectoryWriter& writer, Measure measure = {})
      : writer_(writer), measure_(std::move(measure)) {}
  void observe(const Frame<Dim>& frame) override {
    writer_.write(frame.configuration, frame.index, measure_ ? measure_(frame) : Observables{});
  }

 private:
  TrajectoryWriter& writer_;
  Measure measure_;
};

/// Reads trajectories one frame at a time: vitrel's own, and those of other programs, which are first brought into the
/// same form (core/io/foreign/foreign_file.h). What a file may lack, and what then is read: image: 0; velocity,
/// angular_velocity: 0; angle: taken from the orientation, then not unwrapped; orientation: that of the axes, if all
/// particles are round.
///
/// A frame is read into a configuration of the dimension of the file; `require_dimension` says so before any frame is
/// asked for. Orientations in three dimensions must have the norm 1.
///
/// A file may be read while another process adds frames to it. The reader then has the frames that were in the file
/// when it was opened.
///
/// Times must be finite, and the particles must fit into the box, soft ones with some overlap. FileError names the
/// file, the dataset, and what would be right.
class TrajectoryReader {
 public:
  /// `known`: what a file of another program may lack, and how to read it.
  explicit TrajectoryReader(const std::filesystem::path& path, const KnownSystem& known = {});

  std::uint64_t frames() const { return times_.size(); }
  std::size_t particles() const;
  int dimension() const { return fixed_.index() == 0 ? 2 : 3; }
  /// Throws FileError if the file has the other one.
  void require_dimension(int wanted) const;
  /// One entry per frame.
  const std::vector<double>& times() const { return times_; }
  const std::vector<std::int64_t>& steps() const { return steps_; }
  const std::vector<std::string>& species_names() const;

  template <int Dim = 2>
  Configuration<Dim> read(std::uint64_t frame) const;
  /// The same into a configuration that is empty, or that another frame of this file was read into.
  template <int Dim>
  void read(std::uint64_t frame, Configuration<Dim>& configuration) const;
  /// The same without velocities and close pairs.
  template <int Dim>
  void read_places(std::uint64_t frame, Configuration<Dim>& configuration) const;

  /// Whether positions are rounded to single precision.
  bool has_single_precision() const;
  /// Whether the file has the element "velocity", "image", … of the particles.
  bool has(const std::string& name) const;

  std::vector<std::string> observable_names() const;
  bool has_observable(const std::string& name) const;
  /// One value per frame.
  std::vector<double> observable(const std::string& name) const;

  /// What became of a file of another program, or up to which time a file that is being written was read; else empty.
  const ImportReport& import_report() const { return import_.report; }
  /// The units of a file of another program. Vitrel's own files are in reduced units and have none.
  const std::optional<FileUnits>& units() const { return import_.units; }
  /// Whether angles are known up to half turns only.
  bool angles_are_directors() const { return import_.angles_are_directors; }
  /// The frames, in ascending order, to which some particle may have gone another way than its box crossings say. Only
  /// nearest images leave such doubts.
  const std::vector<std::size_t>& doubtful_frames() const { return import_.doubtful_frames; }
  /// Why nothing can be said about motion; empty if it can.
  std::string obstacle_to_motion() const;

  /// Empty fields where the file has none.
  Provenance provenance() const;
  const std::filesystem::path& path() const { return path_; }

 private:
  template <class Read>
  std::invoke_result_t<Read> consistently(Read&& read) const;
  void read_what_frames_share();
  void report_progress();
  bool has_dataset(const std::string& name) const;
  const h5::Dataset& dataset(const std::string& name, const std::string& meaning) const;
  [[noreturn]] void fail(const std::string& what) const;
  void read_axes();
  void read_shapes();
  std::optional<int> stated_dimension() const;
  void require_size(std::size_t i, double longest, double shortest) const;
  template <int Dim>
  void set_shapes(Configuration<Dim>& fixed, const std::vector<double>& values,
                  const h5::Shape& shape) const;
  template <int Dim>
  void read_masses_and_species(Configuration<Dim>& fixed) const;
  const h5::Dataset& element(const std::string& name, const std::string& meaning) const;
  template <int Dim>
  bool has_no_orientations(const Configuration<Dim>& configuration) const;
  /// Consecutive frames of a dataset, so that every chunk of the file is read once.
  struct Block {
    std::uint64_t first = 0, frames = 0;
    std::size_t numbers = 0;  ///< of a frame
    std::vector<double> values = {};
    const double* at(std::uint64_t frame) const { return &values[(frame - first) * numbers]; }
  };
  void load(Block& block, const h5::Dataset& values, std::uint64_t frame) const;
  template <class Open>
  const Block& block_with(const std::string& name, std::uint64_t frame, Open&& open) const;
  /// One row for every particle.
  struct Rows {
    const double* values = nullptr;
    std::size_t numbers = 0;  ///< of a row
    const double* operator[](std::size_t i) const { return values + i * numbers; }
  };
  Rows rows(const std::string& name, const std::string& meaning, std::uint64_t frame,
            std::size_t numbers) const;
  template <int Dim>
  void read_box(std::uint64_t frame, Configuration<Dim>& configuration) const;
  template <int Dim>
  void require_room(std::uint64_t frame, const Configuration<Dim>& configuration) const;
  template <int Dim>
  void require_near_box(std::uint64_t frame, std::size_t i,
                        const Configuration<Dim>& configuration) const;
  template <int Dim>
  void read_positions(std::uint64_t frame, Configuration<Dim>& configuration) const;
  void read_orientations(std::uint64_t frame, Configuration2& configuration) const;
  void read_orientations(std::uint64_t frame, Configuration3& configuration) const;
  template <int Dim>
  void read_velocities(std::uint64_t frame, Configuration<Dim>& configuration) const;
  template <int Dim>
  void read_close_pairs(std::uint64_t frame, Configuration<Dim>& configuration) const;

  std::uint64_t first_other_box() const;

  std::filesystem::path path_;
  mutable ImportedFile import_;
  mutable std::optional<h5::Group> root_;
  mutable bool is_reading_ = false;
  static inline const std::string group_ = "particles/all";
  std::vector<double> times_;
  std::vector<std::int64_t> steps_;
  std::variant<Configuration2, Configuration3> fixed_;   ///< what all frames share
  mutable std::map<std::string, h5::Dataset> datasets_;  ///< those in use stay open
  mutable std::map<std::string, bool> present_;          ///< these datasets, or not; slow to ask
  mutable std::map<std::string, Block> blocks_;          ///< by element, around the frame read last
};

/// The last frame of a trajectory. FileError if there is none.
template <int Dim = 2>
Configuration<Dim> read_state(const std::filesystem::path& path);
template <int Dim>
Configuration<Dim> read_state(const TrajectoryReader& reader);

}  // namespace vitrel
