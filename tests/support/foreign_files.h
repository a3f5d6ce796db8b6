#pragma once

#include <fstream>
#include <map>
#include <string>

#include "core/error.h"
#include "core/io/h5md.h"
#include "tests/support/files.h"

namespace vitrel {

/// The fixture writes files of other programs, and returns what their import reports.
class ForeignFiles : public Files {
 protected:
  std::filesystem::path text(const std::string& name, const std::string& content) const {
    const std::filesystem::path path = file(name);
    std::ofstream(path) << content;
    return path;
  }

  static std::map<std::string, std::string> report(const std::filesystem::path& path,
                                                   const KnownSystem& known = {}) {
    const TrajectoryReader reader(path, known);
    return {reader.import_report().begin(), reader.import_report().end()};
  }

  static std::string refusal(const std::filesystem::path& path, const KnownSystem& known = {}) {
    try {
      TrajectoryReader(path, known).frames();
    } catch (const FileError& error) {
      return error.what();
    }
    return "read";
  }
};

}  // namespace vitrel
