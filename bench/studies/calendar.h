#pragma once

#include "bench/studies/study.h"

namespace vitrel::bench {

/// The calendar of the engine and a heap, both driven by the same model of the event loop.
Part calendar_part();

}  // namespace vitrel::bench
