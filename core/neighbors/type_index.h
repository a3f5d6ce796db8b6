#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace vitrel {

/// The type of each particle. If there is only one type, no memory is read.
class TypeIndex {
 public:
  TypeIndex() = default;
  TypeIndex(std::vector<std::uint32_t> type, std::size_t types) {
    if (types > 1) type_ = std::move(type);
  }

  std::uint32_t operator[](std::size_t particle) const {
    return type_.empty() ? 0 : type_[particle];
  }

 private:
  std::vector<std::uint32_t> type_;
};

}  // namespace vitrel
