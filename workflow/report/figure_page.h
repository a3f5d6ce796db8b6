#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/results.h"

/// @file
/// A page with figures of a table that belongs to no run.
namespace vitrel {

struct Figure {
  enum class Kind {
    curves,  ///< y as a function of x
    /// Paths in the plane, with equal scales. Points whose `instant` is an integer are marked with it.
    paths,
    map  ///< colours over a lattice of `side` × `side` points (x, y)
  };
  /// Columns of the table. Curves with the same label have the same colour.
  struct Curve {
    std::string x, y, label;
  };
  struct Disk {
    double x, y, radius;
  };

  Kind kind = Kind::curves;
  std::string heading, x_symbol, y_symbol;
  std::vector<Curve> curves = {};  ///< a map has one
  /// If true, values far above 0 are cut off, and the axis y = 0 is drawn.
  bool shows_zero = false;
  std::optional<std::pair<double, std::string>> mark = {};  ///< a vertical line
  std::vector<Disk> outlines = {};                          ///< for paths, drawn dashed
  // The following members are for maps only.
  std::string value = {};     ///< the column that the colours show
  std::size_t first_row = 0;  ///< first row of the lattice; x varies faster than y
  std::size_t side = 0;
  bool has_logarithmic_y = false;
};

struct FigurePage {
  std::string title;
  Results results;  ///< the figures show the first table, whose description precedes them
  std::vector<Figure> figures;
  std::string parameters;  ///< as TOML
  std::string units;       ///< as a sentence
};

/// Builds a table from names and units of columns. Every row must have a number for every column.
Table table_of_rows(const std::string& name, const std::string& description,
                    const std::vector<std::pair<std::string, std::string>>& columns,
                    const std::vector<std::vector<double>>& rows);

/// Writes a file according to the ending of its name: the first table as .csv, all results as .h5
/// (analysis/results.h), or the page as .html. Throws FileError.
void write_figures(const std::filesystem::path& path, const FigurePage& page);

}  // namespace vitrel
