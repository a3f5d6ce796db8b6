#include "core/io/foreign/foreign_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/io/foreign/csv_frames.h"
#include "core/io/foreign/gsd_frames.h"
#include "core/io/foreign/nearest_images.h"
#include "core/io/foreign/xyz_frames.h"
#include "core/io/h5md.h"

namespace vitrel {
namespace {

namespace fs = std::filesystem;

enum class Format { hdf5, gsd, xyz, csv };

/// By the first bytes.
Format format_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, 8> start{};
  stream.read(start.data(), start.size());
  const std::string_view bytes(start.data(), static_cast<std::size_t>(stream.gcount()));
  // What cannot be opened or is empty is no HDF5 file either, as which it is refused.
  if (bytes.empty() || bytes.starts_with("\x89HDF")) return Format::hdf5;
  if (bytes.starts_with("\xDF\x65\xDF\x65")) return Format::gsd;
  const bool is_binary = bytes.find('\0') != std::string_view::npos;
  if (is_binary) return Format::hdf5;
  const std::size_t first = bytes.find_first_not_of(" \t");
  const bool is_number =
      first != std::string_view::npos && bytes[first] >= '0' && bytes[first] <= '9';
  return is_number ? Format::xyz : Format::csv;
}

std::unique_ptr<ForeignFrames> open_frames(const fs::path& path, Format format) {
  if (format == Format::gsd) return open_gsd(path);
  return format == Format::xyz ? open_xyz(path) : open_csv(path);
}

ForeignFrame first_frame(ForeignFrames& frames, const std::string& path) {
  ForeignFrame frame;
  if (!frames.next(frame)) throw FileError(path + ": has no frames");
  return frame;
}

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

/// Writes frames of the same particles one after the other, with images of its own if these are asked for.
template <int Dim>
class Copy {
 public:
  Copy(const fs::path& path, const Configuration<Dim>& first, TrajectoryOptions options,
       bool unwrap, const Provenance& provenance)
      : first_(first), knows_velocities_(options.velocities) {
    options.overwrite = true;
    if (unwrap && !options.images) images_.emplace();
    options.images = options.images || unwrap;
    writer_ = TrajectoryWriter::create(path, first, provenance, options);
  }

  /// UserError.
  void add(Configuration<Dim> frame, std::int64_t step, bool knows_time) {
    if (!same_particles(first_, frame))
      throw UserError(
          "has other particles than frame 0; their number, species, masses and semi-axes should be "
          "the same");
    if (images_) images_->set(frame, knows_velocities_ && knows_time);
    writer_->write(frame, step);
  }

  /// What is to be said about it.
  std::string close() {
    writer_->close();
    return images_ ? images_->remark() : "";
  }

 private:
  const Configuration<Dim> first_;
  bool knows_velocities_;
  std::optional<NearestImages<Dim>> images_;
  std::optional<TrajectoryWriter> writer_;
};

/// Frames are counted for the messages.
template <class Work>
auto naming_frame(const fs::path& path, std::uint64_t number, Work&& work) {
  try {
    return work();
  } catch (const UserError& error) {
    throw FileError(fmt::format("{}: frame {}: {}", path.string(), number, error.what()));
  }
}

/// Copies all frames; returns a remark.
template <int Dim>
std::string copy_frames(const fs::path& path, ForeignFrames& frames, ForeignFrame& frame,
                        const KnownSystem& known, const fs::path& copy) {
  std::optional<Copy<Dim>> output;
  std::uint64_t number = 0;
  bool is_turned = false;
  do {
    if (Dim == 2 && put_longer_axis_first(frame)) is_turned = true;
    naming_frame(path, number, [&] {
      Configuration<Dim> next = configuration_of<Dim>(frame, known);
      const bool knows_time = frame.time.has_value();
      if (!knows_time && !frame.step) next.time = static_cast<double>(number);
      if (!output) {
        TrajectoryOptions options{.velocities = !frame.velocity.empty()};
        options.images = !frame.image.empty() || !frame.unwrapped.empty();
        options.angles = !frame.angle.empty();
        output.emplace(copy, next, options, known.unwrap_nearest, Provenance{});
      }
      output->add(std::move(next), frame.step.value_or(static_cast<std::int64_t>(number)),
                  knows_time);
    });
    ++number;
  } while (frames.next(frame));
  const std::string remark = output->close();
  if (!is_turned) return remark;
  return "semi-axes a < b are exchanged, and their particles turned by π/2" +
         (remark.empty() ? "" : "; " + remark);
}

template <int Dim>
std::string copy_frames(const TrajectoryReader& original, const fs::path& copy) {
  TrajectoryOptions options{.velocities = original.has("velocity"), .images = false};
  options.angles = original.has("angle");
  Copy<Dim> output(copy, original.read<Dim>(0), options, true, original.provenance());
  for (std::uint64_t k = 0; k < original.frames(); ++k)
    naming_frame(original.path(), k,
                 [&] { output.add(original.read<Dim>(k), original.steps()[k], true); });
  return output.close();
}

ImportedFile open_hdf5(const fs::path& path, const KnownSystem& known) {
  const auto as_it_is = [&] {
    return ImportedFile{h5::File::open(path, h5::Access::read), "", "dataset image/value"};
  };
  if (!known.unwrap_nearest) return as_it_is();
  const TrajectoryReader original(path);
  if (original.frames() < 2 || original.has("image")) return as_it_is();
  const TemporaryFile copy;
  const std::string remark = original.dimension() == 2 ? copy_frames<2>(original, copy.name())
                                                       : copy_frames<3>(original, copy.name());
  return {h5::File::open(copy.name(), h5::Access::read), remark, ""};
}

}  // namespace

ImportedFile open_as_h5md(const fs::path& path, const KnownSystem& known) {
  const Format format = format_of(path);
  if (format == Format::hdf5) return open_hdf5(path, known);
  const TemporaryFile copy;
  const std::unique_ptr<ForeignFrames> frames = open_frames(path, format);
  ForeignFrame first = first_frame(*frames, path.string());
  const std::string remark = dimension_of(first, known) == 2
                                 ? copy_frames<2>(path, *frames, first, known, copy.name())
                                 : copy_frames<3>(path, *frames, first, known, copy.name());
  return {h5::File::open(copy.name(), h5::Access::read), remark, frames->box_crossings()};
}

int dimension_of_file(const fs::path& path, const KnownSystem& known) {
  const Format format = format_of(path);
  if (format == Format::hdf5) return TrajectoryReader(path).dimension();
  return dimension_of(first_frame(*open_frames(path, format), path.string()), known);
}

}  // namespace vitrel
