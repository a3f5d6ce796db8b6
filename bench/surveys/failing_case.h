#pragma once

#include "bench/surveys/survey.h"
#include "core/io/json.h"

namespace vitrel::bench {

/// A pair that a method answered wrongly: a caption ("reports the contact 0.6 too late; …"), the velocity
/// of body 2 relative to body 1, and pictures of both ellipses at the start, at the true contact, at the
/// deepest overlap that the method overlooked and at the time it reported, in the order of time. Every
/// picture is a square from −1 to 1 with a scale of its own (`half_width`, in units of length); if one
/// ellipse is far larger, only the neighbourhood of the smaller one is shown.
Json failing_case_json(const FailingCase& failure);

}  // namespace vitrel::bench
