#pragma once

/// @file
/// A clean stop on request: the signals of workflow/sweep/process.h only set a flag, which work asks for
/// where it can be resumed.
namespace vitrel {

/// Installs the handlers. A second SIGINT ends the program at once.
void catch_stop_signals();

bool stop_signalled();

}  // namespace vitrel
