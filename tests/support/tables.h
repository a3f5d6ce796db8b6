#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/results.h"

/// Tables of results.
namespace vitrel {

using Names = std::vector<std::string>;

inline const Table& named(const std::vector<Table>& tables, const std::string& name) {
  for (const Table& table : tables)
    if (table.name == name) return table;
  throw std::out_of_range(name);
}

inline Names column_names(const Table& table) {
  Names names;
  for (const Column& column : table.columns) names.push_back(column.name);
  return names;
}

inline void expect_columns(const std::vector<Table>& tables, const std::string& table,
                           const Names& columns) {
  EXPECT_EQ(column_names(named(tables, table)), columns) << table;
}

/// Every column has a value for each row, as many errors or none, and a unit.
inline void expect_whole_columns(const std::vector<Table>& tables) {
  for (const Table& table : tables)
    for (const Column& column : table.columns) {
      EXPECT_EQ(column.value.size(), table.rows()) << table.name << ' ' << column.name;
      EXPECT_TRUE(column.error.empty() || column.error.size() == table.rows()) << column.name;
      EXPECT_FALSE(column.unit.empty()) << column.name;
    }
}

}  // namespace vitrel
