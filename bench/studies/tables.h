#pragma once

#include <string>
#include <vector>

#include "bench/studies/study.h"

/// @file
/// What the rows of a part say: tables, charts and a sentence, the same for every study.
namespace vitrel::bench {

struct Cell {
  std::string text;
  std::string note = {};  ///< that HTML pages show beside it
  double wrong = 0;       ///< share of wrong answers
};

enum class Content { wrong_answers, costs, all_numbers };

struct StudyTable {
  Content content;
  std::string heading;
  std::vector<std::string> head;
  std::vector<std::vector<Cell>> rows;
};

/// Where which method gives how many wrong answers, in percent; the cost of each relative to the first, if nothing is
/// varied; and all rows. "–": the method does not apply, as it answers not one of the cases. "·": none.
std::vector<StudyTable> tables_of(const Part& part, const Json& rows);

/// Cost against error, a panel for each class of cases and a curve for each method; cost against what is varied, if
/// there is no error. As charts.js of the report page draws them, without colours.
Json charts_of(const Part& part, const Json& rows);

/// One sentence on the methods, from the numbers.
std::string answer_of(const Part& part, const Json& rows);

std::string markdown(const StudyTable& table);
Json table_json(const StudyTable& table);

/// "213 ns", "12.3 µs", "1.23 ms".
std::string time_text(double nanoseconds);
/// "3.1e-14"; "–" if it is not a number.
std::string error_text(double error);
/// Three digits, more for large ones: "0.0255", "41.6", "1412".
std::string ratio_text(double ratio);
/// In percent; "·" for 0, and nothing else is shown as 0.
std::string share_text(double share);

}  // namespace vitrel::bench
