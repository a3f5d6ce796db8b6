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

/// Copies all frames of a file; frames are counted for the messages.
class Conversion {
 public:
  Conversion(const fs::path& path, Format format, const KnownSystem& known)
      : path_(path.string()), known_(known), frames_(open_frames(path, format)) {}

  void write_to(const fs::path& copy) {
    ForeignFrame frame = first_frame(*frames_, path_);
    dimension_of(frame, known_) == 2 ? write<2>(copy, frame) : write<3>(copy, frame);
  }

 private:
  template <int Dim>
  Configuration<Dim> configuration(const ForeignFrame& frame) const {
    try {
      return configuration_of<Dim>(frame, known_);
    } catch (const UserError& error) {
      throw FileError(fmt::format("{}: frame {}: {}", path_, number_, error.what()));
    }
  }

  template <int Dim>
  void write(const fs::path& copy, ForeignFrame& frame) {
    const Configuration<Dim> first = configuration<Dim>(frame);
    TrajectoryOptions options{.velocities = !frame.velocity.empty(), .overwrite = true};
    options.images = !frame.image.empty() || !frame.unwrapped.empty();
    options.angles = !frame.angle.empty();
    TrajectoryWriter writer = TrajectoryWriter::create(copy, first, Provenance{}, options);
    writer.write(first, frame.step.value_or(0));
    for (number_ = 1; frames_->next(frame); ++number_) {
      Configuration<Dim> next = configuration<Dim>(frame);
      if (!same_particles(first, next))
        throw FileError(
            fmt::format("{}: frame {} has other particles than frame 0; their number, "
                        "species, masses and semi-axes should be the same",
                        path_, number_));
      if (!frame.time && !frame.step) next.time = static_cast<double>(number_);
      writer.write(next, frame.step.value_or(static_cast<std::int64_t>(number_)));
    }
    writer.close();
  }

  std::string path_;
  const KnownSystem& known_;
  std::unique_ptr<ForeignFrames> frames_;
  std::uint64_t number_ = 0;
};

}  // namespace

h5::File open_as_h5md(const fs::path& path, const KnownSystem& known) {
  const Format format = format_of(path);
  if (format == Format::hdf5) return h5::File::open(path, h5::Access::read);
  const TemporaryFile copy;
  Conversion(path, format, known).write_to(copy.name());
  return h5::File::open(copy.name(), h5::Access::read);
}

int dimension_of_file(const fs::path& path, const KnownSystem& known) {
  const Format format = format_of(path);
  if (format == Format::hdf5) return TrajectoryReader(path).dimension();
  return dimension_of(first_frame(*open_frames(path, format), path.string()), known);
}

}  // namespace vitrel
