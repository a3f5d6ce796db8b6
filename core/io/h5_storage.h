#pragma once

#include "core/io/h5_open_file.h"

/// @file
/// How files of HDF5 may store what vitrel reads. HDF5 itself would follow a file to others, and into itself.
namespace vitrel::h5 {

/// Whether `path` exists below the group. Every part of it must be a hard link. Throws FileError if one is soft, or leads
/// to another file. `name` is that of the group in messages.
bool has_link(OpenFile& file, const Handle& group, const std::string& name,
              const std::string& path);

/// Throws FileError unless the data of the dataset lie in this file, by themselves, and HDF5's own filters read them.
void require_plain_storage(OpenFile& file, const Handle& dataset, const std::string& name);

/// Throws FileError if a chunk of frames first … last is too short for the checksum that it should have: HDF5 would read
/// beyond its memory.
void require_checksums(OpenFile& file, const Handle& dataset, const std::string& name,
                       const Shape& extent, std::uint64_t first, std::uint64_t last);

}  // namespace vitrel::h5
