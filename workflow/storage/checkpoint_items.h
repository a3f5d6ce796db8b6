#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/io/checkpoint.h"

/// @file
/// What a plain value consists of is named once, by a function template that hands every item with its
/// name to one of these: one writes it into a checkpoint, the other reads it from there.
namespace vitrel {

// Where a checkpoint holds items of a type.
auto& items_like(double, auto& checkpoint) {
  return checkpoint.reals;
}
auto& items_like(std::uint64_t, auto& checkpoint) {
  return checkpoint.counters;
}
auto& items_like(bool, auto& checkpoint) {
  return checkpoint.counters;
}
auto& items_like(const std::string&, auto& checkpoint) {
  return checkpoint.texts;
}
auto& items_like(const std::vector<double>&, auto& checkpoint) {
  return checkpoint.series;
}

class ItemWriter {
 public:
  explicit ItemWriter(Checkpoint& checkpoint) : checkpoint_(checkpoint) {}
  void operator()(const std::string& name, const auto& value) const {
    items_like(value, checkpoint_)[name] = value;
  }
  void if_recorded(const std::string& name, const auto& value) const { (*this)(name, value); }

 private:
  Checkpoint& checkpoint_;
};

class ItemReader {
 public:
  ItemReader(const Checkpoint& checkpoint, const std::filesystem::path& file)
      : checkpoint_(checkpoint), file_(file) {}
  /// Throws FileError, naming `file`, if the item is missing.
  void operator()(const std::string& name, auto& value) const {
    if (!items_like(value, checkpoint_).contains(name)) refuse_without(name);
    if_recorded(name, value);
  }
  /// An item that earlier versions did not write: `value` remains if it is missing.
  void if_recorded(const std::string& name, auto& value) const {
    const auto& items = items_like(value, checkpoint_);
    if (const auto found = items.find(name); found != items.end()) value = found->second;
  }

 private:
  [[noreturn]] void refuse_without(const std::string& name) const {
    throw FileError(file_.string() + ": is no checkpoint of this kind of work: '" + name +
                    "' is missing; delete it to start anew");
  }

  const Checkpoint& checkpoint_;
  const std::filesystem::path& file_;
};

}  // namespace vitrel
