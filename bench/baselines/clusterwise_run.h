#pragma once

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "bench/baselines/soft_pairs.h"

namespace vitrel::bench {

/// Soft spheres or disks whose equations of motion are integrated as accurately as possible, as the reference for the
/// other methods. It uses neither events nor the restitution matrix, and is also correct for contacts of three
/// particles.
///
/// The run consists of steps, each as long as no particle moves by more than half of a margin:
///   1. Particles that are closer than contact and the margin form clusters. No cluster can meet another one in this
///      time.
///   2. A single particle moves freely. Clusters are integrated by the method of Dormand and Prince of order 5 with
///      adaptive steps, which become short where a force begins or ends. `longest_step` must be well below the
///      duration of a contact, so that no contact is missed.
template <int Dim, ContactForce Force>
class ClusterwiseRun {
 public:
  ClusterwiseRun(const Configuration<Dim>& start, const Force& force, double tolerance,
                 double longest_step)
      : c_(start),
        force_(force),
        tolerance_(tolerance),
        longest_step_(longest_step),
        margin_(0.5 * largest_circumradius(start)) {}

  void advance(double duration) {
    const double end = c_.time + duration;
    while (c_.time < end) {
      find_clusters();
      const std::vector<Vec<Dim>> position = c_.position, velocity = c_.velocity;
      double step = std::min(end - c_.time, 0.4 * margin_ / fastest());
      while (!advance_clusters(step)) {  // a particle that was slow at first moved too far
        c_.position = position;
        c_.velocity = velocity;
        step /= 2;
      }
      c_.time = end - c_.time > step ? c_.time + step : end;
    }
  }

  /// Positions are not wrapped.
  const Configuration<Dim>& state() const { return c_; }

 private:
  struct Cluster {
    std::vector<std::size_t> members;
    std::vector<SoftPair<Dim>> pairs;  // numbered within the cluster
  };
  using State = std::vector<double>;  // positions, then velocities

  double fastest() const {
    double most = 0;
    for (const Vec<Dim>& v : c_.velocity) most = std::max(most, v.norm());
    return most;
  }

  void find_clusters() {
    const std::vector<SoftPair<Dim>> near = find_soft_pairs(c_, margin_);
    std::vector<std::size_t> root(c_.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto root_of = [&](std::size_t i) {
      while (root[i] != i) i = root[i] = root[root[i]];
      return i;
    };
    for (const SoftPair<Dim>& pair : near) root[root_of(pair.i)] = root_of(pair.j);
    std::vector<Cluster> of_root(c_.size());
    std::vector<std::size_t> place(c_.size());
    for (std::size_t i = 0; i < c_.size(); ++i) {
      Cluster& cluster = of_root[root_of(i)];
      place[i] = cluster.members.size();
      cluster.members.push_back(i);
    }
    for (SoftPair<Dim> pair : near) {
      Cluster& cluster = of_root[root_of(pair.i)];
      pair.i = place[pair.i], pair.j = place[pair.j];
      cluster.pairs.push_back(pair);
    }
    std::erase_if(of_root, [](const Cluster& cluster) { return cluster.members.empty(); });
    clusters_ = std::move(of_root);
  }

  bool advance_clusters(double step) {
    for (const Cluster& cluster : clusters_) {
      const std::vector<Vec<Dim>> before = positions(cluster);
      if (cluster.members.size() == 1)
        c_.position[cluster.members[0]] += step * c_.velocity[cluster.members[0]];
      else
        integrate(cluster, step);
      for (std::size_t k = 0; k < before.size(); ++k)
        if ((c_.position[cluster.members[k]] - before[k]).norm() > 0.5 * margin_) return false;
    }
    return true;
  }

  std::vector<Vec<Dim>> positions(const Cluster& cluster) const {
    std::vector<Vec<Dim>> all;
    for (const std::size_t i : cluster.members) all.push_back(c_.position[i]);
    return all;
  }

  void integrate(const Cluster& cluster, double duration) {
    namespace odeint = boost::numeric::odeint;
    const std::size_t n = cluster.members.size();
    const Vec<Dim> origin = c_.position[cluster.members[0]];
    State x(2 * n * Dim);
    for (std::size_t k = 0; k < n; ++k) {
      part(x, k) = c_.position[cluster.members[k]] - origin;
      part(x, n + k) = c_.velocity[cluster.members[k]];
    }
    const auto motion = [&](const State& at, State& slope, double) { move(cluster, at, slope); };
    odeint::integrate_adaptive(odeint::make_controlled(tolerance_, tolerance_, longest_step_,
                                                       odeint::runge_kutta_dopri5<State>()),
                               motion, x, 0.0, duration, std::min(duration, longest_step_));
    for (std::size_t k = 0; k < n; ++k) {
      c_.position[cluster.members[k]] = origin + part(x, k);
      c_.velocity[cluster.members[k]] = part(x, n + k);
    }
  }

  void move(const Cluster& cluster, const State& x, State& slope) const {
    const std::size_t n = cluster.members.size();
    for (std::size_t k = 0; k < n; ++k) {
      part(slope, k) = part(x, n + k);
      part(slope, n + k).setZero();
    }
    for (const SoftPair<Dim>& pair : cluster.pairs) {
      const Vec<Dim> force =
          pair.force(force_, part(x, pair.j) + pair.translation - part(x, pair.i),
                     part(x, n + pair.j) - part(x, n + pair.i));
      part(slope, n + pair.i) -= force / c_.mass[cluster.members[pair.i]];
      part(slope, n + pair.j) += force / c_.mass[cluster.members[pair.j]];
    }
  }

  static Eigen::Map<Vec<Dim>> part(State& x, std::size_t k) {
    return Eigen::Map<Vec<Dim>>(x.data() + k * Dim);
  }
  static Eigen::Map<const Vec<Dim>> part(const State& x, std::size_t k) {
    return Eigen::Map<const Vec<Dim>>(x.data() + k * Dim);
  }
  Configuration<Dim> c_;
  Force force_;
  double tolerance_, longest_step_, margin_;
  std::vector<Cluster> clusters_;
};

}  // namespace vitrel::bench
