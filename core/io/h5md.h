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
/// Trajectories in H5MD 1.1 (de Buyl, Colberg & Höfling, Comput. Phys. Commun. 185, 1546, 2014). The file is always
/// three-dimensional, because readers of two-dimensional files are rare. In two dimensions, ellipses lie in the plane
/// z = 0, their third semi-axis is stored as 0, and the box is 1 high and not periodic in z. The attribute `dimension`
/// of `parameters` tells which dimension the system has.
///
///     particles/all/
///       position, image             wrapped, box centred at the origin;
///                                   unwrapped = position + image · edges
///       angle                       in 2-D: θ, unwrapped, radians
///       orientation                 in 3-D: quaternion w, x, y, z; in 2-D (cos θ/2, 0, 0, sin θ/2), if turns are not
///                                   counted, and in files up to version 0.2
///       velocity, angular_velocity  optional, both in the axes of space; in 2-D ω is one number (up to version 0.2
///                                   three)
///       box/edges                   rows are the cell vectors
///       species, id, mass, semiaxes the same in all frames
///     observables/<name>            one number per frame
///     particles/all/close_pairs/    optional, for soft particles; those of frame k are the rows from end[k − 1], or 0,
///                                   to end[k]:
///       pair, lag, distance         (i, j); the shift of j's image, between unwrapped positions; how
///                                   close the centres may be
///     parameters                    provenance
///
/// The stored velocities of soft particles in contact are those after the contact: a run that starts from a frame finds
/// no contacts under way, but it finds the pairs that are still close.
///
/// Every {step, time} is one dataset under many names. Numbers are stored as they are in memory, so a wrapped
/// configuration read back is bit-identical; in single precision they have 24 bits, of which an unwrapped angle also
/// needs some for its turns. Images have 16 bits until a particle needs 32. Several frames, and up to 1024 particles,
/// lie together in a chunk.
namespace vitrel {

using Observables = std::map<std::string, double>;

struct TrajectoryOptions {
  bool velocities = false;            ///< store velocity and angular velocity
  bool close_pairs = false;           ///< store the close pairs of soft particles
  bool images = true, angles = true;  ///< false if a file of another program has none
  bool single_precision = false;  ///< single precision for particle data of frames: half the size
  std::uint64_t expected_frames = 0;          ///< chunks hold no more frames; 0: unknown
  std::vector<std::string> observables = {};  ///< names of the observables of every frame
  bool overwrite = false;                     ///< replace an existing file instead of refusing
};

/// Writes one frame with velocities. The file appears under its name only when it is complete.
template <int Dim>
void write_state(const std::filesystem::path& path, const Configuration<Dim>& configuration,
                 const Provenance& provenance, bool overwrite = false);

/// Writes a trajectory frame by frame. Frames are collected until they fill chunks of the file. `write` saves all
/// frames that are not in the file yet if half a second has passed since it last did; they reach the file whole or not
/// at all. A process killed at any moment, or a full disk, leaves the frames that were saved. Other processes may read
/// the file meanwhile. Throws FileError if the file cannot be written.
///
/// It needs memory for up to 16 frames, fewer above 32 768 particles, and for up to 128 frames below 1024 particles.
class TrajectoryWriter {
 public:
  /// Creates a file without frames, which appears under its name only when it is readable. `configuration` gives what
  /// all frames share: number, shapes, masses and species of the particles. Throws UserError if the file exists and may
  /// not be overwritten.
  template <int Dim>
  static TrajectoryWriter create(const std::filesystem::path& path,
                                 const Configuration<Dim>& configuration,
                                 const Provenance& provenance,
                                 const TrajectoryOptions& options = {});
  TrajectoryWriter(TrajectoryWriter&&) = default;
  TrajectoryWriter& operator=(TrajectoryWriter&&) = delete;  // it would lose frames
  /// Saves all frames, too, but cannot report a failure.
  ~TrajectoryWriter();
  /// Continues a file after its first `frames_to_keep` frames; later ones are dropped. Throws FileError if it has
  /// fewer.
  static TrajectoryWriter append_to(const std::filesystem::path& path,
                                    std::uint64_t frames_to_keep);

  /// Adds a frame at time configuration.time. `observables` must have exactly the names of the
  /// file.
  template <int Dim>
  void write(const Configuration<Dim>& configuration, std::int64_t step,
             const Observables& observables = {});
  /// Records the time spent on this file by all processes so far, for its provenance.
  void record_wall_seconds(double seconds);
  /// Records the parameters of a run that continues with others.
  void record_parameters(const std::string& toml);
  /// Saves all frames, so that they survive a kill of the process.
  void commit();
  /// Saves all frames and waits until the disk has them; a checkpoint that counts them may then be saved.
  void synchronize();
  /// Saves all frames, waits for the disk and closes the file.
  void close();

  std::uint64_t frames() const { return frames_; }
  std::vector<std::string> observable_names() const;

 private:
  explicit TrajectoryWriter(h5::File file);
  template <int Dim>
  friend void write_state(const std::filesystem::path& path,
                          const Configuration<Dim>& configuration, const Provenance& provenance,
                          bool overwrite);

