#pragma once

#include "core/io/json.h"

/// @file
/// The scene of appendix B.1 of the thesis (woetzel2012): two ellipses with a = 1, b = 0.5, one
/// at rest at the origin, the other coming from (1, 1) at (−1, 0), turning at π. They touch first at
/// t = 0.0847, overlap, and touch again from inside the overlap at t = 1, a trap for root finders
/// and optimisers.
namespace vitrel::bench {

/// When the guaranteed reference, with the name "reference", and every method at its usual tolerance say
/// that the two touch first: null for no contact. Without the methods that are not made for such a pair.
Json thesis_scene_answers_json();

}  // namespace vitrel::bench
