#pragma once

#include <filesystem>

#include "core/io/foreign/foreign_frame.h"

namespace vitrel {

/// A table of particles in CSV: a line of names, each perhaps followed by a unit in brackets ("x [length]"), and a line
/// per particle (particle_table.h). Consecutive lines with the same `frame`, or else the same `time`, are a frame;
/// without such a column the file is one. Empty lines and those that start with # are skipped. FileError.
std::unique_ptr<ForeignFrames> open_csv(const std::filesystem::path& path);

}  // namespace vitrel
