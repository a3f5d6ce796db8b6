#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/io/json.h"
#include "core/state/stage.h"

/// @file
/// The common form in which all comparisons are declared. A study asks a question. Its parts measure rows: in each
/// row, one method answers the cases of one class, and its cost and its error come from the same run. The runner
/// (runner.h) makes the same kind of JSON, tables and page from every study.
namespace vitrel::bench {

/// The form in which the numbers of a column are shown.
enum class Shown { text, count, number, all_digits, time, error, share };

/// A key of the rows. Times are in ns. The key of the method is "method". Rows may name their curve in the chart
/// under the key "curve".
struct Column {
  std::string key;
  std::string name = {};  ///< the key if empty
  Shown shown = Shown::number;
  std::string unit = {};
};

/// Options of a study. It has only those options that its defaults set.
struct StudyOptions {
  std::vector<std::string> parts = {}, methods = {}, classes = {};  ///< names; all if empty
  std::uint64_t pairs = 0;                                          ///< in each class
  double seconds = 0;                                               ///< for each method
  double duration = 0;                                              ///< simulated time
  double tolerance = 0, gap_tolerance = 0;  ///< largest error of a right answer; the usual one if 0
  std::uint64_t seed = 1;
  bool quick = false;  ///< few particles and short runs, as a test
};

/// The surroundings of a measurement.
struct StudyContext {
  const StudyOptions& options;
  const RunControl& control;
  Json& more;  ///< numbers for the page of this study only
};

struct Part {
  std::string name;
  std::string about;  ///< the cases, and the meaning of the error, in one or two sentences
  std::function<Json(const StudyContext&)> measure;  ///< returns the rows
  std::vector<Column> cases;  ///< keys that name a class of cases; the chart has a panel per class
  Column cost = {}, error = {};       ///< the axes of the chart; an axis without a key is left out
  std::vector<Column> verdicts = {};  ///< numbers of wrong answers of each kind, among `pairs`
  std::vector<Column> others = {};
  std::string varied = {};  ///< the key of the quantity that is varied within a method
  /// The names of methods and classes from which the user can choose, if any.
  std::vector<std::string> method_names = {}, class_names = {};
  double smallest_error = 0;  ///< smaller errors are drawn at this value
};

/// Another name for a study, or for some of its parts.
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
  bool has_tolerance = false, has_quick = true;  ///< whether the study has these options
  std::vector<std::string> settled = {};  ///< questions that are answered for good, with the commit
};

/// All studies.
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
