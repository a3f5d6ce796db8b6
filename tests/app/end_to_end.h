#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/program.h"

/// What the end-to-end tests have in common: their libraries, and short names.
namespace vitrel {

namespace fs = std::filesystem;

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;
using testing_program::all_datasets;
using testing_program::Datasets;
using testing_program::differing_datasets;
using testing_program::Folder;
using testing_program::Outcome;
using testing_program::run_and_signal;
using testing_program::words_of;

/// The values of some keys of a summary.
inline void expect_values(const nlohmann::json& summary,
                          const std::vector<std::pair<std::string, nlohmann::json>>& expected) {
  for (const auto& [key, value] : expected) EXPECT_EQ(summary[key], value) << key;
}

inline void expect_keys(const nlohmann::json& summary, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(summary.contains(key)) << key;
}

}  // namespace vitrel
