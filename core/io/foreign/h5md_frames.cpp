#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/io/box_crossings.h"
#include "core/io/commit_record.h"
#include "core/io/foreign/foreign_formats.h"
#include "core/io/h5.h"
#include "core/whole_number.h"

namespace vitrel {
namespace {

/// An element of the particles: a dataset if it is the same in all frames, or else a group with the datasets step, time
/// and value.
class Element {
 public:
  Element(const h5::Group& particles, const std::string& name)
      : is_fixed_(particles.has_dataset(name)),
        value_(particles.dataset(is_fixed_ ? name : name + "/value")) {
    if (!is_fixed_ && value_.shape().empty())
      throw UserError(fmt::format("{} is a single number, but needs one for each frame", name));
    if (is_fixed_ || !particles.has_dataset(name + "/step")) return;
    steps_ = axis(particles.dataset(name + "/step"));
    if (particles.has_dataset(name + "/time")) {
      const h5::Dataset time = particles.dataset(name + "/time");
      times_ = axis(time);
      time_unit_ = unit_of(time);
    }
  }

  bool is_fixed() const { return is_fixed_; }
  /// Gives an element without steps of its own those of the positions, if it has as many frames.
  void take_steps(const Element& position) {
    if (is_fixed_ || !steps_.empty()) return;
    if (value_.shape()[0] != position.steps_.size())
      throw UserError(fmt::format("{} has {} frames and no steps, but the positions have {}",
                                  name(), value_.shape()[0], position.steps_.size()));
    steps_ = position.steps_;
  }
  const std::string& name() const { return value_.name(); }
  const std::vector<double>& steps() const { return steps_; }
  const std::vector<double>& times() const { return times_; }
  std::string unit() const { return unit_of(value_); }
  const std::string& time_unit() const { return time_unit_; }
  std::vector<std::string> labels() const { return value_.enumeration(); }

  /// Returns the shape without the direction of frames.
  h5::Shape shape() const {
    h5::Shape shape = value_.shape();
    if (!is_fixed_) shape.erase(shape.begin());
    return shape;
  }

  /// Returns the values at this step.
  std::vector<double> values(double step) const {
    if (is_fixed_) return value_.read<double>();
    // Steps may repeat, so the frame after the last one read is tried first.
    const auto here = last_ < steps_.size() && steps_[last_] == step
                          ? steps_.begin() + static_cast<std::ptrdiff_t>(last_)
                          : std::ranges::find(steps_, step);
    if (here == steps_.end())
      throw UserError(fmt::format("{} has no frame at step {}", name(), step));
    const auto frame = static_cast<std::uint64_t>(here - steps_.begin());
    last_ = frame + 1;
    const h5::Shape one = shape();
    return value_.read_frames<double>(
        frame, 1, std::accumulate(one.begin(), one.end(), std::uint64_t{1}, std::multiplies<>()));
  }

 private:
  static std::string unit_of(const h5::Dataset& values) {
    return values.has_attribute("unit") ? values.text_attribute("unit") : std::string();
  }

  /// Expands steps or times to one number per frame; the file may state only the increment.
  std::vector<double> axis(const h5::Dataset& values) const {
    std::vector<double> numbers = values.read<double>();
    if (!values.shape().empty()) return numbers;
    const double increment = numbers.at(0);
    const double offset =
        values.has_attribute("offset") ? values.number_attribute<double>("offset") : 0;
    numbers.resize(value_.shape()[0]);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      numbers[k] = offset + increment * static_cast<double>(k);
    return numbers;
  }

  bool is_fixed_;
  h5::Dataset value_;
  std::vector<double> steps_, times_;
  std::string time_unit_;
  mutable std::size_t last_ = 0;
};

constexpr std::array known_elements = {"position", "image",  "orientation", "angle",
                                       "velocity", "radius", "semiaxes",    "angular_velocity",
                                       "mass",     "id",     "species",     "box/edges"};

class H5mdFrames final : public ForeignFrames {
 public:
  H5mdFrames(const std::filesystem::path& path, const ImportOptions& options)
      : path_(path),
        root_(h5::File::open(path, h5::Access::read).root()),
        group_(group_of(options)),
        particles_(root_.group(group_)),
        elements_(with_place(path.string(), [&] { return elements_of(particles_); })),
        position_(positions()) {
    const std::size_t times = position_.times().size();
    if (times > 0 && times < position_.steps().size())
      fail("position/time has fewer frames than position/step");
    with_place(path_.string(), [&] {
      for (auto& [name, element] : elements_) element.take_steps(position_);
      require_units();
      set_dimension();
    });
  }

  FileUnits units() const override { return units_; }

  bool next(ForeignFrame& frame) override {
    if (frame_ >= (position_.is_fixed() ? 1 : position_.steps().size())) return false;
    frame = {};
    frame.dimension = dimension_;
    with_place(fmt::format("{}: frame {}", path_.string(), frame_), [&] { read(frame); });
    ++frame_;
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(path_.string() + ": " + what);
  }

