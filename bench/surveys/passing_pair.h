#pragma once

#include "core/io/json.h"

namespace vitrel::bench {

/// Two ellipsoids that overlap for a moment as they pass (ellipsoid_suite.h): a pair of roots so close
/// that a scan for a change of sign steps over both. The depth of the overlap, the true contact, what
/// every method at all its tolerances answers (the time, or null if it finds no contact, and the number
/// of steps or evaluations), and η₁ against time about the overlap, as a curve and as a scan of the usual
/// step sees it.
Json passing_pair_json();

}  // namespace vitrel::bench
