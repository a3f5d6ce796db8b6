#pragma once

#include <variant>

#include "tests/support/mixtures_in_space.h"

/// The mixtures in the plane and those in space, for tests that say the same of both.
namespace vitrel {

using AnyMixture = std::variant<Mixture, MixtureInSpace>;

inline std::vector<AnyMixture> all_mixtures() {
  std::vector<AnyMixture> all;
  for (const Mixture& mixture : mixtures()) all.push_back(mixture);
  for (const MixtureInSpace& mixture : mixtures_in_space()) all.push_back(mixture);
  return all;
}

class MixtureTest : public testing::TestWithParam<AnyMixture> {
 protected:
  /// check(state) of the mixture inserted at random, a Configuration2 or a Configuration3.
  template <class Check>
  static void with_inserted(const Check& check) {
    std::visit([&](const auto& mixture) { check(inserted_mixture(mixture)); }, GetParam());
  }
};

}  // namespace vitrel
