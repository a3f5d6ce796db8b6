#pragma once

#include <array>

/// A clean stop at the user's wish: SIGINT (Ctrl-C), SIGTERM and SIGUSR1 (what batch systems send
/// before time runs out) only set a flag, which work asks for at points from which it can be
/// resumed.
namespace vitrel {

extern const std::array<int, 3> stop_signals;

/// From now on the three signals set the flag. A second SIGINT ends the program at once.
void catch_stop_signals();

bool stop_signalled();

}  // namespace vitrel
