#include "edmd/soft/linear_dashpot.h"

#include "edmd/soft/contact_integration.h"

namespace vitrel {

template Restitution integrate_contact<LinearDashpot>(const ScaledImpact&);

}  // namespace vitrel
