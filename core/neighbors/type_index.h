#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace vitrel {

/// Which of a few kinds every particle is of. If there is one kind only, nothing is read to know it.
class KindOf {
 public:
  KindOf() = default;
  KindOf(std::vector<std::uint32_t> kind, std::size_t kinds) {
    if (kinds > 1) kind_ = std::move(kind);
  }

  std::uint32_t operator[](std::size_t particle) const {
    return kind_.empty() ? 0 : kind_[particle];
  }

 private:
  std::vector<std::uint32_t> kind_;
};

}  // namespace vitrel
