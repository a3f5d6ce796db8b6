#pragma once

#include <array>
#include <bit>
#include <cstdint>

/// @file
/// The file layer of GSD (https://gsd.readthedocs.io/en/stable/file-layer.html) as it is in memory: a header, and an
/// index with an entry per named array ("chunk") and frame.
namespace vitrel::gsd {

static_assert(std::endian::native == std::endian::little, "GSD files are little-endian");

inline constexpr std::uint64_t magic = 0x65DF65DF65DF65DF;
/// The block of names is counted in units of this many bytes; in layer 1 each name has so many.
inline constexpr std::uint64_t names_unit = 64;

struct Header {
  std::uint64_t magic;
  std::uint64_t index_location, index_entries;
  std::uint64_t names_location, names_units;
  std::uint32_t schema_version, version;  ///< major · 2¹⁶ + minor
  std::array<char, 64> application, schema;
  std::array<char, 80> reserved;
};

struct Entry {
  std::uint64_t frame, rows;
  std::int64_t location;  ///< 0 ends the index
  std::uint32_t columns;
  std::uint16_t name;  ///< counted from 0
  std::uint8_t type, flags;
};

static_assert(sizeof(Header) == 256 && sizeof(Entry) == 32);

}  // namespace vitrel::gsd
