#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/results.h"

namespace vitrel {

struct TextFile {
  std::string name;
  std::string text;
};

/// Results as gnuplot takes them: `<table>.dat` for every table, whitespace between its columns,
/// each error in the column after its value, `nan` for an unknown number, and comments that name
/// the columns with their units; and `<table>.gp` for every table with a curve, which draws
/// `<table>.svg` beside it.
///
/// A table is curves over its first column if that is a time, a wave number, a distance, an angle
/// or a packing fraction. There is a panel per unit, and a curve with error bars per column; points
/// where the first column does not increase throughout. Time differences are drawn on a logarithmic
/// axis, and so are powers of lengths and angles, diffusion coefficients and times. Counts of what
/// was averaged over are not drawn.
std::vector<TextFile> gnuplot_files(const Results& results);

/// Writes them into a new folder, which appears under its name when it is complete. Throws
/// FileError.
void write_folder(const std::filesystem::path& folder, const std::vector<TextFile>& files);

}  // namespace vitrel
