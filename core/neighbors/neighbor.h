#pragma once

#include <array>
#include <cstdint>

#include "core/contact/contact_screen.h"

namespace vitrel {

/// The image (j, shift) of another particle, at r_j + shift ∘ L.
template <int Dim>
struct NeighborImage {
  std::uint32_t other = 0;
  std::array<std::int16_t, Dim> boxes{};  // compact, because lists are read in every prediction

  NeighborImage() = default;
  NeighborImage(std::size_t j, const Shift<Dim>& shift) : other(static_cast<std::uint32_t>(j)) {
    for (int k = 0; k < Dim; ++k) boxes[k] = static_cast<std::int16_t>(shift[k]);
  }

  Shift<Dim> shift() const {
    Shift<Dim> wide;
    for (int k = 0; k < Dim; ++k) wide[k] = boxes[k];
    return wide;
  }
  bool is_shifted() const {
    bool shifted = false;
    for (int k = 0; k < Dim; ++k) shifted = shifted || boxes[k] != 0;
    return shifted;
  }
  /// The image of particle i that is a neighbour of the other particle.
  NeighborImage reversed_image(std::size_t i) const { return {i, -shift()}; }
  bool operator==(const NeighborImage& image) const {
    bool same = other == image.other;
    for (int k = 0; k < Dim; ++k) same = same && boxes[k] == image.boxes[k];
    return same;
  }
};

/// A neighbour, which is an image with the warm start of the contact screen for this pair.
template <Body B>
struct Neighbor : NeighborImage<B::dimension> {
  [[no_unique_address]] WarmStart<B> warm_start;

  bool is(const NeighborImage<B::dimension>& image) const { return image == *this; }
};

}  // namespace vitrel
