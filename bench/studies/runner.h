#pragma once

#include <filesystem>
#include <string>

#include "bench/studies/study.h"

namespace vitrel::bench {

struct OutputOptions {
  std::string command_line;  ///< the whole, for the provenance
  std::filesystem::path
      file;  ///< page (.html), tables (.md) or numbers (.json), or a folder for all three; empty: none
  double wall_time = 0;  ///< seconds; 0: no limit
  bool quiet = false, json = false;
};

/// Measures the parts that are wanted, prints their tables, or with `json` the numbers, and writes the file. The
/// numbers: study, question, parts (name, about, answer, rows) and provenance. Returns the exit code. Throws UserError
/// for a part that the study does not have.
int run_study(const Study& study, const StudyOptions& options, const OutputOptions& output);

/// The numbers as Markdown: the question, where it was measured, and of every part the sentence and the tables.
std::string study_markdown(const Study& study, const Json& numbers);

/// One HTML file that needs nothing beside it.
std::string study_page(const Study& study, const Json& numbers);

}  // namespace vitrel::bench
