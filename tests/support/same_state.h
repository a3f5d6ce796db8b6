#pragma once

#include <gtest/gtest.h>

#include "core/state/configuration.h"

namespace vitrel {

/// Places, motions and boxes are bit-identical.
template <int Dim>
void expect_same_state(const Configuration<Dim>& one, const Configuration<Dim>& two) {
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.image, two.image);
  EXPECT_EQ(one.velocity, two.velocity);
  EXPECT_EQ(one.angular_velocity, two.angular_velocity);
  if constexpr (Dim == 2)
    EXPECT_EQ(one.angle, two.angle);
  else
    EXPECT_EQ(one.orientation, two.orientation);
  EXPECT_EQ(one.box.lengths(), two.box.lengths());
}

}  // namespace vitrel
