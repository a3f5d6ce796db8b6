#pragma once

#include "bench/surveys/survey.h"
#include "core/io/json.h"

namespace vitrel::bench {

/// A pair that a method answered wrongly: a caption ("reports the contact 0.6 too late; the first one is at t = 1.2"), and
/// the command that draws the gap and the contact function of this pair. In units of the pair.
Json failing_case_json(const FailingCase& failure);

}  // namespace vitrel::bench
