// The import of GSD files says what it takes as a default.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/io/foreign/gsd_layout.h"
#include "tests/support/foreign_files.h"

namespace vitrel {
namespace {

class GsdImport : public ForeignFiles {};

/// A chunk of a GSD file: numbers of one type, row by row.
struct GsdChunk {
  std::string name;
  std::uint64_t frame;
  std::uint64_t rows;
  std::uint32_t columns;
  std::uint8_t type;
  std::string bytes;
};
template <class Number>
GsdChunk chunk(const std::string& name, std::uint64_t frame, std::uint8_t type, std::uint64_t rows,
               const std::vector<Number>& values) {
  const auto columns = static_cast<std::uint32_t>(values.size() / rows);
  const char* bytes = reinterpret_cast<const char*>(values.data());
  return {name, frame, rows, columns, type, std::string(bytes, values.size() * sizeof(Number))};
}
GsdChunk counts(const std::string& name, std::uint64_t frame,
                const std::vector<std::uint32_t>& values) {
  return chunk(name, frame, 3, values.size(), values);
}
GsdChunk reals(const std::string& name, std::uint64_t frame, std::uint64_t rows,
               const std::vector<float>& values) {
  return chunk(name, frame, 9, rows, values);
}

/// As the specification of the file layer 2.0 says.
std::string gsd(const std::vector<GsdChunk>& chunks) {
  std::vector<std::string> names;
  std::vector<gsd::Entry> index;
  std::string data;
  for (const GsdChunk& chunk : chunks) {
    if (!std::ranges::count(names, chunk.name)) names.push_back(chunk.name);
    const auto name = std::ranges::find(names, chunk.name) - names.begin();
    index.push_back({chunk.frame, chunk.rows,
                     static_cast<std::int64_t>(sizeof(gsd::Header) + data.size()), chunk.columns,
                     static_cast<std::uint16_t>(name), chunk.type, 0});
    data += chunk.bytes;
  }
  std::string list;
  for (const std::string& name : names) list += name + '\0';
  const std::uint64_t units = list.size() / gsd::names_unit + 1;
  list.resize(units * gsd::names_unit);
  gsd::Header header{};
  header.magic = gsd::magic;
  header.index_location = sizeof(header) + data.size();
  header.index_entries = index.size();
  header.names_location = header.index_location + index.size() * sizeof(gsd::Entry);
  header.names_units = units;
  header.schema_version = 1 << 16 | 4;
  header.version = 2 << 16;
  std::ranges::copy(std::string("hoomd"), header.schema.begin());
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes += data;
  bytes.append(reinterpret_cast<const char*>(index.data()), index.size() * sizeof(gsd::Entry));
  return bytes + list;
}

/// The least that GSD can say of two spheres in two frames.
std::vector<GsdChunk> two_spheres() {
  return {counts("particles/N", 0, {2}), reals("configuration/box", 0, 6, {10, 10, 10, 0, 0, 0}),
          reals("particles/diameter", 0, 2, {1, 1}),
          reals("particles/position", 0, 2, {-3, 0, 0, 3, 0, 0}),
          reals("particles/position", 1, 2, {-3, 1, 0, 3, 1, 0})};
}

// What the schema puts in the place of what is absent, is said; and images are absent however few frames have them.
TEST_F(GsdImport, EveryDefaultIsSaid) {
  std::vector<GsdChunk> chunks = two_spheres();
  const std::string defaults =
      "dimension (3, the default of configuration/dimensions), masses (1, the default of "
      "particles/mass), orientations (not turned, the default of particles/orientation), species "
      "(all are \"A\", the default of particles/types), ";
  const std::string frames = "times (they are counted in frames)";
  const std::string no_motion = "box crossings (motion is left out), ";
  EXPECT_EQ(report(text("a.gsd", gsd(chunks))).at("absent"),
            defaults + "velocities (energies are left out), " + no_motion + frames);
  chunks.push_back(chunk<std::int32_t>("particles/image", 0, 7, 2, {0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(report(text("b.gsd", gsd(chunks))).at("absent"),
            defaults + "velocities (energies are left out), " + no_motion + frames);
  chunks.back().frame = 1;
  chunks.push_back(reals("particles/velocity", 1, 2, {0, 1, 0, 0, 1, 0}));
  chunks.push_back(reals("particles/angmom", 1, 2, {0, 1, 0, 0, 0, 1, 0, 0}));
  chunks.push_back(reals("particles/moment_inertia", 0, 2, {1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(report(text("c.gsd", gsd(chunks))).at("absent"),
            "angular velocities (0, the default of particles/angmom), box crossings (0, the "
            "default of particles/image), " +
                defaults + "velocities (0, the default of particles/velocity), " + frames);
}

}  // namespace
}  // namespace vitrel
