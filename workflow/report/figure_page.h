#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/results.h"

/// @file
/// Figures of a table that belongs to no run, on a page of their own.
namespace vitrel {

struct Figure {
  enum class Kind {
    curves,  ///< y against x
    paths,  ///< in the plane, on equal scales; points whose `instant` is an integer are marked with it
    map     ///< colours over a lattice of `side` × `side` points (x, y)
  };
  /// Columns of the table. Curves of one label have one colour.
  struct Curve {
    std::string x, y, label;
  };
  struct Disk {
    double x, y, radius;
  };

  Kind kind = Kind::curves;
  std::string heading, x_symbol, y_symbol;
  std::vector<Curve> curves = {};  ///< of a map one
  /// Leave out what is far above 0, and draw the axis y = 0.
  bool shows_zero = false;
  std::optional<std::pair<double, std::string>> mark = {};  ///< an upright line
  std::vector<Disk> outlines = {};                          ///< dashed, of paths
  // What only a map has:
  std::string value = {};     ///< the column of the colours
  std::size_t first_row = 0;  ///< x runs faster than y
  std::size_t side = 0;
  bool has_logarithmic_y = false;
};

struct FigurePage {
  std::string title;
  Results results;  ///< the figures are of the first table, whose description stands above them
  std::vector<Figure> figures;
  std::string parameters;  ///< TOML
  std::string units;       ///< a sentence
};

/// `columns`: names and units; as many numbers in every row.
Table table_of_rows(const std::string& name, const std::string& description,
                    const std::vector<std::pair<std::string, std::string>>& columns,
                    const std::vector<std::vector<double>>& rows);

/// By the ending of the name: .csv, the first table; .h5, all results (analysis/results.h); .html, the page. Throws
/// FileError.
void write_figures(const std::filesystem::path& path, const FigurePage& page);

}  // namespace vitrel
