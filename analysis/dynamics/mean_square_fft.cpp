#include "analysis/dynamics/mean_square_fft.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <numeric>

#include "analysis/structure/fourier_arrays.h"

namespace vitrel {

namespace {

/// Makes a plan and executes it once.
void transform(fftw_plan (*plan)(double*, std::size_t), double* numbers, std::size_t length) {
  fftw_execute(FourierPlan(length / 2 + 1, [&] { return plan(numbers, length); }).get());
}

fftw_plan forwards(double* numbers, std::size_t length) {
  return fftw_plan_dft_r2c_1d(static_cast<int>(length), numbers,
                              reinterpret_cast<fftw_complex*>(numbers), FFTW_ESTIMATE);
}

fftw_plan backwards(double* numbers, std::size_t length) {
  return fftw_plan_dft_c2r_1d(static_cast<int>(length), reinterpret_cast<fftw_complex*>(numbers),
                              numbers, FFTW_ESTIMATE);
}

/// Σ_k x_k x_{k+n} for n = 0 … T − 1: twice as much room keeps the ends from meeting.
std::vector<double> autocorrelation(const std::vector<double>& x) {
  const std::size_t length = std::bit_ceil(2 * x.size());
  const FourierArray<double> room = real_array(length + 2);
  double* const numbers = room.get();
  std::fill_n(std::copy(x.begin(), x.end(), numbers), length + 2 - x.size(), 0.0);
  transform(forwards, numbers, length);
  for (std::size_t k = 0; k < length + 2; k += 2) {
    numbers[k] = numbers[k] * numbers[k] + numbers[k + 1] * numbers[k + 1];
    numbers[k + 1] = 0;
  }
  transform(backwards, numbers, length);
  std::vector<double> result(numbers, numbers + x.size());
  for (double& value : result) value /= static_cast<double>(length);
  return result;
}

}  // namespace

std::vector<double> mean_square_changes(std::span<const double> series) {
  if (series.empty()) return {};
  const std::size_t count = series.size();
  std::vector<double> x(series.begin(), series.end());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(count);
  for (double& value : x) value -= mean;
  std::vector<double> result = autocorrelation(x);
  double squares = 2 * std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
  for (std::size_t n = 0; n < count; ++n) {
    result[n] = (squares - 2 * result[n]) / static_cast<double>(count - n);
    squares -= x[n] * x[n] + x[count - 1 - n] * x[count - 1 - n];
  }
  return result;
}

}  // namespace vitrel
