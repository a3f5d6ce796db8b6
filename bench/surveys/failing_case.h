#pragma once

#include "bench/surveys/survey.h"
#include "core/io/json.h"

namespace vitrel::bench {

/// A pair that a method answered wrongly, with a caption ("reports the contact 0.6 too late; the first one is at t =
/// 1.2") and with the command that draws its gap and contact function.
Json failing_case_json(const FailingCase& failure);

}  // namespace vitrel::bench
