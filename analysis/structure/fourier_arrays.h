#pragma once

#include <fftw3.h>

#include <cstddef>
#include <memory>

/// @file
/// Memory for FFTW, and sizes for which its transforms are fast.
namespace vitrel {

template <class T>
struct FreeFourierArray {
  void operator()(T* array) const { fftw_free(array); }
};
template <class T>
using FourierArray = std::unique_ptr<T[], FreeFourierArray<T>>;

inline FourierArray<double> real_array(std::size_t n) {
  return FourierArray<double>(fftw_alloc_real(n));
}
inline FourierArray<fftw_complex> complex_array(std::size_t n) {
  return FourierArray<fftw_complex>(fftw_alloc_complex(n));
}

/// The smallest even number from n on without prime factors above 7, for which transforms are fast.
inline int fast_size(int n) {
  for (n += n % 2;; n += 2) {
    int rest = n;
    for (const int prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

}  // namespace vitrel
