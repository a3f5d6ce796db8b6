#include "analysis/dynamics/director_frame.h"

#include <cmath>
#include <numbers>

#include "analysis/structure/order.h"

namespace vitrel {

DirectorFrame::DirectorFrame(Trajectory& whole) : whole_(whole) {
  for (std::size_t k = 0; k < whole.frames(); ++k) {
    double director = order_tensor(whole.read(k)).director();
    if (k > 0) {
      const double turns = std::round((director_.back() - director) / std::numbers::pi);
      director += turns * std::numbers::pi;
    }
    director_.push_back(director);
  }
}

const Configuration2& DirectorFrame::read(std::size_t k) {
  frame_ = whole_.read(k);
  for (double& angle : frame_.angle) angle -= director_[k];
  return frame_;
}

}  // namespace vitrel
