#pragma once

#include <vector>

#include "bench/studies/study.h"

/// @file
/// What soft_contact_study is put together from.
namespace vitrel::bench {

std::vector<Part> soft_sphere_parts();
std::vector<Part> restitution_parts();

}  // namespace vitrel::bench
