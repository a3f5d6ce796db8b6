#pragma once

#include <filesystem>
#include <span>
#include <string>

/// @file
/// Random damage to files, the same for the same stream of random numbers.
namespace vitrel {
class Stream;
}

namespace vitrel::fuzz {

/// A few bytes are flipped, overwritten, removed, repeated or cut off, or come from another original.
std::string damaged_bytes(const std::string& original, std::span<const std::string> others,
                          Stream& stream);

/// The same for text, where numbers become extreme and lines and words are exchanged, removed or repeated.
std::string damaged_text(const std::string& original, std::span<const std::string> others,
                         Stream& stream);

/// Objects of an HDF5 file are removed or replaced by others of another type, shape or value. The file stays one that
/// the HDF5 library reads. False if what was drawn cannot be changed: text has no values.
bool damage_hdf5(const std::filesystem::path& file, Stream& stream);

}  // namespace vitrel::fuzz
