#include "core/contact/ellipse_pair.h"

#include <cmath>

namespace vitrel::detail {

void far_directions(const Lanes& angle, Lanes& x, Lanes& y) {
  x = {std::cos(angle[0]), std::cos(angle[1])};
  y = {std::sin(angle[0]), std::sin(angle[1])};
}

}  // namespace vitrel::detail
