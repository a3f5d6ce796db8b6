#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// Small systems, as parameter files say them, and what summaries have.
namespace vitrel::testing_program {

inline const std::string small_system =
    "[system]\nparticles = 30\n[dynamics]\nequilibration = 1\nduration = 10\n"
    "[output]\nsamples = { spacing = \"linear\", interval = 0.5 }\n";

inline const std::string small_packing =
    "[system]\ndimension = 3\nparticles = 20\npacking_fraction = 0.2\n[[species]]\naspect_ratio = "
    "3\n"
    "[[prepare.stage]]\n[[prepare.stage]]\nmethod = \"grow\"\ngrowth_rate = 0.1\n";

inline const std::string soft_system =
    "[system]\nparticles = 60\npacking_fraction = 0.3\n[[species]]\naspect_ratio = 1\n"
    "[[prepare.stage]]\nmethod = \"insert\"\n[dynamics]\nduration = 20\nequilibration = 0\n"
    "[dynamics.contact]\nlaw = \"linear_dashpot\"\nstiffness = \"1e5 N/m\"\ndamping = \"100 "
    "kg/s\"\n";

inline void expect_keys(const nlohmann::json& summary, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(summary.contains(key)) << key;
}

}  // namespace vitrel::testing_program
