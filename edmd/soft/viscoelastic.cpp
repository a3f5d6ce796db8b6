#include "edmd/soft/viscoelastic.h"

#include "edmd/soft/contact_integration.h"

namespace vitrel {

template Restitution integrate_contact<Viscoelastic>(const ScaledImpact&);

}  // namespace vitrel
