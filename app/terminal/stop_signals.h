#pragma once

#include <string>

/// @file
/// A clean stop on request: the signals of workflow/sweep/process.h and the wall time set a flag, which work asks for
/// where it can be resumed. Work that does not get there soon is ended as if it were killed, which all files survive.
namespace vitrel {

enum class StopDeadline {
  soon,     ///< a second after the request the program ends with exit code 5, whatever it does
  at_once,  ///< for what has nothing to save: the program ends with exit code 5
  none      ///< for what cannot be continued, or waits for other programs, which have their own
};

/// From now on signals and the end of the wall time request a stop. `wall_time` in seconds from now; 0: no limit. SIGHUP
/// that is ignored already (nohup) stays so; shells ignore others for their own sake. A second SIGINT ends the program at
/// once. A file that exceeds the limit of the system becomes an error of writing, instead of SIGXFSZ.
void catch_stop_signals(double wall_time, StopDeadline deadline);

/// What standard output gets if the program is ended at once; nothing by default.
void set_summary_of_stop(const std::string& text);

bool stop_requested();

}  // namespace vitrel
