#include <fmt/format.h>

#include "core/io/foreign/foreign_formats.h"
#include "workflow/configuration/sections.h"
#include "workflow/rules.h"

namespace vitrel {
namespace {

constexpr const char* unwrap_names[] = {"stated", "nearest"};
constexpr const char* angle_names[] = {"turns", "directors"};

void describe_imported_species(ImportOptions::Kind& p, FieldVisitor& visit) {
  visit.field({"name", "", "The species, or type, as the file calls it."}, p.name);
  visit.optional({"diameter", "as the file", "Of disks and spheres.", bounds::length}, p.diameter,
                 1.0);
  visit.optional(
      {"semi_axes", "as the file", "[a, b] in the plane, [a, b, c] in space.", bounds::length},
      p.semi_axes, std::vector{1.0, 0.5});
  visit.optional({"mass", "mass", "Of every particle.", bounds::mass}, p.mass, 1.0);
}

void describe_imported_column(ImportOptions::Column& p, FieldVisitor& visit) {
  visit.field({"file", "", "The name of a column in CSV or a LAMMPS dump, or a property of XYZ."},
              p.file);
  visit.field({"meaning", "", "The column that it is (docs/imports.md), for example qw."},
              p.meaning);
}

}  // namespace

void describe_import(ImportOptions& p, FieldVisitor& visit) {
  visit.optional({"format", "",
                  fmt::format("The format of the file, which its content tells otherwise: {}.",
                              foreign_format_names())},
                 p.format, std::string("CSV"));
  visit.optional({"group", "", "The group of particles in H5MD, if there are several."}, p.group,
                 std::string("all"));
  visit.optional({"dimension", "", "2 or 3, if the file does not say."}, p.dimension, 2);
  visit.optional(
      {"box", "as the file", "Edge lengths, if the file does not have them.", bounds::length},
      p.box, std::vector{10.0, 10.0});
  visit.optional(
      {"time_per_step", "time",
       "Times are the steps of the file times this. Without it, files that have no times "
       "are analysed in steps.",
       bounds::time},
      p.time_per_step, 0.001);
  visit.field(
      {"length_unit", "as the file",
       "All lengths of the file are divided by this, so that it becomes the unit.", bounds::length},
      p.length_unit);
  visit.field({"unwrap", "",
               "How often particles crossed the box, which displacements need: as the file states, "
               "or by the nearest image from frame to frame where it does not. That is right if no "
               "particle moves by more than half a box length between frames."},
              p.unwrap, unwrap_names);
  visit.field({"angles", "",
               "Whether orientations in the plane are those of bodies, or of directors, which are "
               "known up to half turns; those then must turn by less than a quarter turn between "
               "frames."},
              p.angles, angle_names);
  visit.list({"species", "", "Sizes and masses of a species that the file does not have."},
             p.species, describe_imported_species);
  visit.list({"columns", "", "A column of a table that has another name than vitrel's."}, p.columns,
             describe_imported_column);
}

void validate_import(const ImportOptions& p) {
  const Rules rules("import");
  rules.require(!p.dimension || *p.dimension == 2 || *p.dimension == 3, "dimension",
                "must be 2 or 3");
  const auto is_size = [](const std::vector<double>& lengths) {
    return lengths.size() == 2 || lengths.size() == 3;
  };
  rules.require(!p.box || is_size(*p.box), "box", "must be two or three lengths above 0");
  for (std::size_t k = 0; k < p.species.size(); ++k) {
    const Rules of_species(fmt::format("import.species.{}", k));
    const ImportOptions::Kind& kind = p.species[k];
    of_species.require(!(kind.diameter && kind.semi_axes), "semi_axes",
                       "excludes diameter; give one or the other");
    of_species.require(!kind.semi_axes || is_size(*kind.semi_axes), "semi_axes",
                       "must be two or three lengths above 0");
  }
}

}  // namespace vitrel
