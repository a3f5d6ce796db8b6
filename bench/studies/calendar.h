#pragma once

#include "bench/studies/study.h"

namespace vitrel::bench {

/// Compares the calendar of the engine with a heap; the same model of the event loop drives both.
Part calendar_part();

}  // namespace vitrel::bench
