#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace vitrel {

/// Which of a few types every particle is of. If there is one type only, nothing is read to know it.
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
