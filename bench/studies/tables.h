#pragma once

#include <string>
#include <vector>

#include "bench/studies/study.h"

/// @file
/// The presentation of the rows of a part: tables, charts and a sentence, in the same form for every study.
namespace vitrel::bench {

struct Cell {
  std::string text;
  std::string note = {};  ///< shown beside the text in HTML
  double wrong = 0;       ///< share of wrong answers
};

enum class Content { wrong_answers, costs, all_numbers };

struct StudyTable {
  Content content;
  std::string heading;
  std::vector<std::string> head;
  std::vector<std::vector<Cell>> rows;
};

/// Tables of the percentage of wrong answers by case and method; of the cost of each method relative to the first, if
/// nothing is varied; and of all rows. "–" means that the method does not apply, as it answers none of the cases, and
/// "·" that no answer is wrong.
std::vector<StudyTable> tables_of(const Part& part, const Json& rows);

/// Charts of cost against error, with a panel for each class of cases and a curve for each method; cost against the
/// varied quantity if there is no error. They have the form that charts.js of the report page draws, without colours.
Json charts_of(const Part& part, const Json& rows);

/// A sentence about the methods, made from the numbers.
std::string answer_of(const Part& part, const Json& rows);

std::string markdown(const StudyTable& table);
Json table_json(const StudyTable& table);

/// A time in words: "213 ns", "12.3 µs" or "1.23 ms".
std::string time_text(double nanoseconds);
/// An error in words: "3.1e-14", or "–" if it is not a number.
std::string error_text(double error);
/// A ratio with three digits, or more if it is large: "0.0255", "41.6", "1412".
std::string ratio_text(double ratio);
/// A share in percent. Only an exact 0 appears as "·"; no other share is rounded to 0.
std::string share_text(double share);

}  // namespace vitrel::bench
