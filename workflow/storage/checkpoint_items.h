#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/io/checkpoint.h"

/// @file
/// Writing and reading of plain values in checkpoints. A function template names the items of a type once: it hands
/// every item with its name to a visitor. An ItemWriter writes it into a checkpoint, an ItemReader reads it from
/// there.
namespace vitrel {

// Each function returns the part of a checkpoint that holds items of this type.
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
  explicit ItemWriter(Checkpoint& checkpoint, std::string path = "")
      : checkpoint_(checkpoint), path_(std::move(path)) {}
  /// Returns a writer of items whose names begin with `path`.
  ItemWriter below(const std::string& path) const { return ItemWriter(checkpoint_, path_ + path); }
  void operator()(const std::string& name, const auto& value) const {
    items_like(value, checkpoint_)[path_ + name] = value;
  }
  void if_recorded(const std::string& name, const auto& value) const { (*this)(name, value); }

 private:
  Checkpoint& checkpoint_;
  std::string path_;
};

class ItemReader {
 public:
  ItemReader(const Checkpoint& checkpoint, const std::filesystem::path& file, std::string path = "")
      : checkpoint_(checkpoint), file_(file), path_(std::move(path)) {}
  ItemReader below(const std::string& path) const { return {checkpoint_, file_, path_ + path}; }
  /// Throws FileError, naming `file`, if the item is missing.
  void operator()(const std::string& name, auto& value) const {
    if (!items_like(value, checkpoint_).contains(path_ + name)) refuse_without(path_ + name);
    if_recorded(name, value);
  }
  /// Reads an item that earlier versions did not write. `value` remains as it is if the item is missing.
  void if_recorded(const std::string& name, auto& value) const {
    const auto& items = items_like(value, checkpoint_);
    if (const auto found = items.find(path_ + name); found != items.end()) value = found->second;
  }

 private:
  [[noreturn]] void refuse_without(const std::string& name) const {
    throw FileError(file_.string() + ": is no checkpoint of this kind of work: '" + name +
                    "' is missing; delete it to start anew");
  }

  const Checkpoint& checkpoint_;
  const std::filesystem::path& file_;
  std::string path_;
};

}  // namespace vitrel
