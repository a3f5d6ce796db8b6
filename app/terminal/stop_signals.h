#pragma once

#include <string>

/// @file
/// A clean stop on request. The signals of workflow/sweep/process.h and the limit of wall time set a flag, which work
/// checks wherever it can be resumed. Work that does not check the flag soon is ended as if it were killed, which all
/// files survive.
namespace vitrel {

enum class StopDeadline {
  soon,     ///< one second after the request the program ends with exit code 5, whatever it does
  at_once,  ///< for work that has nothing to save: the program ends with exit code 5 at once
  /// For work that cannot be continued, or that waits for other programs, which have a deadline of their own.
  none
};

/// From now on, signals and the end of the wall time request a stop. `wall_time` is in seconds from now; 0 means no
/// limit. A SIGHUP that is already ignored (nohup) stays ignored, but other signals do not, because shells ignore
/// them for purposes of their own. A second SIGINT ends the program at once. A file that exceeds the size limit of
/// the system causes an error of writing instead of SIGXFSZ.
void catch_stop_signals(double wall_time, StopDeadline deadline);

/// Sets the text that is printed on standard output if the program is ended at once. The default is empty.
void set_summary_of_stop(const std::string& text);

bool stop_requested();

}  // namespace vitrel