  std::string group_of(const ImportOptions& options) const {
    if (!root_.has_group("particles")) fail("has no group particles, which all H5MD files have");
    const std::vector<std::string> groups = root_.group("particles").members();
    if (groups.empty()) fail("the group particles is empty: it should hold one group of particles");
    const std::string names = fmt::format("{}", fmt::join(groups, ", "));
    if (!options.group && groups.size() > 1)
      fail(fmt::format("has {} groups of particles, {}; import.group names the one to be read",
                       groups.size(), names));
    const std::string group = options.group.value_or(groups.front());
    if (std::ranges::find(groups, group) == groups.end())
      fail(fmt::format("has no group of particles {}, which import.group names, but {}", group,
                       names));
    return "particles/" + group;
  }

  static std::map<std::string, Element> elements_of(const h5::Group& particles) {
    std::map<std::string, Element> elements;
    for (const std::string name : known_elements)
      if (particles.has_dataset(name) || particles.has_dataset(name + "/value"))
        elements.emplace(name, Element(particles, name));
    return elements;
  }

  const Element& positions() const {
    const Element* const found = find("position");
    if (!found) fail(group_ + " has no position");
    return *found;
  }

  const Element* find(const std::string& name) const {
    const auto found = elements_.find(name);
    return found == elements_.end() ? nullptr : &found->second;
  }

  void require_units() {
    StatedUnits units;
    const auto add = [&](std::vector<StatedUnits::Named>& named, const char* name) {
      if (const Element* const element = find(name))
        named.emplace_back(element->name(), element->unit());
    };
    for (const char* name : {"position", "box/edges", "semiaxes", "radius"})
      add(units.lengths, name);
    add(units.angles, "angle");
    add(units.velocities, "velocity");
    units.time = position_.time_unit();
    units_ = require_agreement(units);
  }

  /// Sets the dimension from the attributes of the box, or from a flat shape.
  void set_dimension() {
    if (particles_.has_group("box")) {
      const h5::Group box = particles_.group("box");
      if (box.has_attribute("boundary")) {
        const std::vector<std::string> words = box.texts_attribute("boundary");
        std::array<bool, 3> periodic = {true, true, true};
        const std::string statement =
            fmt::format("boundary of {} is {}", box.name(), fmt::join(words, ", "));
        for (std::size_t k = 0; k < words.size() && k < 3; ++k) {
          if (words[k] != "none" && words[k] != "periodic")
            throw UserError(statement +
                            ", but should be \"periodic\" or \"none\" for each direction");
          periodic[k] = words[k] == "periodic";
        }
        dimension_ = dimension_of_boundaries(periodic, statement);
        states_boundaries_ = true;
      }
      if (box.has_attribute("dimension") && box.number_attribute<std::int64_t>("dimension") == 2)
        dimension_ = 2;
    }
    const h5::Shape shape = position_.shape();
    if (shape.size() != 2 || shape[1] < 2 || shape[1] > 3)
      fail(position_.name() + " should have the shape particles × 2 or 3");
    if (shape[1] == 2 || has_flat_shapes()) dimension_ = 2;
  }

  bool has_flat_shapes() const {
    const Element* const semiaxes = find("semiaxes");
    if (!semiaxes || !semiaxes->is_fixed()) return false;
    const h5::Shape shape = semiaxes->shape();
    if (shape.size() != 2) return false;
    const std::vector<double> axes = semiaxes->values(0);
    return shape[1] == 2 || (shape[1] == 3 && axes.size() > 2 && axes[2] == 0);
  }

  /// Returns rows of `least` to `most` numbers for each particle.
  std::vector<std::vector<double>> rows(const std::string& name, std::size_t least,
                                        std::size_t most) const {
    const Element* const element = find(name);
    if (!element) return {};
    const h5::Shape shape = element->shape();
    const std::size_t width = shape.size() == 2 ? shape[1] : 1;
    if (shape.empty() || shape.size() > 2 || shape[0] != order_.size() || width < least ||
        width > most)
      fail(fmt::format("{} should have {} numbers for each of {} particles", element->name(), least,
                       order_.size()));
    const std::vector<double> values = element->values(step_);
    std::vector<std::vector<double>> result(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const auto row = values.begin() + static_cast<std::ptrdiff_t>(order_[i] * width);
      result[i].assign(row, row + static_cast<std::ptrdiff_t>(width));
      if (!std::ranges::all_of(result[i], [](double x) { return std::isfinite(x); }))
        fail(
            fmt::format("{} has numbers that are not finite in frame {}", element->name(), frame_));
    }
    return result;
  }

  std::vector<double> numbers(const std::string& name) const {
    std::vector<double> result;
    for (const auto& row : rows(name, 1, 1)) result.push_back(row[0]);
    return result;
  }

  std::vector<Vec3> vectors(const std::string& name) const {
    std::vector<Vec3> result;
    for (const auto& row : rows(name, 2, 3))
      result.emplace_back(row[0], row[1], row.size() == 3 ? row[2] : 0);
    return result;
  }

