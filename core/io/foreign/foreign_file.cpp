#include "core/io/foreign/foreign_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/h5md.h"

namespace vitrel {
namespace {

constexpr double doubtful_step = 0.25;  // steps above this are doubtful, in box lengths

/// Box crossings of a trajectory that does not state them: every particle is assumed to have moved by the shortest way
/// from frame to frame, which is right if no step is longer than half a box length.
template <int Dim>
class NearestImages {
 public:
  /// Sets the images of the next frame; those of the first are 0. Where velocities are stored and times are known, a
  /// particle that kept its velocity flew straight: throws UserError if it flew to another image than the nearest.
  void set(Configuration<Dim>& next, bool knows_flight) {
    double longest = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      Shift<Dim>& image = next.image[i] = Shift<Dim>::Zero();
      if (!last_) continue;
      // The box may have changed.
      const Vec<Dim> step = next.position[i].cwiseQuotient(next.box.lengths()) -
                            last_->position[i].cwiseQuotient(last_->box.lengths());
      for (int k = 0; k < Dim; ++k) {
        const double crossings = std::round(step[k]), length = std::abs(step[k] - crossings);
        image[k] = last_->image[i][k] - static_cast<std::int32_t>(crossings);
        longest = std::max(longest, length);
        if (length > longest_.box_lengths) longest_ = {length, i, frames_, k};
      }
      if (knows_flight) compare_with_flight(next, i);
    }
    if (longest > doubtful_step) doubtful_.push_back(frames_);
    last_ = next;
    ++frames_;
  }

  /// Returns a sentence on the longest step.
  std::string remark() const {
    std::string text = fmt::format(
        "those of the nearest images (unwrap = \"nearest\"); the longest step is "
        "{:.3g} box lengths along {}, of particle {} to frame {}",
        longest_.box_lengths, "xyz"[longest_.direction], longest_.particle, longest_.frame);
    if (!doubtful_.empty())
      text += fmt::format(
          ": above {}, longer steps that were taken for shorter ones cannot be excluded",
          doubtful_step);
    return text;
  }
  /// The frames, in ascending order, to which some particle moved so far that it may have gone another way.
  const std::vector<std::size_t>& doubtful_frames() const { return doubtful_; }

 private:
  void compare_with_flight(const Configuration<Dim>& next, std::size_t i) const {
    const Vec<Dim>& velocity = next.velocity[i];
    constexpr double rounding = 1e-6;  // of numbers in single precision
    if ((velocity - last_->velocity[i]).cwiseAbs().maxCoeff() >
        rounding * velocity.cwiseAbs().maxCoeff())
      return;
    const Vec<Dim> flight = velocity * (next.time - last_->time);
    const Vec<Dim> step = next.unwrapped(i) - last_->unwrapped(i);
    if (((flight - step).cwiseAbs() - 0.5 * next.box.lengths()).maxCoeff() > 0)
      throw UserError(fmt::format(
          "particle {} has the same velocity as in the frame before and flew by ({}), but its "
          "nearest image moved by ({}); unwrap = \"nearest\" does not hold for frames so far apart",
          i, fmt::join(flight, ", "), fmt::join(step, ", ")));
  }

  struct Step {
    double box_lengths = 0;  ///< length of the step along one direction
    std::size_t particle = 0, frame = 0;
    int direction = 0;
  };

