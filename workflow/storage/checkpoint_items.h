#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/checkpoint.h"

/// @file
/// What a plain value consists of is named once, by a function template that hands every item with its
/// name to one of these: one writes it into a checkpoint, the other reads it from there.
namespace vitrel {

class ItemWriter {
 public:
  explicit ItemWriter(Checkpoint& checkpoint) : checkpoint_(checkpoint) {}

  void operator()(const std::string& name, double value) { checkpoint_.reals[name] = value; }
  void operator()(const std::string& name, std::uint64_t value) {
    checkpoint_.counters[name] = value;
  }
  void operator()(const std::string& name, bool value) { checkpoint_.counters[name] = value; }
  void operator()(const std::string& name, const std::string& value) {
    checkpoint_.texts[name] = value;
  }
  void operator()(const std::string& name, const std::vector<double>& value) {
    checkpoint_.series[name] = value;
  }
  void if_recorded(const std::string& name, const auto& value) { (*this)(name, value); }

 private:
  Checkpoint& checkpoint_;
};

/// Throws FileError, naming `file`, if an item is missing.
class ItemReader {
 public:
  ItemReader(const Checkpoint& checkpoint, const std::filesystem::path& file)
      : checkpoint_(checkpoint), file_(file) {}

  void operator()(const std::string& name, double& value) const;
  void operator()(const std::string& name, std::uint64_t& value) const;
  void operator()(const std::string& name, bool& value) const;
  void operator()(const std::string& name, std::string& value) const;
  void operator()(const std::string& name, std::vector<double>& value) const;
  /// An item that earlier versions did not write: `value` remains if it is missing.
  void if_recorded(const std::string& name, double& value) const;
  void if_recorded(const std::string& name, std::uint64_t& value) const;
  void if_recorded(const std::string& name, bool& value) const;
  void if_recorded(const std::string& name, std::vector<double>& value) const;

 private:
  const Checkpoint& checkpoint_;
  const std::filesystem::path& file_;
};

}  // namespace vitrel
