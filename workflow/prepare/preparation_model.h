#pragma once

#include <string>

#include "workflow/configuration/parameters.h"

namespace vitrel {

/// Says how the stages that move particles simulate them, and why: "swell: local moves of ellipses, since some
/// particle is not round; …". The text is empty if no stage moves any. `some` are particles like those to be
/// prepared.
template <int Dim>
std::string preparation_model(const Parameters& parameters, const Configuration<Dim>& some);

}  // namespace vitrel
