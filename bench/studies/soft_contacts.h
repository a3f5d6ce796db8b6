#pragma once

#include "bench/studies/study.h"

namespace vitrel::bench {

/// Compares tables of coefficients with the integration. It is a part of soft_contact_study.
Part restitution_part();

}  // namespace vitrel::bench
