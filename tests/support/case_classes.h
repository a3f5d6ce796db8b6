#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "bench/surveys/stability_suite.h"

/// The classes of the stability suite as tests take them.
namespace vitrel::bench {

/// A class with a name for ctest.
template <int Dim>
struct NamedClass {
  CaseClassOf<Dim> of;
  friend void PrintTo(const NamedClass& named, std::ostream* out) {
    *out << named.of.name << ", aspect ratio " << named.of.aspect_ratio;
  }
};

template <int Dim>
std::vector<NamedClass<Dim>> all_classes() {
  std::vector<NamedClass<Dim>> all;
  for (const CaseClassOf<Dim>& of : stability_suite<Dim>()) all.push_back({of});
  return all;
}

/// The classes of this name, one for each of their aspect ratios.
template <int Dim = 2>
std::vector<CaseClassOf<Dim>> classes_named(const std::string& name) {
  std::vector<CaseClassOf<Dim>> found;
  for (const CaseClassOf<Dim>& of : stability_suite<Dim>())
    if (of.name == name) found.push_back(of);
  EXPECT_FALSE(found.empty()) << name;
  return found;
}

/// check(case) of the first cases of the classes of this name.
template <int Dim = 2, class Check>
void for_cases(const std::string& name, std::uint64_t seed, std::uint64_t cases,
               const Check& check) {
  for (const CaseClassOf<Dim>& of : classes_named<Dim>(name))
    for (std::uint64_t index = 0; index < cases; ++index) {
      SCOPED_TRACE(name + " " + std::to_string(index));
      check(make_case(of, seed, index));
    }
}

}  // namespace vitrel::bench
