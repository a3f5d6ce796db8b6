#include <dlfcn.h>
#include <fftw3.h>
#include <gtest/gtest.h>

#include <functional>
#include <new>

#include "analysis/statistics/gsl_errors.h"
#include "analysis/structure/density_grid.h"
#include "analysis/structure/two_point.h"
#include "tests/support/particles_of.h"

/// FFTW's allocations and plans are counted; a chosen one returns nothing.
namespace {
int calls = 0, failing_call = 0;  // from 1; 0: none

template <class T>
T* unless_it_fails(T* result) {
  return ++calls == failing_call ? nullptr : result;
}

template <class Function>
Function* own(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
}  // namespace

// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name)
extern "C" double* fftw_alloc_real(std::size_t n) {
  return unless_it_fails(own(&fftw_alloc_real, "fftw_alloc_real")(n));
}
extern "C" fftw_complex* fftw_alloc_complex(std::size_t n) {
  return unless_it_fails(own(&fftw_alloc_complex, "fftw_alloc_complex")(n));
}
extern "C" fftw_plan fftw_plan_many_dft_r2c(int rank, const int* n, int many, double* in,
                                            const int* in_size, int in_stride, int in_distance,
                                            fftw_complex* out, const int* out_size, int out_stride,
                                            int out_distance, unsigned flags) {
  return unless_it_fails(own(&fftw_plan_many_dft_r2c, "fftw_plan_many_dft_r2c")(
      rank, n, many, in, in_size, in_stride, in_distance, out, out_size, out_stride, out_distance,
      flags));
}
extern "C" fftw_plan fftw_plan_dft_r2c_3d(int x, int y, int z, double* in, fftw_complex* out,
                                          unsigned flags) {
  return unless_it_fails(
      own(&fftw_plan_dft_r2c_3d, "fftw_plan_dft_r2c_3d")(x, y, z, in, out, flags));
}
extern "C" fftw_plan fftw_plan_dft_c2r_3d(int x, int y, int z, fftw_complex* in, double* out,
                                          unsigned flags) {
  return unless_it_fails(
      own(&fftw_plan_dft_c2r_3d, "fftw_plan_dft_c2r_3d")(x, y, z, in, out, flags));
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)

namespace vitrel {
namespace {

/// Every allocation and every plan of the work that fails is reported, and the work succeeds after it.
void expect_reported(const std::function<void()>& work) {
  const auto count_calls = [&] {
    calls = failing_call = 0;
    work();
    return calls;
  };
  const int count = count_calls();
  ASSERT_GE(count, 5);
  for (int k = 1; k <= count; ++k) {
    calls = 0;
    failing_call = k;
    EXPECT_THROW(work(), std::bad_alloc) << k;
  }
  EXPECT_EQ(count_calls(), count);
}

TEST(ShortMemory, OfDensityGrids) {
  expect_reported([] {
    const DensityGrid<2> grid({10, 10}, 0, 3);
    const std::vector<Vec2> origin{Vec2::Zero()};
    EXPECT_EQ(grid.modes(origin, {{1.0}}).size(), 1);
  });
}

TEST(ShortMemory, OfTwoPointGrids) {
  const auto sphere = particles_of<3>({{Vec3(1, 1, 1)}}, {4, 4, 4});
  expect_reported([&] { TwoPointGrid(sphere).measure(sphere); });
}

// GSL's own handler would end the process.
TEST(ErrorsOfGsl, AreResultsUnlessAHandlerIsSet) {
  gsl_error("not wanted here", __FILE__, __LINE__, GSL_EDOM);
  static int number = 0;
  gsl_error_handler_t* const before =
      gsl_set_error_handler([](const char*, const char*, int, int given) { number = given; });
  gsl_error("wanted", __FILE__, __LINE__, GSL_EDOM);
  static_cast<void>(gsl_set_error_handler(before));
  EXPECT_EQ(number, GSL_EDOM);
  EXPECT_NO_THROW(check_gsl(GSL_SUCCESS));
  EXPECT_THROW(check_gsl(GSL_ENOMEM), std::bad_alloc);
  EXPECT_THROW(check_gsl(GSL_EDOM), std::runtime_error);
}

}  // namespace
}  // namespace vitrel
