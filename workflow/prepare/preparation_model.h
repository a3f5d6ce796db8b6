#pragma once

#include <string>

#include "workflow/configuration/parameters.h"

namespace vitrel {

/// How the stages that move particles simulate them, and why: "swell: local moves of ellipses, since some particle is
/// not round; …". Empty if no stage moves any. `some`: particles like those that are prepared.
template <int Dim>
std::string preparation_model(const Parameters& parameters, const Configuration<Dim>& some);

}  // namespace vitrel
