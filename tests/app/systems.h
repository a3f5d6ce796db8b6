#pragma once

#include <string>

/// Small systems, as parameter files say them.
namespace vitrel {

inline const std::string small_system =
    "[system]\nparticles = 30\n[dynamics]\nequilibration = 1\nduration = 10\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n";

inline const std::string small_packing =
    "[system]\ndimension = 3\nparticles = 20\npacking_fraction = 0.2\n[[species]]\n"
    "aspect_ratio = 3\n[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\ngrowth_rate = "
    "0.1\n";

inline const std::string soft_system =
    "[system]\nparticles = 60\npacking_fraction = 0.3\n[[species]]\naspect_ratio = 1\n"
    "[[prepare.stage]]\nmethod = \"insert\"\n[dynamics]\nduration = 20\nequilibration = 0\n"
    "[dynamics.contact]\nlaw = \"linear_dashpot\"\nstiffness = \"1e5 N/m\"\n"
    "damping = \"100 kg/s\"\n";

}  // namespace vitrel
