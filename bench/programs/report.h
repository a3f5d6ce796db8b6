#pragma once

#include <filesystem>
#include <string>

#include "app/terminal/session.h"
#include "core/io/json.h"
#include "workflow/report/html.h"

/// @file
/// What the comparisons of methods do with what they have measured.
namespace vitrel::bench {

struct OutputOptions {
  std::string command_line;      ///< the whole, for the provenance
  std::filesystem::path folder;  ///< for the page and the data; empty: none is written
  double wall_time = 0;          ///< seconds; 0: no limit
  bool quiet = false, json = false;
};

/// What stands at the head of a page.
struct PageTitle {
  std::string title, subtitle;
};

class Report {
 public:
  /// FileError if the folder cannot be made.
  explicit Report(const OutputOptions& options);

  const RunControl& control() const { return session_.control(); }
  void say(const std::string& step) { session_.say()(step); }

  /// Prints the rows: as JSON if asked for, else unless quiet as the table.
  void print(const Json& rows, const std::string& table);
  /// For work that was interrupted: says so; the exit code.
  int stopped_early() const;
  bool is_wanted() const { return !options_.folder.empty(); }

  /// Adds the provenance, in which `what` describes the benchmark itself, to the data.
  void add_provenance(Json& data, const PageProvenance& what) const;
  /// The data as <name>.json.
  void write_data(const std::string& name, const Json& data) const;
  /// <name>.html, with charts and tables of these data (pages/page.h).
  void write_page(const std::string& name, const PageTitle& title, const Json& data) const;

 private:
  OutputOptions options_;
  Session session_;
};

}  // namespace vitrel::bench
