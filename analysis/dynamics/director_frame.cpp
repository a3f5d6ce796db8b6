#include "analysis/dynamics/director_frame.h"

#include <cmath>
#include <numbers>

#include "analysis/structure/order.h"
#include "analysis/structure/orientation_tensor.h"

namespace vitrel {

namespace {

std::vector<double> turns_of_director(Trajectory2& whole) {
  std::vector<double> directors;
  for (std::size_t k = 0; k < whole.frames(); ++k) {
    double director = order_tensor(whole.read_places(k)).director();
    if (k > 0) {
      const double turns = std::round((directors.back() - director) / std::numbers::pi);
      director += turns * std::numbers::pi;
    }
    directors.push_back(director);
  }
  return directors;
}

/// Returns the shortest rotation from one unit vector to another, at most a quarter turn away.
Quaternion rotation_between(const Vec3& from, const Vec3& to) {
  const Vec3 axis = from.cross(to);
  return Quaternion(1 + from.dot(to), axis.x(), axis.y(), axis.z()).normalized();
}

std::vector<Quaternion> turns_of_director(Trajectory3& whole) {
  std::vector<Quaternion> turns;
  Vec3 before = Vec3::Zero();
  for (std::size_t k = 0; k < whole.frames(); ++k) {
    Vec3 director = orientation_tensor(whole.read_places(k)).director();
    if (k == 0) {
      turns.push_back(Quaternion::Identity());
    } else {
      if (director.dot(before) < 0) director = -director;
      turns.push_back((rotation_between(before, director) * turns.back()).normalized());
    }
    before = director;
  }
  return turns;
}

void turn_back(Configuration2& frame, double director) {
  for (double& angle : frame.angle) angle -= director;
}

void turn_back(Configuration3& frame, const Quaternion& turn) {
  for (Quaternion& orientation : frame.orientation) orientation = turn.conjugate() * orientation;
}

}  // namespace

template <int Dim>
DirectorFrame<Dim>::DirectorFrame(Trajectory<Dim>& whole)
    : whole_(whole), turn_(turns_of_director(whole)) {}

template <int Dim>
const Configuration<Dim>& DirectorFrame<Dim>::turned(const Configuration<Dim>& frame,
                                                     std::size_t k) {
  frame_ = frame;
  turn_back(frame_, turn_[k]);
  return frame_;
}

template class DirectorFrame<2>;
template class DirectorFrame<3>;

}  // namespace vitrel
