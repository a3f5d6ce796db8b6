#include "core/io/provenance.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>

#include "vitrel_commit.h"

namespace vitrel {
namespace {

/// HDF5 limits an attribute, including its header, to 64 KB.
constexpr std::size_t longest_attribute = 60'000;

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

std::string author_name() {
  for (const char* variable : {"USER", "LOGNAME"})
    if (const char* name = std::getenv(variable); name && *name) return name;
  return "unknown";
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm calendar{};
  gmtime_r(&now, &calendar);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &calendar);
  return text.data();
}

void write_text(h5::Group& group, const std::string& name, const std::string& text) {
  if (text.size() <= longest_attribute)
    group.set_attribute(name, text);
  else
    group.create_text(name, text);
}

std::string read_text(const h5::Group& group, const std::string& name) {
  // A dataset may have replaced an attribute.
  if (group.has_dataset(name)) return group.dataset(name).read_text();
  return group.has_attribute(name) ? group.text_attribute(name) : std::string();
}

template <class T>
void read_number(const h5::Group& group, const std::string& name, T& value) {
  if (group.has_attribute(name)) value = group.number_attribute<T>(name);
}

}  // namespace

std::string program_version() {
  return VITREL_VERSION;
}

std::string program_commit() {
  return VITREL_COMMIT;
}

Provenance current_provenance(std::string command_line, std::string parameters, std::uint64_t seed,
                              std::string parent) {
  Provenance provenance;
  provenance.version = program_version();
  provenance.commit = program_commit();
  provenance.command_line = std::move(command_line);
  provenance.host = host_name();
  provenance.author = author_name();
  provenance.parameters = std::move(parameters);
  provenance.seed = seed;
  provenance.parent = std::move(parent);
  provenance.started = utc_now();
  return provenance;
}

void write_provenance(h5::Group& group, const Provenance& provenance) {
  write_text(group, "version", provenance.version);
  write_text(group, "commit", provenance.commit);
  write_text(group, "command_line", provenance.command_line);
  write_text(group, "host", provenance.host);
  write_text(group, "author", provenance.author);
  write_text(group, "toml", provenance.parameters);
  group.set_attribute("seed", provenance.seed);
  group.set_attribute("dimension", std::int32_t{provenance.dimension});
  write_text(group, "parent", provenance.parent);
  write_text(group, "started", provenance.started);
  group.set_attribute("wall_seconds", provenance.wall_seconds);
  if (!provenance.model.empty()) write_text(group, "model", provenance.model);
}

void replace_parameters(h5::Group& group, const std::string& toml) {
  if (group.has_dataset("toml")) group.remove("toml");
  write_text(group, "toml", toml);
}

Provenance read_provenance(const h5::Group& group) {
  Provenance provenance;
  provenance.version = read_text(group, "version");
  provenance.commit = read_text(group, "commit");
  provenance.command_line = read_text(group, "command_line");
  provenance.host = read_text(group, "host");
  provenance.author = read_text(group, "author");
  provenance.parameters = read_text(group, "toml");
  read_number(group, "seed", provenance.seed);
  std::int32_t dimension = provenance.dimension;
  read_number(group, "dimension", dimension);
  provenance.dimension = dimension;
  provenance.parent = read_text(group, "parent");
  provenance.started = read_text(group, "started");
  read_number(group, "wall_seconds", provenance.wall_seconds);
  provenance.model = read_text(group, "model");
  return provenance;
}

}  // namespace vitrel
