#pragma once

#include "bench/studies/study.h"

namespace vitrel::bench {

/// Of soft_contact_study: the tables of coefficients beside the integration.
Part restitution_part();

}  // namespace vitrel::bench
