#pragma once

#include <gtest/gtest.h>

#include <string>

namespace vitrel {

/// Writes a measured value and its error to the report of the test.
inline void record(const std::string& name, double value, double error) {
  testing::Test::RecordProperty(name, std::to_string(value) + " +- " + std::to_string(error));
}

}  // namespace vitrel
