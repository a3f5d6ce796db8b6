#pragma once

#include <string>

#include "bench/lab/survey.h"

namespace vitrel {

/// A pair that a method answered wrongly: both ellipses at the start, at the true contact, at the
/// deepest overlap that the method overlooked and at the time it reported, in the order of time. Every
/// part has its own scale; if one ellipse is far larger, only the neighbourhood of the smaller one
/// is shown. Overlap is red.
std::string failure_svg(const lab::FailingCase& failure);

/// "reports a contact at t = 0.7, 0.6 later than the true one; by then …"
std::string failure_caption(const lab::FailingCase& failure);

}  // namespace vitrel
