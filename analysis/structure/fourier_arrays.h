#pragma once

#include <fftw3.h>

#include <cstddef>
#include <memory>
#include <mutex>

#include "core/io/checked.h"

/// @file
/// Memory and plans for FFTW, and sizes for which its transforms are fast.
namespace vitrel {

struct FreeFourierArray {
  void operator()(void* array) const { fftw_free(array); }
};
template <class T>
using FourierArray = std::unique_ptr<T[], FreeFourierArray>;

inline FourierArray<double> real_array(std::size_t n) {
  return FourierArray<double>(obtained(fftw_alloc_real(n)));
}
inline FourierArray<fftw_complex> complex_array(std::size_t n) {
  return FourierArray<fftw_complex>(obtained(fftw_alloc_complex(n)));
}

/// A plan of FFTW. Any number of threads may execute plans at a time; for planning they wait for each other.
class FourierPlan {
 public:
  /// `make` returns a new plan of a transform of `n` complex numbers. FFTW ends the process if its planner runs out of
  /// memory. The planner needs no more than these numbers and two megabytes, so this much memory is requested first.
  template <class Make>
  FourierPlan(std::size_t n, Make&& make) {
    constexpr std::size_t margin = std::size_t{2} << 20;
    complex_array(n + margin / sizeof(fftw_complex));
    const std::lock_guard lock(planning_);
    plan_ = obtained(make());
  }
  ~FourierPlan() {
    const std::lock_guard lock(planning_);
    fftw_destroy_plan(plan_);
  }
  FourierPlan(const FourierPlan&) = delete;
  FourierPlan& operator=(const FourierPlan&) = delete;

  fftw_plan get() const { return plan_; }

 private:
  static inline std::mutex planning_;
  fftw_plan plan_;
};

/// Returns the smallest even number ≥ n without prime factors above 7, for which transforms are fast.
inline int fast_size(int n) {
  for (n += n % 2;; n += 2) {
    int rest = n;
    for (const int prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

}  // namespace vitrel
