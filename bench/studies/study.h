#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/io/json.h"
#include "core/state/stage.h"

/// @file
/// The one form in which everything that is compared is declared. A study asks a question. Its parts measure rows: in
/// each, one method answers the cases of one class, and its cost and its error come from the same run. The runner
/// (runner.h) makes of any study the same JSON, tables and page.
namespace vitrel::bench {

/// How the numbers of a column are shown.
enum class Shown { text, count, number, all_digits, time, error, share };

/// A key of the rows. Times are in ns. The key of the method is "method"; rows may name their curve in the chart as
/// "curve".
struct Column {
  std::string key;
  std::string name = {};  ///< empty: the key
  Shown shown = Shown::number;
  std::string unit = {};
};

/// What may be asked for. A study has the options that its defaults set.
struct StudyOptions {
  std::vector<std::string> parts = {}, methods = {}, classes = {};  ///< by name; empty: all
  std::uint64_t pairs = 0;                                          ///< of each class
  double seconds = 0;                                               ///< that a method may take
  double duration = 0;                                              ///< simulated time
  double tolerance = 0, gap_tolerance = 0;  ///< what still counts as right; 0: as usual
  std::uint64_t seed = 1;
  bool quick = false;  ///< few particles, short runs: to see that it works
};

/// What a part measures with.
struct StudyContext {
  const StudyOptions& options;
  const RunControl& control;
  Json& more;  ///< what only the page of this study shows
};

struct Part {
  std::string name;
  std::string about;  ///< the cases, and what the error is, in one or two sentences
  std::function<Json(const StudyContext&)> measure;  ///< the rows
  std::vector<Column> cases;     ///< what names a class of cases; a panel of the chart is of one
  Column cost = {}, error = {};  ///< the axes of the chart; no key: there is none
  std::vector<Column> verdicts = {};  ///< numbers of wrong answers of each kind, among `pairs`
  std::vector<Column> others = {};
  std::string varied = {};  ///< the key of what is varied within a method
  /// From which to choose, if anything.
  std::vector<std::string> method_names = {}, class_names = {};
  double smallest_error = 0;  ///< less is drawn there
};

/// Another name of a study, or of some parts of it.
struct Alias {
  std::string name;
  std::vector<std::string> parts = {};
};

struct Study {
  std::string name;
  std::vector<Alias> aliases;
  std::string question;
  std::vector<Part> parts;
  StudyOptions defaults = {};
  bool has_tolerance = false, has_quick = true;  ///< options
  std::vector<std::string> settled = {};         ///< questions answered for good, with the commit
};

/// All of them.
const std::vector<Study>& studies();

Study overlap_study();
Study contact_time_study();
Study peers_study();
Study whole_run_study();
Study brownian_step_study();
Study dense_study();
Study engine_study();
Study sampling_study();
Study soft_contact_study();
Study analysis_study();
Study thesis_study();

}  // namespace vitrel::bench