  /// A series and the values to be added to it.
  template <class T>
  struct Series {
    h5::Dataset dataset;
    std::vector<T> added = {};
    std::uint64_t frames = 0;  ///< number of frames in `added`

    /// Adds room for the numbers of one more frame.
    std::span<T> add_frame(std::size_t numbers);
    void add(std::span<const T> frame);
    /// Appends what was added to the dataset.
    void write();
  };
  using Numbers = Series<double>;

  /// A frame has a row for each of its close pairs, after the rows of the frames before.
  struct ClosePairs {
    Series<std::int64_t> end, pair;
    Series<std::int32_t> lag;
    Numbers distance;
    std::int64_t rows = 0;

    /// Keeps the rows of the first `frames` frames. Throws FileError with the path if there are fewer than `end` says.
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
  /// Calls visit(series) for all series that have one entry per frame.
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
  std::int32_t largest_image_ = 0;  ///< largest image number that the file can hold
  std::optional<Numbers> orientation_, angle_, velocity_, angular_velocity_;
  std::optional<ClosePairs> close_pairs_;
  std::map<std::string, Numbers> observables_;
};

/// Writes every frame that it observes, with the observables that `measure` gives for it.
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
/// same form (core/io/foreign/foreign_file.h). If a file lacks elements, image, velocity and angular_velocity are read
/// as 0, and angle is taken from the orientation and is then not unwrapped. If it lacks orientation and all particles
/// are round, their orientation is that of the axes.
///
/// A frame is read into a configuration of the dimension of the file; `require_dimension` checks the dimension before
/// any frame is read. Orientations in three dimensions must have the norm 1.
///
/// A file may be read while another process adds frames to it. The reader then has the frames that were in the file
/// when it was opened.
///
/// Times must be finite, and the particles must fit into the box, soft ones with some overlap. A FileError names the
/// file, the dataset, and what would be right.
class TrajectoryReader {
 public:
  /// `known` says what a file of another program may lack, and how to read it.
  explicit TrajectoryReader(const std::filesystem::path& path, const KnownSystem& known = {});

  std::uint64_t frames() const { return times_.size(); }
  std::size_t particles() const;
  int dimension() const { return fixed_.index() == 0 ? 2 : 3; }
  /// Throws FileError if the file has the other dimension.
  void require_dimension(int wanted) const;
  /// One entry per frame.
  const std::vector<double>& times() const { return times_; }
  const std::vector<std::int64_t>& steps() const { return steps_; }
  const std::vector<std::string>& species_names() const;

  template <int Dim = 2>
  Configuration<Dim> read(std::uint64_t frame) const;
  /// Reads a frame into a configuration that is empty, or that another frame of this file was read into.
  template <int Dim>
  void read(std::uint64_t frame, Configuration<Dim>& configuration) const;
  /// Reads a frame without velocities and close pairs.
  template <int Dim>
  void read_places(std::uint64_t frame, Configuration<Dim>& configuration) const;

  /// Returns whether positions are rounded to single precision.
  bool has_single_precision() const;
  /// Returns whether the file has the element "velocity", "image", … of the particles.
  bool has(const std::string& name) const;

  std::vector<std::string> observable_names() const;
  bool has_observable(const std::string& name) const;
  /// One value per frame.
  std::vector<double> observable(const std::string& name) const;

  /// What an import did with a file of another program, or up to which time a file that is being written was read;
  /// otherwise empty.
  const ImportReport& import_report() const { return import_.report; }
  /// The units of a file of another program. Vitrel's own files are in reduced units and have none.
  const std::optional<FileUnits>& units() const { return import_.units; }
  /// Returns whether angles are known up to half turns only.
  bool angles_are_directors() const { return import_.angles_are_directors; }
  /// The frames, in ascending order, to which some particle may have gone another way than its box crossings say. Only
  /// box crossings of nearest images leave such doubts.
  const std::vector<std::size_t>& doubtful_frames() const { return import_.doubtful_frames; }
  /// Returns why nothing can be said about motion; empty if it can.
  std::string obstacle_to_motion() const;

  /// Returns the provenance, with empty fields where the file has none.
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
    std::size_t numbers = 0;  ///< numbers per frame
    std::vector<double> values = {};
    const double* at(std::uint64_t frame) const { return &values[(frame - first) * numbers]; }
  };
  void load(Block& block, const h5::Dataset& values, std::uint64_t frame) const;
  template <class Open>
  const Block& block_with(const std::string& name, std::uint64_t frame, Open&& open) const;
  /// One row for every particle.
  struct Rows {
    const double* values = nullptr;
    std::size_t numbers = 0;  ///< numbers per row
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
  mutable std::map<std::string, h5::Dataset> datasets_;  ///< datasets in use stay open
  mutable std::map<std::string, bool> present_;          ///< whether a dataset exists; slow to ask
  mutable std::map<std::string, Block> blocks_;  ///< blocks by element, around the frame read last
};

/// Returns the last frame of a trajectory. Throws FileError if there is none.
template <int Dim = 2>
Configuration<Dim> read_state(const std::filesystem::path& path);
template <int Dim>
Configuration<Dim> read_state(const TrajectoryReader& reader);

}  // namespace vitrel
