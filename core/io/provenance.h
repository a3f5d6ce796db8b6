#pragma once

#include <cstdint>
#include <string>

#include "core/io/h5.h"

namespace vitrel {

/// The origin of a file. Host, author, start and wall time differ between two runs of the same parameters; no dataset
/// outside /parameters does.
struct Provenance {
  std::string version;  ///< version of the program
  std::string commit;   ///< commit of the sources, with "-modified" if they differed; or "unknown"
  std::string command_line;
  std::string host;
  std::string author;      ///< login name, or "unknown"
  std::string parameters;  ///< TOML text
  std::uint64_t seed = 0;
  int dimension = 2;
  std::string parent;       ///< file that the run started from; empty: none
  std::string started;      ///< UTC, "2024-05-01T12:00:00Z"
  double wall_seconds = 0;  ///< time spent on the file so far, including all continuations
  std::string model;        ///< the model chosen for the particles, and why; may be empty
};

std::string program_version();
std::string program_commit();

/// The provenance of a file that this process creates now.
Provenance current_provenance(std::string command_line, std::string parameters, std::uint64_t seed,
                              std::string parent = {});

/// Stores the fields as attributes of `group` (the TOML text as "toml"); a text above 60 000 bytes,
/// which an attribute cannot hold, becomes a dataset of the same name. Throws FileError.
void write_provenance(h5::Group& group, const Provenance& provenance);
/// Replaces the TOML text.
void replace_parameters(h5::Group& group, const std::string& toml);
/// Reads the fields; those that are not there keep their defaults.
Provenance read_provenance(const h5::Group& group);

}  // namespace vitrel
