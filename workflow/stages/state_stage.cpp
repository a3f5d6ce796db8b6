#include "workflow/stages/state_stage.h"

#include <fmt/format.h>

#include "core/io/foreign/foreign_formats.h"
#include "workflow/stages/stage_fields.h"

namespace vitrel {
namespace {

using Rows = StateStage::Rows;

/// Describes an array of rows of numbers; a row of one number may be written as the number itself.
void describe_rows(const Field& field, std::optional<Rows>& rows, Rows example,
                   FieldVisitor& visit) {
  visit.optional(field, rows, std::move(example), [&](FieldVisitor& in, Rows& inner) {
    in.array(field, inner, {0}, [](const Field& key, Rows::value_type& row, FieldVisitor& entry) {
      entry.number_or_numbers(key, row);
    });
  });
}

void describe_file(StateStage& stage, FieldVisitor& visit) {
  visit.optional({"file", "",
                  fmt::format("A state or run, whose last frame is taken, of vitrel or another "
                              "program: {} (docs/imports.md). Relative to the parameter file.",
                              foreign_format_names())},
                 stage.file, std::string("state.h5"));
}

void describe_overlaps(StateStage& stage, FieldVisitor& visit) {
  static constexpr const char* names[] = {"stop", "shrink"};
  visit.field({"on_overlap", "",
               "Overlapping particles are an error, or all particles are scaled until the first "
               "two touch. Contacts of dense states stored in single precision become overlaps."},
              stage.on_overlap, names);
}

void describe_box(StateStage& stage, FieldVisitor& visit) {
  visit.optional({"box", "length",
                  "Edges [L_x, L_y] or [L_x, L_y, L_z] of the box, centred at the origin, unless "
                  "the file has it."},
                 stage.box, std::vector<double>{10, 10});
}

void describe_positions(StateStage& stage, FieldVisitor& visit) {
  describe_rows({"positions", "length",
                 "Instead of a file: the positions [x, y] or [x, y, z] of all particles."},
                stage.positions, {{0, 0}, {3, 0}}, visit);
}

void describe_angles(StateStage& stage, FieldVisitor& visit) {
  visit.optional({"angles", "radians",
                  "In two dimensions: angles from the x axis to the major axes. The default is 0."},
                 stage.angles, std::vector<double>{0, 0.5});
}

void describe_quaternions(StateStage& stage, FieldVisitor& visit) {
  describe_rows({"quaternions", "",
                 "In three dimensions: quaternions [w, x, y, z], which turn the axes of the bodies "
                 "to those of space. The default is [1, 0, 0, 0]."},
                stage.quaternions, {{1, 0, 0, 0}, {0, 1, 0, 0}}, visit);
}

void describe_velocities(StateStage& stage, FieldVisitor& visit) {
  describe_rows({"velocities", "length/time",
                 "The default is 0. A run uses them with initial_velocities = \"keep\"."},
                stage.velocities, {{0, 0}, {-1, 0}}, visit);
}

void describe_angular_velocities(StateStage& stage, FieldVisitor& visit) {
  describe_rows({"angular_velocities", "radians/time",
                 "A number per particle, in three dimensions a vector [ω_x, ω_y, ω_z] in the axes "
                 "of space. The default is 0."},
                stage.angular_velocities, {{0}, {3.14}}, visit);
}

void describe_semi_axes(StateStage& stage, FieldVisitor& visit) {
  describe_rows({"semi_axes", "length",
                 "Semi-axes [a, b] or [a, b, c] of every particle. By default those of its "
                 "species."},
                stage.semi_axes, {{1, 0.5}, {1, 0.5}}, visit);
}

void describe_species_names(StateStage& stage, FieldVisitor& visit) {
  const Field field{"species", "", "The name of every particle's species, if there are several."};
  visit.optional(field, stage.species, std::vector<std::string>{"A", "A"},
                 [&](FieldVisitor& in, std::vector<std::string>& names) {
                   in.array(field, names, "",
                            [](const Field& key, std::string& name, FieldVisitor& entry) {
                              entry.field(key, name);
                            });
                 });
}

void describe_masses(StateStage& stage, FieldVisitor& visit) {
  visit.optional(
      {"masses", "mass", "The default is a b (a b c), or the mass of the species.", bounds::mass},
      stage.masses, std::vector<double>{0.5, 0.5});
}

/// `names` is the plural of what is counted, for example "positions".
template <class Array>
void validate_number(const std::optional<Array>& array, const char* names, std::size_t particles,
                     const Rules& rules) {
  rules.require(
      !array || array->size() == particles, names,
      fmt::format("has {} entries, but positions has {}", array ? array->size() : 0, particles));
}

void validate_rows(const std::optional<Rows>& rows, const char* names, std::size_t columns,
                   std::size_t particles, const Rules& rules) {
  validate_number(rows, names, particles, rules);
  if (!rows) return;
  for (std::size_t i = 0; i < rows->size(); ++i)
    rules.require((*rows)[i].size() == columns, names,
                  fmt::format("has {} numbers for particle {}, but must have {}", (*rows)[i].size(),
                              i, columns));
}

std::vector<Vec3> vectors(const std::optional<Rows>& rows) {
  std::vector<Vec3> result;
  for (const std::vector<double>& row : rows.value_or(Rows())) {
    Vec3& vector = result.emplace_back(Vec3::Zero());
    for (std::size_t k = 0; k < row.size(); ++k) vector[static_cast<int>(k)] = row[k];
  }
  return result;
}

}  // namespace

std::vector<StageField<StateStage>> StateStage::fields() {
  return {{"file", describe_file},
          {"on_overlap", describe_overlaps},
          {"box", describe_box},
          {"positions", describe_positions},
          {"angles", describe_angles},
          {"quaternions", describe_quaternions},
          {"velocities", describe_velocities},
          {"angular_velocities", describe_angular_velocities},
          {"semi_axes", describe_semi_axes},
          {"species", describe_species_names},
          {"masses", describe_masses}};
}

void StateStage::validate(const Rules& rules, int dimension) const {
  rules.require(
      file.has_value() != positions.has_value(), "file",
      file ? "excludes positions; give one or the other" : "is missing; give a file, or positions");
  const auto d = static_cast<std::size_t>(dimension);
  rules.require(!box || box->size() == d, "box",
                fmt::format("has {} edges, but must have {}", box ? box->size() : 0, d));
  rules.require(!positions || box.has_value(), "box", "is missing; positions need a box");
  const std::size_t n = positions ? positions->size() : 0;
  rules.require(!positions || n > 0, "positions", "is empty, but there must be a particle");
  rules.require(!angles || dimension == 2, "angles", "is for two dimensions; give quaternions");
  rules.require(!quaternions || dimension == 3, "quaternions",
                "is for three dimensions; give angles");
  validate_rows(positions, "positions", d, n, rules);
  validate_rows(velocities, "velocities", d, n, rules);
  validate_rows(semi_axes, "semi_axes", d, n, rules);
  validate_rows(quaternions, "quaternions", 4, n, rules);
  validate_rows(angular_velocities, "angular_velocities", dimension == 2 ? 1 : 3, n, rules);
  validate_number(angles, "angles", n, rules);
  validate_number(masses, "masses", n, rules);
  validate_number(species, "species", n, rules);
}

std::string StateStage::description() const {
  return file ? "the state in " + *file : "the state in the parameter file";
}

StageReport StateStage::advance(NoState&, const StageContext&) const {
  return {StageEnd::reached, "as given"};
}

ForeignFrame StateStage::frame(int dimension) const {
  ForeignFrame frame;
  frame.dimension = dimension;
  frame.position = vectors(positions);
  frame.velocity = vectors(velocities);
  frame.half_lengths = vectors(semi_axes);
  frame.angle = angles.value_or(std::vector<double>());
  frame.mass = masses.value_or(std::vector<double>());
  frame.species = species.value_or(std::vector<std::string>());
  for (const std::vector<double>& q : quaternions.value_or(Rows()))
    frame.orientation.emplace_back(q[0], q[1], q[2], q[3]);
  for (const std::vector<double>& omega : angular_velocities.value_or(Rows()))
    frame.angular_velocity.push_back(dimension == 2 ? Vec3(0, 0, omega[0])
                                                    : Vec3(omega[0], omega[1], omega[2]));
  if (dimension == 2 && !angles) frame.angle.assign(frame.position.size(), 0);
  if (dimension == 3 && !quaternions)
    frame.orientation.assign(frame.position.size(), Quaternion::Identity());
  return frame;
}

}  // namespace vitrel
