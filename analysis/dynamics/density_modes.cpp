#include "analysis/dynamics/density_modes.h"

#include <algorithm>
#include <cmath>

namespace vitrel {

namespace {

/// Number of particles whose phases stay in the cache.
constexpr std::size_t block = 32;

/// exp(i n φ) of a block of particles for n = 0 … order, with real and imaginary parts apart.
class Powers {
 public:
  explicit Powers(int order)
      : real_((static_cast<std::size_t>(order) + 1) * block), imaginary_(real_.size()) {
    std::fill_n(real_.begin(), block, 1.0);
  }

  void set(std::size_t p, double phase) {
    if (real_.size() == block) return;
    real_[block + p] = std::cos(phase);
    imaginary_[block + p] = std::sin(phase);
  }
  void multiply() {
    const double *re = real_.data(), *im = imaginary_.data();
    for (std::size_t from = block; from + block < real_.size(); from += block)
      for (std::size_t p = 0; p < block; ++p) {
        const double c = re[from + p], s = im[from + p];
        real_[from + block + p] = c * re[block + p] - s * im[block + p];
        imaginary_[from + block + p] = c * im[block + p] + s * re[block + p];
      }
  }
  const double* real(int n) const { return &real_[static_cast<std::size_t>(n) * block]; }
  const double* imaginary(int n) const { return &imaginary_[static_cast<std::size_t>(n) * block]; }

 private:
  std::vector<double> real_, imaginary_;
};

/// Returns the sum over the particles of a block.
template <std::size_t Dim>
std::complex<double> sum(const std::vector<Powers>& powers, const std::array<int, Dim>& n,
                         std::size_t count) {
  std::array<const double*, Dim> real_parts, imaginary_parts;
  std::array<double, Dim> sign;
  for (std::size_t d = 0; d < Dim; ++d) {
    real_parts[d] = powers[d].real(std::abs(n[d]));
    imaginary_parts[d] = powers[d].imaginary(std::abs(n[d]));
    sign[d] = n[d] < 0 ? -1 : 1;
  }
  double real[2] = {}, imaginary[2] = {};  // even and odd particles are added at once
  for (std::size_t p = 0; p < count; ++p) {
    double re = real_parts[0][p], im = sign[0] * imaginary_parts[0][p];
    for (std::size_t d = 1; d < Dim; ++d) {
      const double c = real_parts[d][p], s = sign[d] * imaginary_parts[d][p];
      const double next = re * c - im * s;
      im = re * s + im * c;
      re = next;
    }
    real[p % 2] += re;
    imaginary[p % 2] += im;
  }
  return {real[0] + real[1], imaginary[0] + imaginary[1]};
}

}  // namespace

template <int Dim>
DensityModes<Dim>::DensityModes(std::vector<Index> vectors, const PeriodicBox<Dim>& box)
    : vectors_(std::move(vectors)), unit_(reciprocal_lengths(box)) {
  for (const Index& n : vectors_)
    for (std::size_t d = 0; d < Dim; ++d) order_[d] = std::max(order_[d], std::abs(n[d]));
}

template <int Dim>
std::vector<std::complex<double>> DensityModes<Dim>::of(
    const std::vector<Vec<Dim>>& positions) const {
  std::vector<std::complex<double>> sums(vectors_.size());
  std::vector<Powers> powers(order_.begin(), order_.end());
  for (std::size_t begin = 0; begin < positions.size(); begin += block) {
    const std::size_t count = std::min(block, positions.size() - begin);
    for (std::size_t d = 0; d < Dim; ++d) {
      const int axis = static_cast<int>(d);
      for (std::size_t p = 0; p < count; ++p)
        powers[d].set(p, unit_[axis] * positions[begin + p][axis]);
      powers[d].multiply();
    }
    for (std::size_t v = 0; v < vectors_.size(); ++v) sums[v] += sum(powers, vectors_[v], count);
  }
  return sums;
}

template class DensityModes<2>;
template class DensityModes<3>;

}  // namespace vitrel