  void read(ForeignFrame& frame) {
    step_ = position_.is_fixed() ? 0 : position_.steps()[frame_];
    if (!position_.is_fixed()) {
      frame.step = whole_number<std::int64_t>(std::round(step_));
      if (!frame.step)
        throw UserError(fmt::format("the step is {}, but should be a whole number", step_));
      if (!position_.times().empty()) frame.time = position_.times()[frame_];
    }
    set_order();
    set_box(frame);
    frame.id = numbers("id");
    frame.position = vectors("position");
    for (const Vec3& image : vectors("image")) {
      const auto crossings = box_crossings<3>(image);
      if (!crossings) throw UserError("image has impossible numbers");
      frame.image.push_back(*crossings);
    }
    frame.angle = numbers("angle");
    for (const auto& q : rows("orientation", 4, 4))
      frame.orientation.emplace_back(q[0], q[1], q[2], q[3]);
    frame.velocity = vectors("velocity");
    for (const auto& row : rows("angular_velocity", 1, 3))
      frame.angular_velocity.emplace_back(row.size() == 3 ? row[0] : 0,
                                          row.size() == 3 ? row[1] : 0, row.back());
    frame.half_lengths = vectors("semiaxes");
    for (const double radius :
         frame.half_lengths.empty() ? numbers("radius") : std::vector<double>())
      frame.half_lengths.push_back(Vec3::Constant(radius));
    frame.mass = numbers("mass");
    set_species(frame);
    if (!states_boundaries_) frame.assumed["boundaries"] = "periodic";
    note_skipped(frame);
  }

  /// Sorts particles by ascending id, so that every particle keeps its place.
  void set_order() {
    order_.resize(position_.shape()[0]);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const std::vector<double> id = numbers("id");
    if (id.empty()) return;
    const auto id_of = [&](std::size_t i) { return id[i]; };
    std::ranges::stable_sort(order_, {}, id_of);
    const auto twice = std::ranges::adjacent_find(order_, {}, id_of);
    if (twice != order_.end()) throw UserError(fmt::format("the id {} comes twice", id[*twice]));
  }

  void set_box(ForeignFrame& frame) const {
    const Element* const edges = find("box/edges");
    if (!edges) return;
    const h5::Shape shape = edges->shape();
    const std::size_t d = shape.empty() ? 0 : shape[0];
    if (d < 2 || d > 3 || shape.size() > 2 || (shape.size() == 2 && shape[1] != d))
      throw UserError(edges->name() + " should hold 2 or 3 lengths, or as many cell vectors");
    const std::vector<double> values = edges->values(step_);
    frame.box = Vec3(Vec3::Ones());
    for (std::size_t k = 0; k < d; ++k) {
      (*frame.box)[static_cast<int>(k)] = values[shape.size() == 2 ? k * d + k : k];
      for (std::size_t l = 0; shape.size() == 2 && l < d; ++l)
        if (l != k && values[k * d + l] != 0)
          throw UserError("the box should be a cuboid with edges along x, y and z");
    }
    if (d == 2) frame.dimension = 2;
  }

  /// Names species by their labels, or by their numbers.
  void set_species(ForeignFrame& frame) const {
    const Element* const species = find("species");
    if (!species) return;
    const std::vector<std::string> labels = species->labels();
    for (const double number : numbers("species")) {
      const auto k = whole_number<std::size_t>(number);
      const bool is_labelled = k && *k < labels.size() && !labels[*k].empty();
      frame.species.push_back(is_labelled ? labels[*k] : fmt::format("{}", number));
    }
  }

  void note_skipped(ForeignFrame& frame) const {
    for (const std::string& name : particles_.members())
      if (name != "box" && std::ranges::find(known_elements, name) == known_elements.end())
        frame.skipped.insert(name);
    if (root_.has_group("observables")) frame.skipped.insert("observables");
    if (find("semiaxes") && find("radius")) frame.skipped.insert("radius, as semiaxes says more");
  }

  std::filesystem::path path_;
  h5::Group root_;
  std::string group_;
  h5::Group particles_;
  std::map<std::string, Element> elements_;
  const Element& position_;
  std::optional<int> dimension_;
  bool states_boundaries_ = false;
  FileUnits units_;
  std::size_t frame_ = 0;
  double step_ = 0;
  std::vector<std::size_t> order_;  ///< order of the particles in the file
};

/// Returns whether a file is HDF5, from its first 4096 bytes: HDF5 leaves the first 0, 512, 1024 … bytes to others.
bool is_hdf5(std::string_view start) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  const auto& record = CommitRecord().magic;  // begins every file of vitrel, however short
  if (start.starts_with(signature) || start.starts_with({record.data(), record.size()}))
    return true;
  for (std::size_t at = 512; at < start.size(); at *= 2)
    if (start.substr(at).starts_with(signature)) return true;
  return false;
}

}  // namespace

constexpr ForeignFormat h5md_format = {
    "H5MD",
    {"box/edges", "\"none\" as the third word of the attribute boundary of box",
     "dataset semiaxes or radius", "dataset image/value"},
    is_hdf5,
    [](const std::filesystem::path& path, const ImportOptions& options)
        -> std::unique_ptr<ForeignFrames> { return std::make_unique<H5mdFrames>(path, options); }};

}  // namespace vitrel