  std::optional<Configuration<Dim>> last_;
  std::size_t frames_ = 0;
  Step longest_;
  std::vector<std::size_t> doubtful_;
};

namespace fs = std::filesystem;

/// A file that nobody else uses, and that is removed at the end of the scope.
class TemporaryFile {
 public:
  TemporaryFile() : name_((fs::temp_directory_path() / "vitrel-XXXXXX").string()) {
    const int descriptor = mkstemp(name_.data());
    if (descriptor < 0)
      throw FileError(fmt::format("{}: cannot make the file: {}", name_, std::strerror(errno)));
    static_cast<void>(close(descriptor));
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(name_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

/// Returns whether vitrel wrote the file.
bool is_own(const h5::Group& root) {
  constexpr const char* creator = "h5md/creator";
  return root.has_group(creator) && root.group(creator).has_attribute("name") &&
         root.group(creator).text_attribute("name") == "vitrel";
}

/// Replaces the unit of length of the file by that of the results.
void rescale(ForeignFrame& frame, double unit) {
  if (frame.box) *frame.box /= unit;
  for (auto* vectors : {&frame.position, &frame.unwrapped, &frame.half_lengths, &frame.velocity})
    for (Vec3& vector : *vectors) vector /= unit;
}

/// Returns the names of what a frame states.
std::vector<std::string> parts_of(const ForeignFrame& frame) {
  const std::pair<bool, const char*> parts[] = {
      {!frame.position.empty(), "positions"},
      {!frame.unwrapped.empty(), "unwrapped positions"},
      {!frame.image.empty(), "box crossings"},
      {!frame.angle.empty(), "angles"},
      {!frame.orientation.empty(), "orientations"},
      {!frame.half_lengths.empty(), "semi-axes"},
      {!frame.species.empty(), "species"},
      {!frame.mass.empty(), "masses"},
      {!frame.velocity.empty(), "velocities"},
      {!frame.angular_velocity.empty(), "angular velocities"},
      {!frame.id.empty(), "ids"},
      {frame.time.has_value(), "times"},
      {frame.step.has_value(), "steps"}};
  std::vector<std::string> texts;
  for (const auto& [is_there, name] : parts)
    if (is_there) texts.emplace_back(name);
  return texts;
}

/// Converts all frames to vitrel's own form.
template <int Dim>
class Conversion {
 public:
  Conversion(const ForeignFormat& format, const KnownSystem& known, const fs::path& copy)
      : format_(format), known_(known), copy_(copy) {}

  /// Adds a frame. Throws UserError.
  void add(ForeignFrame frame) {
    if (number_ == 0) require_sizes(frame);
    if (Dim == 2 && put_longer_axis_first(frame)) is_turned_ = true;
    Configuration<Dim> next = configuration_of<Dim>(frame, known_);
    next.time = time_of(frame);
    if (number_ == 0) begin(frame, next);
    require_parts_of_first(frame);
    if (!same_particles(*first_, next) || frame.id != first_frame_.id)
      throw UserError(
          "has other particles than frame 0; their number, ids, species, masses and semi-axes "
          "should be the same");
    if (images_) images_->set(next, stores_velocities_ && frame.time);
    writer_->write(next, frame.step.value_or(static_cast<std::int64_t>(number_)));
    ++number_;
  }

  void close() { writer_->close(); }
  std::vector<std::size_t> doubtful_frames() const {
    return images_ ? images_->doubtful_frames() : std::vector<std::size_t>();
  }
  bool counts_steps() const { return first_frame_.step.has_value(); }
  bool knows_time() const {
    return first_frame_.time.has_value() || known_.import.time_per_step.has_value();
  }
  ImportReport report() const {
    ImportReport report = {
        {"format", format_.name},
        {"frames", fmt::format("{} of {} particles in {}", number_, first_->size(),
                               Dim == 2 ? "the plane" : "space")}};
    const auto add = [&](const char* heading, const Texts& texts) {
      if (!texts.empty()) report.emplace_back(heading, fmt::format("{}", fmt::join(texts, ", ")));
    };
    add("read", read());
    add("absent", absent());
    Texts converted;
    if (is_turned_)
      converted.emplace_back("semi-axes a < b are exchanged, and their particles turned by π/2");
    if (known_.import.length_unit != 1)
      converted.push_back(fmt::format("lengths are divided by {:g}", known_.import.length_unit));
    if (known_.import.time_per_step)
      converted.push_back(fmt::format("times are steps times {:g}", *known_.import.time_per_step));
    add("converted", converted);
    if (images_) add("box crossings", {images_->remark()});
    add("skipped", {first_frame_.skipped.begin(), first_frame_.skipped.end()});
    return report;
  }

 private:
  using Texts = std::vector<std::string>;

  void require_sizes(const ForeignFrame& frame) const {
    if (!frame.box && !known_.box)
      throw UserError(
          fmt::format("has no box: it has no {}, and import.box gives none", format_.words.box));
    if (!frame.half_lengths.empty()) return;
    const auto has_axes = [](const KnownSpecies& species) {
      return species.half_lengths.has_value();
    };
    const auto is_known = [&](const std::string& name) {
      return std::ranges::any_of(known_.species, [&](const KnownSpecies& species) {
        return species.name == name && has_axes(species);
      });
    };
    const std::set<std::string> names(frame.species.begin(), frame.species.end());
    Texts missing;
    std::ranges::copy_if(names, std::back_inserter(missing),
                         [&](const std::string& name) { return !is_known(name); });
    if (names.empty() && !std::ranges::any_of(known_.species, has_axes)) missing = {"A"};
    if (!missing.empty())
      throw UserError(fmt::format(
          "has no sizes: it has no {}, and neither [[import.species]] nor [[species]] gives "
          "diameter or semi-axes of {}",
          format_.words.sizes, fmt::join(missing, ", ")));
  }

  /// Throws UserError if the frame does not state what frame 0 states: nothing stands in for what is missing.
  void require_parts_of_first(const ForeignFrame& frame) const {
    const Texts parts = parts_of(frame), first = parts_of(first_frame_);
    if (parts != first)
      throw UserError(fmt::format("states {}, but frame 0 states {}", fmt::join(parts, ", "),
                                  fmt::join(first, ", ")));
  }

  double time_of(const ForeignFrame& frame) const {
    const std::optional<double>& per_step = known_.import.time_per_step;
    if (per_step && !frame.step)
      throw UserError("import.time_per_step needs steps, but it has none");
    const double counted =
        static_cast<double>(frame.step.value_or(static_cast<std::int64_t>(number_)));
    const double time = per_step ? *per_step * counted : frame.time.value_or(counted);
    constexpr double rounding = 1e-6;
    if (per_step && frame.time && std::abs(time - *frame.time) > rounding * std::abs(time))
      throw UserError(
          fmt::format("its time is {}, but its step {} times import.time_per_step is {}",
                      *frame.time, *frame.step, time));
    return time;
  }

  void begin(const ForeignFrame& frame, const Configuration<Dim>& first) {
    first_ = first;
    first_frame_ = frame;
    // Velocities without angular velocities would give bodies that do not rotate, and energies without that of
    // rotation.
    has_half_of_velocities_ =
        frame.velocity.empty() != frame.angular_velocity.empty() && rotor_count(first) > 0;
    stores_velocities_ = !frame.velocity.empty() && !has_half_of_velocities_;
    TrajectoryOptions options{.velocities = stores_velocities_};
    options.images = !frame.image.empty() || !frame.unwrapped.empty();
    options.angles = !frame.angle.empty();
    if (known_.import.unwrap == ImportOptions::Unwrap::nearest && !options.images)
      images_.emplace();
    options.images = options.images || images_;
    options.overwrite = true;
    writer_.emplace(TrajectoryWriter::create(copy_, first, Provenance{}, options));
  }

  std::vector<std::string> read() const {
    Texts texts = parts_of(first_frame_);
    std::erase_if(texts, [&](const std::string& part) {
      return first_frame_.assumed.contains(part) ||
             (has_half_of_velocities_ && part.ends_with("velocities"));
    });
    return texts;
  }
  std::vector<std::string> absent() const {
    const ForeignFrame& frame = first_frame_;
    Texts texts;
    for (const auto& [name, otherwise] : frame.assumed)
      texts.push_back(fmt::format("{} ({})", name, otherwise));
    const auto note = [&](bool is_absent, const std::string& text) {
      if (is_absent) texts.push_back(text);
    };
    const bool has_images = !frame.image.empty() || !frame.unwrapped.empty();
    note(frame.species.empty(),
         fmt::format("species (all are \"{}\")", first_->species_names.front()));
    const bool has_masses = std::ranges::all_of(
        known_.species, [](const KnownSpecies& s) { return s.mass.has_value(); });
    note(frame.mass.empty(),
         known_.species.empty() || !has_masses
             ? fmt::format("masses (in proportion to the {}, 1 where {} = 1)",
                           Dim == 2 ? "area" : "volume", Dim == 2 ? "a b" : "a b c")
             : "masses (those of the species)");
    note(frame.half_lengths.empty(), "semi-axes (those of the species)");
    note(!stores_velocities_, has_half_of_velocities_
                                  ? "angular velocities (so velocities are left out, too)"
                                  : "velocities (energies are left out)");
    note(!has_images && !images_ && number_ > 1, "box crossings (motion is left out)");
    note(!knows_time() && number_ > 1,
         frame.step ? "times (they are counted in steps)" : "times (they are counted in frames)");
    return texts;
  }

  const ForeignFormat& format_;
  const KnownSystem& known_;
  fs::path copy_;
  std::optional<Configuration<Dim>> first_;
  ForeignFrame first_frame_;
  std::optional<NearestImages<Dim>> images_;
  std::optional<TrajectoryWriter> writer_;
  std::uint64_t number_ = 0;
  bool is_turned_ = false, has_half_of_velocities_ = false, stores_velocities_ = false;
};

/// The frames of a file in the unit of length of the results.
class RescaledFrames {
 public:
  RescaledFrames(std::unique_ptr<ForeignFrames> frames, double length_unit)
      : frames_(std::move(frames)), length_unit_(length_unit) {}
  bool next(ForeignFrame& frame) {
    if (!frames_->next(frame)) return false;
    if (length_unit_ != 1) rescale(frame, length_unit_);
    return true;
  }
  /// The user's own unit of length has no name.
  FileUnits units() const {
    FileUnits units = frames_->units();
    if (length_unit_ != 1) units.length.clear();
    return units;
  }

 private:
  std::unique_ptr<ForeignFrames> frames_;
  double length_unit_;
};

/// Frame 0, and the frames that follow.
struct OpenFrames {
  const ForeignFormat& format;
  RescaledFrames frames;
  ForeignFrame first;
  int dimension;
};

OpenFrames open_frames(const fs::path& path, const KnownSystem& known) {
  const ForeignFormat& format = format_of(path, known.import);
  OpenFrames open{format, {format.open(path, known.import), known.import.length_unit}, {}, 0};
  if (!open.frames.next(open.first)) throw FileError(path.string() + ": has no frames");
  open.dimension = with_place(path.string(),
                              [&] { return dimension_of(open.first, known, format.words.plane); });
  return open;
}

template <int Dim>
ImportedFile convert(const fs::path& path, OpenFrames& open, const KnownSystem& known) {
  const TemporaryFile copy;
  Conversion<Dim> conversion(open.format, known, copy.name());
  ForeignFrame& frame = open.first;
  std::uint64_t number = 0;
  do {
    with_place(fmt::format("{}: frame {}", path.string(), number),
               [&] { conversion.add(std::move(frame)); });
    ++number;
  } while (open.frames.next(frame));
  conversion.close();
  FileUnits units = open.frames.units();
  if (known.import.time_per_step) units.time.clear();
  if (!conversion.knows_time()) units.time = conversion.counts_steps() ? "steps" : "frames";
  if (units.length.empty()) units.length = "(unit of length)";
  if (units.time.empty()) units.time = "(unit of time)";
  return {h5::File::open(copy.name(), h5::Access::read),
          conversion.report(),
          open.format.words.box_crossings,
          known.import.angles == ImportOptions::Angles::directors,
          conversion.doubtful_frames(),
          std::move(units)};
}

/// Returns the open file if it is an HDF5 file that vitrel wrote.
std::optional<h5::File> own_file(const fs::path& path, const ImportOptions& options) {
  if (&format_of(path, options) != &h5md_format) return std::nullopt;
  h5::File file = h5::File::open(path, h5::Access::read);
  const bool is_own_file = h5::read_consistently(
      file, [&] { return is_own(file.root()); }, [] {});
  return is_own_file ? std::optional(std::move(file)) : std::nullopt;
}

}  // namespace

ImportedFile open_as_h5md(const fs::path& path, const KnownSystem& known) {
  if (auto own = own_file(path, known.import)) return {std::move(*own), {}, "dataset image/value"};
  OpenFrames open = open_frames(path, known);
  return (open.dimension == 2 ? convert<2> : convert<3>)(path, open, known);
}

int dimension_of_file(const fs::path& path, const KnownSystem& known) {
  if (own_file(path, known.import)) return TrajectoryReader(path).dimension();
  return open_frames(path, known).dimension;
}

}  // namespace vitrel
