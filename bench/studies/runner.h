#pragma once

#include <filesystem>
#include <string>

#include "bench/studies/study.h"

namespace vitrel::bench {

struct OutputOptions {
  std::string command_line;  ///< the whole command line, for the provenance
  /// The page (.html), tables (.md) or numbers (.json), or a folder for all three; empty for none.
  std::filesystem::path file;
  double wall_time = 0;  ///< in seconds; 0: no limit
  bool quiet = false, json = false;
};

/// Measures the chosen parts, prints their tables or, with `json`, the numbers, and writes the file. The numbers are
/// study, question, parts (name, about, answer, rows) and provenance. Returns the exit code. Throws UserError for a
/// part that the study does not have.
int run_study(const Study& study, const StudyOptions& options, const OutputOptions& output);

/// The numbers as Markdown: the question, where it was measured, and the sentence and the tables of every part.
std::string study_markdown(const Study& study, const Json& numbers);

/// The numbers as a single HTML file that needs no other file.
std::string study_page(const Study& study, const Json& numbers);

}  // namespace vitrel::bench
